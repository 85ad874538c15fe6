/// The back ends: what they are called, what they are on this machine, and whether they render what they
/// should.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "renderer/types.h"

namespace stereobench::renderer {

/// Those that have names.
inline constexpr std::array<Backend, 3> kBackends = {Backend::kOsmesa, Backend::kEgl, Backend::kEglGpu};

/// What the command line and run.json call it: "osmesa", "egl", "egl-gpu". kSoftware has the name of what it
/// is here.
const char* name_of(Backend backend);

/// @throws std::runtime_error that lists the names there are
Backend backend_named(const std::string& name);

struct BackendInfo {
  std::string gl_version;
  std::string gl_renderer;  ///< the rasteriser and what it was compiled for
  std::string gl_vendor;
};

/// Asks a fresh context what it is.
/// @throws std::runtime_error when this machine has no such back end
BackendInfo backend_info(Backend backend);

struct TestFrame {
  std::string complaint;   ///< what is wrong with it, one line; empty when it is as expected
  std::uint64_t hash = 0;  ///< of all its bytes: colours, identities, depths
};

/// Renders a small frame, one ball in a room of every material, and compares it with what geometry says.
/// @throws std::runtime_error when this machine has no such back end
TestFrame render_test_frame(Backend backend);

/// Says whose pixels a picture has, one line: GL's version, the rasteriser with its vector width, the test
/// frame. Pictures of equal fingerprints can be compared byte for byte. The back end has no part in it:
/// osmesa and egl give the same pixels.
std::string fingerprint(const BackendInfo& info, const TestFrame& frame);

}  // namespace stereobench::renderer
