#pragma once
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <string>
#include <vector>

namespace ppm {

/// EGL by pointers into libEGL.so.1, which is loaded when it is first asked for and stays loaded.
struct EglLibrary {
  PFNEGLGETPROCADDRESSPROC GetProcAddress = nullptr;
  PFNEGLBINDAPIPROC BindAPI = nullptr;
  PFNEGLCREATECONTEXTPROC CreateContext = nullptr;
  PFNEGLDESTROYCONTEXTPROC DestroyContext = nullptr;
  PFNEGLGETERRORPROC GetError = nullptr;
  PFNEGLINITIALIZEPROC Initialize = nullptr;
  PFNEGLMAKECURRENTPROC MakeCurrent = nullptr;
  PFNEGLQUERYSTRINGPROC QueryString = nullptr;
  PFNEGLRELEASETHREADPROC ReleaseThread = nullptr;
  PFNEGLGETPLATFORMDISPLAYEXTPROC GetPlatformDisplay = nullptr;
  PFNEGLQUERYDEVICESEXTPROC QueryDevices = nullptr;            ///< null where EGL cannot list devices
  PFNEGLQUERYDEVICESTRINGEXTPROC QueryDeviceString = nullptr;  ///< null where EGL cannot list devices

  /// Throws Error where there is no EGL that can do without a display.
  static const EglLibrary& get();
};

/// Whoever calls EGL has one of these on the stack: at its end EGL forgets the thread. EGL frees what it keeps of a
/// thread when the thread ends, and once more when the process does: a worker that ends at that very time would crash
/// it.
class EglThread {
 public:
  EglThread() : egl_(EglLibrary::get()) {}
  EglThread(const EglThread&) = delete;
  EglThread& operator=(const EglThread&) = delete;
  ~EglThread() { egl_.ReleaseThread(); }

 private:
  const EglLibrary& egl_;
};

/// A way to a device that EGL knows.
struct EglDisplayChoice {
  std::string name;       ///< for messages: "device 0", "Mesa's surfaceless platform"
  bool software = false;  ///< the processor draws
  EGLDisplay display = EGL_NO_DISPLAY;
};

/// Devices in EGL's own order, those of hardware first; Mesa's surfaceless platform where devices cannot be listed.
/// None is opened yet.
std::vector<EglDisplayChoice> egl_displays(const EglLibrary& egl);

/// Whether a list of extensions, separated by spaces, holds one. list: null holds none.
bool has_extension(const char* list, const char* name);

}  // namespace ppm
