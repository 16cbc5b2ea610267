#include "modules/maps/points/point_update.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/error.hpp"
#include "framework/slam/measured_pixels.hpp"

namespace ppm {

namespace {

std::uint16_t count_up(std::uint16_t count) {
  return count == 0xffff ? count : static_cast<std::uint16_t>(count + 1);
}

/// One frame and one map.
class Update {
 public:
  Update(const Frame& frame, const Prediction& view, const PointUpdateSettings& settings,
         PointTallies& tallies)
      : frame_(frame), view_(view), settings_(settings), tallies_(tallies), measured_(frame, view) {}

  /// Counts what each pixel says.
  void look(const PointMap& map) {
    tallies_.reset(map.table().size());
    for (int y = 0; y < view_.camera.rows; ++y)
      for (int x = 0; x < view_.camera.cols; ++x)
        if (measured_.valid(x, y)) look(map, x, y);
  }

  void fuse(PointEdit& edit) {
    std::ranges::sort(tallies_.tiles);
    const auto spacing = static_cast<float>(edit.map().spacing_m());
    std::vector<PointEdit::Place> gone;
    for (const auto tile : tallies_.tiles) {
      auto& points = edit.points(tile);
      for (std::uint32_t k = 0; k < points.size(); ++k) {
        const PointTally& tally = tallies_.tally[tallies_.first[tile] + k];
        if (tally.measured > 0) fuse(tally, spacing, points[k]);
        if (!vote(tally, points[k])) gone.push_back({tile, k});
      }
    }
    edit.remove(gone);
  }

  void grow(PointEdit& edit) const {
    const auto spacing = static_cast<float>(edit.map().spacing_m());
    for (const auto& [at, normal] : tallies_.candidates) {
      if (edit.find(at.position, normal, spacing, settings_.agree_cosine)) continue;
      SurfacePoint point;
      point.position = at.position;
      point.normal = UnitNormal(normal);
      point.information = 1 / std::max(at.variance_along(normal), least_variance());
      point.scatter = settings_.scatter_sigma_m * settings_.scatter_sigma_m;
      point.set_radius(std::max(spacing, radius(at, normal)));
      point.hits = 1;
      edit.add(point);
    }
  }

 private:
  float least_variance() const { return settings_.sigma_least_m * settings_.sigma_least_m; }
  /// Of a disc that reaches to those of the pixels beside, m.
  float radius(const MeasuredPoint& at, const Eigen::Vector3f& normal) const {
    constexpr float kSteepest = 0.3f;  // flatter views stretch a disc no further
    return settings_.radius_pixels * at.footprint / std::max(-normal.dot(at.ray), kSteepest);
  }

  void look(const PointMap& map, int x, int y) {
    const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.camera.cols) + static_cast<std::size_t>(x);
    const MeasuredPoint at = measured_.at(x, y);
    if (!view_.hit(pixel)) return offer(at, measured_.normal(x, y, settings_.normal_reach, settings_.jump_m), x, y);
    const SurfacePoint& point = map.table()[view_.chunk[pixel]].tile->points[view_.face[pixel]];
    const Eigen::Vector3f seen(view_.normal[3 * pixel], view_.normal[3 * pixel + 1], view_.normal[3 * pixel + 2]);
    const float cosine = -seen.dot(at.ray), in_front = (view_.range[pixel] - at.range) * cosine;
    const float map_variance = std::min(point.variance(), settings_.map_sigma_most_m * settings_.map_sigma_most_m);
    const float sensor = at.variance_along(seen);
    const float gate = settings_.gate_sigmas *
                       std::sqrt(sensor + settings_.gate_pose_m * settings_.gate_pose_m + map_variance);
    PointTally& tally = tallies_.of(map, view_.chunk[pixel], view_.face[pixel]);
    const bool speaks = cosine > settings_.votes_cosine;
    if (in_front < -gate) {
      tally.through += speaks;
      return;
    }
    const Eigen::Vector3f normal = measured_.normal(x, y, settings_.normal_reach, settings_.jump_m);
    const bool agrees = in_front < gate && !(normal.dot(point.normal.vector()) < settings_.agree_cosine && !normal.isZero());
    if (agrees) {
      tally.hits += speaks;
      add(at, normal, point, sensor, tally);
    }
    const auto spacing = static_cast<float>(map.spacing_m());
    if (!agrees || (at.position - point.position).squaredNorm() > spacing * spacing) offer(at, normal, x, y);
  }

  void add(const MeasuredPoint& at, const Eigen::Vector3f& normal, const SurfacePoint& point, float sensor,
           PointTally& tally) const {
    const float off = point.normal.vector().dot(at.position - point.position);
    const float weight = 1 / sensor;
    ++tally.measured;
    tally.weight += weight;
    tally.shift += weight * off;
    tally.surplus += off * off - sensor - 1 / point.information;
    tally.normal += normal;
    tally.radius = std::min(tally.radius, radius(at, point.normal.vector()));
  }

  void offer(const MeasuredPoint& at, const Eigen::Vector3f& normal, int x, int y) {
    if (normal.isZero() || -normal.dot(at.ray) < settings_.cosine_least) return;
    if (at_depth_jump(frame_, x * view_.stride, y * view_.stride, settings_.jump_m)) return;
    tallies_.candidates.push_back({at, normal});
  }

  void fuse(const PointTally& tally, float spacing, SurfacePoint& point) const {
    const Eigen::Vector3f normal = point.normal.vector();
    point.position += tally.shift / (point.information + tally.weight) * normal;
    point.information = std::min(point.information + tally.weight, 1 / least_variance());
    const float frames = static_cast<float>(point.hits) + static_cast<float>(settings_.scatter_frames);
    point.scatter += (tally.surplus / static_cast<float>(tally.measured) - point.scatter) / (frames + 1);
    // A mean over frames, of which so many are remembered: the surface may be known better from nearer.
    constexpr float kFrames = 50;
    const Eigen::Vector3f turned = std::min(static_cast<float>(point.hits), kFrames) * normal +
                                   tally.normal / static_cast<float>(tally.measured);
    if (turned.squaredNorm() > 0) point.normal = UnitNormal(turned);
    SurfacePoint nearer = point;
    nearer.set_radius(std::max(tally.radius, spacing));
    point.radius = std::min(point.radius, nearer.radius);
  }

  /// What the frame says for and against a point; false: it goes.
  bool vote(const PointTally& tally, SurfacePoint& point) const {
    if (tally.hits >= tally.through) {
      if (tally.hits > 0) point.hits = count_up(point.hits);
      return true;
    }
    point.through = count_up(point.through);
    if (tally.measured == 0)
      point.hits = static_cast<std::uint16_t>(static_cast<float>(point.hits) * (1 - settings_.votes_forget));
    return static_cast<float>(point.through) <=
           settings_.votes_ratio * static_cast<float>(point.hits) + settings_.votes_free;
  }

  const Frame& frame_;
  const Prediction& view_;
  const PointUpdateSettings& settings_;
  PointTallies& tallies_;
  MeasuredPoints measured_;
};

}  // namespace

std::shared_ptr<const PointMap> update_points(std::shared_ptr<const PointMap> map, const Frame& frame,
                                              const Prediction& view, const PointUpdateSettings& settings,
                                              PointTallies& tallies) {
  PPM_CHECK(!view.deferred, "the view's arrays are not filled");
  Update update(frame, view, settings, tallies);
  update.look(*map);
  PointEdit edit(std::move(map));
  update.fuse(edit);
  update.grow(edit);
  return edit.commit();
}

}  // namespace ppm
