#include "framework/graph/registry.hpp"
#include "framework/roles/empty_map.hpp"
#include "modules/maps/points/point_codec.hpp"
#include "modules/maps/points/point_map.hpp"

namespace {

using namespace ppm;

/// Starts with a map without points.
class EmptyPoints final : public EmptyMap {
 public:
  EmptyPoints() : EmptyMap("map.points") {
    params_.add("spacing", spacing_)
        .unit("m")
        .range(0.001, 10)
        .doc(
            "Least distance between points of one surface, and radius of the discs that they stand for. Particles share tiles "
            "of 32^3 spacings.");
  }

 protected:
  MapHandle make(const Frame&) const override { return std::make_shared<PointMap>(spacing_); }

 private:
  double spacing_ = 0.02;
};

}  // namespace

PPM_MODULES(r) {
  r.add_map_kind<ppm::PointCodec>("points");
  r.add<EmptyPoints>("map.points", "Starts the belief: particles at one pose that share one empty map of points with normals.",
                     "paper, section 2.1; Pfister et al., \"Surfels\", SIGGRAPH 2000");
}
