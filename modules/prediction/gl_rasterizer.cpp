#include "modules/prediction/gl_rasterizer.hpp"

#include <algorithm>
#include <tuple>

#include "framework/core/error.hpp"
#include "modules/maps/ppm/visible_chunks.hpp"
#include "modules/prediction/gl_functions.hpp"
#include "modules/prediction/gl_program.hpp"

namespace ppm {
namespace {

constexpr GLuint kPosition = 0, kInstance = 1;  // vertex attributes and the bindings that they read

// Depth is near / z: 1 at the near plane, 0 at infinity, with the same relative precision at every range.
constexpr const char* kVertexShader = R"(#version 450 core
#extension GL_ARB_shader_viewport_layer_array : require
struct View { vec4 centre, x, y, z; };
layout(std140, binding = 0) uniform Views { View views[256]; };
layout(location = 0) in vec3 position;
layout(location = 1) in uvec2 instance;
flat out uint face;
void main() {
  View view = views[instance.x];
  vec3 p = position - view.centre.xyz;
  gl_Position = vec4(dot(view.x.xyz, p), dot(view.y.xyz, p), view.centre.w, dot(view.z.xyz, p));
  gl_Layer = int(instance.x);
  face = instance.y + uint(gl_VertexID);
}
)";
constexpr const char* kFragmentShader = R"(#version 450 core
flat in uint face;
layout(location = 0) out uint number;
void main() { number = face; }
)";

// A view as the vertex shader reads it: clip coordinates x, y, w are the products of x, y, z with the point seen from
// the camera's centre, in the map's axes.
struct ViewBlock {
  float centre[4];  // m, map frame; near plane, m
  float x[4], y[4], z[4];
};

template <class Row>
void put(const Row& row, float (&out)[4]) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(row(i));
  out[3] = 0;
}

ViewBlock block_of(const Camera& camera, const Pose& T_map_camera) {
  const Eigen::Matrix3d R = T_map_camera.linear();
  ViewBlock block;
  put(T_map_camera.translation(), block.centre);
  block.centre[3] = static_cast<float>(GlRasterizer::kNear);
  // A window's pixel has its centre half a pixel off its integer coordinates; ours does not.
  put(2 * camera.fx / camera.cols * R.col(0) + ((2 * camera.cx + 1) / camera.cols - 1) * R.col(2), block.x);
  put(2 * camera.fy / camera.rows * R.col(1) + ((2 * camera.cy + 1) / camera.rows - 1) * R.col(2), block.y);
  put(R.col(2), block.z);
  return block;
}

template <class T>
void fill(const GlFunctions& gl, GLuint buffer, const std::vector<T>& data) {
  gl.NamedBufferData(buffer, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), GL_STREAM_DRAW);
}

}  // namespace

GlRasterizer::GlRasterizer(const GlContext& context, bool cull_back_faces)
    : context_(context), target_(context.gl()) {
  const GlFunctions& gl = context_.gl();
  program_ = make_gl_program(gl, kVertexShader, kFragmentShader);
  gl.CreateBuffers(1, &views_);
  gl.CreateBuffers(1, &instances_);
  gl.CreateBuffers(1, &commands_);
  gl.NamedBufferData(views_, kMostViews * sizeof(ViewBlock), nullptr, GL_DYNAMIC_DRAW);
  gl.CreateVertexArrays(1, &vertex_array_);
  gl.VertexArrayAttribFormat(vertex_array_, kPosition, 3, GL_FLOAT, GL_FALSE, 0);
  gl.VertexArrayAttribIFormat(vertex_array_, kInstance, 2, GL_UNSIGNED_INT, 0);
  gl.VertexArrayBindingDivisor(vertex_array_, kInstance, 1);
  for (GLuint attribute : {kPosition, kInstance}) {
    gl.VertexArrayAttribBinding(vertex_array_, attribute, attribute);
    gl.EnableVertexArrayAttrib(vertex_array_, attribute);
  }
  gl.VertexArrayVertexBuffer(vertex_array_, kInstance, instances_, 0, 2 * sizeof(GLuint));
  gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_GREATER);
  gl.CullFace(GL_BACK);
  if (cull_back_faces) gl.Enable(GL_CULL_FACE);
  context_.check();
}

GlRasterizer::~GlRasterizer() {
  const GlFunctions& gl = context_.gl();
  gl.DeleteVertexArrays(1, &vertex_array_);
  for (GLuint buffer : {views_, instances_, commands_}) gl.DeleteBuffers(1, &buffer);
  gl.DeleteProgram(program_);
}

// Which chunks each view may see, in the order of drawing: by chunk number, so that of equally near faces the same one
// wins whatever else is drawn; the same triangles for several views stand together.
void GlRasterizer::collect(const Camera& camera, std::span<const GlView> views) {
  instance_.clear();
  for (std::uint32_t v = 0; v < views.size(); ++v)
    for (std::uint32_t chunk : chunks_in_image(*views[v].map, camera, views[v].T_map_camera))
      instance_.push_back({chunk, views[v].map->table()[chunk].geometry.get(), v});
  std::ranges::sort(instance_, {}, [](const Instance& i) { return std::tuple(i.chunk, i.geometry->id, i.view); });
}

void GlRasterizer::send(std::span<const GlView> views, const GlMeshes& meshes) {
  instance_data_.clear();
  command_.clear();
  const Geometry* last = nullptr;
  for (const Instance& i : instance_) {
    const GlMesh& mesh = meshes.of(*i.geometry);
    if (i.geometry != last)
      command_.push_back({3 * mesh.faces, 0, 3 * mesh.first_face, mesh.first_vertex,
                          static_cast<std::uint32_t>(instance_data_.size())});
    last = i.geometry;
    ++command_.back().instances;
    instance_data_.push_back({i.view, views[i.view].numbers->first(i.chunk) - mesh.first_vertex});
  }
  fill(context_.gl(), instances_, instance_data_);
  fill(context_.gl(), commands_, command_);
}

void GlRasterizer::send_views(const Camera& camera, std::span<const GlView> views) {
  std::vector<ViewBlock> blocks;
  blocks.reserve(views.size());
  for (const GlView& view : views) blocks.push_back(block_of(camera, view.T_map_camera));
  context_.gl().NamedBufferSubData(views_, 0, static_cast<GLsizeiptr>(blocks.size() * sizeof(ViewBlock)),
                                   blocks.data());
}

void GlRasterizer::draw(const Camera& camera, std::span<const GlView> views, const GlMeshes& meshes,
                        std::span<std::uint32_t> numbers) {
  const auto layers = static_cast<int>(views.size());
  PPM_CHECK(layers <= kMostViews && numbers.size() == views.size() * static_cast<std::size_t>(camera.pixels()),
            "{} views, {} numbers", views.size(), numbers.size());
  collect(camera, views);
  if (instance_.empty()) {
    std::ranges::fill(numbers, FaceNumbers::kNone);
    return;
  }
  const GlFunctions& gl = context_.gl();
  target_.resize(camera.cols, camera.rows, layers);
  send(views, meshes);
  send_views(camera, views);
  target_.start(layers);
  gl.FrontFace(camera.fx * camera.fy > 0 ? GL_CW : GL_CCW);  // rows grow downwards, a window's upwards
  gl.UseProgram(program_);
  gl.BindVertexArray(vertex_array_);
  gl.VertexArrayVertexBuffer(vertex_array_, kPosition, meshes.positions(), 0, 3 * sizeof(float));
  gl.VertexArrayElementBuffer(vertex_array_, meshes.indices());
  gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, views_);
  gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_);
  gl.MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, static_cast<GLsizei>(command_.size()), 0);
  target_.read(layers, numbers.data());
  context_.check();
}

}  // namespace ppm
