#include "harness/python/bindings/filter.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "harness/experiment/filter_config.h"
#include "harness/python/bindings/bindings.h"
#include "harness/python/bindings/tables.h"

namespace py = pybind11;

namespace stereobench::harness::bindings {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

slam::FilterConfig config_of(const PyDrive& drive, int particles) {
  slam::FilterConfig config = filter_config(drive.experiment());
  if (particles > 0) config.particles = particles;
  return config;
}

py::dict counters_of(const slam::FilterCounters& counters) {
  py::dict dict;
  dict["resamplings"] = counters.resamplings;
  dict["covariance_repairs"] = counters.covariance_repairs;
  dict["weight_collapses"] = counters.weight_collapses;
  dict["gated_measurements"] = counters.gated_measurements;
  dict["rejected_inputs"] = counters.rejected_inputs;
  dict["joint_searches_cut"] = counters.joint_searches_cut;
  dict["refitted_frames"] = counters.refitted_frames;
  return dict;
}

/// Whether sightings are those that the drive logged.
bool are_same(const std::vector<slam::RangeBearing>& logged, const std::vector<slam::RangeBearing>& given) {
  return std::ranges::equal(logged, given,
                            [](const slam::RangeBearing& one, const slam::RangeBearing& other) {
                              return one.range_m == other.range_m && one.bearing_rad == other.bearing_rad;
                            });
}

std::string shape_of(const Numbers& numbers) {
  std::string shape;
  for (py::ssize_t i = 0; i < numbers.ndim(); ++i)
    shape += (i ? " x " : "") + std::to_string(numbers.shape(i));
  return shape;
}

/// @throws py::value_error that says what was expected
void check_shape(const char* what, const Numbers& numbers, const std::vector<py::ssize_t>& expected) {
  bool right = numbers.ndim() == static_cast<py::ssize_t>(expected.size());
  for (std::size_t i = 0; right && i < expected.size(); ++i)
    right = numbers.shape(static_cast<py::ssize_t>(i)) == expected[i];
  if (!right)
    throw py::value_error(fmt::format("{}: expected an array of {} (got {})", what,
                                      fmt::join(expected, " x "), shape_of(numbers)));
}

/// Estimates that were made elsewhere, one a step, as a filter's run.
FilterRun run_of(const std::string& name, const PyDrive& drive, const Numbers& poses,
                 const std::optional<Numbers>& covariances,
                 const std::optional<Table<LandmarkRow>>& landmarks) {
  const auto steps = static_cast<py::ssize_t>(drive.steps());
  check_shape("poses", poses, {steps, 3});
  if (covariances) check_shape("covariances", *covariances, {steps, 3, 3});
  FilterRun run{.filter = name, .seed = drive.seed()};
  run.updates.resize(drive.steps());
  for (py::ssize_t k = 0; k < steps; ++k) {
    run.poses.push_back({poses.at(k, 0), poses.at(k, 1), poses.at(k, 2)});
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (int row = 0; covariances && row < 3; ++row)
      for (int col = 0; col < 3; ++col) covariance(row, col) = covariances->at(k, row, col);
    run.covariances.push_back(covariance);
  }
  run.last = {.pose = run.poses.back(), .covariance = run.covariances.back()};
  if (landmarks) run.last.landmarks = landmarks_of(*landmarks);
  return run;
}

}  // namespace

PyFilter::PyFilter(const std::string& name, DrivePointer drive, int particles)
    : name_(name),
      drive_(std::move(drive)),
      replay_(name, config_of(*drive_, particles), drive_->start(), drive_->seed()) {}

void PyFilter::step(const std::vector<slam::Control>& odometry,
                    const std::vector<slam::RangeBearing>& measurements) {
  if (step_ == drive_->steps())
    throw std::runtime_error(fmt::format("{}: expected {} steps, as the drive has", name_, drive_->steps()));
  const LogStep& logged = drive_->log_step(step_++);
  knows_truth_ = knows_truth_ && logged.true_landmarks.size() == measurements.size() &&
                 are_same(logged.measurements, measurements);
  truth_.insert(truth_.end(), logged.true_landmarks.begin(), logged.true_landmarks.end());
  if (!knows_truth_) truth_.clear();
  replay_.step({.stamp_ns = logged.stamp_ns, .odometry = odometry, .measurements = measurements}, truth_);
}

void add_filter(py::module_& module) {
  py::class_<FilterRun, std::shared_ptr<FilterRun>>(module, "Estimates",
                                                    "A filter's estimates over a drive, to be scored.")
      .def_readonly("name", &FilterRun::filter)
      .def("__len__", [](const FilterRun& run) { return run.poses.size(); });
  module.def("_estimates", run_of, py::arg("name"), py::arg("drive"), py::arg("poses"),
             py::arg("covariances"), py::arg("landmarks"));
  py::class_<PyFilter, std::shared_ptr<PyFilter>>(module, "Filter", "One of our filters on a drive.")
      .def(py::init<const std::string&, DrivePointer, int>(), py::arg("name"), py::arg("drive"),
           py::arg("particles") = 0, "particles: 0 is as the scenario says.")
      .def(
          "step",
          [](PyFilter& filter, const Table<ControlRow>& odometry, const Table<MeasurementRow>& measurements) {
            const auto controls = controls_of(odometry);
            const auto seen = measurements_of(measurements);
            const py::gil_scoped_release release;
            filter.step(controls, seen);
          },
          py::arg("odometry"), py::arg("measurements"),
          "Moves on by the odometry since the last step, and corrects by what was measured at this one.")
      .def_property_readonly("name", &PyFilter::name)
      .def("__len__", &PyFilter::steps)
      .def_property_readonly(
          "pose", [](const PyFilter& filter) { return array_of(filter.estimate_without_map().pose); },
          "x_m, y_m, heading_rad in the world frame (float64, 3).")
      .def_property_readonly(
          "covariance", [](const PyFilter& filter) { return filter.estimate_without_map().covariance; },
          "Of the pose (float64, 3 x 3): m^2, m rad, rad^2.")
      .def_property_readonly(
          "landmarks", [](const PyFilter& filter) { return table_of(filter.estimate().landmarks); },
          "The map: landmark_id, colour_class, x_m, y_m in the world frame, covariance (2 x 2, m^2).")
      .def_property_readonly(
          "counters", [](const PyFilter& filter) { return counters_of(filter.estimate().counters); },
          "What it had to repair or refuse so far (dict).")
      .def("estimates", &PyFilter::run, "What it has done so far, to be scored.");
}

}  // namespace stereobench::harness::bindings
