/// The OpenGL functions that the renderer calls, fetched from its own context.
#pragma once

#include <string>

#include <GL/glcorearb.h>

#include "renderer/gl/context.h"

namespace stereobench::renderer {

/// A table of functions, named as in the OpenGL specification without their "gl". Calling the symbols of a
/// libGL instead would silently do nothing: they know another library's contexts.
struct Gl {
  /// Fetches every function. @throws std::runtime_error naming the one that is missing
  explicit Gl(const Context& context);

  PFNGLATTACHSHADERPROC AttachShader;
  PFNGLBINDBUFFERPROC BindBuffer;
  PFNGLBINDFRAMEBUFFERPROC BindFramebuffer;
  PFNGLBINDRENDERBUFFERPROC BindRenderbuffer;
  PFNGLBINDTEXTUREPROC BindTexture;
  PFNGLBINDVERTEXARRAYPROC BindVertexArray;
  PFNGLBLENDFUNCSEPARATEPROC BlendFuncSeparate;
  PFNGLBUFFERDATAPROC BufferData;
  PFNGLCHECKFRAMEBUFFERSTATUSPROC CheckFramebufferStatus;
  PFNGLCLEARPROC Clear;
  PFNGLCLEARCOLORPROC ClearColor;
  PFNGLCLEARDEPTHPROC ClearDepth;
  PFNGLCLIPCONTROLPROC ClipControl;
  PFNGLCOMPILESHADERPROC CompileShader;
  PFNGLCREATEPROGRAMPROC CreateProgram;
  PFNGLCREATESHADERPROC CreateShader;
  PFNGLDELETEBUFFERSPROC DeleteBuffers;
  PFNGLDELETEFRAMEBUFFERSPROC DeleteFramebuffers;
  PFNGLDELETEPROGRAMPROC DeleteProgram;
  PFNGLDELETERENDERBUFFERSPROC DeleteRenderbuffers;
  PFNGLDELETESHADERPROC DeleteShader;
  PFNGLDELETETEXTURESPROC DeleteTextures;
  PFNGLDELETEVERTEXARRAYSPROC DeleteVertexArrays;
  PFNGLDEPTHFUNCPROC DepthFunc;
  PFNGLCULLFACEPROC CullFace;
  PFNGLDEPTHMASKPROC DepthMask;
  PFNGLDETACHSHADERPROC DetachShader;
  PFNGLDISABLEPROC Disable;
  PFNGLDRAWARRAYSPROC DrawArrays;
  PFNGLDRAWARRAYSINSTANCEDBASEINSTANCEPROC DrawArraysInstancedBaseInstance;
  PFNGLENABLEPROC Enable;
  PFNGLENABLEVERTEXATTRIBARRAYPROC EnableVertexAttribArray;
  PFNGLFRAMEBUFFERRENDERBUFFERPROC FramebufferRenderbuffer;
  PFNGLGENBUFFERSPROC GenBuffers;
  PFNGLGENFRAMEBUFFERSPROC GenFramebuffers;
  PFNGLGENRENDERBUFFERSPROC GenRenderbuffers;
  PFNGLGENTEXTURESPROC GenTextures;
  PFNGLGENVERTEXARRAYSPROC GenVertexArrays;
  PFNGLGETERRORPROC GetError;
  PFNGLGETPROGRAMINFOLOGPROC GetProgramInfoLog;
  PFNGLGETPROGRAMIVPROC GetProgramiv;
  PFNGLGETSHADERINFOLOGPROC GetShaderInfoLog;
  PFNGLGETSHADERIVPROC GetShaderiv;
  PFNGLGETSTRINGPROC GetString;
  PFNGLGETUNIFORMLOCATIONPROC GetUniformLocation;
  PFNGLLINKPROGRAMPROC LinkProgram;
  PFNGLPIXELSTOREIPROC PixelStorei;
  PFNGLREADPIXELSPROC ReadPixels;
  PFNGLRELEASESHADERCOMPILERPROC ReleaseShaderCompiler;
  PFNGLRENDERBUFFERSTORAGEPROC RenderbufferStorage;
  PFNGLSCISSORPROC Scissor;
  PFNGLSHADERSOURCEPROC ShaderSource;
  PFNGLTEXBUFFERPROC TexBuffer;
  PFNGLUNIFORM1FPROC Uniform1f;
  PFNGLUNIFORM1IVPROC Uniform1iv;
  PFNGLUNIFORM2FPROC Uniform2f;
  PFNGLUNIFORM2IPROC Uniform2i;
  PFNGLUNIFORM3FPROC Uniform3f;
  PFNGLUNIFORMMATRIX4FVPROC UniformMatrix4fv;
  PFNGLUSEPROGRAMPROC UseProgram;
  PFNGLVERTEXATTRIBDIVISORPROC VertexAttribDivisor;
  PFNGLVERTEXATTRIBPOINTERPROC VertexAttribPointer;
  PFNGLVIEWPORTPROC Viewport;
};

/// One of the context's descriptions of itself (GL_VERSION, GL_RENDERER, GL_VENDOR); empty when it has none.
std::string gl_string(const Gl& gl, GLenum name);

}  // namespace stereobench::renderer
