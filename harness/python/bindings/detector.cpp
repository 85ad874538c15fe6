#include "harness/python/bindings/detector.h"

#include <memory>

#include <fmt/format.h>

#include "harness/detector/detection_lines.h"
#include "harness/detector/detector_process.h"
#include "harness/detector/detector_registry.h"
#include "harness/detector/protocol.h"
#include "harness/json/json_line.h"
#include "harness/python/bindings/bindings.h"
#include "harness/python/bindings/tables.h"

namespace py = pybind11;

namespace stereobench::harness::bindings {
namespace {

using Picture = py::array_t<std::uint8_t, py::array::c_style>;

py::object json_module() {
  return py::module_::import("json");
}

/// Numbers and arrays of numpy as Python's own, for json.
py::object plain(const py::object& value) {
  if (py::hasattr(value, "tolist")) return value.attr("tolist")();
  throw py::type_error(fmt::format("a detector's answer cannot hold a {}",
                                   std::string(py::str(py::type::of(value).attr("__name__")))));
}

std::string line_of(const py::object& balls, std::size_t frame) {
  py::dict line;
  line["frame"] = frame;
  line["balls"] = py::list(balls);
  return py::str(json_module().attr("dumps")(line, py::arg("default") = py::cpp_function(plain)));
}

/// Objects of Python that C++ copies and drops without the interpreter's lock.
template <typename Object>
std::shared_ptr<Object> held(Object object) {
  return std::shared_ptr<Object>(new Object(std::move(object)), [](Object* kept) {
    const py::gil_scoped_acquire acquire;
    delete kept;
  });
}

/// @param setup of the drive
Detector detector_of(const std::shared_ptr<py::function>& callable, const DetectorSetup& setup) {
  const py::gil_scoped_acquire lock;
  const auto told = held(setup_dict(setup));
  return [callable, told, setup](const DetectorInput& input) {
    const py::gil_scoped_acquire acquire;
    const py::object answer =
        (*callable)(PyFrame{input.frame, input.stamp_ns, {input.pair.left, input.pair.right}, *told});
    return balls_of(answer, input.frame, setup);
  };
}

/// A picture's own memory. @throws pybind11::value_error unless the array is H x W x 3
cv::Mat picture_of(const Picture& array) {
  if (array.ndim() != 3 || array.shape(2) != 3)
    throw py::value_error("expected a picture of height x width x 3");
  const auto rows = static_cast<int>(array.shape(0)), cols = static_cast<int>(array.shape(1));
  return cv::Mat(rows, cols, CV_8UC3, const_cast<std::uint8_t*>(array.data())).clone();
}

}  // namespace

py::object setup_dict(const DetectorSetup& setup) {
  return json_module().attr("loads")(setup_line(setup));
}

std::vector<vision::BallObservation> balls_of(const py::object& balls, std::size_t frame,
                                              const DetectorSetup& setup) {
  const std::string line = line_of(balls, frame);
  try {
    return read_detections(line, frame, {setup.rig, setup.ball_radius_m});
  } catch (const BadLine& bad) {
    throw DetectorFault(fmt::format("detector: frame {}: {}", frame, bad.what()));
  }
}

py::object dicts_of(const std::vector<vision::BallObservation>& balls, std::size_t frame) {
  return json_module().attr("loads")(detections_line(frame, balls))["balls"];
}

void register_callable(const std::string& name, const py::function& callable) {
  // Never dropped: the registry outlives the interpreter.
  const std::shared_ptr<py::function> function(new py::function(callable), [](py::function*) {});
  register_detector({name, [function](const DetectorSetup& setup) { return detector_of(function, setup); }});
}

void add_frame(py::module_& module) {
  module.def("_register_detector", register_callable, py::arg("name"), py::arg("callable"));
  py::class_<PyFrame, std::shared_ptr<PyFrame>>(module, "Frame", "A stereo pair as a detector may see it.")
      .def(py::init([](std::size_t step, std::int64_t stamp_ns, const Picture& left, const Picture& right,
                       const py::object& setup) {
             return PyFrame{step, stamp_ns, {picture_of(left), picture_of(right)}, setup};
           }),
           "left, right: uint8, H x W x 3, BGR, which are copied.", py::arg("step"), py::arg("stamp_ns"),
           py::arg("left"), py::arg("right"), py::arg("setup"))
      .def_readonly("step", &PyFrame::step, "Step of the path, from 0.")
      .def_readonly("stamp_ns", &PyFrame::stamp_ns)
      .def_readonly("setup", &PyFrame::setup,
                    "What a detector may know (dict): rig, ball_radius_m, palette_rgb, noise_sd_levels, ...")
      .def_property_readonly(
          "left", [](const PyFrame& frame) { return view_of(frame.pair.left); },
          "uint8, H x W x 3, BGR, read-only and not a copy; None without a picture.")
      .def_property_readonly(
          "right", [](const PyFrame& frame) { return view_of(frame.pair.right); }, "As `left`.");
}

}  // namespace stereobench::harness::bindings
