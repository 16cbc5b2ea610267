#include "framework/slam/camera_parameters.hpp"

#include <cmath>

namespace ppm {

std::string to_string(CameraParameter parameter) {
  switch (parameter) {
    case CameraParameter::focal: return "focal_scale";
    case CameraParameter::cx: return "cx_shift";
    case CameraParameter::cy: return "cy_shift";
    case CameraParameter::bend: return "depth_bend";
    case CameraParameter::bend_x: return "depth_bend_x";
    case CameraParameter::bend_y: return "depth_bend_y";
    case CameraParameter::bend_radial: return "depth_bend_radial";
  }
  return "";
}

CameraCorrection CameraParameters::moved(const CameraCorrection& from, const Eigen::VectorXd& step) const {
  CameraCorrection out = from;
  for (Eigen::Index k = 0; k < size(); ++k) {
    switch (free[static_cast<std::size_t>(k)]) {
      case CameraParameter::focal: out.focal_scale *= std::exp(step[k]); break;
      case CameraParameter::cx: out.cx_shift += step[k]; break;
      case CameraParameter::cy: out.cy_shift += step[k]; break;
      case CameraParameter::bend:
        out.depth_bend += step[k];
        out.depth_factor *= (1 - out.depth_bend * pivot_m) / (1 - from.depth_bend * pivot_m);
        break;
      case CameraParameter::bend_x: out.depth_bend_x += step[k]; break;
      case CameraParameter::bend_y: out.depth_bend_y += step[k]; break;
      case CameraParameter::bend_radial: out.depth_bend_radial += step[k]; break;
    }
  }
  return out;
}

}  // namespace ppm
