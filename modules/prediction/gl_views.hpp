#pragma once
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include "framework/core/pool.hpp"
#include "framework/slam/prediction.hpp"
#include "modules/prediction/face_view.hpp"
#include "modules/prediction/gl_rasterizer.hpp"

namespace ppm {

/// How views are drawn.
struct GlViewOptions {
  GlDevice device = GlDevice::any;
  bool cull_back_faces = true;
  int views_per_draw = 4;  ///< 1 .. GlRasterizer::kMostViews
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
  /// The faces that a view shows. Draws, if need be, its batch; or the view alone where it was not expected. From any
  /// thread.
  ShownFaces faces(const PpmMap& map, const Camera& camera, const Pose& T_map_camera);

  const std::string& renderer() const { return context_.renderer(); }
  const GlMeshes& meshes() const { return *meshes_; }

 private:
  using Numbers = std::vector<std::uint32_t>;
  // Expected views side by side, drawn together.
  struct Batch {
    std::shared_ptr<const Numbers> drawn;  // null before it is drawn, and after all views were asked for
    std::size_t views_left = 0;
  };
  std::shared_ptr<const Numbers> draw(const Camera& camera, std::span<const GlView> views);

  GlViewOptions options_;
  GlContext context_;
  std::unique_ptr<GlMeshes> meshes_;
  std::unique_ptr<GlRasterizer> rasterizer_;
  std::unordered_map<const PpmMap*, std::shared_ptr<const FaceNumbers>> numbers_;
  std::mutex mutex_;  // guards the context and all below
  Camera camera_;
  std::vector<GlView> expected_;
  std::vector<Batch> batches_;
  Pool<Numbers> pool_;
};

}  // namespace ppm
