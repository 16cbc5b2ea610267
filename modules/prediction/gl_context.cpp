#include "modules/prediction/gl_context.hpp"

#include "framework/core/error.hpp"
#include "modules/prediction/egl_library.hpp"
#include "modules/prediction/gl_functions.hpp"

namespace ppm {
namespace {

// A context on an opened display, or null with the reason.
EGLContext make_context(const EglLibrary& egl, const EglDisplayChoice& choice, std::string& reason) {
  if (choice.display == EGL_NO_DISPLAY || !egl.Initialize(choice.display, nullptr, nullptr)) {
    reason = fmt::format("cannot be opened (EGL error {:#x})", egl.GetError());
    return EGL_NO_CONTEXT;
  }
  const char* extensions = egl.QueryString(choice.display, EGL_EXTENSIONS);
  for (const char* needed : {"EGL_KHR_surfaceless_context", "EGL_KHR_no_config_context"})
    if (!has_extension(extensions, needed)) {
      reason = fmt::format("lacks {}", needed);
      return EGL_NO_CONTEXT;
    }
  const EGLint attributes[] = {
      EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  egl.BindAPI(EGL_OPENGL_API);
  EGLContext context = egl.CreateContext(choice.display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  if (context == EGL_NO_CONTEXT) reason = fmt::format("has no OpenGL 4.5 (EGL error {:#x})", egl.GetError());
  return context;
}

bool gl_extension(const GlFunctions& gl, const char* name) {
  GLint count = 0;
  gl.GetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLint i = 0; i < count; ++i)
    if (has_extension(reinterpret_cast<const char*>(gl.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i))), name))
      return true;
  return false;
}

// Loads the functions of the current context. Returns what it lacks, or nothing.
std::string load_functions(const EglLibrary& egl, GlFunctions& gl) {
#define PPM_GL_LOAD(name, type)                                                  \
  gl.name = reinterpret_cast<PFNGL##type##PROC>(egl.GetProcAddress("gl" #name)); \
  if (!gl.name) return "lacks gl" #name;
  PPM_GL_FUNCTIONS(PPM_GL_LOAD)
#undef PPM_GL_LOAD
  if (!gl_extension(gl, "GL_ARB_shader_viewport_layer_array")) return "lacks GL_ARB_shader_viewport_layer_array";
  return {};
}

const char* text(const GlFunctions& gl, GLenum name) {
  return reinterpret_cast<const char*>(gl.GetString(name));
}

}  // namespace

GlContext::GlContext(GlDevice wanted) : gl_(std::make_unique<GlFunctions>()) {
  const EglLibrary& egl = EglLibrary::get();
  const EglThread thread;
  std::string reasons;
  for (const auto& choice : egl_displays(egl)) {
    if (wanted != GlDevice::any && choice.software != (wanted == GlDevice::software)) continue;
    std::string reason;
    context_ = make_context(egl, choice, reason);
    display_ = choice.display;
    if (context_) {
      egl.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
      reason = load_functions(egl, *gl_);
      if (reason.empty()) {
        renderer_ = fmt::format("{}, {}", text(*gl_, GL_RENDERER), text(*gl_, GL_VERSION));
        return;
      }
      egl.DestroyContext(display_, context_);  // goes when the thread is released
    }
    context_ = nullptr;
    reasons += fmt::format("; {} {}", choice.name, reason);
  }
  const char* kind = wanted == GlDevice::hardware ? "hardware " : wanted == GlDevice::software ? "software " : "";
  throw Error(fmt::format(
      "no {}device for OpenGL without a display{}", kind,
      reasons.empty() ? ": EGL knows none (is Mesa's libgl1-mesa-dri or the GPU's driver installed?)" : reasons));
}

GlContext::~GlContext() {
  const EglThread thread;
  EglLibrary::get().DestroyContext(display_, context_);
}

GlContext::Current::Current(const GlContext& context) : context_(context) {
  const EglLibrary& egl = EglLibrary::get();
  egl.BindAPI(EGL_OPENGL_API);  // of this thread
  if (egl.MakeCurrent(context.display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context.context_)) return;
  const EGLint error = egl.GetError();
  egl.ReleaseThread();
  throw Error(fmt::format("the OpenGL context cannot be used (EGL error {:#x})", error));
}

GlContext::Current::~Current() {
  const EglThread thread;
  EglLibrary::get().MakeCurrent(context_.display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

void GlContext::check() const {
  const GLenum error = gl_->GetError();
  if (error == GL_NO_ERROR) return;
  if (error == GL_OUT_OF_MEMORY) throw Error("OpenGL: out of device memory");
  throw Error(fmt::format("OpenGL: error {:#x}", error));
}

}  // namespace ppm
