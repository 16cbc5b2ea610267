#include <cmath>

#include "framework/graph/registry.hpp"
#include "framework/roles/frame_source.hpp"
#include "modules/sources/room_path.hpp"
#include "modules/sources/room_scene.hpp"
#include "modules/sources/tof_camera.hpp"

namespace ppm {
namespace {

class RoomSurface final : public TrueSurface {
 public:
  explicit RoomSurface(const AnalyticScene& room) : room_(room) {}
  void cast(const Eigen::Vector3d& origin, std::span<const Eigen::Vector3f> direction,
            std::span<float> range_m) const override {
    for (std::size_t i = 0; i < direction.size(); ++i)
      range_m[i] = static_cast<float>(room_.cast(origin, direction[i].cast<double>().normalized()).range_m);
  }
  double distance(const Eigen::Vector3d& p) const override { return std::abs(room_.distance(p)); }

 private:
  const AnalyticScene& room_;
};

class RoomSequence final : public FrameSequence {
 public:
  RoomSequence(std::int64_t frames, std::uint64_t seed, const TofCamera& tof)
      : frames_(frames), seed_(seed), tof_(tof), room_(make_room()) {}

  std::string name() const override { return "synthetic room"; }
  std::int64_t size() const override { return frames_; }
  double stamp_s(std::int64_t index) const override { return static_cast<double>(index) / kRoomRateHz; }
  std::optional<Pose> reference_pose(std::int64_t index) const override { return room_camera_pose(stamp_s(index)); }
  std::unique_ptr<const TrueSurface> true_surface() const override { return std::make_unique<RoomSurface>(room_); }
  Frame read(std::int64_t index) const override {
    Frame frame;
    frame.index = index;
    frame.stamp_s = stamp_s(index);
    frame.T_world_camera_ref = reference_pose(index);
    tof_.render(room_, *frame.T_world_camera_ref, seed_, frame);
    return frame;
  }

 private:
  std::int64_t frames_;
  std::uint64_t seed_;
  TofCamera tof_;
  AnalyticScene room_;
};

/// A furnished room made in code (make_room), seen by a simulated time-of-flight camera (TofCamera) that is carried
/// round (room_camera_pose). Needs no data; poses and geometry are exact.
/// frame   176x144 depth with noise, flying pixels and drop-outs; sigma is the true one; reference poses; color if
///         asked for
/// source  noise model: Lange & Seitz 2001
class SyntheticRoom final : public FrameSource {
 public:
  SyntheticRoom() {
    params_.add("frames", frames_)
        .range(1, 1e6)
        .doc("Length of the sequence. One loop round the room takes 370 frames.");
    params_.add("seed", seed_).range(0, 1e15).doc("Seed of the camera's noise; it does not depend on the run's seed.");
    params_.add("noise", tof_.noise).range(0, 10).doc("Scale of the noise of ranges; 0 gives exact ones.");
    params_.add("flying_pixels", tof_.flying_pixels)
        .doc("Whether pixels at depth edges mix the ranges of what is in them.");
    params_.add("color", tof_.color).doc("Also give a colour image.");
  }

 private:
  std::unique_ptr<const FrameSequence> open_sequence() const override {
    return std::make_unique<RoomSequence>(frames_, static_cast<std::uint64_t>(seed_), tof_);
  }

  std::int64_t frames_ = 380, seed_ = 1;
  TofCamera tof_;
};

}  // namespace
}  // namespace ppm

PPM_MODULES(r) {
  r.add<ppm::SyntheticRoom>("source.synthetic_room",
                            "Makes depth images of a furnished room, as a time-of-flight camera would see it.",
                            "Noise model: Lange & Seitz, IEEE JQE 2001");
}
