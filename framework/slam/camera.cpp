#include "framework/slam/camera.hpp"

#include "framework/core/error.hpp"

namespace ppm {

Camera Camera::decimated(int stride, int x0, int y0) const {
  PPM_CHECK(stride >= 1 && x0 >= 0 && y0 >= 0, "stride {}, offset ({}, {})", stride, x0, y0);
  auto count = [stride](int size, int offset) { return size > offset ? (size - offset - 1) / stride + 1 : 0; };
  Camera out;
  out.cols = count(cols, x0);
  out.rows = count(rows, y0);
  out.fx = fx / stride;
  out.fy = fy / stride;
  out.cx = (cx - x0) / stride;
  out.cy = (cy - y0) / stride;
  return out;
}

}  // namespace ppm
