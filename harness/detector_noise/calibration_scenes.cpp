#include "harness/detector_noise/calibration_scenes.h"

#include "harness/detector_noise/serialise.h"
#include "harness/process/process_pool.h"
#include "harness/process/progress.h"

namespace stereobench::harness {
namespace {

std::string name_of_work(const CalibrationLook& look) {
  return "calibrate " + look.experiment.scenario.name;
}

std::string take(const CalibrationLook& look, std::uint64_t seed) {
  Experiment scene = look.experiment;
  scene.scenario = worlds::calibration_scene(look.experiment.scenario, look.settings, seed);
  return to_bytes(take_samples(scene, seed, look.backend));
}

}  // namespace

std::vector<CalibrationTake> take_calibration_scenes(const CalibrationLook& look, int jobs) {
  Progress progress(name_of_work(look), static_cast<double>(look.seeds.size()));
  std::vector<CalibrationTake> takes;
  for (const std::string& bytes : run_in_processes(
           look.seeds.size(), jobs,
           [&](std::size_t index, const std::function<void(double)>&) {
             return take(look, look.seeds[index]);
           },
           [&](double done) { progress.show(done); }))
    takes.push_back(calibration_take_from_bytes(bytes));
  return takes;
}

void take_into(AnswerStore& store, const CalibrationLook& look, const std::vector<std::string>& keys,
               int jobs) {
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (!store.holds(keys[i])) missing.push_back(i);
  if (missing.empty()) return;
  Progress progress(name_of_work(look), static_cast<double>(missing.size()));
  run_in_processes(
      missing.size(), jobs,
      [&](std::size_t index, const std::function<void(double)>&) {
        return take(look, look.seeds[missing[index]]);
      },
      [&](std::size_t index, const std::string& bytes) { store.append(keys[missing[index]], bytes); },
      [&](double done) { progress.show(done); });
}

}  // namespace stereobench::harness
