#pragma once

namespace ppm {

struct GlFunctions;

/// Images that views are drawn into, one layer a view: a face's number and a depth for each pixel. Every call, the
/// destructor too, needs the context to be current.
class GlTarget {
 public:
  explicit GlTarget(const GlFunctions& gl) : gl_(gl) {}
  GlTarget(const GlTarget&) = delete;
  GlTarget& operator=(const GlTarget&) = delete;
  ~GlTarget();

  /// Makes at least so many layers of that size; does nothing where they are there. Throws Error where the device
  /// cannot.
  void resize(int cols, int rows, int layers);
  /// Empties the first layers and makes them what is drawn into.
  void start(int layers);
  /// Reads the numbers of the first layers. numbers: [layers * rows * cols].
  void read(int layers, unsigned* numbers) const;

 private:
  void release();

  const GlFunctions& gl_;
  int cols_ = 0, rows_ = 0, layers_ = 0;
  unsigned number_ = 0, depth_ = 0, framebuffer_ = 0;
};

}  // namespace ppm
