#include "renderer/gl.h"

namespace stereobench::renderer {
namespace {

template <typename Function>
void fetch(const Context& context, const char* name, Function& function) {
  function = reinterpret_cast<Function>(context.procedure(name));
}

}  // namespace

Gl::Gl(const Context& context) {
  fetch(context, "glAttachShader", AttachShader);
  fetch(context, "glBindBuffer", BindBuffer);
  fetch(context, "glBindFramebuffer", BindFramebuffer);
  fetch(context, "glBindRenderbuffer", BindRenderbuffer);
  fetch(context, "glBindTexture", BindTexture);
  fetch(context, "glBindVertexArray", BindVertexArray);
  fetch(context, "glBlendFuncSeparate", BlendFuncSeparate);
  fetch(context, "glBufferData", BufferData);
  fetch(context, "glCheckFramebufferStatus", CheckFramebufferStatus);
  fetch(context, "glClear", Clear);
  fetch(context, "glClearColor", ClearColor);
  fetch(context, "glClearDepth", ClearDepth);
  fetch(context, "glClipControl", ClipControl);
  fetch(context, "glCompileShader", CompileShader);
  fetch(context, "glCreateProgram", CreateProgram);
  fetch(context, "glCreateShader", CreateShader);
  fetch(context, "glDeleteBuffers", DeleteBuffers);
  fetch(context, "glDeleteFramebuffers", DeleteFramebuffers);
  fetch(context, "glDeleteProgram", DeleteProgram);
  fetch(context, "glDeleteRenderbuffers", DeleteRenderbuffers);
  fetch(context, "glDeleteTextures", DeleteTextures);
  fetch(context, "glDeleteShader", DeleteShader);
  fetch(context, "glDeleteVertexArrays", DeleteVertexArrays);
  fetch(context, "glDepthFunc", DepthFunc);
  fetch(context, "glCullFace", CullFace);
  fetch(context, "glDepthMask", DepthMask);
  fetch(context, "glDisable", Disable);
  fetch(context, "glDrawArrays", DrawArrays);
  fetch(context, "glDrawArraysInstancedBaseInstance", DrawArraysInstancedBaseInstance);
  fetch(context, "glEnable", Enable);
  fetch(context, "glEnableVertexAttribArray", EnableVertexAttribArray);
  fetch(context, "glFramebufferRenderbuffer", FramebufferRenderbuffer);
  fetch(context, "glGenBuffers", GenBuffers);
  fetch(context, "glGenFramebuffers", GenFramebuffers);
  fetch(context, "glGenRenderbuffers", GenRenderbuffers);
  fetch(context, "glGenTextures", GenTextures);
  fetch(context, "glGenVertexArrays", GenVertexArrays);
  fetch(context, "glGetError", GetError);
  fetch(context, "glGetProgramInfoLog", GetProgramInfoLog);
  fetch(context, "glGetProgramiv", GetProgramiv);
  fetch(context, "glGetShaderInfoLog", GetShaderInfoLog);
  fetch(context, "glGetShaderiv", GetShaderiv);
  fetch(context, "glGetString", GetString);
  fetch(context, "glGetUniformLocation", GetUniformLocation);
  fetch(context, "glLinkProgram", LinkProgram);
  fetch(context, "glPixelStorei", PixelStorei);
  fetch(context, "glReadPixels", ReadPixels);
  fetch(context, "glRenderbufferStorage", RenderbufferStorage);
  fetch(context, "glScissor", Scissor);
  fetch(context, "glShaderSource", ShaderSource);
  fetch(context, "glTexBuffer", TexBuffer);
  fetch(context, "glUniform1f", Uniform1f);
  fetch(context, "glUniform1iv", Uniform1iv);
  fetch(context, "glUniform2f", Uniform2f);
  fetch(context, "glUniform2i", Uniform2i);
  fetch(context, "glUniform3f", Uniform3f);
  fetch(context, "glUniformMatrix4fv", UniformMatrix4fv);
  fetch(context, "glUseProgram", UseProgram);
  fetch(context, "glVertexAttribDivisor", VertexAttribDivisor);
  fetch(context, "glVertexAttribPointer", VertexAttribPointer);
  fetch(context, "glViewport", Viewport);
}

std::string gl_string(const Gl& gl, GLenum name) {
  const GLubyte* text = gl.GetString(name);
  return text == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(text));
}

}  // namespace stereobench::renderer
