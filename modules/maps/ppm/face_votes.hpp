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
  int hits = 0;     ///< pixels that measured it
  int through = 0;  ///< pixels that measured something behind it
};

/// Faces that at least one ray met, ascending, with their votes.
std::vector<FaceTally> tally_faces(const PpmMap& map, const UpdateView& view, const std::vector<std::uint8_t>& classes);

struct VoteSettings {
  float through_per_hit = 2;  ///< a face goes when it was seen through more often than so many times its hits ...
  int through_free = 10;      ///< ... and so many times more
  int hits_most = 65535;      ///< hits count up to here: a surface that was seen for long can still go
};

/// Adds the votes to the evidence of the faces; returns those that have lost it, ascending. They are not removed yet.
std::vector<FaceRef> cast_votes(const std::vector<FaceTally>& tallies, const VoteSettings& settings, PpmEdit& edit);

/// Marks the pixels [px] whose predicted face is in `faces` (ascending).
void mark_pixels(const UpdateView& view, const std::vector<FaceRef>& faces, std::vector<std::uint8_t>& marked);

}  // namespace ppm
