#pragma once
#include <memory>

#include "framework/slam/frame.hpp"
#include "framework/slam/prediction.hpp"
#include "modules/maps/points/point_edit.hpp"
#include "modules/maps/points/point_tallies.hpp"

namespace ppm {

/// How frames are written into point maps.
struct PointUpdateSettings {
  // A measurement and a disc are of one surface.
  float gate_sigmas = 4;      ///< within so many standard deviations along the normal ...
  float gate_pose_m = 0.01f;  ///< ... to which this one is added for the error of the pose and of the map ...
  float map_sigma_most_m = 0.01f;  ///< ... and the disc's own, but not more than this
  float agree_cosine = 0.5f;       ///< and their normals no farther apart
  float sigma_least_m = 1e-4f;     ///< no point becomes surer than this by its measurements: it stays open to change

  // New points.
  float cosine_least = 0.2f;    ///< surface seen more slantingly makes none
  float jump_m = 0.05f;         ///< nor do pixels beside a depth jump
  int normal_reach = 2;         ///< px: the measured normal is of neighbours so far away, or else of the next ones
  float radius_pixels = 0.8f;   ///< radius of the disc, at least so many pixels' spacings on the surface
  float scatter_sigma_m = 0.01f;   ///< square root of the scatter that it starts with ...
  int scatter_frames = 10;         ///< ... as if so many frames had shown it

  // Points that are seen through.
  float votes_cosine = 0.3f;  ///< pixels that meet a disc at a smaller cosine do not speak for or against it
  float votes_ratio = 1;      ///< a point goes when seen through in more than so many times the frames that hit it ...
  float votes_free = 3;       ///< ... and so many more
  float votes_forget = 0.1f;  ///< share of its hits that each frame takes away in which it is only seen through
};

/// The map after a frame. Pixels that measure the disc that they should see move it along its normal (a Kalman step whose
/// variance is the sensor's along the normal) and turn its normal; others, where no point of the same surface lies
/// within the spacing, become points; points that are seen through again and again go.
/// frame  depth, sigma, lateral_px
/// view   of this frame's camera (decimated by its stride) from the particle's pose, arrays filled; of `map`
/// tallies  memory of one worker, kept between frames
/// Source: Keller et al., 3DV 2013 (fusion by projective association, points that contradict the view are removed).
std::shared_ptr<const PointMap> update_points(std::shared_ptr<const PointMap> map, const Frame& frame,
                                              const Prediction& view, const PointUpdateSettings& settings,
                                              PointTallies& tallies);

}  // namespace ppm
