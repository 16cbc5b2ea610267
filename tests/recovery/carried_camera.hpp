#pragma once
#include <atomic>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/config.hpp"
#include "framework/graph/executor.hpp"
#include "framework/roles/frame_source.hpp"
#include "framework/slam/belief_digest.hpp"
#include "modules/builtin.hpp"
#include "modules/sources/room_path.hpp"
#include "modules/sources/room_scene.hpp"
#include "modules/sources/tof_camera.hpp"

namespace ppm::test {

/// The synthetic room, seen from stretches of its path: between two stretches the camera is carried with its eye shut.
class CarriedCamera final : public FrameSource {
 public:
  CarriedCamera() { params_.add("stretches", stretches_).required().doc("\"0-60 20-40\": images of the room's sequence, each second."); }

 private:
  class Sequence final : public FrameSequence {
   public:
    explicit Sequence(std::vector<std::int64_t> images) : images_(std::move(images)), room_(make_room()) {}
    std::string name() const override { return "carried camera"; }
    std::int64_t size() const override { return static_cast<std::int64_t>(images_.size()); }
    double stamp_s(std::int64_t i) const override { return static_cast<double>(2 * i) / kRoomRateHz; }
    std::optional<Pose> reference_pose(std::int64_t i) const override {
      return room_camera_pose(static_cast<double>(images_[static_cast<std::size_t>(i)]) / kRoomRateHz);
    }
    Frame read(std::int64_t i) const override {
      Frame frame;
      frame.index = i;
      frame.stamp_s = stamp_s(i);
      frame.T_world_camera_ref = reference_pose(i);
      TofCamera().render(room_, *frame.T_world_camera_ref, 1, frame);
      return frame;
    }

   private:
    std::vector<std::int64_t> images_;
    AnalyticScene room_;
  };

  std::unique_ptr<const FrameSequence> open_sequence() const override {
    std::vector<std::int64_t> images;
    std::istringstream in(stretches_);
    std::int64_t first = 0, last = 0;
    char dash = 0;
    while (in >> first >> dash >> last)
      for (auto i = first; i <= last; i += 2) images.push_back(i);
    return std::make_unique<Sequence>(std::move(images));
  }
  std::string stretches_;
};

/// A run of a graph that may have a `source.carried`, frame by frame.
class CarriedRun {
 public:
  explicit CarriedRun(const std::string& yaml, int threads = 1)
      : graph_(Graph::build(parse_yaml(yaml, "carried.yaml"), registry())),
        workers_(threads),
        context_(workers_, log_, metrics_, graph_.seed(), {}),
        executor_(graph_, context_) {}
  /// Goes on until so many frames are done.
  void run_to(std::int64_t frames) { executor_.run(frames, stop_); }
  const ParticleSet& belief() const { return executor_.belief(); }
  std::string digest() const { return belief_digest(belief(), workers_); }
  Executor& executor() { return executor_; }
  /// The values of a metric, a frame each.
  std::vector<double> metric(const std::string& name) const {
    std::vector<double> values;
    for (const auto& entry : metrics_.columns().at(name)) values.push_back(entry.value);
    return values;
  }
  static const Registry& registry() {
    static const Registry all = [] {
      Registry r;
      register_builtin(r);
      r.add<CarriedCamera>("source.carried", "The room, in stretches.", "None.");
      return r;
    }();
    return all;
  }

 private:
  Graph graph_;
  Workers workers_;
  Log log_{LogLevel::error};
  Metrics metrics_;
  Context context_;
  std::atomic<bool> stop_{false};
  Executor executor_;
};

}  // namespace ppm::test
