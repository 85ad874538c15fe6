/// A headless OpenGL context that draws in software, behind an interface that names no library.
#pragma once

#include <memory>

namespace stereobench::renderer {

/// Owns a core-profile context (OpenGL 4.5, drawn by Mesa's llvmpipe through OSMesa). Several may live in one
/// process; the one that was made current last is the one that GL calls go to. Move-only.
class Context {
 public:
  using Procedure = void (*)();

  /// Creates the context and makes it current.
  /// @throws std::runtime_error without OSMesa's OpenGL 4.5, or with LP_NATIVE_VECTOR_WIDTH above 256, which
  ///   crashes the rasteriser
  Context();

  /// Directs GL calls of this thread to this context.
  void make_current() const;

  /// Looks up a GL function by its whole name ("glClear"); never the functions that the program is linked
  /// with, which belong to whatever libGL some other library brought along.
  /// @throws std::runtime_error when this GL does not have it
  Procedure procedure(const char* name) const;

 private:
  struct Handle;
  struct Destroy {
    void operator()(Handle* handle) const;
  };
  std::unique_ptr<Handle, Destroy> handle_;
};

}  // namespace stereobench::renderer
