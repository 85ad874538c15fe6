#include "harness/python/bindings/scenario.h"

#include <optional>
#include <vector>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "harness/experiment/write_experiment.h"
#include "harness/python/bindings/bindings.h"
#include "harness/python/bindings/tables.h"
#include "renderer/backend.h"
#include "slam/filter_registry.h"
#include "worlds/yaml/parse_yaml.h"

namespace py = pybind11;

namespace stereobench::harness::bindings {
namespace {

/// What is said beside the file, as the program's options take it.
struct ScenarioOptions {
  std::string seeds, filters;  ///< empty: as the scenario says
  int particles = 0;
  std::string backend;   ///< empty: in software
  std::string detector;  ///< empty: as the scenario says
};

std::shared_ptr<PyScenario> scenario_of(const std::filesystem::path& file,
                                        const std::vector<std::string>& overrides,
                                        const ScenarioOptions& options) {
  auto scenario = std::make_shared<PyScenario>();
  ScenarioArguments& arguments = scenario->arguments;
  arguments.scenario = file;
  arguments.overrides = overrides;
  if (!options.backend.empty()) arguments.backend = renderer::backend_named(options.backend);
  if (!options.seeds.empty()) arguments.run.seeds = parse_seeds_option(options.seeds);
  if (!options.filters.empty()) arguments.run.filters = parse_filters(options.filters);
  arguments.run.particles = options.particles;
  arguments.detector = options.detector;
  scenario->experiment = read_experiment(arguments);
  return scenario;
}

std::string written(const PyScenario& scenario, std::optional<std::uint64_t> seed) {
  const ScenarioArguments& arguments = scenario.arguments;
  return written_out(arguments.scenario, arguments.overrides, seed, arguments.meshes->occluders());
}

/// A scalar by YAML's core schema.
py::object value_of(const YAML::Node& scalar) {
  if (scalar.Tag() == "!") return py::str(scalar.Scalar());  // it stands in quotation marks
  bool truth = false;
  if (YAML::convert<bool>::decode(scalar, truth)) return py::bool_(truth);
  long long whole = 0;
  if (YAML::convert<long long>::decode(scalar, whole)) return py::int_(whole);
  double number = 0.0;
  if (YAML::convert<double>::decode(scalar, number)) return py::float_(number);
  return py::str(scalar.Scalar());
}

py::object object_of(const YAML::Node& node) {
  if (node.IsScalar()) return value_of(node);
  if (node.IsSequence()) {
    py::list list;
    for (const YAML::Node& entry : node) list.append(object_of(entry));
    return list;
  }
  if (!node.IsMap()) return py::none();
  py::dict dict;
  for (const auto& entry : node) dict[py::str(entry.first.Scalar())] = object_of(entry.second);
  return dict;
}

py::object dict_of(const PyScenario& scenario, std::optional<std::uint64_t> seed) {
  return object_of(worlds::parse_yaml(written(scenario, seed)).front());
}

const worlds::Scenario& world_part(const PyScenario& scenario) {
  return scenario.experiment.scenario;
}

}  // namespace

std::string pixels_here(const PyScenario& scenario) {
  if (world_part(scenario).sensor != worlds::SensorKind::kStereo) return {};
  const renderer::Backend backend = scenario.arguments.backend;
  return renderer::fingerprint(renderer::backend_info(backend), renderer::render_test_frame(backend));
}

void add_scenario(py::module_& module) {
  module.def("filter_names", &slam::filter_names, "Names of all filters.");
  py::class_<PyScenario, std::shared_ptr<PyScenario>>(module, "Scenario")
      .def(py::init([](const std::filesystem::path& file, const std::vector<std::string>& overrides,
                       const std::string& seeds, const std::string& filters, int particles,
                       const std::string& backend, const std::string& detector) {
             const py::gil_scoped_release release;
             return scenario_of(file, overrides, {seeds, filters, particles, backend, detector});
           }),
           py::arg("file"), py::arg("overrides"), py::arg("seeds"), py::arg("filters"), py::arg("particles"),
           py::arg("backend"), py::arg("detector"))
      .def_property_readonly("name", [](const PyScenario& s) { return world_part(s).name; })
      .def_property_readonly("description", [](const PyScenario& s) { return world_part(s).description; })
      .def_property_readonly(
          "sensor",
          [](const PyScenario& s) {
            return world_part(s).sensor == worlds::SensorKind::kStereo ? "stereo" : "oracle";
          },
          "\"stereo\": pictures; \"oracle\": ranges and bearings without pictures.")
      .def_property_readonly("seeds", [](const PyScenario& s) { return s.experiment.seeds; })
      .def_property_readonly("filters", [](const PyScenario& s) { return s.experiment.filters; })
      .def_property_readonly("particles", [](const PyScenario& s) { return s.experiment.particles; })
      .def_property_readonly(
          "path", [](const PyScenario& s) { return table_of(world_part(s).path); },
          "The true drive: stamp_ns, x_m, y_m, heading_rad in the world frame; one row a step.")
      .def("_written", written, py::arg("seed"), py::call_guard<py::gil_scoped_release>())
      .def("_dict", dict_of, py::arg("seed"));
}

}  // namespace stereobench::harness::bindings
