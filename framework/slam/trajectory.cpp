#include "framework/slam/trajectory.hpp"

#include <limits>
#include <unordered_map>
#include <utility>

#include "framework/core/error.hpp"

namespace ppm {

Trajectory::Trajectory(const Trajectory& other) noexcept : head_(other.head_) {
  if (head_) head_->count.fetch_add(1, std::memory_order_relaxed);
}

Trajectory::Trajectory(Trajectory&& other) noexcept : head_(std::exchange(other.head_, nullptr)) {}

Trajectory& Trajectory::operator=(Trajectory other) noexcept {
  std::swap(head_, other.head_);
  return *this;
}

Trajectory::~Trajectory() {
  release(head_);
}

void Trajectory::release(Node* node) {
  while (node && node->count.fetch_sub(1, std::memory_order_acq_rel) == 1) delete std::exchange(node, node->parent);
}

Trajectory Trajectory::parent() const {
  PPM_CHECK(head_, "an empty path has no parent");
  if (head_->parent) head_->parent->count.fetch_add(1, std::memory_order_relaxed);
  return Trajectory(head_->parent);
}

void Trajectory::extend(const StampedPose& pose) {
  auto* node = new Node;
  node->length = length() + 1;
  node->parent = head_;  // takes over this handle's share of the old head
  node->value = pose;
  head_ = node;
}

std::vector<StampedPose> Trajectory::poses() const {
  std::vector<StampedPose> path(length());
  auto slot = path.rbegin();
  for (const Node* node = head_; node; node = node->parent) *slot++ = node->value;
  return path;
}

void save(RecordWriter& out, const StampedPose& pose) {
  out.add(pose.frame);
  out.add(pose.stamp_s);
  out.add(pose.T_map_camera);
}

void load(RecordReader& in, StampedPose& pose) {
  in.take(pose.frame);
  in.take(pose.stamp_s);
  in.take(pose.T_map_camera);
}

namespace {

constexpr std::uint32_t kNoNode = std::numeric_limits<std::uint32_t>::max();

}  // namespace

void save_paths(RecordWriter& out, const std::vector<Trajectory>& paths) {
  std::unordered_map<const void*, std::uint32_t> number{{nullptr, kNoNode}};
  std::vector<std::pair<std::uint32_t, StampedPose>> nodes;  // number of the parent, and the pose; parents first
  for (const auto& path : paths) {
    std::vector<Trajectory> fresh;  // the end of the path that no path before it has, newest first
    for (auto at = path; !number.contains(at.identity()); at = at.parent()) fresh.push_back(at);
    for (auto at = fresh.rbegin(); at != fresh.rend(); ++at) {
      number.emplace(at->identity(), static_cast<std::uint32_t>(nodes.size()));
      nodes.emplace_back(number.at(at->parent().identity()), at->last());
    }
  }
  out.add(static_cast<std::uint64_t>(nodes.size()));
  for (const auto& [parent, pose] : nodes) {
    out.add(parent);
    out.add(pose);
  }
  out.add(static_cast<std::uint64_t>(paths.size()));
  for (const auto& path : paths) out.add(number.at(path.identity()));
}

std::vector<Trajectory> load_paths(RecordReader& in) {
  std::vector<Trajectory> nodes;
  auto take_node = [&] {
    const auto i = in.take<std::uint32_t>();
    if (i != kNoNode && i >= nodes.size()) in.fail("has a path that leads nowhere");
    return i == kNoNode ? Trajectory() : nodes[i];
  };
  for (auto n = in.take<std::uint64_t>(); n > 0; --n) {
    auto path = take_node();
    path.extend(in.take<StampedPose>());
    nodes.push_back(std::move(path));
  }
  std::vector<Trajectory> paths;
  for (auto n = in.take<std::uint64_t>(); n > 0; --n) paths.push_back(take_node());
  return paths;
}

}  // namespace ppm
