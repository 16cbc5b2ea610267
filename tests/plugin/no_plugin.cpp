// A shared library that has nothing to do with ppm.
extern "C" int answer() {
  return 42;
}
