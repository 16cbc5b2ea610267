#include "modules/prediction/mesh_view.hpp"

namespace ppm {

std::vector<const PpmMap*> as_ppm(const std::vector<const Map*>& maps) {
  std::vector<const PpmMap*> meshes;
  meshes.reserve(maps.size());
  for (const Map* map : maps) meshes.push_back(&as_ppm(*map));
  return meshes;
}

void declare_mesh_view(Params& params, bool& cull_back_faces, bool& linear_texels) {
  params.add_choice("backfaces", cull_back_faces, {{"cull", true}, {"hit", false}})
      .doc(
          "What a ray does at a face whose observed side looks away from it: cull lets it go on, hit stops it "
          "there.");
  params.add_choice("texel", linear_texels, {{"nearest", false}, {"linear", true}})
      .doc("Mean and variance at a hit: of the nearest texel, or interpolated between texels.");
}

}  // namespace ppm
