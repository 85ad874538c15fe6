#include <utility>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "harness/commands/kept_drives.h"
#include "harness/io/atomic_file.h"
#include "harness/json/json_text.h"
#include "harness/python/bindings/bindings.h"
#include "harness/python/bindings/detector.h"
#include "harness/python/bindings/scenario.h"
#include "harness/regression/gates.h"
#include "harness/run_command/run_scenario.h"
#include "harness/study_commands/sweep_run.h"

namespace py = pybind11;

namespace stereobench::harness::bindings {
namespace {

/// A result's text, and what its gates say: a line for each that is broken.
struct Outcome {
  std::string json;
  std::string broken;
};

/// @param detector None: as the scenario says. Seeds are then driven in forked processes, so that this
///   process may not have rendered before.
Outcome run(const PyScenario& scenario, const std::filesystem::path& out, int jobs,
            const py::object& detector) {
  ScenarioArguments arguments = scenario.arguments;
  arguments.run.jobs = jobs;
  const Experiment& experiment = scenario.experiment;
  const auto gates = gates_of(experiment);
  const DetectorSetup setup = detector_setup(experiment.scenario);
  std::optional<Detector> look;
  if (!detector.is_none()) look = detector_of(detector.cast<py::function>(), setup);
  const py::gil_scoped_release release;
  check_metrics(gates, result_without_values(experiment));
  const std::string pixels = look ? pixels_here(scenario) : pixels_of(experiment.scenario, arguments.backend);
  const auto tasks = drive_tasks(arguments, {}, experiment, pixels, kRunParts);
  prepare_output_folder(out);
  const RunResult result =
      look ? run_here_into(out, arguments, experiment, tasks, pixels, [&] { return *look; })
           : run_into(out, arguments, experiment, tasks, pixels);
  const nlohmann::ordered_json json = run_json(result);
  const auto broken = broken_gates(json, gates);
  return {json_text(json), broken.empty() ? "" : gate_report(broken, gates.size())};
}

Outcome sweep(const PyScenario& scenario, const std::vector<std::string>& variations,
              const std::filesystem::path& out, int jobs, const std::string& paired_to, int adaptive) {
  SweepArguments arguments{scenario.arguments, variations, paired_to, adaptive};
  arguments.scenario.run.jobs = jobs;
  SweepPlan plan = plan_sweep(arguments);
  plan_drives(arguments, plan);
  prepare_output_folder(out);
  const SweepOutcome outcome = sweep_into(out, arguments, plan);
  return {sweep_json(outcome.sweep).dump(2) + "\n", outcome.broken == 0 ? "" : outcome.gate_lines};
}

}  // namespace

void add_run(py::module_& module) {
  py::class_<Outcome>(module, "_Outcome")
      .def_readonly("json", &Outcome::json)
      .def_readonly("broken", &Outcome::broken);
  module.def("_run", run, py::arg("scenario"), py::arg("out"), py::arg("jobs"), py::arg("detector"));
  module.def("_sweep", sweep, py::arg("scenario"), py::arg("variations"), py::arg("out"), py::arg("jobs"),
             py::arg("paired_to"), py::arg("adaptive"), py::call_guard<py::gil_scoped_release>());
}

}  // namespace stereobench::harness::bindings
