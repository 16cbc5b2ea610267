#include "modules/prediction/gl_program.hpp"

#include <string>

#include "framework/core/error.hpp"
#include "modules/prediction/gl_functions.hpp"

namespace ppm {
namespace {

GLuint compile(const GlFunctions& gl, GLenum stage, const char* source) {
  const GLuint shader = gl.CreateShader(stage);
  gl.ShaderSource(shader, 1, &source, nullptr);
  gl.CompileShader(shader);
  return shader;
}

}  // namespace

unsigned make_gl_program(const GlFunctions& gl, const char* vertex, const char* fragment) {
  const GLuint program = gl.CreateProgram();
  const GLuint shaders[] = {compile(gl, GL_VERTEX_SHADER, vertex), compile(gl, GL_FRAGMENT_SHADER, fragment)};
  for (GLuint shader : shaders) gl.AttachShader(program, shader);
  gl.LinkProgram(program);
  std::string log(4096, '\0');
  std::string words;
  for (GLuint shader : shaders) {
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    words += log.c_str();
    gl.DeleteShader(shader);
  }
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  gl.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
  gl.DeleteProgram(program);
  throw Error(fmt::format("OpenGL refuses our shaders: {}{}", words, log.c_str()));
}

}  // namespace ppm
