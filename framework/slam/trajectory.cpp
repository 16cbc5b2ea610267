#include "framework/slam/trajectory.hpp"

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

}  // namespace ppm
