#pragma once
#include <cstddef>
#include <vector>

#include "framework/core/se3.hpp"
#include "framework/roles/view_predictor.hpp"

namespace ppm {

/// Particles that may be weighed against one view.
struct ViewGroup {
  Pose pose = Pose::Identity();      ///< T_map_camera of the view: the mean of the members', or one of them
  std::vector<std::size_t> members;  ///< ascending
};

struct GroupLimits {
  double distance_m = 0, angle_rad = 0;  ///< at most, from the view's pose to a member's
  std::size_t least = 2;                 ///< members
};

/// Groups of views of one map within the limits, by their indices; views in no group are left to themselves. About the
/// mean of all that are left, or else about the first of them, as many as the limits allow at a time. A pure function of
/// the views and their order; which maps are the same counts, not where they are.
std::vector<ViewGroup> group_views(const std::vector<ViewPredictor::ExpectedView>& views, const GroupLimits& limits);

}  // namespace ppm
