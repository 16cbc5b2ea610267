#pragma once
#include <string>

#include "framework/graph/module.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {

/// Makes the belief from nothing: the base of every `map.*_empty`. Particles with equal weights at one pose share one
/// empty map; the first frame is on every path. Runs in the first frame (`when: {until_frame: 0}`); it starts over
/// wherever it runs.
/// throws  DataError where the start is the reference and the frame has none
class EmptyMap : public Module {
 public:
  In<Frame> frame{this, "frame", "The first frame: its stamp, and its reference pose where the map starts there."};
  InOut<Belief> belief;

  void tick(Context& context) final;

 protected:
  /// map_facet: the kind of map that it makes, "map.ppm".
  explicit EmptyMap(const std::string& map_facet);
  /// The map with nothing in it. first: what the particles' first frame is. May throw DataError.
  virtual MapHandle make(const Frame& first) const = 0;

 private:
  enum class Start { reference, identity };
  Pose start_pose(const Frame& first) const;

  int particles_ = 100;
  Start start_ = Start::reference;
};

}  // namespace ppm
