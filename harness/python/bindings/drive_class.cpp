#include <memory>
#include <utility>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "harness/python/bindings/bindings.h"
#include "harness/python/bindings/drive.h"
#include "harness/python/bindings/tables.h"

namespace py = pybind11;

namespace stereobench::harness::bindings {
namespace {

/// What both cameras really see.
struct PyTruth {
  renderer::StereoFrame frame;
  slam::Pose world_from_robot;
};

/// A frame of a drive, with what a detector may not see.
struct PyDriveFrame : PyFrame {
  DrivePointer drive;
  std::optional<TakenPair> taken;
  std::optional<std::vector<vision::BallObservation>> ours = {};  ///< once our detector was asked
};

std::shared_ptr<PyDriveFrame> frame_of(const DrivePointer& drive, std::size_t step, const py::object& setup) {
  if (step >= drive->steps())
    throw py::index_error(fmt::format("expected a step below {} (got {})", drive->steps(), step));
  auto frame = std::make_shared<PyDriveFrame>();
  frame->step = step;
  frame->stamp_ns = drive->world_part().path[step].stamp_ns;
  frame->setup = setup;
  frame->drive = drive;
  const py::gil_scoped_release release;
  frame->taken = drive->take(step);
  if (frame->taken) frame->pair = frame->taken->pair;
  return frame;
}

const std::vector<vision::BallObservation>& ours_of(PyDriveFrame& frame) {
  const py::gil_scoped_release release;
  if (!frame.ours) {
    frame.ours.emplace();
    if (frame.taken) frame.ours = frame.drive->observe(frame.step, *frame.taken);
  }
  return *frame.ours;
}

/// @param balls None: our detector's, or what the oracle sensed
Table<MeasurementRow> measure(PyDriveFrame& frame, const py::object& balls) {
  PyDrive& drive = *frame.drive;
  const bool is_ours = balls.is_none();
  std::vector<vision::BallObservation> found =
      is_ours ? ours_of(frame) : balls_of(balls, frame.step, drive.setup());
  const std::vector<slam::RangeBearing>* measured = nullptr;
  {
    const py::gil_scoped_release release;
    measured =
        &drive.measure(frame.step, frame.taken, std::move(found), is_ours ? kOurDetector : kCallableDetector);
  }
  return table_of(*measured);
}

std::optional<PyTruth> truth_of(const PyDriveFrame& frame) {
  if (!frame.taken) return {};
  return PyTruth{frame.taken->exposed.frame, frame.drive->world_part().path[frame.step].pose};
}

py::dict bounds_of(const PyDrive& drive) {
  BoundRun bound;
  {
    const py::gil_scoped_release release;
    bound = drive.bound();
  }
  py::dict bounds;
  bounds["poses"] = stack_of(bound.poses);
  bounds["smoothed_poses"] = stack_of(bound.smoothed_poses);
  bounds["landmarks"] = stack_of(bound.landmarks);
  return bounds;
}

void add_truth(py::module_& module) {
  const auto part = [](cv::Mat renderer::RenderedImage::*picture,
                       renderer::RenderedImage renderer::StereoFrame::*side) {
    return [picture, side](const PyTruth& truth) { return view_of(truth.frame.*side.*picture); };
  };
  using Image = renderer::RenderedImage;
  using Pair = renderer::StereoFrame;
  py::class_<PyTruth>(module, "Truth", "What both cameras really see. Arrays are read-only and no copies.")
      .def_property_readonly(
          "pose", [](const PyTruth& truth) { return array_of(truth.world_from_robot); },
          "x_m, y_m, heading_rad of the robot in the world frame (float64, 3).")
      .def_property_readonly("left", part(&Image::colour, &Pair::left),
                             "Linear light without noise, H x W x 3, BGR: uint8 levels, or uint16 in 1/257.")
      .def_property_readonly("right", part(&Image::colour, &Pair::right), "As `left`.")
      .def_property_readonly("left_ids", part(&Image::ball_id, &Pair::left),
                             "uint8, H x W: ball_id + 1, 0 where there is no ball.")
      .def_property_readonly("right_ids", part(&Image::ball_id, &Pair::right), "As `left_ids`.")
      .def_property_readonly("left_depth_m", part(&Image::depth_m, &Pair::left),
                             "float32, H x W: depth along the optical axis, m; inf where there is nothing.")
      .def_property_readonly("right_depth_m", part(&Image::depth_m, &Pair::right), "As `left_depth_m`.");
}

void add_drive_frame(py::module_& module) {
  py::class_<PyDriveFrame, PyFrame, std::shared_ptr<PyDriveFrame>>(
      module, "DriveFrame", "A frame of a drive: what a detector may see, and the rest beside it.")
      .def_property_readonly("truth", truth_of, "What the cameras really see; None without a picture.")
      .def_property_readonly(
          "odometry",
          [](const PyDriveFrame& frame) { return table_of(frame.drive->log_step(frame.step).odometry); },
          "Measured controls since the frame before: v_mps, w_radps, duration_s, lateral_mps.")
      .def(
          "observe", [](PyDriveFrame& frame) { return dicts_of(ours_of(frame), frame.step); },
          "What our own detector finds: a list of dicts, as detectors answer.")
      .def("measure", measure, py::arg("balls") = py::none(),
           "What filters are given of this frame: an array of measurements. It is scored and logged.\n\n"
           "balls: what a detector found, a list of dicts; None: what our detector or the oracle finds.");
}

}  // namespace

void add_drive(py::module_& module) {
  add_truth(module);
  add_drive_frame(module);
  py::class_<PyDrive, DrivePointer>(module, "Drive")
      .def(py::init([](const std::shared_ptr<PyScenario>& scenario, std::uint64_t seed) {
             const py::gil_scoped_release release;
             return std::make_shared<PyDrive>(scenario, seed);
           }),
           py::arg("scenario"), py::arg("seed"))
      .def("__len__", &PyDrive::steps)
      .def_property_readonly("seed", &PyDrive::seed)
      .def_property_readonly("setup", [](const PyDrive& drive) { return setup_dict(drive.setup()); })
      .def_property_readonly(
          "start", [](const PyDrive& drive) { return array_of(drive.start()); },
          "x_m, y_m, heading_rad that filters are told to start at (float64, 3).")
      .def_property_readonly(
          "balls", [](const PyDrive& drive) { return table_of(drive.world().balls); },
          "The seed's balls: ball_id, colour, x_m, y_m, z_m, radius_m in the world frame.")
      .def("_frame", frame_of, py::arg("step"), py::arg("setup"))
      .def("_render",
           [](PyDrive& drive, double x_m, double y_m, double heading_rad) {
             const py::gil_scoped_release release;
             const slam::Pose pose{x_m, y_m, heading_rad};
             return PyTruth{drive.render(pose), pose};
           })
      .def("bounds", bounds_of,
           "Cramer-Rao bounds of the log so far, as covariances: \"poses\" (N x 3 x 3 of x, y, heading; m, "
           "rad),\n\"smoothed_poses\" (the same given the whole log), \"landmarks\" (M x 2 x 2, m^2).");
}

}  // namespace stereobench::harness::bindings
