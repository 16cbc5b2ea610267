#pragma once
#include <cstdint>
#include <vector>

#include "modules/maps/ppm/boundary.hpp"
#include "modules/maps/ppm/pixel_classes.hpp"
#include "modules/maps/ppm/ppm_edit.hpp"

namespace ppm {

/// What one frame says of a face.
struct FaceTally {
  FaceRef face;
  int hits = 0;     ///< pixels that measured it, and not at grazing incidence
  int through = 0;  ///< pixels that measured something behind it
  /// m^2: over the hits, squared distance from the predicted surface minus the variance predicted for it, summed.
  float surplus = 0;
  /// Not hit, and most of it lies where the image sees through the map over a whole area, not only along an edge.
  bool deserted = false;
};

struct VoteSettings {
  /// Pixels that meet a face at a smaller cosine do not speak for it: there a gate along the normal is a long way along
  /// the ray, and a fin over a depth jump would be confirmed by what is behind it.
  float cosine_least = 0.3f;
  float through_per_hit = 0.8f;  ///< a face goes when it was seen through more often than so many times its hits ...
  int through_free = 2;          ///< ... and so many times more
  float forget = 0.1f;           ///< share of a face's hits that each frame takes away in which it is deserted
  int forget_radius = 3;  ///< px: areas thinner than 2 r + 1 that are seen through are edges; see FaceTally::deserted
};

/// Counts what a frame says. Kept between frames for its memory.
class FaceTallies {
 public:
  /// Faces that at least one ray met, ascending, with their votes. Good until the next count().
  const std::vector<FaceTally>& count(const PpmMap& map, const UpdateView& view,
                                      const std::vector<std::uint8_t>& classes, const VoteSettings& settings);

 private:
  struct Votes {
    std::uint16_t seen = 0, hits = 0, through = 0, wide = 0;  // pixels
    float surplus = 0;
  };
  static constexpr std::uint32_t kNone = 0xffffffffu;

  void find_wide(const UpdateView& view, const std::vector<std::uint8_t>& classes, int radius);
  Votes& votes_of(const PpmMap& map, std::uint32_t chunk, std::uint32_t face);
  void list(const PpmMap& map);

  std::vector<std::uint32_t> first_;   // by chunk: of its faces in votes_; kNone for chunks that no ray met
  std::vector<std::uint32_t> chunks_;  // those that rays met
  std::vector<Votes> votes_;
  std::vector<std::uint8_t> wide_, none_;  // [px] sees through the map over a whole area; nothing
  std::vector<FaceTally> tallies_;
};

/// Adds the votes to the evidence of the faces; returns those that have lost it, ascending. They are not removed yet.
std::vector<FaceRef> cast_votes(const std::vector<FaceTally>& tallies, const VoteSettings& settings, PpmEdit& edit);

/// How a face learns its excess variance, FaceEvidence::excess.
struct ExcessSettings {
  bool learn = true;           ///< false: it stays 0, the paper's form
  float prior_sigma = 0.005f;  ///< m, what the first faces of a map start with
  int prior_hits = 100;        ///< hits that a face's start counts for
  /// A face learns from a frame once it has been hit so many times as often as in that frame: images taken one after
  /// another share the error of their poses, and agree with what they made more than later ones will.
  int least_views = 6;
};

/// Moves the excess of the faces towards the surplus of this frame, as the mean over all their hits. Before
/// cast_votes(): it reads the hits of the frames before. Returns what new faces start with, m^2: the mean over the hits
/// of this frame, since faces that are seen together have poses and sensor in common; the settings' own where there are
/// few.
float learn_excess(const std::vector<FaceTally>& tallies, const ExcessSettings& settings, PpmEdit& edit);

/// Marks the pixels [px] whose predicted face is in `faces` (ascending).
void mark_pixels(const UpdateView& view, const std::vector<FaceRef>& faces, std::vector<std::uint8_t>& marked);

}  // namespace ppm
