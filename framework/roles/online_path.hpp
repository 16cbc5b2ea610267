#pragma once
#include <vector>

#include "framework/slam/estimate.hpp"
#include "framework/slam/trajectory.hpp"

namespace ppm {

/// A node that keeps what the filter said of each frame when it was there.
class OnlinePath {
 public:
  virtual ~OnlinePath() = default;
  /// Of the frames that are done, oldest first.
  virtual const std::vector<StampedPose>& online_path() const = 0;
  /// Which pose of the belief it is.
  virtual Estimate online_estimate() const = 0;
};

}  // namespace ppm
