#include "modules/maps/ppm/ppm_map.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/error.hpp"

namespace ppm {

PpmMap::PpmMap(const PpmSettings& settings) : settings_(settings) {
  PPM_CHECK(settings.cell_size_m > 0 && settings.texel_size_m > 0 && settings.prior_sigma_m > 0,
            "cell {} m, texel {} m, prior {} m", settings.cell_size_m, settings.texel_size_m, settings.prior_sigma_m);
  PPM_CHECK(settings.max_divisions >= 1 && settings.max_divisions <= 255, "{} divisions", settings.max_divisions);
  PPM_CHECK(settings.color_channels == 0 || settings.color_channels == 1 || settings.color_channels == 3,
            "{} channels of colour", settings.color_channels);
}

Cell PpmMap::cell_of(const Eigen::Vector3f& p) const {
  return (p.cast<double>() / settings_.cell_size_m).array().floor().cast<int>();
}

std::uint32_t PpmMap::divisions_for(const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                                    const Eigen::Vector3f& c) const {
  const double area = 0.5 * (b - a).cross(c - a).norm();
  const double edge = std::sqrt(area * 4.0 / std::sqrt(3.0));
  return static_cast<std::uint32_t>(
      std::clamp(std::ceil(edge / settings_.texel_size_m), 1.0, double(settings_.max_divisions)));
}

MapStats PpmMap::stats() const {
  MapStats stats;
  std::vector<bool> seen(next_vertex_id_, false);
  for (const auto& chunk : table_.chunks()) {
    const Geometry& geometry = *chunk.geometry;
    if (!geometry.face.empty()) ++stats.chunks;
    stats.faces += static_cast<std::int64_t>(geometry.face.size());
    stats.texels += static_cast<std::int64_t>(chunk.texels->mean.size());
    for (auto id : geometry.vertex_id) {
      if (!seen[id]) ++stats.vertices;
      seen[id] = true;
    }
  }
  std::unordered_set<const void*> none;
  stats.bytes = account(none);
  return stats;
}

std::int64_t PpmMap::account(std::unordered_set<const void*>& seen) const {
  if (!seen.insert(this).second) return 0;
  std::int64_t bytes = static_cast<std::int64_t>(sizeof *this) + table_.account(seen);
  for (const auto& chunk : table_.chunks()) {
    if (seen.insert(chunk.geometry.get()).second) bytes += chunk.geometry->bytes();
    if (seen.insert(chunk.texels.get()).second) bytes += chunk.texels->bytes();
  }
  return bytes;
}

std::shared_ptr<const PpmMap> PpmMap::unshared() const {
  auto copy = std::make_shared<PpmMap>(*this);
  for (std::size_t i = 0; i < copy->table_.size(); ++i) {
    auto& chunk = copy->table_.edit(i);
    chunk = {Cow<Geometry>::make(*chunk.geometry), Cow<Texels>::make(*chunk.texels)};
  }
  return copy;
}

void PpmMap::digest(Digest& digest) const {
  digest.add(settings_.cell_size_m);
  digest.add(settings_.texel_size_m);
  digest.add(settings_.prior_sigma_m);
  digest.add(settings_.max_divisions);
  digest.add(settings_.color_channels);
  digest.add(next_vertex_id_);
  digest.add(table_.size());
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const Geometry& geometry = *table_[i].geometry;
    const Texels& texels = *table_[i].texels;
    digest.add(table_.cell(i).data(), 3 * sizeof(int));
    digest.add(geometry.position);
    digest.add(geometry.normal);
    digest.add(geometry.vertex_id);
    digest.add(geometry.face);
    digest.add(geometry.divisions);
    digest.add(texels.mean);
    digest.add(texels.variance);
    digest.add(texels.color);
    digest.add(texels.color_variance);
    digest.add(texels.evidence);
    digest.add(texels.settled);
  }
}

}  // namespace ppm
