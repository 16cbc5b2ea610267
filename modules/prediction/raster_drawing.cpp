#include "modules/prediction/raster_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ppm {
namespace {

/// The directions in which points of an image lie, as five half spaces through the camera's centre.
class Frustum {
 public:
  /// first_row, end_row: of the camera are what is looked at.
  explicit Frustum(const RasterCamera& camera) {
    constexpr float margin = 0.5f;  // px, more than what the boxes of faces are grown by
    const Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>> axes(&camera.axes[0][0]);
    const auto from = [](int pixel, int middle) { return static_cast<float>(pixel - middle); };
    const Eigen::Vector3f x = axes.row(0), y = axes.row(1), w = axes.row(2);
    side_[0] = x - (from(0, camera.middle_x) - margin) * w;
    side_[1] = (from(camera.cols - 1, camera.middle_x) + margin) * w - x;
    side_[2] = y - (from(camera.first_row, camera.middle_y) - margin) * w;
    side_[3] = (from(camera.end_row - 1, camera.middle_y) + margin) * w - y;
    side_[4] = w;
    for (int i = 0; i < 3; ++i) centre_[i] = camera.centre[i];
  }

  /// False where a box is outside of one of them.
  bool meets(const Eigen::AlignedBox3f& box) const {
    const Eigen::Vector3f middle = box.center() - centre_, half = 0.5f * box.sizes();
    for (const auto& s : side_)
      if (s.dot(middle) + s.cwiseAbs().dot(half) < -kRounding) return false;
    return true;
  }
  const Eigen::Vector3f& centre() const { return centre_; }

 private:
  static constexpr float kRounding = 1e-2f;  // px m
  std::array<Eigen::Vector3f, 5> side_;
  Eigen::Vector3f centre_;
};

void choose_chunks(const PpmMap& map, const Frustum& frustum, std::vector<RasterScratch::Chunk>& chunks) {
  chunks.clear();
  for (std::uint32_t i = 0; i < map.table().size(); ++i) {
    const Geometry& geometry = *map.table()[i].geometry;
    if (geometry.face.empty() || !frustum.meets(geometry.box)) continue;
    chunks.push_back({i, geometry.box.squaredExteriorDistance(frustum.centre())});
  }
  std::sort(chunks.begin(), chunks.end(), [](const auto& a, const auto& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.number < b.number;
  });
}

void clear(const RasterCamera& camera, RasterBand& band, RasterScratch& scratch) {
  const auto pixels =
      static_cast<std::size_t>(camera.end_row - camera.first_row) * static_cast<std::size_t>(camera.cols);
  band.shown.reserve(pixels + RasterBand::kSpare);
  scratch.inverse_depth.reserve(pixels + RasterBand::kSpare);
  std::fill_n(band.shown.data(), pixels + RasterBand::kSpare, RasterBand::kNone);
  std::fill_n(scratch.inverse_depth.data(), pixels + RasterBand::kSpare, 0.0f);
  band.triangles = 0;
  band.texels.clear();
}

RasterTexels texels_of(std::uint32_t number, const PpmChunk& chunk) {
  const Geometry& g = *chunk.geometry;
  const Texels& t = *chunk.texels;
  return {number, g.divisions.data(), g.first_texel.data(), t.evidence.data(), t.mean.data(), t.variance.data()};
}

void draw_chunk(const RasterCamera& camera, const Geometry& geometry, std::uint32_t slot, RasterScratch& scratch,
                RasterBand& band) {
  const std::size_t vertices = geometry.position.size(), faces = geometry.face.size();
  scratch.vertex.reserve(4 * (vertices + RasterBand::kSpare));
  for (auto* array : {&scratch.boxes.face, &scratch.boxes.columns, &scratch.boxes.rows})
    array->reserve(faces + RasterBand::kSpare);
  raster_project(camera, geometry.position.front().data(), vertices, scratch.vertex.data());
  scratch.boxes.size = 0;
  const std::uint32_t* face = geometry.face.front().data();
  raster_select(camera, face, faces, 0, faces, scratch.vertex.data(), scratch.boxes);
  if (scratch.boxes.size > 0)
    raster_draw(camera, face, scratch.vertex.data(), scratch.boxes, slot, band, scratch.inverse_depth.data());
}

}  // namespace

void draw_rows(const Rows& rows, RasterView& view, RasterScratch& scratch) {
  RasterCamera camera = view.camera();
  camera.first_row = rows.first;
  camera.end_row = rows.end;
  RasterBand& band = view.add_band(rows);
  clear(camera, band, scratch);
  choose_chunks(view.map(), Frustum(camera), scratch.chunks);
  for (const auto& chosen : scratch.chunks) {
    const PpmChunk& chunk = view.map().table()[chosen.number];
    band.texels.push_back(texels_of(chosen.number, chunk));
    draw_chunk(camera, *chunk.geometry, static_cast<std::uint32_t>(band.texels.size() - 1), scratch, band);
  }
}

}  // namespace ppm
