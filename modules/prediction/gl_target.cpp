#include "modules/prediction/gl_target.hpp"

#include "framework/core/error.hpp"
#include "modules/prediction/face_numbers.hpp"
#include "modules/prediction/gl_functions.hpp"

namespace ppm {
namespace {

GLuint make_layers(const GlFunctions& gl, GLenum format, int cols, int rows, int layers) {
  GLuint texture = 0;
  gl.CreateTextures(GL_TEXTURE_2D_ARRAY, 1, &texture);
  gl.TextureStorage3D(texture, 1, format, cols, rows, layers);
  return texture;
}

}  // namespace

GlTarget::~GlTarget() {
  release();
}

void GlTarget::release() {
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(1, &number_);
  gl_.DeleteTextures(1, &depth_);
  framebuffer_ = number_ = depth_ = 0;
  layers_ = 0;
}

void GlTarget::resize(int cols, int rows, int layers) {
  if (cols == cols_ && rows == rows_ && layers <= layers_) return;
  release();
  number_ = make_layers(gl_, GL_R32UI, cols, rows, layers);
  depth_ = make_layers(gl_, GL_DEPTH_COMPONENT32F, cols, rows, layers);
  gl_.CreateFramebuffers(1, &framebuffer_);
  gl_.NamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, number_, 0);
  gl_.NamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, depth_, 0);
  if (gl_.CheckNamedFramebufferStatus(framebuffer_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error(fmt::format("OpenGL cannot draw into {} images of {} x {} px", layers, cols, rows));
  cols_ = cols;
  rows_ = rows;
  layers_ = layers;
}

void GlTarget::start(int layers) {
  const GLuint none = FaceNumbers::kNone;
  const float farthest = 0.0f;
  gl_.ClearTexSubImage(number_, 0, 0, 0, 0, cols_, rows_, layers, GL_RED_INTEGER, GL_UNSIGNED_INT, &none);
  gl_.ClearTexSubImage(depth_, 0, 0, 0, 0, cols_, rows_, layers, GL_DEPTH_COMPONENT, GL_FLOAT, &farthest);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, cols_, rows_);
}

void GlTarget::read(int layers, unsigned* numbers) const {
  const auto bytes = static_cast<GLsizei>(sizeof(GLuint)) * cols_ * rows_ * layers;
  gl_.GetTextureSubImage(number_, 0, 0, 0, 0, cols_, rows_, layers, GL_RED_INTEGER, GL_UNSIGNED_INT, bytes, numbers);
}

}  // namespace ppm
