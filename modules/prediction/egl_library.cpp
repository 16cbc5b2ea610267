#include "modules/prediction/egl_library.hpp"

#include <algorithm>
#include <dlfcn.h>
#include <string_view>

#include "framework/core/error.hpp"

namespace ppm {
namespace {

template <class F>
void load(const EglLibrary& egl, const char* name, F& function) {
  function = reinterpret_cast<F>(egl.GetProcAddress(name));
}

EglLibrary open_library() {
  void* library = ::dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
  if (!library) throw Error(fmt::format("EGL is not installed: {}", ::dlerror()));
  EglLibrary egl;
  egl.GetProcAddress = reinterpret_cast<PFNEGLGETPROCADDRESSPROC>(::dlsym(library, "eglGetProcAddress"));
  if (!egl.GetProcAddress) throw Error("libEGL.so.1 has no eglGetProcAddress");
  load(egl, "eglBindAPI", egl.BindAPI);
  load(egl, "eglCreateContext", egl.CreateContext);
  load(egl, "eglDestroyContext", egl.DestroyContext);
  load(egl, "eglGetError", egl.GetError);
  load(egl, "eglInitialize", egl.Initialize);
  load(egl, "eglMakeCurrent", egl.MakeCurrent);
  load(egl, "eglQueryString", egl.QueryString);
  load(egl, "eglReleaseThread", egl.ReleaseThread);
  load(egl, "eglGetPlatformDisplayEXT", egl.GetPlatformDisplay);
  if (!egl.BindAPI || !egl.CreateContext || !egl.DestroyContext || !egl.GetError || !egl.Initialize ||
      !egl.MakeCurrent || !egl.QueryString || !egl.ReleaseThread || !egl.GetPlatformDisplay)
    throw Error("this EGL cannot do without a display: it lacks eglGetPlatformDisplayEXT");
  const char* client = egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const bool lists =
      has_extension(client, "EGL_EXT_device_base") || has_extension(client, "EGL_EXT_device_enumeration");
  if (lists && has_extension(client, "EGL_EXT_platform_device")) {
    load(egl, "eglQueryDevicesEXT", egl.QueryDevices);
    load(egl, "eglQueryDeviceStringEXT", egl.QueryDeviceString);
  }
  return egl;
}

}  // namespace

const EglLibrary& EglLibrary::get() {
  static const EglLibrary egl = open_library();
  return egl;
}

std::vector<EglDisplayChoice> egl_displays(const EglLibrary& egl) {
  std::vector<EglDisplayChoice> choices;
  EGLDeviceEXT devices[32];
  EGLint count = 0;
  if (egl.QueryDevices && egl.QueryDeviceString && egl.QueryDevices(32, devices, &count)) {
    for (EGLint i = 0; i < count; ++i)
      choices.push_back({fmt::format("device {}", i),
                         has_extension(egl.QueryDeviceString(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software"),
                         egl.GetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr)});
    std::ranges::stable_partition(choices, [](const auto& c) { return !c.software; });
  } else if (has_extension(egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless")) {
    choices.push_back({"Mesa's surfaceless platform", false,
                       egl.GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)});
  }
  return choices;
}

bool has_extension(const char* list, const char* name) {
  std::string_view rest = list ? list : "";
  while (!rest.empty()) {
    const auto end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == name) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

}  // namespace ppm
