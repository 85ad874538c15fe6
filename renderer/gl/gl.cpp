#include "renderer/gl/gl.h"

namespace stereobench::renderer {
namespace {

template <typename Function>
void fetch(const Context& context, const char* name, Function& function) {
  function = reinterpret_cast<Function>(context.procedure(name));
}

/// Buffers, framebuffers, textures and arrays of vertices.
void fetch_objects(const Context& context, Gl& gl) {
  fetch(context, "glBindBuffer", gl.BindBuffer);
  fetch(context, "glBindFramebuffer", gl.BindFramebuffer);
  fetch(context, "glBindRenderbuffer", gl.BindRenderbuffer);
  fetch(context, "glBindTexture", gl.BindTexture);
  fetch(context, "glBindVertexArray", gl.BindVertexArray);
  fetch(context, "glBufferData", gl.BufferData);
  fetch(context, "glCheckFramebufferStatus", gl.CheckFramebufferStatus);
  fetch(context, "glDeleteBuffers", gl.DeleteBuffers);
  fetch(context, "glDeleteFramebuffers", gl.DeleteFramebuffers);
  fetch(context, "glDeleteRenderbuffers", gl.DeleteRenderbuffers);
  fetch(context, "glDeleteTextures", gl.DeleteTextures);
  fetch(context, "glDeleteVertexArrays", gl.DeleteVertexArrays);
  fetch(context, "glFramebufferRenderbuffer", gl.FramebufferRenderbuffer);
  fetch(context, "glGenBuffers", gl.GenBuffers);
  fetch(context, "glGenFramebuffers", gl.GenFramebuffers);
  fetch(context, "glGenRenderbuffers", gl.GenRenderbuffers);
  fetch(context, "glGenTextures", gl.GenTextures);
  fetch(context, "glGenVertexArrays", gl.GenVertexArrays);
  fetch(context, "glRenderbufferStorage", gl.RenderbufferStorage);
  fetch(context, "glTexBuffer", gl.TexBuffer);
}

/// Shaders, programs and their uniforms.
void fetch_programs(const Context& context, Gl& gl) {
  fetch(context, "glAttachShader", gl.AttachShader);
  fetch(context, "glCompileShader", gl.CompileShader);
  fetch(context, "glCreateProgram", gl.CreateProgram);
  fetch(context, "glCreateShader", gl.CreateShader);
  fetch(context, "glDeleteProgram", gl.DeleteProgram);
  fetch(context, "glDeleteShader", gl.DeleteShader);
  fetch(context, "glDetachShader", gl.DetachShader);
  fetch(context, "glGetProgramInfoLog", gl.GetProgramInfoLog);
  fetch(context, "glGetProgramiv", gl.GetProgramiv);
  fetch(context, "glGetShaderInfoLog", gl.GetShaderInfoLog);
  fetch(context, "glGetShaderiv", gl.GetShaderiv);
  fetch(context, "glGetUniformLocation", gl.GetUniformLocation);
  fetch(context, "glLinkProgram", gl.LinkProgram);
  fetch(context, "glReleaseShaderCompiler", gl.ReleaseShaderCompiler);
  fetch(context, "glShaderSource", gl.ShaderSource);
  fetch(context, "glUniform1f", gl.Uniform1f);
  fetch(context, "glUniform1iv", gl.Uniform1iv);
  fetch(context, "glUniform2f", gl.Uniform2f);
  fetch(context, "glUniform2i", gl.Uniform2i);
  fetch(context, "glUniform3f", gl.Uniform3f);
  fetch(context, "glUniformMatrix4fv", gl.UniformMatrix4fv);
  fetch(context, "glUseProgram", gl.UseProgram);
}

/// State, drawing and reading back.
void fetch_drawing(const Context& context, Gl& gl) {
  fetch(context, "glBlendFuncSeparate", gl.BlendFuncSeparate);
  fetch(context, "glClear", gl.Clear);
  fetch(context, "glClearColor", gl.ClearColor);
  fetch(context, "glClearDepth", gl.ClearDepth);
  fetch(context, "glClipControl", gl.ClipControl);
  fetch(context, "glDepthFunc", gl.DepthFunc);
  fetch(context, "glCullFace", gl.CullFace);
  fetch(context, "glDepthMask", gl.DepthMask);
  fetch(context, "glDisable", gl.Disable);
  fetch(context, "glDrawArrays", gl.DrawArrays);
  fetch(context, "glDrawArraysInstancedBaseInstance", gl.DrawArraysInstancedBaseInstance);
  fetch(context, "glEnable", gl.Enable);
  fetch(context, "glEnableVertexAttribArray", gl.EnableVertexAttribArray);
  fetch(context, "glGetError", gl.GetError);
  fetch(context, "glGetString", gl.GetString);
  fetch(context, "glPixelStorei", gl.PixelStorei);
  fetch(context, "glReadPixels", gl.ReadPixels);
  fetch(context, "glScissor", gl.Scissor);
  fetch(context, "glVertexAttribDivisor", gl.VertexAttribDivisor);
  fetch(context, "glVertexAttribPointer", gl.VertexAttribPointer);
  fetch(context, "glViewport", gl.Viewport);
}

}  // namespace

Gl::Gl(const Context& context) {
  fetch_objects(context, *this);
  fetch_programs(context, *this);
  fetch_drawing(context, *this);
}

std::string gl_string(const Gl& gl, GLenum name) {
  const GLubyte* text = gl.GetString(name);
  return text == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(text));
}

}  // namespace stereobench::renderer
