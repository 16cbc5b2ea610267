#pragma once
#include <utility>

#include "framework/graph/module.hpp"
#include "framework/slam/particle_set.hpp"

namespace ppm {

/// What an edit of a map is a function of, beside the frame.
enum class EditReads {
  view,  ///< the particle's map, pose and prediction
  map,   ///< its map alone
};

/// Base of modules that change maps as a pure function of what they read: particles that agree in all of it (copies of
/// one ancestor after resampling) are computed once, by the lowest of them, and share the result. Draws no random
/// numbers. Predictions end with the edit: they were of the maps before it.
class MapEditor : public Module {
 public:
  InOut<Belief> belief;

  /// Work shared by all maps before they are edited. Called from one thread.
  virtual void before(Context&) {}
  /// The map of particle i after the edit. Reads no other particle's data. May return the map it was given (no change).
  /// `map` is the particle's handle, moved in, while the belief's map column is empty: where no other particle has the
  /// map (and no sink keeps a snapshot), it is the only handle and its memory may be reused: a deferred prediction is to
  /// be completed before. Called from any worker.
  virtual MapHandle edit(Context& context, std::size_t particle, MapHandle map, int worker) = 0;
  /// After all edits, for each particle in order: the one whose edit gave it its map (itself, or the one that it agrees
  /// with). For columns of the editor's own. Called from one thread.
  virtual void edited(std::size_t /*particle*/, std::size_t /*by*/) {}

  void tick(Context& context) final;

 protected:
  /// facets: beside that predictions are dropped.
  explicit MapEditor(Facets facets, EditReads reads = EditReads::view);

 private:
  EditReads reads_;
};

}  // namespace ppm
