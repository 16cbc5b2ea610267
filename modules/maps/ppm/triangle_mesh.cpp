#include "modules/maps/ppm/triangle_mesh.hpp"

#include "modules/maps/ppm/ppm_edit.hpp"

namespace ppm {

std::shared_ptr<const PpmMap> map_of(const TriangleMesh& mesh, const PpmSettings& settings,
                                     const std::function<float(const Eigen::Vector3f&)>& mean_of, float variance) {
  PpmEdit edit(std::make_shared<const PpmMap>(settings));
  std::vector<std::uint32_t> id;
  id.reserve(mesh.position.size());
  for (const auto& p : mesh.position) id.push_back(edit.add_vertex(p));
  std::vector<float> mean, variances;
  for (const auto& f : mesh.face) {
    const auto &a = mesh.position[f[0]], &b = mesh.position[f[1]], &c = mesh.position[f[2]];
    const auto n = edit.map().divisions_for(a, b, c);
    mean.resize(texel_count(n));
    variances.assign(texel_count(n), variance);
    for (std::uint32_t i = 0; i <= n; ++i)
      for (std::uint32_t j = 0; i + j <= n; ++j) {
        const float u = static_cast<float>(i) / static_cast<float>(n),
                    v = static_cast<float>(j) / static_cast<float>(n);
        mean[texel_index(n, i, j)] = mean_of((1 - u - v) * a + u * b + v * c);
      }
    edit.add_face({id[f[0]], id[f[1]], id[f[2]]}, static_cast<std::uint8_t>(n), {mean, variances});
  }
  return edit.commit();
}

}  // namespace ppm
