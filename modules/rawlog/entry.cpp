// What the program finds in the library that speaks MRPT.
#include "modules/rawlog/reader.hpp"
#include "modules/rawlog/writer.hpp"

extern "C" __attribute__((visibility("default"))) const ppm::RawlogLibrary ppm_rawlog_library{&ppm::open_rawlog,
                                                                                              &ppm::rawlog_bytes};
