#pragma once
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include "framework/core/pool.hpp"
#include "framework/slam/prediction.hpp"
#include "modules/prediction/gl_rasterizer.hpp"

namespace ppm {

/// How views are drawn.
struct GlViewOptions {
  GlDevice device = GlDevice::any;
  bool cull_back_faces = true;
  int views_per_draw = 10;  ///< 1 .. GlRasterizer::kMostViews
};

/// The faces that a view sees.
struct SeenFaces {
  std::shared_ptr<const std::vector<std::uint32_t>> drawn;  ///< owns what `number` refers to
  std::span<const std::uint32_t> number;                    ///< [rows*cols], by `faces`; FaceNumbers::kNone = nothing
  const FaceNumbers* faces = nullptr;                       ///< of the map; lives until the next update()
};

/// Views of mesh maps by OpenGL. Views that were announced are drawn in batches: the first worker that needs one of a
/// batch draws it whole, while others use what is drawn.
class GlViews {
 public:
  /// Opens a device. Throws Error where there is none that can draw.
  explicit GlViews(const GlViewOptions& options);
  ~GlViews();

  /// Gets ready to draw exactly these maps, which must be alive whenever faces() is called. From one thread, with no
  /// faces() at the same time; likewise expect().
  void update(const std::vector<const PpmMap*>& maps);
  /// Says which views are going to be asked for; forgets those of before.
  void expect(const Camera& camera, std::vector<GlView> views);
  /// The faces that rows of a view see (those of all rows are given). Draws, if need be, its batch; or the view alone
  /// where it was not expected. From any thread.
  SeenFaces faces(const PpmMap& map, const Camera& camera, const Pose& T_map_camera, const Rows& rows);

  const std::string& renderer() const { return context_.renderer(); }
  const GlMeshes& meshes() const { return *meshes_; }

 private:
  using Numbers = std::vector<std::uint32_t>;
  // Expected views side by side, drawn together.
  struct Batch {
    std::shared_ptr<const Numbers> drawn;  // null before it is drawn, and after all rows were asked for
    int rows_left = 0;
  };
  std::shared_ptr<const Numbers> draw(const Camera& camera, std::span<const GlView> views);

  GlViewOptions options_;
  GlContext context_;
  std::unique_ptr<GlMeshes> meshes_;
  std::unique_ptr<GlRasterizer> rasterizer_;
  std::unordered_map<const PpmMap*, FaceNumbers> numbers_;
  std::mutex mutex_;  // guards the context and all below
  Camera camera_;
  std::vector<GlView> expected_;
  std::vector<Batch> batches_;
  Pool<Numbers> pool_;
};

}  // namespace ppm
