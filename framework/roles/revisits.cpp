#include "framework/roles/revisits.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace ppm {

namespace {

using IndexPair = std::pair<std::size_t, std::size_t>;  // into `images`, the earlier one first

/// At most `most` of some values, evenly from the first on.
template <class T>
std::vector<T> thinned(const std::vector<T>& values, std::size_t most) {
  if (values.size() <= most) return values;
  std::vector<T> some;
  for (std::size_t k = 0; k < most; ++k) some.push_back(values[k * values.size() / most]);
  return some;
}

/// The path's poses with the source's own numbers of their images; those that are no image of the source are left out.
std::vector<StampedPose> numbered(const std::vector<StampedPose>& path, const FrameSource& source) {
  constexpr double kSameStamp = 1e-6;  // s, of stamps that were written as text
  std::vector<StampedPose> out;
  auto at = path.begin();
  for (auto index : source.given()) {
    const double stamp = source.stamp_s(index);
    while (at != path.end() && at->stamp_s < stamp - kSameStamp) ++at;
    if (at != path.end() && at->stamp_s <= stamp + kSameStamp) out.push_back({index, stamp, at->T_map_camera});
  }
  return out;
}

/// The images that may be compared, ascending.
std::vector<StampedPose> candidates(const std::vector<StampedPose>& path, const RevisitSettings& settings) {
  if (path.empty() || path.back().frame - path.front().frame < settings.gap) return {};
  if (settings.form == RevisitSettings::Gap::at_least) return thinned(path, settings.images);
  std::map<std::int64_t, const StampedPose*> by_index;
  for (const auto& p : path) by_index.emplace(p.frame, &p);
  std::vector<const StampedPose*> first;
  for (const auto& p : path)
    if (by_index.contains(p.frame + settings.gap)) first.push_back(&p);
  std::map<std::int64_t, StampedPose> chosen;
  for (const auto* p : thinned(first, settings.images))
    for (auto index : {p->frame, p->frame + settings.gap}) chosen.emplace(index, *by_index.at(index));
  std::vector<StampedPose> images;
  for (const auto& [index, pose] : chosen) images.push_back(pose);
  return images;
}

std::vector<PosedImage> read(const std::vector<StampedPose>& poses, const FrameSource& source, const Workers& workers) {
  std::vector<std::optional<PosedImage>> slots(poses.size());
  workers.for_each(poses.size(), [&](std::size_t i, int) {
    slots[i].emplace(source.full_frame(poses[i].frame), poses[i].T_map_camera);
  });
  std::vector<PosedImage> images;
  images.reserve(slots.size());
  for (auto& slot : slots) images.push_back(std::move(*slot));
  return images;
}

std::vector<IndexPair> overlapping(const std::vector<StampedPose>& poses, const std::vector<PosedImage>& images,
                                   const RevisitSettings& settings, const Workers& workers) {
  std::vector<std::vector<IndexPair>> found(images.size());
  workers.for_each(images.size(), [&](std::size_t i, int) {
    for (std::size_t j = i + 1; j < images.size(); ++j) {
      const auto gap = poses[j].frame - poses[i].frame;
      const bool wanted = settings.form == RevisitSettings::Gap::exactly ? gap == settings.gap : gap >= settings.gap;
      if (wanted && overlap(images[i], images[j]) >= settings.overlap &&
          overlap(images[j], images[i]) >= settings.overlap)
        found[i].emplace_back(i, j);
    }
  });
  std::vector<IndexPair> all;
  for (const auto& of_one : found) all.insert(all.end(), of_one.begin(), of_one.end());
  return all;
}

}  // namespace

std::optional<ReprojectionError> score_revisits(const std::vector<StampedPose>& path, const FrameSource& source,
                                                const RevisitSettings& settings, const Workers& workers) {
  const auto poses = candidates(numbered(path, source), settings);
  if (poses.empty()) return std::nullopt;
  const auto images = read(poses, source, workers);
  ReprojectionScorer scorer;
  for (const auto& [i, j] : thinned(overlapping(poses, images, settings, workers), settings.pairs))
    scorer.add(images[i], images[j]);
  if (scorer.empty()) return std::nullopt;
  return scorer.score();
}

}  // namespace ppm
