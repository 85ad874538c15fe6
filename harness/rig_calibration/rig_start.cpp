#include "harness/rig_calibration/rig_start.h"

#include <algorithm>
#include <stdexcept>

#include <Eigen/Geometry>
#include <opencv2/calib3d.hpp>

namespace stereobench::harness {
namespace {

/// A camera and where it saw the board.
struct CameraStart {
  CameraParameters camera = CameraParameters::Zero();
  std::vector<Eigen::Isometry3d> camera_from_board;
};

Eigen::Isometry3d isometry_of(const cv::Mat& rotation_vector, const cv::Mat& shift) {
  const Eigen::Vector3d turn(rotation_vector.ptr<double>());
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  if (turn.norm() > 0.0) result.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).matrix();
  result.translation() = Eigen::Vector3d(shift.ptr<double>());
  return result;
}

BoardPose pose_of(const Eigen::Isometry3d& transform) {
  const Eigen::AngleAxisd turn(transform.rotation());
  BoardPose pose;
  pose << turn.angle() * turn.axis(), transform.translation();
  return pose;
}

CameraStart start_camera(const std::vector<BoardView>& views, std::size_t side,
                         const RigFitSettings& settings) {
  std::vector<std::vector<cv::Point3f>> board(views.size());
  std::vector<std::vector<cv::Point2f>> seen(views.size());
  for (std::size_t view = 0; view < views.size(); ++view) {
    for (int i = 0; i < settings.board.corners(); ++i) {
      const Eigen::Vector3f at = settings.board.corner_m(i).cast<float>();
      const Eigen::Vector2f pixel = views[view].corners_px[side][static_cast<std::size_t>(i)].cast<float>();
      board[view].emplace_back(at.x(), at.y(), at.z());
      seen[view].emplace_back(pixel.x(), pixel.y());
    }
  }
  const double guess_px = settings.width_px;
  cv::Mat k = (cv::Mat_<double>(3, 3) << guess_px, 0, 0.5 * (settings.width_px - 1), 0, guess_px,
               0.5 * (settings.height_px - 1), 0, 0, 1);
  cv::Mat d = cv::Mat::zeros(1, 5, CV_64F);
  std::vector<cv::Mat> turns, shifts;
  int flags = cv::CALIB_FIX_K2 | cv::CALIB_FIX_K3 | cv::CALIB_ZERO_TANGENT_DIST;
  if (settings.square_pixels) flags |= cv::CALIB_FIX_ASPECT_RATIO;
  if (!settings.lens[0]) flags |= cv::CALIB_FIX_K1;
  cv::calibrateCamera(board, seen, {settings.width_px, settings.height_px}, k, d, turns, shifts, flags);
  CameraStart start;
  start.camera << k.at<double>(0, 0), k.at<double>(0, 2), k.at<double>(1, 2), d.at<double>(0), 0, 0, 0, 0,
      settings.square_pixels ? 1.0 : k.at<double>(1, 1) / k.at<double>(0, 0);
  for (std::size_t view = 0; view < turns.size(); ++view)
    start.camera_from_board.push_back(isometry_of(turns[view], shifts[view]));
  return start;
}

/// The component-wise median: what one view is off by does not move it.
BoardPose median_of(const std::vector<BoardPose>& poses) {
  BoardPose median;
  for (int i = 0; i < 6; ++i) {
    std::vector<double> values;
    for (const BoardPose& pose : poses) values.push_back(pose[i]);
    std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
    median[i] = values[values.size() / 2];
  }
  return median;
}

}  // namespace

RigState start_rig(const std::vector<BoardView>& views, const RigFitSettings& settings) try {
  const CameraStart left = start_camera(views, 0, settings);
  const CameraStart right = start_camera(views, 1, settings);
  RigState state;
  state.cameras = {left.camera, right.camera};
  std::vector<BoardPose> offsets;
  for (std::size_t view = 0; view < views.size(); ++view) {
    state.left_from_board.push_back(pose_of(left.camera_from_board[view]));
    offsets.push_back(pose_of(left.camera_from_board[view] * right.camera_from_board[view].inverse()));
  }
  state.left_from_right = median_of(offsets);
  if (settings.model == RigModel::kOneCamera) {
    state.cameras[0] = state.cameras[1] = 0.5 * (left.camera + right.camera);
    state.left_from_right.tail<2>().setZero();
  }
  return state;
} catch (const cv::Exception&) {
  throw std::runtime_error("the views do not determine a camera: turn the board to other sides");
}

}  // namespace stereobench::harness
