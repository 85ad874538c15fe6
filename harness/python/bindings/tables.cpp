#include "harness/python/bindings/tables.h"

namespace py = pybind11;

namespace stereobench::harness::bindings {
namespace {

/// @param row of an element
template <typename Row, typename Value, typename Convert>
Table<Row> rows_of(const std::vector<Value>& values, const Convert& convert) {
  Table<Row> table(static_cast<py::ssize_t>(values.size()));
  Row* const rows = table.mutable_data();
  for (std::size_t i = 0; i < values.size(); ++i) rows[i] = convert(values[i], i);
  return table;
}

template <typename Value, typename Row, typename Convert>
std::vector<Value> values_of(const Table<Row>& table, const Convert& convert) {
  if (table.ndim() != 1)
    throw py::value_error("expected an array of one dimension (got " + std::to_string(table.ndim()) + ")");
  std::vector<Value> values;
  for (py::ssize_t i = 0; i < table.size(); ++i) values.push_back(convert(table.data()[i]));
  return values;
}

using Rows2 = double[2][2];

void copy_to(Rows2& to, const Eigen::Matrix2d& from) {
  for (int row = 0; row < 2; ++row)
    for (int col = 0; col < 2; ++col) to[row][col] = from(row, col);
}

Eigen::Matrix2d matrix_of(const Rows2& rows) {
  Eigen::Matrix2d matrix;
  matrix << rows[0][0], rows[0][1], rows[1][0], rows[1][1];
  return matrix;
}

py::dtype dtype_of(int depth) {
  if (depth == CV_8U) return py::dtype::of<std::uint8_t>();
  if (depth == CV_16U) return py::dtype::of<std::uint16_t>();
  return py::dtype::of<float>();
}

}  // namespace

void register_tables() {
  PYBIND11_NUMPY_DTYPE(MeasurementRow, range_m, bearing_rad, covariance, sd_scale, landmark_id, colour_class);
  PYBIND11_NUMPY_DTYPE(ControlRow, v_mps, w_radps, duration_s, lateral_mps);
  PYBIND11_NUMPY_DTYPE(LandmarkRow, landmark_id, colour_class, x_m, y_m, covariance);
  PYBIND11_NUMPY_DTYPE(PathRow, stamp_ns, x_m, y_m, heading_rad);
  PYBIND11_NUMPY_DTYPE(BallRow, ball_id, colour, x_m, y_m, z_m, radius_m);
}

Table<MeasurementRow> table_of(const std::vector<slam::RangeBearing>& measurements) {
  return rows_of<MeasurementRow>(measurements, [](const slam::RangeBearing& seen, std::size_t) {
    MeasurementRow row{.range_m = seen.range_m,
                       .bearing_rad = seen.bearing_rad,
                       .covariance = {},
                       .sd_scale = {seen.sd_scale.x(), seen.sd_scale.y()},
                       .landmark_id = seen.landmark_id,
                       .colour_class = seen.colour_class};
    copy_to(row.covariance, seen.covariance);
    return row;
  });
}

Table<ControlRow> table_of(const std::vector<slam::Control>& controls) {
  return rows_of<ControlRow>(controls, [](const slam::Control& control, std::size_t) {
    return ControlRow{control.v_mps, control.w_radps, control.duration_s, control.lateral_mps};
  });
}

Table<LandmarkRow> table_of(const std::vector<slam::LandmarkEstimate>& landmarks) {
  return rows_of<LandmarkRow>(landmarks, [](const slam::LandmarkEstimate& landmark, std::size_t) {
    LandmarkRow row{
        landmark.landmark_id, landmark.colour_class, landmark.position_m.x(), landmark.position_m.y(), {}};
    copy_to(row.covariance, landmark.covariance);
    return row;
  });
}

Table<PathRow> table_of(const worlds::GroundTruth& path) {
  return rows_of<PathRow>(path, [](const worlds::PathStep& step, std::size_t) {
    return PathRow{step.stamp_ns, step.pose.x_m, step.pose.y_m, step.pose.heading_rad};
  });
}

Table<BallRow> table_of(const std::vector<worlds::Ball>& balls) {
  return rows_of<BallRow>(balls, [](const worlds::Ball& ball, std::size_t i) {
    return BallRow{static_cast<std::int64_t>(i),
                   ball.colour,
                   ball.centre_m.x(),
                   ball.centre_m.y(),
                   ball.centre_m.z(),
                   ball.radius_m};
  });
}

std::vector<slam::RangeBearing> measurements_of(const Table<MeasurementRow>& table) {
  return values_of<slam::RangeBearing>(table, [](const MeasurementRow& row) {
    return slam::RangeBearing{.range_m = row.range_m,
                              .bearing_rad = row.bearing_rad,
                              .covariance = matrix_of(row.covariance),
                              .landmark_id = static_cast<int>(row.landmark_id),
                              .colour_class = static_cast<int>(row.colour_class),
                              .sd_scale = {row.sd_scale[0], row.sd_scale[1]}};
  });
}

std::vector<slam::Control> controls_of(const Table<ControlRow>& table) {
  return values_of<slam::Control>(table, [](const ControlRow& row) {
    return slam::Control{.v_mps = row.v_mps,
                         .w_radps = row.w_radps,
                         .duration_s = row.duration_s,
                         .lateral_mps = row.lateral_mps};
  });
}

std::vector<slam::LandmarkEstimate> landmarks_of(const Table<LandmarkRow>& table) {
  return values_of<slam::LandmarkEstimate>(table, [](const LandmarkRow& row) {
    return slam::LandmarkEstimate{.landmark_id = static_cast<int>(row.landmark_id),
                                  .colour_class = static_cast<int>(row.colour_class),
                                  .position_m = {row.x_m, row.y_m},
                                  .covariance = matrix_of(row.covariance)};
  });
}

py::array_t<double> array_of(const slam::Pose& pose) {
  py::array_t<double> array(3);
  double* const values = array.mutable_data();
  values[0] = pose.x_m;
  values[1] = pose.y_m;
  values[2] = pose.heading_rad;
  return array;
}

py::object view_of(const cv::Mat& picture) {
  if (picture.empty()) return py::none();
  auto* const kept = new cv::Mat(picture);
  const py::capsule owner(kept, [](void* mat) { delete static_cast<cv::Mat*>(mat); });
  std::vector<py::ssize_t> shape = {kept->rows, kept->cols};
  std::vector<py::ssize_t> strides = {static_cast<py::ssize_t>(kept->step[0]),
                                      static_cast<py::ssize_t>(kept->elemSize())};
  if (kept->channels() > 1) {
    shape.push_back(kept->channels());
    strides.push_back(static_cast<py::ssize_t>(kept->elemSize1()));
  }
  py::array view(dtype_of(kept->depth()), shape, strides, kept->data, owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

}  // namespace stereobench::harness::bindings
