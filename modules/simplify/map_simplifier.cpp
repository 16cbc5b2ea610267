#include "modules/simplify/map_simplifier.hpp"

#include "modules/maps/ppm/ppm_edit.hpp"

namespace ppm {
namespace {

/// The faces of a region that do not stay, for decimate().
Decimation active_part(const Region& region, const std::vector<std::uint8_t>& stays, float error) {
  Decimation surface{region.displaced, {}, region.locked, error};
  for (std::size_t f = 0; f < stays.size(); ++f) {
    if (!stays[f])
      surface.face.push_back(region.corner[f]);
    else
      for (auto v : region.corner[f]) surface.locked[v] = 1;
  }
  return surface;
}

std::shared_ptr<const PpmMap> write(std::shared_ptr<const PpmMap> map, const Region& region,
                                    const Replacement::Result& result) {
  PpmEdit edit(std::move(map));
  for (std::size_t f = 0; f < region.face.size(); ++f) {
    const auto& [c, face] = region.face[f];
    if (result.goes[f])
      edit.remove_face(c, face);
    else
      edit.texels(c).settled[face] = 1;
  }
  for (std::size_t t = 0; t < result.triangle.size(); ++t) {
    Triangle ids;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = result.triangle[t][k];
      ids[k] = region.id[v];
      edit.use_vertex(ids[k], region.position[v]);
    }
    const ResampledFace& face = result.face[t];
    edit.add_face(ids, face.divisions, face.view(), face.evidence, true);
  }
  return edit.commit();
}

}  // namespace

MapSimplifier::MapSimplifier() : MapEditor({{"map.ppm"}, {}, {}}, EditReads::map) {
  params_.add("hits_least", due_.hits_least)
      .range(0, 65535)
      .doc("Faces take part once so many pixels have measured them: what was made lately stays as it is.");
  params_.add("share_least", due_.share_least)
      .range(0, 1)
      .doc("A chunk is simplified when so large a share of its faces may take part and never did.");
  params_.add("error", replacement_.tolerance.distance)
      .unit("m")
      .range(0, 10)
      .doc("The described surface may change by so much, or by `sigmas` standard deviations where that is more.");
  params_.add("sigmas", replacement_.tolerance.sigmas)
      .range(0, 100)
      .doc("Standard deviations of the described surface, texel and excess, by which it may change.");
  params_.add("error_base", error_base_)
      .unit("m")
      .range(0, 10)
      .doc("How far from the described surface the simplifier itself may put a face; texels carry the rest.");
  params_.add("offset_most", replacement_.offset_most)
      .unit("m")
      .range(0, 10)
      .doc("Farthest that a new face may lie from the surface that its texels describe.");
  params_.add("border", replacement_.border)
      .unit("m")
      .range(0, 10)
      .doc("How far an open border of the mesh may move.");
  params_.add("shape_least", replacement_.shape_least)
      .range(0, 1)
      .doc("Least shape of a new face: 4 sqrt(3) area over the sum of its squared edges, 1 = equilateral.");
}

MapHandle MapSimplifier::edit(Context&, std::size_t, MapHandle handle, int) {
  auto map = std::static_pointer_cast<const PpmMap>(std::move(handle));
  const auto due = due_chunks(*map, due_);
  if (due.empty()) return map;
  const Region region = make_region(*map, due, due_);
  const auto result = simplify(region, map->settings());
  return write(std::move(map), region, result);
}

/// Each round leaves out at least one face more, so that it ends: with all of them out, if need be. After the first
/// rounds, which find most of what cannot be, faults take their neighbours with them, one ring more in each round, so
/// that it ends soon.
Replacement::Result MapSimplifier::simplify(const Region& region, const PpmSettings& map) const {
  constexpr int kExactRounds = 2;
  Replacement replacement(region, map, replacement_);
  std::vector<std::uint8_t> stays(region.face.size(), 0);
  for (int round = 0;; ++round) {
    const auto proposed = decimate(active_part(region, stays, static_cast<float>(error_base_)));
    auto faults = replacement.faults(proposed, stays);
    if (faults.empty()) return replacement.take(proposed, stays);
    for (int ring = kExactRounds; ring <= round; ++ring) faults = replacement.with_neighbours(faults);
    for (auto f : faults) stays[f] = 1;
  }
}

}  // namespace ppm
