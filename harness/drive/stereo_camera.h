/// The cameras of a drive: pairs as they are taken at its steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "harness/drive/shutter.h"
#include "renderer/renderer.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// A pair as it was taken, with the truth behind it.
struct TakenPair {
  ExposedFrame exposed;
  vision::StereoPair pair;
  double late_s = 0.0;  ///< by how much the cameras looked later than the step's time says
};

/// Renders and exposes pairs; lives as long as the drive.
class StereoCamera {
 public:
  /// @param scenario must live as long
  /// @param world of the drive's seed
  /// @param seed of lateness and noise
  StereoCamera(const worlds::Scenario& scenario, const worlds::World& world, std::uint64_t seed,
               renderer::Backend backend, renderer::LightDepth light,
               const renderer::FormReader& read = renderer::read_form)
      : scenario_(scenario), seed_(seed), renderer_(world, scenario.rig, backend, light, read) {}

  /// Takes the pair of a step.
  /// @param timing seconds of "render" and "expose" are added to it
  /// @return empty where the frame is lost
  std::optional<TakenPair> take(std::size_t index, std::map<std::string, double>& timing);

  renderer::Renderer& renderer() { return renderer_; }

 private:
  const worlds::Scenario& scenario_;
  std::uint64_t seed_;
  renderer::Renderer renderer_;
};

}  // namespace stereobench::harness
