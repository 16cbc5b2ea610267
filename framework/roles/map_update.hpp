#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "framework/roles/map_editor.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {

/// Writes frames into every particle's map: the base of every `map_update.*`. It says which frames teach a map how
/// much, by parameters that mean the same for all kinds of map. Frames that are held out, or come while the belief is
/// lost, teach nothing and do not count. Of the others every `keyframe_every`-th is a keyframe, and between these, for a
/// particle that has moved or turned far since its last one, or whose map shows too little of what is measured, a further
/// one. What a frame between keyframes changes is the map's own affair: by default nothing.
class MapUpdate : public MapEditor {
 public:
  In<Frame> frame{this, "frame", "The image to be mapped."};

  /// Who overrides it calls it first.
  void before(Context& context) override;
  MapHandle edit(Context& context, std::size_t particle, MapHandle map, int worker) final;
  void edited(std::size_t particle, std::size_t by) final;
  void save(RecordWriter& out) const override { out.add(mapped_); }
  void load(RecordReader& in) override { in.take(mapped_); }

 protected:
  /// facets: see MapEditor.
  explicit MapUpdate(Facets facets);
  void add_keyframe_params();

  /// The map after a keyframe. For `map` and who calls see MapEditor::edit().
  virtual MapHandle learn(Context& context, std::size_t particle, MapHandle map, int worker) = 0;
  /// Share of the frame's measured pixels where the particle's map shows nothing: of its prediction; 0 where it has
  /// none. Called for frames between the regular keyframes.
  virtual double miss_share(const Map& map, std::size_t particle, int worker);
  /// The map after a frame that is no keyframe. Called after miss_share() of the same particle, by the same worker.
  virtual MapHandle between(Context&, std::size_t, MapHandle map, int) { return map; }
  /// Number of this frame's keyframe, counted from 0: the regular one that it is or follows.
  std::int64_t keyframe() const { return number_ / keyframe_every_; }

 private:
  static constexpr const char* kKeyframe = "map_update.keyframe";  // column: where the particle's last keyframe was
  bool has_moved(std::size_t particle) const;

  std::int64_t mapped_ = 0;  // frames that the maps have learnt from
  std::int64_t number_ = 0;  // of this one among them
  bool learns_ = true;       // from this one
  std::int64_t keyframe_every_ = 1;
  double keyframe_misses_ = 0.1, keyframe_distance_ = 0.1, keyframe_angle_;
  std::vector<std::uint8_t> keyframed_;           // by particle, of this frame
  const Column<Pose>* keyframe_poses_ = nullptr;  // of this frame
};

/// Share of the frame's measured pixels, of those that the view has, where the view shows nothing; 0 without any.
double miss_share(const Prediction& view, const Frame& frame);

}  // namespace ppm
