#include "modules/maps/ppm/ppm_update.hpp"

#include <algorithm>
#include <cmath>

namespace ppm {
namespace {

/// Hands new faces to the edit session, with texels that have seen this frame.
class FaceWriter {
 public:
  FaceWriter(const UpdateView& view, const ColorView& colors, const TexelSettings& texels, float excess,
             Boundary& boundary, PpmEdit& edit)
      : view_(view),
        colors_(colors),
        texels_(texels),
        excess_(excess),
        boundary_(boundary),
        edit_(edit),
        used_(boundary.vertex.size(), 0) {}

  void write(const RimFace& face) {
    std::array<std::uint32_t, 3> ids;
    std::array<Eigen::Vector3f, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      ids[k] = id_of(face[k]);
      corner[k] = boundary_.vertex[face[k]].point;
    }
    const PpmSettings& map = edit_.map().settings();
    const auto n = divisions(corner);
    mean_.resize(texel_count(n));
    variance_.resize(texel_count(n));
    start_texels(view_, texels_, corner, n, static_cast<float>(map.prior_sigma_m * map.prior_sigma_m), excess_, mean_,
                 variance_);
    if (!colors_.empty()) {
      color_.resize(static_cast<std::size_t>(colors_.channels()) * mean_.size());
      color_variance_.resize(mean_.size());
      start_color(view_, colors_, texels_, corner, n, excess_, {mean_, variance_, color_, color_variance_});
    }
    edit_.add_face(ids, static_cast<std::uint8_t>(n), {mean_, variance_, color_, color_variance_}, {0, 0, excess_});
  }

 private:
  /// By the map's texel size, or by the footprint of pixels here where that is larger.
  std::uint32_t divisions(const std::array<Eigen::Vector3f, 3>& corner) const {
    const float wanted = static_cast<float>(edit_.map().settings().texel_size_m);
    const float depth = view_.project((corner[0] + corner[1] + corner[2]) / 3).z();
    const float texel = std::max(wanted, texels_.least_pixels * depth * std::abs(view_.inv_fx));
    const float scale = wanted / texel;  // a smaller face of the same shape
    return edit_.map().divisions_for(scale * corner[0], scale * corner[1], scale * corner[2]);
  }
  std::uint32_t id_of(std::uint32_t number) {
    RimVertex& v = boundary_.vertex[number];
    if (v.id == RimVertex::kNew)
      v.id = edit_.add_vertex(v.position);
    else if (!used_[number])
      edit_.use_vertex(v.id, v.position);
    used_[number] = 1;
    return v.id;
  }

  const UpdateView& view_;
  const ColorView& colors_;
  const TexelSettings& texels_;
  float excess_;
  Boundary& boundary_;
  PpmEdit& edit_;
  std::vector<std::uint8_t> used_;
  std::vector<float> mean_, variance_, color_, color_variance_;
};

/// Sets scratch.wanted: pixels where surface may be made in this frame. Returns how many there are.
std::size_t find_wanted(int open_radius, UpdateScratch& scratch) {
  const UpdateView& view = scratch.view;
  const auto& classes = scratch.classes;
  scratch.wanted.resize(classes.size());
  scratch.unknown.resize(classes.size());
  for (std::size_t p = 0; p < classes.size(); ++p) {
    scratch.wanted[p] = (classes[p] & kWanted) != 0;
    scratch.unknown[p] = !view.measured(p);
  }
  if (open_radius > 0) open_mask(view.cols(), view.rows(), open_radius, scratch.unknown, scratch.wanted);
  return static_cast<std::size_t>(std::count(scratch.wanted.begin(), scratch.wanted.end(), 1));
}

bool is_due(int every, std::int64_t frame) {
  return every > 0 && frame % every == 0;
}

/// Classifies pixels and lets them vote: faces that lost leave the map, and their pixels are misses at once. Sets
/// scratch.classes, removed and kept. Returns the excess that new faces start with, m^2.
float vote(const UpdateSettings& settings, const Workers& workers, UpdateScratch& scratch, PpmEdit& edit) {
  const UpdateView& view = scratch.view;
  classify_pixels(view, settings.gate, settings.classify_sigmas, {}, workers, scratch.classes);
  const auto& tallies = scratch.tallies.count(edit.map(), view, scratch.classes, settings.votes);
  const float excess = learn_excess(tallies, settings.excess, edit);
  scratch.removed = cast_votes(tallies, settings.votes, edit);
  const auto& removed = scratch.removed;
  scratch.kept.clear();
  for (const auto& t : tallies)
    if (!std::binary_search(removed.begin(), removed.end(), t.face)) scratch.kept.push_back(t.face);
  if (removed.empty()) return excess;
  for (const auto& f : removed) edit.remove_face(f.chunk, f.face);
  mark_pixels(view, removed, scratch.gone);
  classify_pixels(view, settings.gate, settings.classify_sigmas, scratch.gone, workers, scratch.classes);
  return excess;
}

/// New surface, notches and holes: sets scratch.faces, over vertices of scratch.boundary.
UpdateCounts propose_faces(const UpdateSettings& settings, std::int64_t frame_number, UpdateScratch& scratch) {
  const UpdateView& view = scratch.view;
  auto& faces = scratch.faces;
  faces.clear();
  NewSurfaceSettings surface = settings.surface;
  if (is_due(settings.grazing_every, frame_number)) surface.triangle.cosine_least = settings.grazing_cosine;
  NotchSettings notches = settings.notches;
  notches.triangle = surface.triangle;
  UpdateCounts counts;
  counts.removed_faces = scratch.removed.size();
  counts.wanted_pixels = find_wanted(is_due(settings.thin_every, frame_number) ? 0 : settings.open_radius, scratch);
  if (counts.wanted_pixels > 0) make_surface(view, scratch.classes, scratch.wanted, surface, scratch.boundary, faces);
  counts.new_faces = faces.size();
  fill_notches(view, scratch.classes, notches, scratch.boundary, faces);
  fill_holes(view, settings.holes, scratch.boundary, faces);
  counts.filled_faces = faces.size() - counts.new_faces;
  return counts;
}

}  // namespace

void UpdateSettings::share() {
  texels.gate = surface.triangle.gate = holes.gate = gate;
}

std::shared_ptr<const PpmMap> update_map(std::shared_ptr<const PpmMap> map, const Frame& frame,
                                         const Prediction& prediction, const UpdateSettings& settings,
                                         std::int64_t frame_number, const Workers& workers, UpdateScratch& scratch,
                                         UpdateCounts* counts) {
  const UpdateView& view = scratch.view;
  const auto& classes = scratch.classes;
  scratch.view.build(frame, prediction, workers);
  PpmEdit edit(std::move(map));
  const float excess = vote(settings, workers, scratch, edit);
  const ColorView colors(frame, view, classes, edit.map().settings().color_channels, settings.color);
  update_texels(view, classes, scratch.kept, settings.texels, workers, edit);
  update_color(view, colors, classes, scratch.kept, settings.texels, workers, edit);

  scratch.boundary.build(edit.map(), view, scratch.removed);
  const UpdateCounts made = propose_faces(settings, frame_number, scratch);
  FaceWriter writer(view, colors, settings.texels, excess, scratch.boundary, edit);
  for (const auto& f : scratch.faces) writer.write(f);
  if (counts) *counts = made;
  return edit.commit();
}

std::shared_ptr<const PpmMap> update_visible_texels(std::shared_ptr<const PpmMap> map, const Frame& frame, int stride,
                                                    const Pose& T_map_camera, const VisibleFaces& seen,
                                                    const TexelSettings& settings) {
  GatherImage image = gather_image(frame.camera.decimated(stride), T_map_camera);
  image.lateral_px = frame.lateral_px / static_cast<float>(stride);
  image.row_step = stride * frame.camera.cols;
  image.col_step = stride;
  image.depth = frame.depth.data();
  image.sigma = frame.sigma.data();
  const GatherGate gate = gather_gate(settings);
  PpmEdit edit(std::move(map));
  for (const auto& part : seen.parts()) {
    Texels& texels = edit.texels(part.chunk);
    gather_faces(image, gate, gather_faces_of(*edit.map().table()[part.chunk].geometry, texels), part.faces.data(),
                 part.faces.size());
  }
  return edit.commit();
}

}  // namespace ppm
