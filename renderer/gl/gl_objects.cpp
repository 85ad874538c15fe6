#include "renderer/gl/gl_objects.h"

#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>

namespace stereobench::renderer {
namespace {

GLuint generate(void (*make)(GLsizei, GLuint*)) {
  GLuint name = 0;
  make(1, &name);
  return name;
}

void delete_buffer(const Gl& gl, GLuint name) {
  gl.DeleteBuffers(1, &name);
}
void delete_framebuffer(const Gl& gl, GLuint name) {
  gl.DeleteFramebuffers(1, &name);
}
void delete_program(const Gl& gl, GLuint name) {
  gl.DeleteProgram(name);
}
void delete_renderbuffer(const Gl& gl, GLuint name) {
  gl.DeleteRenderbuffers(1, &name);
}
void delete_shader(const Gl& gl, GLuint name) {
  gl.DeleteShader(name);
}
void delete_texture(const Gl& gl, GLuint name) {
  gl.DeleteTextures(1, &name);
}
void delete_vertex_array(const Gl& gl, GLuint name) {
  gl.DeleteVertexArrays(1, &name);
}

GlName compile(const Gl& gl, GLenum stage, const std::string& source) {
  GlName shader(gl, gl.CreateShader(stage), delete_shader);
  const char* text = source.c_str();
  gl.ShaderSource(shader.get(), 1, &text, nullptr);
  gl.CompileShader(shader.get());
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader.get(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  std::string log(4096, '\0');
  gl.GetShaderInfoLog(shader.get(), static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw std::runtime_error(fmt::format("renderer: a shader does not compile: {}", log.c_str()));
}

void check_linked(const Gl& gl, GLuint program) {
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return;
  std::string log(4096, '\0');
  gl.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw std::runtime_error(fmt::format("renderer: a program does not link: {}", log.c_str()));
}

GlName renderbuffer(const Gl& gl, GLenum format, int width_px, int height_px) {
  GlName buffer(gl, generate(gl.GenRenderbuffers), delete_renderbuffer);
  gl.BindRenderbuffer(GL_RENDERBUFFER, buffer.get());
  gl.RenderbufferStorage(GL_RENDERBUFFER, format, width_px, height_px);
  return buffer;
}

}  // namespace

GlName::GlName(GlName&& other) noexcept
    : gl_(other.gl_), name_(std::exchange(other.name_, 0U)), destroy_(other.destroy_) {}

GlName& GlName::operator=(GlName&& other) noexcept {
  std::swap(gl_, other.gl_);
  std::swap(name_, other.name_);
  std::swap(destroy_, other.destroy_);
  return *this;
}

GlName::~GlName() {
  if (name_ != 0U) destroy_(*gl_, name_);
}

Program::Program(const Gl& gl, const std::string& vertex_source, const std::string& fragment_source)
    : gl_(&gl), program_(gl, gl.CreateProgram(), delete_program) {
  const GlName vertex = compile(gl, GL_VERTEX_SHADER, vertex_source);
  const GlName fragment = compile(gl, GL_FRAGMENT_SHADER, fragment_source);
  gl.AttachShader(program_.get(), vertex.get());
  gl.AttachShader(program_.get(), fragment.get());
  gl.LinkProgram(program_.get());
  check_linked(gl, program_.get());
  for (const GlName* shader : {&vertex, &fragment}) gl.DetachShader(program_.get(), shader->get());
}

VertexArray::VertexArray(const Gl& gl, std::span<const int> widths, GLuint divisor)
    : gl_(&gl),
      array_(gl, generate(gl.GenVertexArrays), delete_vertex_array),
      buffer_(gl, generate(gl.GenBuffers), delete_buffer) {
  bind();
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_.get());
  const std::size_t stride = sizeof(float) * std::accumulate(widths.begin(), widths.end(), std::size_t{0});
  std::uintptr_t offset = 0;
  for (GLuint index = 0; index < widths.size(); ++index) {
    gl.EnableVertexAttribArray(index);
    gl.VertexAttribPointer(index, widths[index], GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                           reinterpret_cast<const void*>(offset));  // GL's way to say "offset in the buffer"
    gl.VertexAttribDivisor(index, divisor);
    offset += sizeof(float) * static_cast<std::size_t>(widths[index]);
  }
}

void VertexArray::upload(std::span<const float> values) {
  gl_->BindBuffer(GL_ARRAY_BUFFER, buffer_.get());
  gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(values.size_bytes()), values.data(),
                  GL_STREAM_DRAW);
}

NumberList::NumberList(const Gl& gl, std::span<const std::uint32_t> numbers)
    : gl_(&gl),
      buffer_(gl, generate(gl.GenBuffers), delete_buffer),
      texture_(gl, generate(gl.GenTextures), delete_texture) {
  gl.BindBuffer(GL_TEXTURE_BUFFER, buffer_.get());
  gl.BufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(numbers.size_bytes()), numbers.data(),
                GL_STATIC_DRAW);
  bind();
  gl.TexBuffer(GL_TEXTURE_BUFFER, GL_R32UI, buffer_.get());
}

Framebuffer::Framebuffer(const Gl& gl, GLenum colours, int width_px, int height_px)
    : gl_(&gl),
      colour_(renderbuffer(gl, colours, width_px, height_px)),
      depth_(renderbuffer(gl, GL_DEPTH_COMPONENT32F, width_px, height_px)),
      framebuffer_(gl, generate(gl.GenFramebuffers), delete_framebuffer) {
  bind();
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.get());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.get());
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error(
        fmt::format("renderer: cannot draw to a picture of {} x {} pixels", width_px, height_px));
  }
}

}  // namespace stereobench::renderer
