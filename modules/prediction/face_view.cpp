#include "modules/prediction/face_view.hpp"

#include "framework/core/error.hpp"
#include "modules/prediction/face_hits.hpp"

namespace ppm {
void FaceView::sample(const Prediction& view, std::span<const std::uint32_t> pixels, ViewSamples& out) const {
  HitFinder finder(map_, *shown_.faces, view);
  ElementHits hit;
  hit.reset(1);
  const auto cols = static_cast<std::uint32_t>(view.camera.cols);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::uint32_t p = pixels[i];
    finder.find(static_cast<int>(p % cols), static_cast<int>(p / cols), shown_.number[p], hit, 0);
    sample_hit(map_, linear_texels_, hit, 0, i, out);
  }
}

void FaceView::fill(const Prediction& view, const Rows& rows, Prediction& out) const {
  PPM_CHECK(view.color_channels == 0 || view.color_channels == map_.color_channels(),
            "a view with {} channels of colour of a map with {}", view.color_channels, map_.color_channels());
  HitFinder finder(map_, *shown_.faces, view);
  ElementHits hit;
  hit.reset(1);
  std::uint32_t last = FaceNumbers::kNone;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // of the last face: often the next pixel's too
  for (int y = rows.first; y < rows.end; ++y)
    for (int x = 0; x < view.camera.cols; ++x) {
      const auto p = static_cast<std::size_t>(y * view.camera.cols + x);
      const std::uint32_t number = shown_.number[p];
      if (number == FaceNumbers::kNone) continue;
      finder.find(x, y, number, hit, 0);
      if (number != last) normal = map_.table()[hit.chunk[0]].geometry->face_normal(hit.face[0]);
      last = number;
      fill_hit(map_, linear_texels_, hit, 0, normal, p, out);
    }
}

void FaceView::elements(const Prediction& view, const Rows& rows, std::span<std::uint32_t> chunk,
                        std::span<std::uint32_t> face) const {
  const auto cols = static_cast<std::size_t>(view.camera.cols), first = static_cast<std::size_t>(rows.first) * cols;
  PPM_CHECK(chunk.size() == face.size() && first + face.size() <= shown_.number.size(),
            "{} and {} elements of rows {} to {}", chunk.size(), face.size(), rows.first, rows.end);
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const std::uint32_t number = shown_.number[first + i];
    chunk[i] = face[i] = Prediction::kNone;
    if (number == FaceNumbers::kNone) continue;
    chunk[i] = last = shown_.faces->chunk_of(number, last);
    face[i] = number - shown_.faces->first(last);
  }
}

}  // namespace ppm
