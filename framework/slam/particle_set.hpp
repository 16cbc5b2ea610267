#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/core/error.hpp"
#include "framework/core/se3.hpp"
#include "framework/slam/column.hpp"
#include "framework/slam/map.hpp"
#include "framework/slam/prediction.hpp"
#include "framework/slam/trajectory.hpp"

namespace ppm {

/// The belief: weighted hypotheses about path and map, as a structure of arrays, index = particle.
/// Invariants: all columns have size() entries; log_weight is normalised (log-sum-exp 0) whenever a weighting or resampling
/// node has ended; pose[i] equals trajectory[i].last() once the first frame has begun.
/// No module keeps state by particle number of its own: it declares a column, so that gather() moves it.
class ParticleSet {
 public:
  std::vector<Pose> pose;  ///< T_map_camera, m
  std::vector<double> log_weight;
  std::vector<Trajectory> trajectory;
  std::vector<MapHandle> map;
  std::vector<PredictionHandle> prediction;  ///< null until a prediction node has run in this frame
  /// Where the source's reference frame lies in the map frame, so that T_map_camera = T_map_world * T_world_camera_ref for exact
  /// poses: identity where the map started at a reference pose; empty where the first frame has none. Set by map.*.
  std::optional<Pose> T_map_world = Pose::Identity();

  /// No particle explains what the camera sees, as a recovery.* node found: no map may learn from the frame.
  bool lost = false;

  std::size_t size() const { return pose.size(); }
  /// n particles at one pose with equal weights and one shared map, in the reference's frame. Drops all paths; typed columns are
  /// resized and kept.
  void init(std::size_t n, const Pose& T_map_camera, MapHandle map_handle);
  /// Appends the particle's new pose for a new frame to its path, and drops its prediction, which was of the frame before.
  void extend(std::size_t i, const StampedPose& pose);
  /// Replaces the pose that this frame's extend() gave (a proposal that looked at the image; a refinement).
  void correct(std::size_t i, const Pose& T_map_camera);
  /// Particle i becomes a copy of particle ancestors[i], in every column. ancestors.size() is the new number of particles.
  void gather(const std::vector<std::uint32_t>& ancestors);
  /// Makes the log weights sum to one (fixed order); returns the log of the sum before. Throws InternalError where none is finite.
  double normalize();
  /// Effective sample size 1 / sum w^2, in [1, size()]. Needs normalised weights.
  double ess() const;
  /// The particle with the largest weight (the lowest index among equals).
  std::size_t best() const;

  /// The column of that name, made on first use with default values. Throws InternalError where the type differs.
  template <class T>
  Column<T>& column(const std::string& name) {
    auto& slot = columns_[name];
    if (auto* saved = dynamic_cast<SavedColumn*>(slot.get())) {
      slot = saved->as<T>();
    } else if (!slot) {
      slot = std::make_unique<Column<T>>();
      slot->resize(size());
    }
    PPM_CHECK(slot->type() == typeid(T), "column '{}' is used with two types", name);
    return static_cast<Column<T>&>(*slot);
  }

  // For keeping a belief in a file: see belief_file.hpp.
  using Columns = std::map<std::string, std::unique_ptr<ColumnBase>>;
  const Columns& columns() const { return columns_; }
  void set_columns(Columns columns) { columns_ = std::move(columns); }

 private:
  Columns columns_;
};

/// What is carried from frame to frame.
using Belief = ParticleSet;

}  // namespace ppm
