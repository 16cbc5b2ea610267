#pragma once
#include <mutex>
#include <vector>

#include "framework/slam/prediction.hpp"
#include "modules/maps/ppm/ppm_map.hpp"
#include "modules/prediction/warp_kernel.hpp"

namespace ppm {

/// A view of a mesh map whose pixels are carried over to cameras that are near: the plane of the described surface at
/// each pixel, parallel to the pixel's element.
class PlaneView {
 public:
  /// view: of the map, which must outlive the use of this (see DeferredView).
  void start(const PpmMap& map, PredictionHandle view);
  /// Finds the planes of some rows. Several threads may do so for distinct rows.
  void fill(const Rows& rows);

  const Prediction& view() const { return *view_; }
  PlaneArrays arrays() const;
  /// The view with its arrays filled, on first use. For any thread.
  const Prediction& whole() const;

 private:
  struct Normals {
    explicit Normals(std::size_t n) : x(n), y(n), z(n) {}
    std::vector<float> x, y, z;  // of the pixels' elements, camera frame
  };
  void fill_row(int y, std::size_t from, const ViewSamples& seen, const Normals& normals);
  void close_gaps(int y);

  const PpmMap* map_ = nullptr;
  PredictionHandle view_;
  std::vector<float> disparity_, per_x_, per_y_, distance_, variance_;  // see PlaneArrays
  mutable std::mutex mutex_;                                            // guards whole_
  mutable PredictionHandle whole_;
};

}  // namespace ppm
