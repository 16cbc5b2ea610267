#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "framework/slam/prediction.hpp"
#include "tests/prediction/face_tree.hpp"

namespace ppm::test {

/// What became of one pixel of a back-end's view, against exact arithmetic.
enum class Verdict {
  same,    ///< the element that the oracle's ray meets first, or nothing where it meets nothing
  tie,     ///< another one that the same ray meets at the same range: coplanar, crossing, or a shared edge
  edge,    ///< what the oracle's ray meets elsewhere within kEdge of the pixel
  sliver,  ///< no such ray was found, but every face that tells the answers apart has its outline within kEdge
  close,   ///< right if surface nearer to the camera than kClosest is left out
  fault,   ///< none of these
};
constexpr std::size_t kVerdicts = 6;
std::string_view name_of(Verdict verdict);

constexpr double kEdge = 1.0 / 64;  ///< px
constexpr double kClosest = 0.01;   ///< m along the optical axis
/// Ranges, and hits on their face, agree to this share of (1 m + range), over the cosine of incidence.
constexpr double kRangeShare = 4e-6;
/// Corners are known to this share of (1 m + range + sides of the face), which counts where the face is narrow.
constexpr double kCornerShare = 4e-7;
/// Attributes agree with the texture at the hit that the back-end names: relative to their size, and at least absolute.
constexpr double kAttribute = 2e-5;

/// Pixels counted by verdict, and the largest errors of hits in units of what is tolerated: more than 1 is a fault.
struct Tally {
  std::size_t pixels = 0, hits = 0;
  std::array<std::size_t, kVerdicts> count{};
  double range = 0, point = 0, normal = 0, mean = 0, variance = 0, color = 0;
  std::string first_fault;  ///< in words; empty where there is none

  void add(const Tally& other);
  std::size_t of(Verdict verdict) const { return count[static_cast<std::size_t>(verdict)]; }
  /// Share of pixels that rounding decides: ties, edges, slivers.
  double doubtful() const;
  double worst_error() const;
};

/// Judges every pixel of a view of `map` whose arrays are filled, texels interpolated. tree: of the same map, with back
/// faces as the view has them.
Tally judge(const PpmMap& map, const FaceTree& tree, const Prediction& view);

}  // namespace ppm::test
