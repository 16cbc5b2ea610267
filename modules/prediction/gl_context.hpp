#pragma once
#include <memory>
#include <string>

namespace ppm {

struct GlFunctions;

/// Which devices may draw.
enum class GlDevice {
  any,       ///< hardware where there is some, else the processor (Mesa's llvmpipe)
  hardware,  ///< hardware only
  software   ///< the processor only
};

/// An OpenGL 4.5 context without a display, by EGL. It belongs to no thread: whoever draws makes it current for that
/// time, one thread at a time. The connection to the device, which all contexts of the process share, stays open.
class GlContext {
 public:
  /// Throws Error, with each device's reason, where none can draw.
  explicit GlContext(GlDevice wanted);
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;
  ~GlContext();

  /// The context is current on this thread as long as this lives.
  class Current {
   public:
    explicit Current(const GlContext& context);
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;
    ~Current();

   private:
    const GlContext& context_;
  };

  const GlFunctions& gl() const { return *gl_; }
  /// Device and driver, for the log: "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 (Core Profile) Mesa 22.3.6".
  const std::string& renderer() const { return renderer_; }
  /// Throws Error where a call since the last check failed. The context must be current.
  void check() const;

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
  std::unique_ptr<GlFunctions> gl_;
  std::string renderer_;
};

}  // namespace ppm
