/// Things that live inside a GL context and are deleted with their owners: programs, vertices, framebuffers.
/// The context must be current when they are made, used and destroyed.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "renderer/gl/gl.h"

namespace stereobench::renderer {

/// The name of a GL object and how to delete it. Move-only.
class GlName {
 public:
  using Delete = void (*)(const Gl& gl, GLuint name);

  GlName(const Gl& gl, GLuint name, Delete destroy) : gl_(&gl), name_(name), destroy_(destroy) {}
  GlName(GlName&& other) noexcept;
  GlName& operator=(GlName&& other) noexcept;
  GlName(const GlName&) = delete;
  GlName& operator=(const GlName&) = delete;
  ~GlName();

  GLuint get() const { return name_; }

 private:
  const Gl* gl_;
  GLuint name_;
  Delete destroy_;
};

/// A linked pair of shaders.
class Program {
 public:
  /// @throws std::runtime_error with the compiler's log, which is a bug of the shader or of the driver
  Program(const Gl& gl, const std::string& vertex_source, const std::string& fragment_source);

  void use() const { gl_->UseProgram(program_.get()); }
  GLint uniform(const char* name) const { return gl_->GetUniformLocation(program_.get(), name); }

 private:
  const Gl* gl_;
  GlName program_;
};

/// Vertices made of floats, and how they are laid out: attribute k has `widths[k]` floats.
class VertexArray {
 public:
  /// @param divisor 0 when each vertex has its own values, 1 when each instance has
  VertexArray(const Gl& gl, std::span<const int> widths, GLuint divisor);

  /// Replaces all vertices.
  void upload(std::span<const float> values);
  void bind() const { gl_->BindVertexArray(array_.get()); }

 private:
  const Gl* gl_;
  GlName array_;
  GlName buffer_;
};

/// A list of 32-bit numbers that shaders can look into: a usamplerBuffer of texture unit 0.
class NumberList {
 public:
  NumberList(const Gl& gl, std::span<const std::uint32_t> numbers);

  void bind() const { gl_->BindTexture(GL_TEXTURE_BUFFER, texture_.get()); }

 private:
  const Gl* gl_;
  GlName buffer_;
  GlName texture_;
};

/// A picture to draw to: RGBA and a 32-bit float depth.
class Framebuffer {
 public:
  /// @param colours GL_RGBA8 or GL_RGBA16
  Framebuffer(const Gl& gl, GLenum colours, int width_px, int height_px);

  void bind() const { gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get()); }

 private:
  const Gl* gl_;
  GlName colour_;
  GlName depth_;
  GlName framebuffer_;
};

}  // namespace stereobench::renderer
