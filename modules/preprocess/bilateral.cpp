#include <algorithm>
#include <cmath>
#include <vector>

#include "framework/graph/registry.hpp"
#include "framework/roles/frame_filter.hpp"
#include "modules/preprocess/row_bands.hpp"

namespace {

using namespace ppm;

/// Smooths depth, but not across edges: each pixel becomes a mean of its neighbourhood, in which a neighbour counts
/// less the farther it is in the image (Gaussian) and in depth (Tukey's biweight: beyond sigma_depth standard
/// deviations it does not count). Means are taken of inverse depth, in which planes are linear, so that slanted
/// surfaces stay where they are. frame   depth changes; sigma stays as it is. A mean of n pixels looks sqrt(n) times
/// better than one only if their
///         errors are independent, and those of a depth camera are not; besides, neighbouring pixels now share their
///         errors, and the map would count each of them as news.
/// source  Tomasi & Manduchi, "Bilateral filtering for gray and color images", ICCV 1998; the biweight: Durand &
/// Dorsey,
///         SIGGRAPH 2002
class Bilateral final : public Preprocessing {
 public:
  Bilateral() {
    params_.add("radius", radius_).range(1, 16).doc("Of the neighbourhood, a square, in pixels.");
    params_.add("sigma_image", sigma_image_)
        .unit("px")
        .above(0)
        .doc("Standard deviation of the weight over the image.");
    params_.add("sigma_depth", sigma_depth_)
        .above(0)
        .doc("Neighbours whose depth differs by so many of the pixel's standard deviations no longer count.");
  }

 protected:
  void apply(Frame& image, const Workers& workers) const override {
    const auto weights = image_weights();
    std::vector<float> inverse(image.depth.size());
    for (std::size_t p = 0; p < inverse.size(); ++p)
      inverse[p] = image.depth[p] == image.depth[p] ? 1.0f / image.depth[p] : kFar;
    const int cols = image.camera.cols, rows = image.camera.rows;
    for_row_bands(workers, rows, cols, [&](int first, int last) {
      Row row(static_cast<std::size_t>(cols));
      for (int y = first; y < last; ++y) smooth_row(inverse, weights, y, row, image);
    });
  }

 private:
  /// Inverse depth of a pixel without return: unlike any other, so that it never counts.
  static constexpr float kFar = 1e9f;

  /// Scratch for a row of pixels.
  struct Row {
    explicit Row(std::size_t cols) : sum(cols), total(cols), scale(cols) {}
    std::vector<float> sum, total, scale;
  };

  std::vector<float> image_weights() const {
    std::vector<float> weights;
    for (int dy = -radius_; dy <= radius_; ++dy)
      for (int dx = -radius_; dx <= radius_; ++dx)
        weights.push_back(static_cast<float>(std::exp(-0.5 * (dx * dx + dy * dy) / (sigma_image_ * sigma_image_))));
    return weights;
  }

  /// Neighbour by neighbour, so that the loop over the row has no branch.
  void smooth_row(const std::vector<float>& inverse, const std::vector<float>& weights, int y, Row& row,
                  Frame& image) const {
    const int cols = image.camera.cols, rows = image.camera.rows;
    const auto start = static_cast<std::size_t>(y * cols);
    const float* own = &inverse[start];
    float *sum = row.sum.data(), *total = row.total.data(), *scale = row.scale.data(), *depth = &image.depth[start];
    const auto reach = static_cast<float>(sigma_depth_);
    for (int x = 0; x < cols; ++x) {
      sum[x] = total[x] = 0;
      scale[x] = 1.0f / (reach * image.sigma[start + static_cast<std::size_t>(x)] * own[x] * own[x]);
    }
    std::size_t k = 0;
    for (int dy = -radius_; dy <= radius_; ++dy)
      for (int dx = -radius_; dx <= radius_; ++dx, ++k) {
        if (y + dy < 0 || y + dy >= rows) continue;
        const float* other = own + dy * cols + dx;
        const float weight = weights[k];
        const int end = std::min(cols, cols - dx);
        for (int x = std::max(0, -dx); x < end; ++x) {
          const float off = (other[x] - own[x]) * scale[x];
          const float inside = std::max(0.0f, 1 - off * off), w = weight * inside * inside;
          sum[x] += w * other[x];
          total[x] += w;
        }
      }
    for (int x = 0; x < cols; ++x) depth[x] = depth[x] == depth[x] ? total[x] / sum[x] : depth[x];
  }

  int radius_ = 2;
  double sigma_image_ = 1.0, sigma_depth_ = 3;
};

}  // namespace

PPM_MODULES(r) {
  r.add<Bilateral>("preprocess.bilateral", "Smooths depth within surfaces, not across edges.",
                   "Tomasi & Manduchi, ICCV 1998; Durand & Dorsey, SIGGRAPH 2002");
}
