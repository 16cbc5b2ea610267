#pragma once
#include <cstdint>
#include <memory>

#include "framework/core/parallel.hpp"
#include "framework/slam/frame.hpp"
#include "framework/slam/prediction.hpp"
#include "modules/maps/ppm/face_votes.hpp"
#include "modules/maps/ppm/hole_fill.hpp"
#include "modules/maps/ppm/new_surface.hpp"
#include "modules/maps/ppm/notch_fill.hpp"
#include "modules/maps/ppm/texel_color.hpp"
#include "modules/maps/ppm/texel_update.hpp"
#include "modules/maps/ppm/visible_faces.hpp"

namespace ppm {

/// How a frame changes a map; see the parameters of map_update.ppm_bayes.
struct UpdateSettings {
  SurfaceGate gate;  ///< copied into the parts below by whoever sets it
  float classify_sigmas = 6;
  int open_radius = 2;  ///< px, of the opening that leaves thin strips of wanted pixels for later; 0 = none
  int thin_every = 1;   ///< frames: so often thin strips are let through; 0 = never
  /// frames: so often surface may be made down to grazing_cosine, where no view has shown it better; 0 = never
  int grazing_every = 3;
  float grazing_cosine = 0.15f;  ///< least cosine of incidence of new surface in those frames
  VoteSettings votes;
  ExcessSettings excess;
  TexelSettings texels;
  ColorSettings color;  ///< for maps with colour
  NewSurfaceSettings surface;
  NotchSettings notches;
  HoleSettings holes;

  /// Gives every part the gate that is set here. Notches take the surface's triangle test frame by frame.
  void share();
};

/// Memory that updates use one after the other, so that none is allocated anew for each.
struct UpdateScratch {
  UpdateView view;
  std::vector<std::uint8_t> classes, gone, wanted, unknown;  // [px]
  FaceTallies tallies;
  std::vector<FaceRef> kept, removed;  // of the faces in view; ascending
  Boundary boundary;
  std::vector<RimFace> faces;
};

/// What an update did.
struct UpdateCounts {
  std::size_t wanted_pixels = 0, new_faces = 0, filled_faces = 0, removed_faces = 0;
};

/// The map after one frame: pixels are classified against the prediction, faces voted on and removed, texels updated,
/// new surface made and stitched on, slits and small holes closed. A pure function of its arguments: the same bytes
/// each time. map: moved in; where it is the only handle its memory is reused. prediction: of this map at the frame's
/// pose. frame_number: counts updates of the run, from 0. workers: share the parts that no order binds. scratch: the
/// calling thread's own.
std::shared_ptr<const PpmMap> update_map(std::shared_ptr<const PpmMap> map, const Frame& frame,
                                         const Prediction& prediction, const UpdateSettings& settings,
                                         std::int64_t frame_number, const Workers& workers, UpdateScratch& scratch,
                                         UpdateCounts* counts = nullptr);

/// The light update of frames that bring nothing new: the texels of the faces in view take the image's offsets in the
/// gather form, and all else stays: faces, evidence, colour. Shares everything with the map but those texels; allocates
/// nothing but copies of shared chunks. map: moved in, as in update_map(). seen: the faces that a view of the map shows
/// with the camera, decimated by `stride`, at the pose.
std::shared_ptr<const PpmMap> update_visible_texels(std::shared_ptr<const PpmMap> map, const Frame& frame, int stride,
                                                    const Pose& T_map_camera, const VisibleFaces& seen,
                                                    const TexelSettings& settings);

}  // namespace ppm
