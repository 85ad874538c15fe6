#include "harness/drive/stereo_camera.h"

#include "harness/process/stopwatch.h"
#include "renderer/camera/expose.h"

namespace stereobench::harness {

std::optional<TakenPair> StereoCamera::take(std::size_t index, std::map<std::string, double>& timing) {
  Stopwatch watch(timing);
  const std::optional<double> late_s = lateness_s(scenario_.shutter, seed_, index);
  if (!late_s) return {};
  TakenPair taken{.late_s = *late_s};
  taken.exposed = watch.time(
      "render", [&] { return open_shutter(renderer_, scenario_.path, index, scenario_.shutter, *late_s); });
  taken.pair = watch.time(
      "expose", [&] { return renderer::expose(taken.exposed.frame, scenario_.camera, seed_, index); });
  return taken;
}

}  // namespace stereobench::harness
