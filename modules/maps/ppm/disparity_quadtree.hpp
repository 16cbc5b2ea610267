#pragma once
#include <cstdint>
#include <vector>

#include "modules/maps/ppm/update_view.hpp"

namespace ppm {

/// Inverse depth, in which a plane of space is exactly linear over the image: the quantity in which new surface is
/// fitted.
struct DisparityImage {
  int cols = 0, rows = 0;
  std::vector<float> value;  ///< [px] 1/m; NaN = no return
  std::vector<float> sigma;  ///< [px] 1/m, standard deviation of one pixel

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(cols) + static_cast<std::size_t>(x);
  }
  bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < cols && y < rows; }
  /// From a depth image, smoothed where `wanted` is set: the mean of the pixel and of those pairs (p+o, p-o) within the
  /// radius whose mean and whose members fit the pixel to `pair_sigmas`. A symmetric pair does not bend a slanted
  /// plane.
  void build(const UpdateView& view, const std::vector<std::uint8_t>& wanted, int radius, float pair_sigmas);
};

struct QuadtreeSettings {
  int leaf_min = 2;          ///< px, a power of two
  int leaf_max = 16;         ///< px, a power of two
  float rms_sigmas = 2.0f;   ///< a leaf is flat when its residuals' rms is below this many sigmas
  float peak_factor = 4.0f;  ///< ... and none above this multiple of that
  float valid_share = 0.5f;  ///< ... and at least so many of its pixels are measured
};

/// A square of the image that is flat to within the noise. It covers pixels x..x+size, y..y+size (borders shared with
/// its neighbours, cut at the image's edge). Disparity at (X, Y): c + a (X - x) + b (Y - y).
struct Leaf {
  int x, y, size;
  float a, b, c;
  float disparity(int X, int Y) const { return c + a * static_cast<float>(X - x) + b * static_cast<float>(Y - y); }
};

/// Leaves that hold at least one pixel of `wanted`, from a quadtree on squares of leaf_max: each is split until it is
/// flat; squares of leaf_min that are not flat give none (depth jumps, flying pixels). Restricted: leaves that share an
/// edge differ in size by at most a factor of two (a split leaf's children keep its plane). Order: by rows of the
/// smallest cells.
std::vector<Leaf> disparity_leaves(const DisparityImage& image, const std::vector<std::uint8_t>& wanted,
                                   const QuadtreeSettings& settings);

/// A corner shared by leaves.
struct LeafCorner {
  int x, y;
  float disparity;  ///< mean of the planes of the leaves here that fit the measurement
  float a, b;       ///< its gradient over the image, 1/m/px
  int spacing;      ///< px, size of the smallest of them
};

/// Corners of the leaves, each once, in row-major order. fit_sigmas: how far a leaf's plane may be from the corner's
/// own measured disparity (several surfaces may meet at a jump; the corner belongs to the one that was measured).
std::vector<LeafCorner> leaf_corners(const DisparityImage& image, const std::vector<Leaf>& leaves, float fit_sigmas);

}  // namespace ppm
