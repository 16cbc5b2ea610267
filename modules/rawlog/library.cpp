#include <dlfcn.h>

#include "framework/core/error.hpp"
#include "modules/rawlog/rawlog.hpp"

namespace ppm {

namespace {

RawlogLibrary load_library() {
  void* library = ::dlopen("libppm_rawlog.so", RTLD_NOW | RTLD_LOCAL);
  if (!library) throw Error(fmt::format("the library for rawlogs cannot be loaded: {}", ::dlerror()));
  const auto* table = static_cast<const RawlogLibrary*>(::dlsym(library, "ppm_rawlog_library"));
  if (!table) throw Error("libppm_rawlog.so is not the library for rawlogs");
  return *table;
}

}  // namespace

const RawlogLibrary& RawlogLibrary::get() {
  static const RawlogLibrary library = load_library();
  return library;
}

}  // namespace ppm
