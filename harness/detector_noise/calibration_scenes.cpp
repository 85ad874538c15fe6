#include "harness/detector_noise/calibration_scenes.h"

#include "harness/detector_noise/serialise.h"
#include "harness/process/process_pool.h"
#include "harness/process/progress.h"

namespace stereobench::harness {

std::vector<CalibrationTake> take_calibration_scenes(const Experiment& experiment,
                                                     const worlds::CalibrationSceneSettings& settings,
                                                     const std::vector<std::uint64_t>& seeds,
                                                     renderer::Backend backend, int jobs) {
  Progress progress("calibrate " + experiment.scenario.name, static_cast<double>(seeds.size()));
  const auto take = [&](std::size_t index, const std::function<void(double)>&) {
    Experiment scene = experiment;
    scene.scenario = worlds::calibration_scene(experiment.scenario, settings, seeds[index]);
    return to_bytes(take_samples(scene, seeds[index], backend));
  };
  std::vector<CalibrationTake> takes;
  for (const std::string& bytes :
       run_in_processes(seeds.size(), jobs, take, [&](double done) { progress.show(done); }))
    takes.push_back(calibration_take_from_bytes(bytes));
  return takes;
}

}  // namespace stereobench::harness
