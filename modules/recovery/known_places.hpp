#pragma once
#include <numbers>
#include <span>
#include <vector>

#include "framework/config/params.hpp"
#include "framework/core/parallel.hpp"
#include "framework/roles/view_predictor.hpp"
#include "framework/slam/place_signature.hpp"

namespace ppm {

/// Poses from which a map has been seen, each with the signature of what the map shows from there: where a frame was taken
/// is sought among them.
class KnownPlaces {
 public:
  void declare(Params& params);
  /// Takes of the poses, in their order, those that are far from all taken before, and looks at the map from each.
  /// camera: of the frames that are to be found. The predictor is prepared for the map.
  void build(std::span<const Pose> T_map_camera, const ViewPredictor& predictor, const Map& map, const Camera& camera,
             const Workers& workers);
  void forget() { places_.clear(); }
  std::size_t size() const { return places_.size(); }

  /// Where a frame was taken if this place is the one: the place's pose, turned by what the signatures say.
  struct Candidate {
    Pose T_map_camera = Pose::Identity();
    double difference = 0;  ///< of the signatures
  };
  /// The `candidates` likeliest, likeliest first.
  std::vector<Candidate> candidates(const Frame& frame, const Workers& workers) const;

  void save(RecordWriter& out) const { out.add(places_); }
  void load(RecordReader& in) { in.take(places_); }

 private:
  struct Place {
    Pose T_map_camera = Pose::Identity();
    PlaceSignature signature;
  };
  friend void save(RecordWriter& out, const Place& place);
  friend void load(RecordReader& in, Place& place);

  double distance_ = 0.25, angle_ = 15 * std::numbers::pi / 180;
  int candidates_ = 12;
  std::vector<Place> places_;
};

}  // namespace ppm
