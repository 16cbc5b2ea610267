#include "modules/prediction/warped_view.hpp"

#include <algorithm>
#include <numeric>

namespace ppm {
namespace {

Eigen::Matrix3d pixels_of(const Camera& camera) {
  Eigen::Matrix3d k;
  k << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  return k;
}

}  // namespace

WarpedView::WarpedView(std::shared_ptr<const PlaneView> planes, const Prediction& view) : planes_(std::move(planes)) {
  const Camera& camera = view.camera;
  const Pose T = planes_->view().T_map_camera.inverse() * view.T_map_camera;
  const Eigen::Matrix3d to_pixels = pixels_of(planes_->view().camera);
  const Eigen::Matrix3d turn = to_pixels * T.linear() * pixels_of(camera).inverse();
  const Eigen::Vector3d shift = to_pixels * T.translation();
  for (Eigen::Index i = 0; i < 9; ++i) warp_.turn[i] = static_cast<float>(turn(i / 3, i % 3));
  for (Eigen::Index i = 0; i < 3; ++i) warp_.shift[i] = static_cast<float>(shift[i]);
  warp_.cols = camera.cols;
  warp_.fx = static_cast<float>(camera.fx), warp_.fy = static_cast<float>(camera.fy);
  warp_.cx = static_cast<float>(camera.cx), warp_.cy = static_cast<float>(camera.cy);
}

Eigen::Vector2d WarpedView::overhang(const Camera& camera, const Pose& T_planes_camera, double near_m) {
  Eigen::Vector2d most = Eigen::Vector2d::Zero();
  const Eigen::Vector2d last(camera.cols - 1, camera.rows - 1);
  for (int corner = 0; corner < 4; ++corner)
    for (double disparity : {0.0, 1 / near_m}) {
      const Eigen::Vector3d ray = camera.ray(corner % 2 ? last.x() : 0, corner / 2 ? last.y() : 0);
      const Eigen::Vector3d seen = T_planes_camera.linear() * ray + disparity * T_planes_camera.translation();
      if (seen.z() <= 0) return last;  // beside or behind
      const Eigen::Vector2d pixel = camera.project(seen);
      most = most.cwiseMax(-pixel).cwiseMax(pixel - last);
    }
  return most;
}

void WarpedView::look(std::span<const std::uint32_t> pixels, std::size_t first, ViewSamples& out,
                      Found& found) const {
  warp_samples(planes_->arrays(), warp_, pixels.data() + first, std::min(kPart, pixels.size() - first),
               static_cast<float>(Prediction::kMinCosine), &out.range[first], &out.variance[first], &out.cosine[first],
               found.data());
}

void WarpedView::sample(const Prediction&, std::span<const std::uint32_t> pixels, ViewSamples& out) const {
  const auto channels = static_cast<std::size_t>(out.color_channels);
  Found found;
  for (std::size_t first = 0; first < pixels.size(); first += kPart) {
    look(pixels, first, out, found);
    if (channels == 0) continue;
    const Prediction& shared = planes_->whole();
    for (std::size_t i = first; i < std::min(first + kPart, pixels.size()); ++i) {
      const std::size_t from = found[i - first];
      std::copy_n(&shared.color[channels * from], channels, &out.color[channels * i]);
      out.color_variance[i] = shared.color_variance[from];
    }
  }
}

void WarpedView::fill(const Prediction& view, const Rows& rows, Prediction& out) const {
  const auto cols = static_cast<std::size_t>(view.camera.cols);
  std::vector<std::uint32_t> pixels(cols * static_cast<std::size_t>(rows.end - rows.first));
  std::iota(pixels.begin(), pixels.end(), static_cast<std::uint32_t>(cols * static_cast<std::size_t>(rows.first)));
  ViewSamples seen;
  seen.resize(pixels.size());
  const Prediction& shared = planes_->whole();
  Found found;
  for (std::size_t first = 0; first < pixels.size(); first += kPart) {
    look(pixels, first, seen, found);
    for (std::size_t i = first; i < std::min(first + kPart, pixels.size()); ++i)
      if (seen.range[i] != Prediction::kMiss)
        fill_pixel(shared, found[i - first], seen.range[i], seen.cosine[i], pixels[i], out);
  }
}

void WarpedView::fill_pixel(const Prediction& shared, std::size_t from, float range, float cosine, std::size_t p,
                            Prediction& out) {
  out.range[p] = range + shared.mean[from] / cosine;
  out.mean[p] = shared.mean[from];
  out.variance[p] = shared.variance[from];
  std::copy_n(&shared.normal[3 * from], 3, &out.normal[3 * p]);
  out.chunk[p] = shared.chunk[from];
  out.face[p] = shared.face[from];
  std::copy_n(&shared.bary[2 * from], 2, &out.bary[2 * p]);
  const auto channels = static_cast<std::size_t>(out.color_channels);
  if (channels == 0) return;
  std::copy_n(&shared.color[channels * from], channels, &out.color[channels * p]);
  out.color_variance[p] = shared.color_variance[from];
}

}  // namespace ppm
