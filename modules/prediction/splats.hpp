#pragma once
#include <cstdint>
#include <vector>

#include "framework/slam/prediction.hpp"
#include "modules/maps/points/point_map.hpp"

namespace ppm {

/// How discs become a surface.
struct SplatSettings {
  float blend_m = 0.06f;   ///< discs so far behind the foremost one are of its surface
  float blend_sigmas = 2;  ///< or so many of its standard deviations
};

/// Draws point maps as discs (surfels), each oriented by its normal, into an image of what a camera sees. Two steps: the
/// foremost disc along each pixel's ray; then the mean of the discs that lie about as far, weighted by how near to their
/// middles the ray passes and how well they are known. Discs are seen from both sides. One drawing a worker: it keeps its memory.
/// Source: Pfister et al., SIGGRAPH 2000; Zwicker et al., "Surface splatting", SIGGRAPH 2001 (visibility, then blending).
class SplatDrawing {
 public:
  /// Fills some rows of `out`, which was reset to misses, for its camera and pose.
  void draw(const PointMap& map, const SplatSettings& settings, const Rows& rows, Prediction& out);

 private:
  /// Where a disc lies in the camera's frame.
  struct Disc {
    Eigen::Vector3f middle, normal;  // m; unit, towards the camera
    float radius, variance;          // m, m^2
    std::uint32_t tile, index;
  };
  /// A pixel's ray through a disc.
  struct Fragment {
    std::uint32_t pixel, disc;  // of the rows drawn; of discs_
    float depth, weight;        // m along the optical axis
  };
  struct Sum {
    float weight = 0, depth = 0, variance = 0, middle = 0;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    std::uint32_t disc = 0;
  };

  void gather(const PointMap& map, const Rows& rows, const Prediction& out);
  void aim(const Rows& rows, const Camera& camera);
  void rasterize(std::uint32_t disc, const Rows& rows, const Camera& camera);
  void blend(const SplatSettings& settings);
  void write(const Rows& rows, Prediction& out) const;

  std::vector<float> ray_x_, ray_y_;  // by column, by row drawn: of the ray with z = 1
  std::vector<Disc> discs_;
  std::vector<Fragment> fragments_;
  std::vector<float> nearest_;           // by pixel of the rows drawn: depth
  std::vector<std::uint32_t> foremost_;  // and its disc
  std::vector<Sum> sums_;
};

}  // namespace ppm
