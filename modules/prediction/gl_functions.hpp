#pragma once
#include <GL/glcorearb.h>

// The OpenGL functions that are used, without their prefix, and their types.
#define PPM_GL_FUNCTIONS(F)                                   \
  F(AttachShader, ATTACHSHADER)                               \
  F(BindBufferBase, BINDBUFFERBASE)                           \
  F(BindBuffer, BINDBUFFER)                                   \
  F(BindFramebuffer, BINDFRAMEBUFFER)                         \
  F(BindVertexArray, BINDVERTEXARRAY)                         \
  F(CheckNamedFramebufferStatus, CHECKNAMEDFRAMEBUFFERSTATUS) \
  F(ClearTexSubImage, CLEARTEXSUBIMAGE)                       \
  F(ClipControl, CLIPCONTROL)                                 \
  F(CompileShader, COMPILESHADER)                             \
  F(CopyNamedBufferSubData, COPYNAMEDBUFFERSUBDATA)           \
  F(CreateBuffers, CREATEBUFFERS)                             \
  F(CreateFramebuffers, CREATEFRAMEBUFFERS)                   \
  F(CreateProgram, CREATEPROGRAM)                             \
  F(CreateShader, CREATESHADER)                               \
  F(CreateTextures, CREATETEXTURES)                           \
  F(CreateVertexArrays, CREATEVERTEXARRAYS)                   \
  F(CullFace, CULLFACE)                                       \
  F(DeleteBuffers, DELETEBUFFERS)                             \
  F(DeleteFramebuffers, DELETEFRAMEBUFFERS)                   \
  F(DeleteProgram, DELETEPROGRAM)                             \
  F(DeleteShader, DELETESHADER)                               \
  F(DeleteTextures, DELETETEXTURES)                           \
  F(DeleteVertexArrays, DELETEVERTEXARRAYS)                   \
  F(DepthFunc, DEPTHFUNC)                                     \
  F(Enable, ENABLE)                                           \
  F(EnableVertexArrayAttrib, ENABLEVERTEXARRAYATTRIB)         \
  F(FrontFace, FRONTFACE)                                     \
  F(GetError, GETERROR)                                       \
  F(GetIntegerv, GETINTEGERV)                                 \
  F(GetProgramInfoLog, GETPROGRAMINFOLOG)                     \
  F(GetProgramiv, GETPROGRAMIV)                               \
  F(GetShaderInfoLog, GETSHADERINFOLOG)                       \
  F(GetString, GETSTRING)                                     \
  F(GetStringi, GETSTRINGI)                                   \
  F(GetTextureSubImage, GETTEXTURESUBIMAGE)                   \
  F(LinkProgram, LINKPROGRAM)                                 \
  F(MultiDrawElementsIndirect, MULTIDRAWELEMENTSINDIRECT)     \
  F(NamedBufferData, NAMEDBUFFERDATA)                         \
  F(NamedBufferStorage, NAMEDBUFFERSTORAGE)                   \
  F(NamedBufferSubData, NAMEDBUFFERSUBDATA)                   \
  F(NamedFramebufferTexture, NAMEDFRAMEBUFFERTEXTURE)         \
  F(ShaderSource, SHADERSOURCE)                               \
  F(TextureStorage3D, TEXTURESTORAGE3D)                       \
  F(UseProgram, USEPROGRAM)                                   \
  F(VertexArrayAttribBinding, VERTEXARRAYATTRIBBINDING)       \
  F(VertexArrayAttribFormat, VERTEXARRAYATTRIBFORMAT)         \
  F(VertexArrayAttribIFormat, VERTEXARRAYATTRIBIFORMAT)       \
  F(VertexArrayBindingDivisor, VERTEXARRAYBINDINGDIVISOR)     \
  F(VertexArrayElementBuffer, VERTEXARRAYELEMENTBUFFER)       \
  F(VertexArrayVertexBuffer, VERTEXARRAYVERTEXBUFFER)         \
  F(Viewport, VIEWPORT)

namespace ppm {

/// OpenGL by pointers that were asked of EGL: nothing is linked, so that a machine without OpenGL runs all else.
struct GlFunctions {
#define PPM_GL_MEMBER(name, type) PFNGL##type##PROC name = nullptr;
  PPM_GL_FUNCTIONS(PPM_GL_MEMBER)
#undef PPM_GL_MEMBER
};

}  // namespace ppm
