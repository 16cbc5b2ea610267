#pragma once
#include <cstdint>

#include "modules/prediction/element_view.hpp"
#include "modules/prediction/face_numbers.hpp"

namespace ppm {

/// A face as rays from one point meet it, after Möller and Trumbore 1997: barycentrics and depth at a pixel are ratios
/// of values that grow linearly over the image. In double precision, which needles and grazing faces need.
class SeenFace {
 public:
  SeenFace() = default;
  /// centre: the camera's, map frame; ray_of: pixel (x, y) looks along ray_of * (x, y, 1), map frame.
  SeenFace(const Geometry& geometry, std::uint32_t face, const Eigen::Vector3d& centre, const Eigen::Matrix3d& ray_of);
  /// Where the ray of a pixel meets the face; the nearest point of its border where the ray passes beside it. ray_of:
  /// as before; length: of ray_of * (x, y, 1).
  void meet(int x, int y, const Eigen::Matrix3d& ray_of, double length, ElementHits& hits, std::size_t at) const;

 private:
  void pass_beside(const Eigen::Vector3d& direction, double& u, double& v, double& range) const;

  using Vector3d = Eigen::Vector3d;
  Vector3d e1_ = Vector3d::Zero(), e2_ = e1_;       // m, edges from the first corner
  Vector3d from_ = e1_;                             // m, from the first corner to the camera's centre
  Vector3d det_ = e1_, u_det_ = e1_, v_det_ = e1_;  // by (x, y, 1)
  double height_ = 0;                               // m, of the centre over the face's plane, times twice the area
  double per_area_ = 0;                             // 1/m^2, of twice the area
};

/// Finds where rays meet the faces that a rasterizer says they see. A rasterizer takes corners to a grid a little finer
/// than pixels, so a ray may pass just beside its face: it is given the point of the face near by.
class HitFinder {
 public:
  /// faces: counts those of `map`. view: its camera and pose are read.
  HitFinder(const PpmMap& map, const FaceNumbers& faces, const Prediction& view);
  /// The hit of pixel (x, y) on the face of that number (kNone: a miss), as entry `at` of the record. Fast where the
  /// last face is asked for again.
  void find(int x, int y, std::uint32_t number, ElementHits& hits, std::size_t at);

 private:
  void look_at(std::uint32_t number);

  const PpmMap& map_;
  const FaceNumbers& faces_;
  const Camera& camera_;
  Eigen::Vector3d centre_;
  Eigen::Matrix3d ray_of_;
  double per_fx_, per_fy_;
  std::uint32_t last_ = FaceNumbers::kNone, chunk_ = 0, face_ = 0;
  SeenFace seen_;
};

}  // namespace ppm
