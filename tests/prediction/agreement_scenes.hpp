#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "modules/maps/ppm/ppm_map.hpp"
#include "tests/prediction/backends.hpp"

namespace ppm::test {

/// A map and the views of it that back-ends are compared on.
struct Scene {
  std::string name;
  std::shared_ptr<const PpmMap> map;
  std::vector<Look> looks;
  double doubtful = 0.004;  ///< largest share of pixels that rounding may decide
};

/// Surfaces of known shape: a wave cut into chunks, a plane whose vertices and edges lie exactly on rays, a room.
std::vector<Scene> shaped_scenes();
/// Triangles that share nothing, each kind in some seeds: ordinary ones with slivers and huge ones among them; needles;
/// planes that nearly hold the camera; all about the camera, near and behind it; walls larger than the view by far.
std::vector<Scene> soups();
/// Maps that the filter's own update made: of the embedded room, in colour, and of `kitchen` where that is present (a
/// message says so where not).
Scene mapped_room();
std::optional<Scene> mapped_kitchen();

}  // namespace ppm::test
