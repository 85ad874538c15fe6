#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "harness/commands/kept_drives.h"
#include "harness/json/json_text.h"
#include "harness/program.h"
#include "harness/python/bindings/bindings.h"
#include "harness/python/bindings/scenario.h"
#include "harness/regression/gates.h"
#include "harness/run_command/run_scenario.h"
#include "harness/study_commands/sweep_run.h"
#include "harness/verify/verify_collection.h"

namespace py = pybind11;

namespace stereobench::harness::bindings {
namespace {

/// A result's text, and what its gates say: a line for each that is broken.
using Outcome = std::pair<std::string, std::string>;

/// @param here whether drives are done in this process
Outcome run(const PyScenario& scenario, const std::filesystem::path& out, int jobs, bool here) {
  ScenarioArguments arguments = scenario.arguments;
  arguments.run.jobs = jobs;
  const Experiment& experiment = scenario.experiment;
  const auto gates = gates_of(experiment);
  check_metrics(gates, result_without_values(experiment));
  const std::string pixels = here ? pixels_here(scenario) : pixels_of(experiment.scenario, arguments.backend);
  const auto tasks = drive_tasks(arguments, {}, experiment, pixels, kRunParts);
  prepare_output_folder(out);
  const auto run_in = here ? run_here_into : run_into;
  const nlohmann::ordered_json json = run_json(run_in(out, arguments, experiment, tasks, pixels));
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

std::vector<std::string> verify(const std::filesystem::path& folder, const std::string& format) {
  std::vector<std::string> lines;
  for (const Fault& fault : verify_folder(folder, format, [](double) {}).faults)
    lines.push_back(line_of(fault));
  return lines;
}

}  // namespace

/// All but _verify and a run that is done here fork: they are called in a process that has not rendered
/// before.
void add_run(py::module_& module) {
  const py::call_guard<py::gil_scoped_release> unlocked;
  module.def("_run", run, py::arg("scenario"), py::arg("out"), py::arg("jobs"), py::arg("here"), unlocked);
  module.def("_sweep", sweep, py::arg("scenario"), py::arg("variations"), py::arg("out"), py::arg("jobs"),
             py::arg("paired_to"), py::arg("adaptive"), unlocked);
  module.def("_command", run_words, py::arg("words"), unlocked);
  module.def("_verify", verify, py::arg("folder"), py::arg("format"), unlocked);
}

}  // namespace stereobench::harness::bindings
