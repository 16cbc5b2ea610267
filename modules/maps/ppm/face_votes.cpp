#include "modules/maps/ppm/face_votes.hpp"

#include <algorithm>

#include "modules/maps/ppm/texel_update.hpp"

namespace ppm {
namespace {

float cosine_at(const UpdateView& view, std::size_t p) {
  return std::min(std::abs(view.normal[p].dot(view.point[p])) / view.point[p].norm(), 1.0f);
}

constexpr float kFarthest = 9;  // times the predicted variance: squares beyond 3 standard deviations count as if there

/// Squared distance of a measurement from the surface predicted at its own pixel, minus its predicted variance, m^2.
float surplus(const UpdateView& view, std::size_t p, float cosine) {
  const float off = view.normal[p].dot(view.point[p]) - view.offset[p];
  const float lateral = view.lateral_px * view.depth[p] * std::abs(view.inv_fx);
  const float predicted = view.prediction->variance[p] + variance_along_normal(view.sigma[p], cosine, lateral);
  return std::min(off * off, kFarthest * predicted) - predicted;
}

/// Pixels that see through the map in areas at least 2 radius + 1 pixels thick.
std::vector<std::uint8_t> wide_behind(const UpdateView& view, const std::vector<std::uint8_t>& classes, int radius) {
  std::vector<std::uint8_t> behind(classes.size());
  const std::vector<std::uint8_t> none(classes.size());
  for (std::size_t p = 0; p < classes.size(); ++p) behind[p] = (classes[p] & kBehind) != 0;
  open_mask(view.cols(), view.rows(), radius, none, behind);
  return behind;
}

}  // namespace

std::vector<FaceTally> tally_faces(const PpmMap& map, const UpdateView& view,
                                   const std::vector<std::uint8_t>& classes, const VoteSettings& settings) {
  struct Votes {
    std::uint16_t seen = 0, hits = 0, through = 0, wide = 0;
    float surplus = 0;
  };
  const auto wide = wide_behind(view, classes, settings.forget_radius);
  std::vector<std::vector<Votes>> votes(map.table().size());  // by chunk and face; empty for chunks that no ray met
  const Prediction& seen = *view.prediction;
  for (std::size_t p = 0; p < classes.size(); ++p) {
    if (!seen.hit(p)) continue;
    auto& chunk = votes[seen.chunk[p]];
    if (chunk.empty()) chunk.resize(map.table()[seen.chunk[p]].geometry->face.size());
    Votes& v = chunk[seen.face[p]];
    ++v.seen;
    if (classes[p] & kOwnHit) {
      const float cosine = cosine_at(view, p);
      if (cosine < settings.cosine_least) continue;
      ++v.hits;
      v.surplus += surplus(view, p, cosine);
    }
    v.through += (classes[p] & kBehind) != 0;
    v.wide += wide[p] != 0;
  }
  std::vector<FaceTally> tallies;
  for (std::uint32_t c = 0; c < votes.size(); ++c)
    for (std::uint32_t f = 0; f < votes[c].size(); ++f)
      if (const Votes& v = votes[c][f]; v.seen) tallies.push_back({{c, f}, v.hits, v.through, v.surplus, v.hits == 0 && 2 * v.wide > v.seen});
  return tallies;
}

float learn_excess(const std::vector<FaceTally>& tallies, const ExcessSettings& settings, PpmEdit& edit) {
  if (!settings.learn) return 0;
  const auto prior_hits = static_cast<float>(settings.prior_hits);
  float sum = prior_hits * settings.prior_sigma * settings.prior_sigma, weight = prior_hits;
  for (const auto& t : tallies) {
    if (t.hits == 0) continue;
    FaceEvidence& e = edit.texels(t.face.chunk).evidence[t.face.face];
    if (e.hits < settings.least_views * t.hits) continue;
    const auto hits = static_cast<float>(t.hits);
    const float observed = t.surplus / hits + e.added_variance();  // the prediction counted the excess already
    const float gain = hits / (prior_hits + static_cast<float>(e.hits) + hits);
    e.excess += gain * (observed - e.excess);
    sum += hits * e.added_variance();
    weight += hits;
  }
  return sum / weight;
}

std::vector<FaceRef> cast_votes(const std::vector<FaceTally>& tallies, const VoteSettings& settings, PpmEdit& edit) {
  std::vector<FaceRef> lost;
  for (const auto& t : tallies) {
    if (t.hits == 0 && t.through == 0) continue;
    FaceEvidence& e = edit.texels(t.face.chunk).evidence[t.face.face];
    if (t.deserted) e.hits -= static_cast<std::uint16_t>(settings.forget * static_cast<float>(e.hits));
    e.hits = static_cast<std::uint16_t>(std::min(e.hits + t.hits, 65535));
    e.through = static_cast<std::uint16_t>(std::min(e.through + t.through, 65535));
    if (static_cast<float>(e.through) >
        settings.through_per_hit * static_cast<float>(e.hits) + static_cast<float>(settings.through_free))
      lost.push_back(t.face);
  }
  return lost;
}

void mark_pixels(const UpdateView& view, const std::vector<FaceRef>& faces, std::vector<std::uint8_t>& marked) {
  const Prediction& seen = *view.prediction;
  marked.assign(view.depth.size(), 0);
  for (std::size_t p = 0; p < marked.size(); ++p)
    marked[p] = seen.hit(p) && std::binary_search(faces.begin(), faces.end(), FaceRef{seen.chunk[p], seen.face[p]});
}

}  // namespace ppm
