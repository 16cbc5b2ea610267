#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "framework/core/se3.hpp"
#include "framework/slam/camera.hpp"
#include "modules/maps/picture/rgb_image.hpp"

namespace ppm {

struct ColoredPoint {
  Eigen::Vector3f position;  ///< m, map frame
  Color color;
};

/// How a line looks.
struct Pen {
  Color color = Color::Zero();
  double width_px = 1;
  float opacity = 1;         ///< where nothing is in front of it
  float opacity_hidden = 0;  ///< where a surface is in front of it
  double lift = 0;           ///< share of its depth by which a line is drawn nearer, to lie over its own surface
};

/// A picture that is drawn by software: triangles with a depth buffer, lines over them, anti-aliased by `samples` x
/// `samples` samples a pixel. Single-threaded, the same bytes every time.
class Canvas {
 public:
  Canvas(const Camera& camera, const Pose& T_map_camera, int samples);

  /// Draws a triangle that is seen from its front (counter-clockwise); its back is invisible. Colours are interpolated.
  void triangle(const std::array<ColoredPoint, 3>& corners);
  /// Darkens what lies behind its neighbours in the image, so that depth edges and corners stand out. After triangles.
  /// Source: Boucheny, "Visualisation scientifique de grands volumes de donnees", 2009 (eye-dome lighting).
  void shade_depth_edges(float strength);
  /// Draws lines, map frame, m. Where lines of one call overlap, they are drawn once.
  void polylines(const std::vector<std::vector<Eigen::Vector3d>>& lines, const Pen& pen);
  /// The picture over a background that goes from one colour at the top to another at the bottom.
  RgbImage resolve(const Color& top, const Color& bottom) const;

  static constexpr float kNothing = std::numeric_limits<float>::infinity();
  /// Depth along the optical axis at the middle sample of a pixel, m; kNothing where there is none.
  float depth(int x, int y) const;

 private:
  struct Corner {
    Eigen::Vector3d p;  // camera frame
    Color color;
  };
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(fine_.cols) + static_cast<std::size_t>(x);
  }
  void fill(const Corner& a, const Corner& b, const Corner& c);
  void segment(Eigen::Vector3d p, Eigen::Vector3d q, const Pen& pen);

  int samples_;
  Camera fine_;  // one pixel a sample
  Pose T_camera_map_;
  std::vector<float> depth_;
  std::vector<float> color_;           // [3 * samples]; meaningful where covered_
  std::vector<float> coverage_;        // 1 where drawn, less under a transparent line on the background
  std::vector<std::uint32_t> stroke_;  // the last call of polylines() that drew here
  std::uint32_t strokes_ = 0;
};

}  // namespace ppm
