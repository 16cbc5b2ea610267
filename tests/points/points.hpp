#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/graph/harness.hpp"
#include "framework/roles/view_predictor.hpp"
#include "modules/maps/points/point_edit.hpp"
#include "tests/support/registry.hpp"
#include "tests/support/workers.hpp"

namespace ppm::test {

/// A point that so many frames have measured to sigma (m).
inline SurfacePoint surface_point(const Eigen::Vector3f& position, const Eigen::Vector3f& normal, float radius,
                                  std::uint16_t hits = 1, float sigma = 0.002f) {
  SurfacePoint point;
  point.position = position;
  point.normal = UnitNormal(normal);
  point.set_radius(radius);
  point.hits = hits;
  point.information = 1 / (sigma * sigma);
  return point;
}

/// The map with further points.
inline std::shared_ptr<const PointMap> with(std::shared_ptr<const PointMap> map, const std::vector<SurfacePoint>& points) {
  PointEdit edit(std::move(map));
  for (const auto& point : points) edit.add(point);
  return edit.commit();
}

/// Points of a square n * n grid over the plane through `middle`, `spacing` apart, on a new map.
inline std::shared_ptr<const PointMap> plane_of_points(const Eigen::Vector3f& middle, const Eigen::Vector3f& normal, int n,
                                                       float spacing) {
  const Eigen::Vector3f n1 = normal.normalized(), a = n1.unitOrthogonal(), b = n1.cross(a);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const float u = spacing * (static_cast<float>(i) - 0.5f * static_cast<float>(n - 1));
      const float v = spacing * (static_cast<float>(j) - 0.5f * static_cast<float>(n - 1));
      points.push_back(surface_point(middle + u * a + v * b, n1, spacing));
    }
  return with(std::make_shared<PointMap>(spacing), points);
}

inline std::vector<SurfacePoint> all_points(const PointMap& map) {
  std::vector<SurfacePoint> all;
  for (const auto& chunk : map.table().chunks())
    all.insert(all.end(), chunk.tile->points.begin(), chunk.tile->points.end());
  return all;
}

inline std::string points_digest(const Map& map) {
  Digest digest;
  map.digest(digest);
  return digest.hex();
}

/// prediction.points, asked directly.
class PointView {
 public:
  explicit PointView(const std::string& params = "{}") : harness_(builtin(), "prediction.points", params) {}
  ViewPredictor& predictor() { return dynamic_cast<ViewPredictor&>(harness_.module()); }
  Prediction of(const Map& map, const Camera& camera, const Pose& T_map_camera, int stride = 1) {
    predictor().prepare({&map}, one_worker());
    Prediction out;
    out.reset(camera, stride, T_map_camera);
    predictor().predict_all(map, out, 0);
    return out;
  }

 private:
  Harness harness_;
};

}  // namespace ppm::test
