#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "framework/core/se3.hpp"
#include "framework/slam/camera.hpp"
#include "modules/prediction/face_numbers.hpp"
#include "modules/prediction/gl_context.hpp"
#include "modules/prediction/gl_meshes.hpp"
#include "modules/prediction/gl_target.hpp"

namespace ppm {

/// A view to be drawn.
struct GlView {
  const PpmMap* map = nullptr;
  const FaceNumbers* numbers = nullptr;  ///< of the map
  Pose T_map_camera = Pose::Identity();
};

/// Draws the faces that views see, several views together: each chunk's triangles are drawn once for all views of a
/// batch whose image they may meet, as instances, each into the layer of its view. Where two faces are equally near,
/// the one of the lower number is seen. What lies less than kNear in front of the camera is not seen.
/// Every call, the destructor too, needs the context to be current.
///
/// source   paper, section 5; depth reversed in floats after Reed, "Depth Precision Visualized", 2015
class GlRasterizer {
 public:
  static constexpr int kMostViews = 256;  ///< in one draw: what uniform blocks hold everywhere
  static constexpr double kNear = 1e-3;   ///< m, along the optical axis

  /// cull_back_faces: faces seen from behind are not there. Throws Error where the driver refuses.
  GlRasterizer(const GlContext& context, bool cull_back_faces);
  GlRasterizer(const GlRasterizer&) = delete;
  GlRasterizer& operator=(const GlRasterizer&) = delete;
  ~GlRasterizer();

  /// views: at most kMostViews, of maps that `meshes` holds. numbers: [views * rows * cols], the face that each pixel
  /// shows, FaceNumbers::kNone where nothing. Throws Error where the device fails.
  void draw(const Camera& camera, std::span<const GlView> views, const GlMeshes& meshes,
            std::span<std::uint32_t> numbers);

 private:
  // A chunk in a view.
  struct Instance {
    std::uint32_t chunk;
    const Geometry* geometry;
    std::uint32_t view;
  };
  // What the device reads, see DrawElementsIndirectCommand in OpenGL's specification.
  struct Command {
    std::uint32_t indices, instances, first_index, first_vertex, first_instance;
  };

  void collect(const Camera& camera, std::span<const GlView> views);
  void send(std::span<const GlView> views, const GlMeshes& meshes);
  void send_views(const Camera& camera, std::span<const GlView> views);

  const GlContext& context_;
  GlTarget target_;
  unsigned program_ = 0, vertex_array_ = 0;
  unsigned views_ = 0, instances_ = 0, commands_ = 0;  // buffers
  std::vector<Instance> instance_;
  // View, and what is added to a vertex's place on the device (modulo 2^32) to give the number of the face that it is
  // the last vertex of.
  std::vector<std::array<std::uint32_t, 2>> instance_data_;
  std::vector<Command> command_;
};

}  // namespace ppm
