#pragma once
#include <array>
#include <memory>

#include "modules/prediction/plane_view.hpp"

namespace ppm {

/// What a camera sees, by a view from near by: each of its rays is followed to the pixel of that view where its point
/// appears, and meets the plane of the element there. Of the map it asks nothing.
class WarpedView final : public DeferredView {
 public:
  /// view: camera and pose of what is to be seen.
  WarpedView(std::shared_ptr<const PlaneView> planes, const Prediction& view);
  void sample(const Prediction& view, std::span<const std::uint32_t> pixels, ViewSamples& out) const override;
  void fill(const Prediction& view, const Rows& rows, Prediction& out) const override;
  /// Pixels around the planes' image that the camera would need, whose nearest surface is at `near_m`: the largest
  /// distance from the image on any side at (x, y).
  static Eigen::Vector2d overhang(const Camera& camera, const Pose& T_planes_camera, double near_m);

 private:
  static constexpr std::size_t kPart = 1024;  // pixels that are looked up at a time
  using Found = std::array<std::uint32_t, kPart>;
  /// Samples of pixels first .. first + kPart, and the planes' pixels that they were found at.
  void look(std::span<const std::uint32_t> pixels, std::size_t first, ViewSamples& out, Found& found) const;
  /// range: of the described surface.
  static void fill_pixel(const Prediction& shared, std::size_t from, float range, float cosine, std::size_t p,
                         Prediction& out);

  std::shared_ptr<const PlaneView> planes_;
  Warp warp_{};
};

}  // namespace ppm
