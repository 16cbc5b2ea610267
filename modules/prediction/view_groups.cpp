#include "modules/prediction/view_groups.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace ppm {
namespace {

using Indices = std::vector<std::size_t>;

// Poses as positions and quaternions, which are quick to compare.
class Poses {
 public:
  Poses(const std::vector<ViewPredictor::ExpectedView>& views, const GroupLimits& limits) : limits_(limits) {
    for (const auto& view : views) {
      position_.push_back(view.T_map_camera.translation());
      rotation_.push_back(Eigen::Quaterniond(view.T_map_camera.linear()).coeffs());
    }
  }

  Pose mean(const Indices& of) const {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector4d rotation = Eigen::Vector4d::Zero();
    for (auto i : of) {
      position += position_[i];
      rotation += rotation_[i].dot(rotation_[of.front()]) < 0 ? -rotation_[i] : rotation_[i];
    }
    Pose pose = Pose::Identity();
    pose.translation() = position / static_cast<double>(of.size());
    pose.linear() = Eigen::Quaterniond(rotation.normalized()).toRotationMatrix();
    return pose;
  }

  Indices near(const Pose& pose, const Indices& candidates) const {
    const Eigen::Vector4d rotation = Eigen::Quaterniond(pose.linear()).coeffs();
    const double least_cosine = std::cos(limits_.angle_rad / 2), most = limits_.distance_m * limits_.distance_m;
    Indices found;
    for (auto i : candidates)
      if ((position_[i] - pose.translation()).squaredNorm() <= most &&
          std::abs(rotation_[i].dot(rotation)) >= least_cosine)
        found.push_back(i);
    return found;
  }

 private:
  const GroupLimits& limits_;
  std::vector<Eigen::Vector3d> position_;
  std::vector<Eigen::Vector4d> rotation_;
};

// The largest of some tries, the first of equals.
ViewGroup largest_group(const Poses& poses, const Indices& left, const Pose& first, std::size_t least) {
  const Pose all = poses.mean(left);
  ViewGroup best{all, poses.near(all, left)};
  if (best.members.size() < least) best = {first, poses.near(first, left)};
  const Pose centre = best.members.empty() ? first : poses.mean(best.members);
  ViewGroup again{centre, poses.near(centre, left)};
  return again.members.size() >= best.members.size() ? again : best;
}

}  // namespace

std::vector<ViewGroup> group_views(const std::vector<ViewPredictor::ExpectedView>& views, const GroupLimits& limits) {
  std::vector<Indices> by_map;
  std::unordered_map<const Map*, std::size_t> number;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto [found, is_new] = number.emplace(views[i].map, by_map.size());
    if (is_new) by_map.emplace_back();
    by_map[found->second].push_back(i);
  }
  const Poses poses(views, limits);
  std::vector<ViewGroup> groups;
  for (Indices& left : by_map) {
    while (left.size() >= limits.least) {
      ViewGroup group = largest_group(poses, left, views[left.front()].T_map_camera, limits.least);
      Indices done = group.members;
      if (done.size() >= limits.least)
        groups.push_back(std::move(group));
      else
        done = {left.front()};
      Indices rest;
      std::set_difference(left.begin(), left.end(), done.begin(), done.end(), std::back_inserter(rest));
      left = std::move(rest);
    }
  }
  return groups;
}

}  // namespace ppm
