#include "modules/recovery/known_places.hpp"

#include <algorithm>
#include <numbers>

namespace ppm {

namespace {

// Largest shifts of signatures that are tried, in cells: a third of the image's width and a quarter of its height.
constexpr int kMostCols = 6, kMostRows = 4;

/// A view for a signature needs two pixels a cell and direction.
int signature_stride(const Camera& camera) {
  return std::max(1, std::min(camera.cols / (2 * PlaceSignature::kCols), camera.rows / (2 * PlaceSignature::kRows)));
}

}  // namespace

void save(RecordWriter& out, const KnownPlaces::Place& place) {
  out.add(place.T_map_camera);
  out.add(place.signature);
}

void load(RecordReader& in, KnownPlaces::Place& place) {
  in.take(place.T_map_camera);
  in.take(place.signature);
}

void KnownPlaces::declare(Params& params) {
  params.add("place_distance", distance_)
      .unit("m")
      .range(0, 100)
      .doc("Poses of the path that are nearer to each other than this, and turned by less than place_angle, are one place.");
  params.add("place_angle", angle_).unit("rad").range(0, std::numbers::pi).doc("See place_distance.");
  params.add("candidates", candidates_)
      .range(1, 10000)
      .doc("So many places that look most like the frame are tried in each frame of a search.");
}

void KnownPlaces::build(std::span<const Pose> T_map_camera, const ViewPredictor& predictor, const Map& map,
                        const Camera& camera, const Workers& workers) {
  places_.clear();
  auto known = [&](const Pose& T) {
    return std::ranges::any_of(places_, [&](const Place& p) { return are_near(p.T_map_camera, T, distance_, angle_); });
  };
  for (const Pose& T : T_map_camera)
    if (!known(T)) places_.push_back({T, {}});
  PerWorker<Prediction> views;
  views.resize(workers.threads());
  workers.for_each(places_.size(), [&](std::size_t i, int worker) {
    views[worker].reset(camera, signature_stride(camera), places_[i].T_map_camera);
    predictor.predict_all(map, views[worker], worker);
    places_[i].signature = PlaceSignature::of(views[worker]);
  });
}

std::vector<KnownPlaces::Candidate> KnownPlaces::candidates(const Frame& frame, const Workers& workers) const {
  const auto seen = PlaceSignature::of(frame);
  std::vector<Candidate> found(places_.size());
  workers.for_each(places_.size(), [&](std::size_t i, int) {
    const auto match = best_match(seen, places_[i].signature, kMostCols, kMostRows);
    found[i] = {places_[i].T_map_camera * turn_of(match, frame.camera), match.difference};
  });
  std::ranges::stable_sort(found, {}, &Candidate::difference);
  found.resize(std::min(found.size(), static_cast<std::size_t>(candidates_)));
  return found;
}

}  // namespace ppm
