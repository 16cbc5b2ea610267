#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "framework/core/parallel.hpp"
#include "framework/core/pool.hpp"
#include "framework/core/record.hpp"
#include "framework/core/se3.hpp"
#include "framework/slam/camera.hpp"
#include "framework/slam/rows.hpp"
#include "framework/slam/view_samples.hpp"

namespace ppm {

/// All rows of a camera's image.
inline Rows all_rows(const Camera& camera) {
  return {0, camera.rows};
}

struct Prediction;

/// A view of which a back-end knows so far which element each pixel shows, and finds the rest when asked: a likelihood
/// that compares few pixels, or needs few of the attributes, pays for no others, and they stay in the core's cache.
/// Refers to the map that was looked at without owning it: whoever asks must hold a handle to that map, so that it is
/// not edited in place meanwhile. Asking changes nothing and may be done from several threads.
class DeferredView {
 public:
  virtual ~DeferredView() = default;
  /// Fills `out`, which has the size of `pixels` (indices into the view, ascending) and the colour channels that are
  /// asked for.
  virtual void sample(const Prediction& view, std::span<const std::uint32_t> pixels, ViewSamples& out) const = 0;
  /// Fills some rows of all arrays of `out`, which were reset to misses. out: of the same camera and pose as `view`.
  virtual void fill(const Prediction& view, const Rows& rows, Prediction& out) const = 0;
  /// Which element the pixels of some rows show: chunk and face as in Prediction, one entry a pixel of these rows each.
  /// Whoever needs no more asks for no more. Here: what fill() says; a back-end that keeps elements hands them out.
  virtual void elements(const Prediction& view, const Rows& rows, std::span<std::uint32_t> chunk,
                        std::span<std::uint32_t> face) const;
};

/// What a camera at a pose should see of a map: one entry a pixel of `camera` (row-major, [rows*cols]).
/// It is where maps and likelihoods meet: a weighting knows this and no map.
/// The described surface lies `mean` beyond the element along `normal`; expected_range() is its range along the ray.
/// Written by one prediction node, read-only after. Where it is deferred the arrays are empty: sample() answers for
/// chosen pixels, completed() gives the view with all of them.
struct Prediction {
  static constexpr float kMiss = std::numeric_limits<float>::infinity();
  static constexpr std::uint32_t kNone = 0xffffffffu;

  Camera camera;   ///< the predicted image's camera: the frame's, decimated by `stride`
  int stride = 1;  ///< frame pixel (stride*x, stride*y) is prediction pixel (x, y)
  Pose T_map_camera = Pose::Identity();

  std::vector<float> range;     ///< m along the ray to the element; kMiss = nothing hit
  std::vector<float> mean;      ///< m along the normal, from the element to the described surface; 0 where unknown
  std::vector<float> variance;  ///< m^2 along the normal; 0 at a miss
  std::vector<float> normal;    ///< [3*pixels] xyz interleaved, unit, map frame, turned towards the camera; 0 at a miss
  std::vector<std::uint32_t> chunk;  ///< the map's chunk hit; kNone = miss
  std::vector<std::uint32_t> face;   ///< the element (PPM: face) within the chunk
  int color_channels = 0;             ///< C: 0 (the map has no colour), 1 (intensity) or 3 (red, green, blue)
  std::vector<float> color;           ///< [C*pixels] interleaved, 0 .. 1 as the camera encodes it; 0 at a miss
  std::vector<float> color_variance;  ///< [pixels] of each channel alike, by the map alone; empty where C = 0
  std::vector<float>
      bary;  ///< [2*pixels] u, v of the hit: p = (1-u-v) p0 + u p1 + v p2; 0 where elements are no triangles

  std::shared_ptr<DeferredView> deferred;  ///< null where the arrays are filled

  /// Sizes every array for the camera and fills them with misses. Keeps capacity. channels: of colour, the map's.
  void reset(const Camera& frame_camera, int stride_, const Pose& T_map_camera_, int channels = 0);
  /// The same without the arrays, which become empty and keep their memory: for a view that is to be deferred.
  void reset_deferred(const Camera& frame_camera, int stride_, const Pose& T_map_camera_, int channels = 0);
  /// What the view shows at some pixels, ascending: from the arrays, or from the deferred view (see there for who may
  /// ask). out.color_channels: 0, or the view's.
  void sample(std::span<const std::uint32_t> pixels, ViewSamples& out) const;
  /// Which element the pixels of some rows show, see DeferredView::elements(): from the arrays, or the deferred view.
  void elements(const Rows& rows, std::span<std::uint32_t> chunk_out, std::span<std::uint32_t> face_out) const;
  bool hit(std::size_t pixel) const { return chunk[pixel] != kNone; }

  /// Smallest cosine between ray and normal that is divided by: an offset along the normal moves a grazing hit at most
  /// 5 times as far along the ray. The first order says nothing useful about flatter views.
  static constexpr double kMinCosine = 0.2;
  /// Unit direction of the pixel's ray, map frame.
  Eigen::Vector3d direction(std::size_t pixel) const;
  /// |normal . direction| of a hit, at least kMinCosine. direction: see direction(pixel).
  double cosine(std::size_t pixel, const Eigen::Vector3d& direction) const;
  /// Range of the described surface, to first order, m: range - mean / cosine (a positive mean is nearer to the
  /// camera).
  double expected_range(std::size_t pixel, const Eigen::Vector3d& direction) const {
    return range[pixel] - mean[pixel] / cosine(pixel, direction);
  }
  /// Variance of that range by the map alone, m^2: variance / cosine^2.
  double range_variance(std::size_t pixel, const Eigen::Vector3d& direction) const {
    const double c = cosine(pixel, direction);
    return variance[pixel] / (c * c);
  }
};

void save(RecordWriter& out, const Prediction& prediction);
void load(RecordReader& in, Prediction& prediction);

using PredictionHandle = std::shared_ptr<const Prediction>;

using PredictionPool = Pool<Prediction>;

/// The view with its arrays filled: itself, or, of a deferred one, a view from the pool that workers fill in bands of
/// rows. The caller holds the map.
PredictionHandle completed(const PredictionHandle& view, PredictionPool& pool, const Workers& workers);

}  // namespace ppm
