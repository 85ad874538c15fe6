/// Values of the program as rows of numpy's structured arrays, and pictures as arrays.
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>
#include <pybind11/numpy.h>

#include "slam/types.h"
#include "worlds/types.h"

namespace stereobench::harness::bindings {

/// Makes the rows known to numpy. Called once, before all else.
void register_tables();

/// slam::RangeBearing
struct MeasurementRow {
  double range_m;
  double bearing_rad;
  double covariance[2][2];
  double sd_scale[2];
  std::int64_t landmark_id;
  std::int64_t colour_class;
};

/// slam::Control, without a covariance of its own
struct ControlRow {
  double v_mps;
  double w_radps;
  double duration_s;
  double lateral_mps;
};

/// slam::LandmarkEstimate
struct LandmarkRow {
  std::int64_t landmark_id;
  std::int64_t colour_class;
  double x_m;
  double y_m;
  double covariance[2][2];
};

/// worlds::PathStep
struct PathRow {
  std::int64_t stamp_ns;
  double x_m;
  double y_m;
  double heading_rad;
};

/// worlds::Ball
struct BallRow {
  std::int64_t ball_id;
  std::int64_t colour;
  double x_m;
  double y_m;
  double z_m;
  double radius_m;
};

template <typename Row>
using Table = pybind11::array_t<Row, pybind11::array::c_style>;

Table<MeasurementRow> table_of(const std::vector<slam::RangeBearing>& measurements);
Table<ControlRow> table_of(const std::vector<slam::Control>& controls);
Table<LandmarkRow> table_of(const std::vector<slam::LandmarkEstimate>& landmarks);
Table<PathRow> table_of(const worlds::GroundTruth& path);
Table<BallRow> table_of(const std::vector<worlds::Ball>& balls);

/// @throws pybind11::value_error when the table has not exactly one dimension
std::vector<slam::RangeBearing> measurements_of(const Table<MeasurementRow>& table);
std::vector<slam::Control> controls_of(const Table<ControlRow>& table);
std::vector<slam::LandmarkEstimate> landmarks_of(const Table<LandmarkRow>& table);

/// (x_m, y_m, heading_rad)
pybind11::array_t<double> array_of(const slam::Pose& pose);

/// One matrix (Rows x Cols), or many as N x Rows x Cols.
template <typename Matrix>
pybind11::array_t<double> stack_of(const std::vector<Matrix>& matrices) {
  const auto rows = static_cast<pybind11::ssize_t>(Matrix::RowsAtCompileTime);
  const auto cols = static_cast<pybind11::ssize_t>(Matrix::ColsAtCompileTime);
  pybind11::array_t<double> stack({static_cast<pybind11::ssize_t>(matrices.size()), rows, cols});
  auto values = stack.template mutable_unchecked<3>();
  for (pybind11::ssize_t i = 0; i < values.shape(0); ++i)
    for (pybind11::ssize_t row = 0; row < rows; ++row)
      for (pybind11::ssize_t col = 0; col < cols; ++col)
        values(i, row, col) = matrices[static_cast<std::size_t>(i)](row, col);
  return stack;
}

/// A picture as a read-only array of its own memory, which lives as long as the array. None for an empty one.
pybind11::object view_of(const cv::Mat& picture);

}  // namespace stereobench::harness::bindings
