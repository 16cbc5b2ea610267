#pragma once
#include <atomic>
#include <cstdint>
#include <vector>

#include "framework/core/record.hpp"
#include "framework/core/se3.hpp"

namespace ppm {

/// A pose at a time.
struct StampedPose {
  std::int64_t frame = 0;  ///< the source's own number of the frame
  double stamp_s = 0;
  Pose T_map_camera = Pose::Identity();
};
void save(RecordWriter& out, const StampedPose& pose);
void load(RecordReader& in, StampedPose& pose);

/// A path that shares its past with its siblings: each node points at its parent, copies are one pointer.
/// Dropping a path frees the nodes that nobody else needs, iteratively (a path of a million frames does not recurse).
class Trajectory {
 public:
  Trajectory() = default;
  Trajectory(const Trajectory& other) noexcept;
  Trajectory(Trajectory&& other) noexcept;
  Trajectory& operator=(Trajectory other) noexcept;
  ~Trajectory();

  bool empty() const { return head_ == nullptr; }
  const StampedPose& last() const { return head_->value; }
  /// The path without its last pose (empty if there was one or none).
  Trajectory parent() const;
  std::size_t length() const { return head_ ? head_->length : 0; }
  /// Appends a pose to this handle's path; siblings are untouched.
  void extend(const StampedPose& pose);
  /// All poses, oldest first.
  std::vector<StampedPose> poses() const;
  bool operator==(const Trajectory& other) const { return head_ == other.head_; }
  /// Paths with the same identity are one path in memory, while a handle to it lives; null where it is empty.
  const void* identity() const { return head_; }
  /// How many paths hold on to the last pose: handles, and paths that go on from it. 0 where it is empty.
  std::int64_t holders() const { return head_ ? head_->count.load(std::memory_order_relaxed) : 0; }

 private:
  struct Node {
    std::atomic<std::int64_t> count{1};
    std::size_t length = 1;
    Node* parent = nullptr;
    StampedPose value;
  };
  explicit Trajectory(Node* head) : head_(head) {}
  static void release(Node* node);
  Node* head_ = nullptr;
};

/// Writes paths with the past that they share once, and reads them back sharing it.
void save_paths(RecordWriter& out, const std::vector<Trajectory>& paths);
std::vector<Trajectory> load_paths(RecordReader& in);

}  // namespace ppm
