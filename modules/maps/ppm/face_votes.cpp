#include "modules/maps/ppm/face_votes.hpp"

#include <algorithm>

namespace ppm {
namespace {

constexpr float kFarthest = 9;  // times the predicted variance: squares beyond 3 standard deviations count as if there

/// Squared cosine of incidence at a pixel's own surface.
float squared_cosine(const UpdateView& view, std::size_t p) {
  const float along = view.normal[p].dot(view.point[p]);
  return std::min(along * along / view.point[p].squaredNorm(), 1.0f);
}

/// Squared distance of a measurement from the surface predicted at its own pixel, minus its predicted variance, m^2.
float surplus(const UpdateView& view, std::size_t p, float cosine2) {
  const float off = view.normal[p].dot(view.point[p]) - view.offset[p];
  const float lateral = view.lateral_px * view.depth[p] * view.inv_fx, sigma = view.sigma[p];
  const float predicted = view.prediction->variance[p] + sigma * sigma * cosine2 + lateral * lateral * (1 - cosine2);
  return std::min(off * off, kFarthest * predicted) - predicted;
}

}  // namespace

const std::vector<FaceTally>& FaceTallies::count(const PpmMap& map, const UpdateView& view,
                                                 const std::vector<std::uint8_t>& classes,
                                                 const VoteSettings& settings) {
  find_wide(view, classes, settings.forget_radius);
  for (auto c : chunks_) first_[c] = kNone;  // of the frame before
  first_.resize(map.table().size(), kNone);
  chunks_.clear();
  votes_.clear();
  const Prediction& seen = *view.prediction;
  const float cosine2_least = settings.cosine_least * settings.cosine_least;
  for (std::size_t p = 0; p < classes.size(); ++p) {
    if (!seen.hit(p)) continue;
    Votes& v = votes_of(map, seen.chunk[p], seen.face[p]);
    ++v.seen;
    if (classes[p] & kOwnHit) {
      const float cosine2 = squared_cosine(view, p);
      if (cosine2 < cosine2_least) continue;
      ++v.hits;
      v.surplus += surplus(view, p, cosine2);
    }
    v.through += (classes[p] & kBehind) != 0;
    v.wide += wide_[p] != 0;
  }
  list(map);
  return tallies_;
}

/// Pixels that see through the map in areas at least 2 radius + 1 pixels thick.
void FaceTallies::find_wide(const UpdateView& view, const std::vector<std::uint8_t>& classes, int radius) {
  wide_.resize(classes.size());
  none_.assign(classes.size(), 0);
  bool any = false;
  for (std::size_t p = 0; p < classes.size(); ++p) {
    wide_[p] = (classes[p] & kBehind) != 0;
    any |= wide_[p] != 0;
  }
  if (any) open_mask(view.cols(), view.rows(), radius, none_, wide_);
}

FaceTallies::Votes& FaceTallies::votes_of(const PpmMap& map, std::uint32_t chunk, std::uint32_t face) {
  if (first_[chunk] == kNone) {
    first_[chunk] = static_cast<std::uint32_t>(votes_.size());
    votes_.resize(votes_.size() + map.table()[chunk].geometry->face.size());
    chunks_.push_back(chunk);
  }
  return votes_[first_[chunk] + face];
}

void FaceTallies::list(const PpmMap& map) {
  std::sort(chunks_.begin(), chunks_.end());
  tallies_.clear();
  for (auto c : chunks_)
    for (std::uint32_t f = 0; f < map.table()[c].geometry->face.size(); ++f)
      if (const Votes& v = votes_[first_[c] + f]; v.seen)
        tallies_.push_back({{c, f}, v.hits, v.through, v.surplus, v.hits == 0 && 2 * v.wide > v.seen});
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
  FaceRef last{Prediction::kNone, Prediction::kNone};  // of the pixel before: often this one's too
  bool is_marked = false;
  for (std::size_t p = 0; p < marked.size(); ++p) {
    if (!seen.hit(p)) continue;
    const FaceRef face{seen.chunk[p], seen.face[p]};
    if (face != last) is_marked = std::binary_search(faces.begin(), faces.end(), face);
    last = face;
    marked[p] = is_marked;
  }
}

}  // namespace ppm
