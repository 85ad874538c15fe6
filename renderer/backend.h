/// Which GL renders, and whether it renders what it should: for `doctor`.
#pragma once

#include <string>

namespace stereobench::renderer {

struct BackendInfo {
  std::string backend;  ///< "osmesa"
  std::string gl_version;
  std::string gl_renderer;  ///< the rasteriser and what it was compiled for
  std::string gl_vendor;
};

/// Asks a fresh context what it is.
/// @throws std::runtime_error when there is no GL to render with
BackendInfo backend_info();

/// Renders a small frame, one ball in an empty room, and compares it with what geometry says.
/// @return empty when the frame is as expected, otherwise what is wrong with it, one line
/// @throws std::runtime_error when there is no GL to render with
std::string test_frame_complaint();

}  // namespace stereobench::renderer
