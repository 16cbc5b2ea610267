#include "modules/maps/ppm/chunk_record.hpp"

#include "modules/maps/ppm/chunk_edit.hpp"

namespace ppm {
namespace {

constexpr float kFarthest = 1e6f;  // m; of a coordinate

void derive(RecordReader& in, Geometry& geometry) {
  geometry.first_texel.clear();
  std::uint32_t texel = 0;
  for (std::size_t f = 0; f < geometry.face.size(); ++f) {
    for (auto v : geometry.face[f])
      if (v >= geometry.position.size()) in.fail("has a face with a vertex that is not there");
    geometry.first_texel.push_back(texel);
    texel += texel_count(geometry.divisions[f]);
  }
  geometry.open_edge = open_edges(geometry);
  geometry.box = bounding_box(geometry);
  geometry.shrink_to_fit();
  geometry.id = next_geometry_id();
}

}  // namespace

void save(RecordWriter& out, const Geometry& geometry) {
  out.add(geometry.position);
  out.add(geometry.normal);
  out.add(geometry.vertex_id);
  out.add(geometry.face);
  out.add(geometry.divisions);
}

void load(RecordReader& in, Geometry& geometry) {
  in.take(geometry.position);
  in.take(geometry.normal);
  in.take(geometry.vertex_id);
  in.take(geometry.face);
  in.take(geometry.divisions);
  if (geometry.normal.size() != geometry.position.size() || geometry.vertex_id.size() != geometry.position.size() ||
      geometry.divisions.size() != geometry.face.size())
    in.fail("has counts that do not fit");
  for (const auto& p : geometry.position)
    if (!(p.cwiseAbs().maxCoeff() < kFarthest)) in.fail("has a vertex that lies nowhere");
  derive(in, geometry);
}

void save(RecordWriter& out, const Texels& texels) {
  out.add(texels.mean);
  out.add(texels.variance);
  out.add(texels.color);
  out.add(texels.color_variance);
  out.add(texels.evidence);
  out.add(texels.settled);
}

void load(RecordReader& in, Texels& texels) {
  in.take(texels.mean);
  in.take(texels.variance);
  in.take(texels.color);
  in.take(texels.color_variance);
  in.take(texels.evidence);
  in.take(texels.settled);
}

void save(RecordWriter& out, const PpmSettings& settings) {
  out.add(settings.cell_size_m);
  out.add(settings.texel_size_m);
  out.add(settings.prior_sigma_m);
  out.add(static_cast<std::int32_t>(settings.max_divisions));
  out.add(static_cast<std::int32_t>(settings.color_channels));
}

void load(RecordReader& in, PpmSettings& settings) {
  in.take(settings.cell_size_m);
  in.take(settings.texel_size_m);
  in.take(settings.prior_sigma_m);
  settings.max_divisions = in.take<std::int32_t>();
  settings.color_channels = in.take<std::int32_t>();
}

}  // namespace ppm
