#pragma once
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <string>

#include "framework/slam/frame.hpp"

namespace ppm {

/// The image of a scan whose outside files are loaded: camera, T_base_camera, depth, confidence, and colour if asked for. Where
/// the camera's lens distorts, each pixel is that of the scan whose ray is nearest, so that no value is a mean of several.
/// Throws std::runtime_error with the reason where the scan has no such image.
Frame frame_of_scan(const mrpt::obs::CObservation3DRangeScan& scan, bool with_color);

}  // namespace ppm
