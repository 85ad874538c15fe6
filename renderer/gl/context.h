/// A headless OpenGL context, behind an interface that names no library.
#pragma once

#include <memory>

#include "renderer/types.h"

namespace stereobench::renderer {

/// A core-profile context (OpenGL 4.5). Several may live in one process, also of different back ends; the one
/// that was made current last is the one that GL calls go to. Each belongs to the thread that made it.
class Context {
 public:
  using Procedure = void (*)();

  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  virtual ~Context() = default;

  /// Directs GL calls of this thread to this context.
  void make_current() const;

  /// Looks up a GL function by its whole name ("glClear"); never the functions that the program is linked
  /// with, which belong to whatever libGL some other library brought along.
  /// @throws std::runtime_error when this GL does not have it
  Procedure procedure(const char* name) const;

 protected:
  /// Takes GL calls away from this context, if they go to it; what destructors begin with.
  void leave() const;

 private:
  virtual bool bind() const = 0;
  virtual void unbind() const = 0;
  virtual Procedure find(const char* name) const = 0;
};

/// Says what draws. The answer is the same as long as the process lives.
/// @return kOsmesa or kEgl for kSoftware; any other back end is itself
Backend drawn_by(Backend backend);

/// Creates a context and makes it current.
/// @throws std::runtime_error when this machine has no such back end, or with LP_NATIVE_VECTOR_WIDTH above
///   256, which crashes the rasteriser of those in software
std::unique_ptr<Context> make_context(Backend backend);

}  // namespace stereobench::renderer
