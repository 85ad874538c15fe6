#include <stdexcept>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "harness/json/json_text.h"
#include "harness/noise_check/noise_check.h"
#include "harness/python/bindings/bindings.h"
#include "harness/python/bindings/drive.h"
#include "harness/run/run_tally.h"
#include "harness/run_command/run_folder.h"

namespace py = pybind11;

namespace stereobench::harness::bindings {
namespace {

/// Drives that Python took step by step, summed up as `run` sums up its seeds.
class PyTally {
 public:
  explicit PyTally(ScenarioPointer scenario)
      : scenario_(std::move(scenario)),
        sums_(world_part().name, rendered_by(world_part(), scenario_->arguments.backend)) {}

  void add(const PyDrive& drive, std::vector<FilterRun> runs) {
    if (drive.scenario() != scenario_) throw std::runtime_error("expected a drive of the tally's scenario");
    const SeedResult seed = score_seed(drive.ended(std::move(runs)), {.log = logs_.size() < kCheckedLogs});
    sums_.add(seed);
    metrics_.add(seed);
    if (seed.log) logs_.push_back(*seed.log);
  }

  std::string json() const {
    RunResult result = sums_.result();
    result.seed_metrics = metrics_.metrics();
    return json_text(run_json(completed(std::move(result), logs_, scenario_->arguments, scenario_->experiment,
                                        pixels_here(*scenario_))));
  }

 private:
  const worlds::Scenario& world_part() const { return scenario_->experiment.scenario; }

  ScenarioPointer scenario_;
  RunTally sums_;
  SeedMetricsTally metrics_;
  std::vector<SensorLog> logs_;
};

}  // namespace

void add_tally(py::module_& module) {
  py::class_<PyTally>(module, "Tally")
      .def(py::init([](const std::shared_ptr<PyScenario>& scenario) {
             return std::make_unique<PyTally>(scenario);
           }),
           py::arg("scenario"))
      .def("_add", &PyTally::add, py::arg("drive"), py::arg("runs"), py::call_guard<py::gil_scoped_release>())
      .def("_json", &PyTally::json, py::call_guard<py::gil_scoped_release>());
}

}  // namespace stereobench::harness::bindings
