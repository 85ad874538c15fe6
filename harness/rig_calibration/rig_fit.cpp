#include "harness/rig_calibration/rig_fit.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include <Eigen/Cholesky>
#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <fmt/format.h>

#include "harness/rig_calibration/residual_facts.h"
#include "harness/rig_calibration/rig_start.h"

namespace stereobench::harness {
namespace {

constexpr double kRobustScale_px = 0.5;  // beyond it a corner's pull grows no more
constexpr double kWorstKnown = 0.1;      // of the focal length; what is known no better is not known
constexpr std::size_t kFewestViews = 3;

/// Where a camera shows a point: vision::image_point, with derivatives.
/// @param camera as CameraParameters
template <typename T>
void project(const T* camera, const T* point, T* pixel) {
  const T x = point[0] / point[2];
  const T y = point[1] / point[2];
  const T r2 = x * x + y * y;
  const T radial = 1.0 + r2 * (camera[3] + r2 * (camera[4] + r2 * camera[7]));
  pixel[0] = camera[1] + camera[0] * (x * radial + 2.0 * camera[5] * x * y + camera[6] * (r2 + 2.0 * x * x));
  pixel[1] = camera[2] + camera[0] * camera[kAspect] *
                             (y * radial + camera[5] * (r2 + 2.0 * y * y) + 2.0 * camera[6] * x * y);
}

/// left = R(pose) point + shift
template <typename T>
void transform(const T* pose, const T* point, T* result) {
  ceres::AngleAxisRotatePoint(pose, point, result);
  for (int i = 0; i < 3; ++i) result[i] += pose[3 + i];
}

/// point = R(pose)' (result - shift)
template <typename T>
void transform_back(const T* pose, const T* point, T* result) {
  const T turn[3] = {-pose[0], -pose[1], -pose[2]};
  const T moved[3] = {point[0] - pose[3], point[1] - pose[4], point[2] - pose[5]};
  ceres::AngleAxisRotatePoint(turn, moved, result);
}

/// A corner in the left camera's picture, minus where it should be.
struct LeftCorner {
  Eigen::Vector3d corner_m;
  Eigen::Vector2d seen_px;

  template <typename T>
  bool operator()(const T* camera, const T* left_from_board, T* residual) const {
    const T corner[3] = {T(corner_m[0]), T(corner_m[1]), T(corner_m[2])};
    T in_left[3];
    transform(left_from_board, corner, in_left);
    project(camera, in_left, residual);
    for (int i = 0; i < 2; ++i) residual[i] -= seen_px[i];
    return true;
  }
};

/// The same in the right camera's.
struct RightCorner {
  Eigen::Vector3d corner_m;
  Eigen::Vector2d seen_px;

  template <typename T>
  bool operator()(const T* camera, const T* left_from_right, const T* left_from_board, T* residual) const {
    const T corner[3] = {T(corner_m[0]), T(corner_m[1]), T(corner_m[2])};
    T in_left[3];
    T in_right[3];
    transform(left_from_board, corner, in_left);
    transform_back(left_from_right, in_left, in_right);
    project(camera, in_right, residual);
    for (int i = 0; i < 2; ++i) residual[i] -= seen_px[i];
    return true;
  }
};

std::vector<int> fixed_of_camera(const RigFitSettings& settings) {
  std::vector<int> fixed;
  for (int i = 0; i < 5; ++i)
    if (!settings.lens[static_cast<std::size_t>(i)]) fixed.push_back(3 + i);
  if (settings.square_pixels) fixed.push_back(kAspect);
  return fixed;
}

/// A block of parameters, and which of them are fitted.
struct Block {
  double* values;
  int size;
  std::vector<int> fixed;

  bool is_free(int i) const { return std::find(fixed.begin(), fixed.end(), i) == fixed.end(); }
};

/// The least-squares problem over a state, which it changes.
class RigProblem {
 public:
  RigProblem(const std::vector<BoardView>& views, const RigFitSettings& settings, RigState& state)
      : one_camera_(settings.model == RigModel::kOneCamera),
        loss_(settings.robust ? std::make_unique<ceres::CauchyLoss>(kRobustScale_px) : nullptr) {
    blocks_.push_back({state.cameras[0].data(), kCameraSize, fixed_of_camera(settings)});
    if (!one_camera_) blocks_.push_back({state.cameras[1].data(), kCameraSize, fixed_of_camera(settings)});
    double* right_camera = blocks_.back().values;
    blocks_.push_back(
        {state.left_from_right.data(), 6, one_camera_ ? std::vector<int>{4, 5} : std::vector<int>{}});
    for (std::size_t view = 0; view < views.size(); ++view) {
      double* pose = state.left_from_board[view].data();
      blocks_.push_back({pose, 6, {}});
      for (int i = 0; i < settings.board.corners(); ++i) {
        const Eigen::Vector3d corner = settings.board.corner_m(i);
        const auto& [left, right] = views[view].corners_px;
        const auto at = static_cast<std::size_t>(i);
        problem_.AddResidualBlock(
            new ceres::AutoDiffCostFunction<LeftCorner, 2, kCameraSize, 6>(new LeftCorner{corner, left[at]}),
            loss_.get(), state.cameras[0].data(), pose);
        problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<RightCorner, 2, kCameraSize, 6, 6>(
                                      new RightCorner{corner, right[at]}),
                                  loss_.get(), right_camera, state.left_from_right.data(), pose);
      }
    }
    for (const Block& block : blocks_)
      if (!block.fixed.empty())
        problem_.SetManifold(block.values, new ceres::SubsetManifold(block.size, block.fixed));
  }

  void solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.max_num_iterations = 200;
    options.function_tolerance = 1e-14;
    options.parameter_tolerance = 1e-12;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    if (!summary.IsSolutionUsable())
      throw std::runtime_error("the fit of the rig does not settle: the views contradict each other");
  }

  /// Residuals without the loss: by view, corner, camera, axis.
  Eigen::VectorXd residuals() {
    std::vector<double> values;
    ceres::Problem::EvaluateOptions options;
    options.apply_loss_function = false;
    problem_.Evaluate(options, nullptr, &values, nullptr, nullptr);
    return Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<long>(values.size()));
  }

  /// (J' J)^-1 of what is fitted, in the order of blocks. @throws as fit_rig
  Eigen::MatrixXd inverse_information();

  /// Standard deviations of a block's parameters; zero for those that are not fitted.
  /// @param variances of what is fitted, in the order of blocks
  Eigen::VectorXd sds_of(std::size_t block, const Eigen::VectorXd& variances) const {
    long next = 0;
    for (std::size_t b = 0; b < block; ++b)
      next += blocks_[b].size - static_cast<long>(blocks_[b].fixed.size());
    Eigen::VectorXd sds = Eigen::VectorXd::Zero(blocks_[block].size);
    for (int i = 0; i < blocks_[block].size; ++i)
      if (blocks_[block].is_free(i)) sds[i] = std::sqrt(variances[next++]);
    return sds;
  }

 private:
  bool one_camera_;
  std::unique_ptr<ceres::LossFunction> loss_;
  std::vector<Block> blocks_;  ///< cameras, left_from_right, views
  ceres::Problem problem_{{.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP}};
};

Eigen::MatrixXd RigProblem::inverse_information() {
  ceres::CRSMatrix jacobian;
  ceres::Problem::EvaluateOptions options;
  options.apply_loss_function = false;
  for (const Block& block : blocks_) options.parameter_blocks.push_back(block.values);
  problem_.Evaluate(options, nullptr, nullptr, nullptr, &jacobian);
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(jacobian.num_cols, jacobian.num_cols);
  for (std::size_t row = 0; row + 1 < jacobian.rows.size(); ++row)
    for (auto i = static_cast<std::size_t>(jacobian.rows[row]);
         i < static_cast<std::size_t>(jacobian.rows[row + 1]); ++i)
      for (auto j = static_cast<std::size_t>(jacobian.rows[row]);
           j < static_cast<std::size_t>(jacobian.rows[row + 1]); ++j)
        information(jacobian.cols[i], jacobian.cols[j]) += jacobian.values[i] * jacobian.values[j];
  const Eigen::VectorXd scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> solver(scale.asDiagonal() * information * scale.asDiagonal());
  if (!scale.allFinite() || solver.info() != Eigen::Success)
    throw std::runtime_error("the views do not determine the rig: turn the board to other sides");
  const Eigen::MatrixXd inverse =
      solver.solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
  return scale.asDiagonal() * inverse * scale.asDiagonal();
}

/// The largest angle between the normals of two views' boards.
double tilt_spread(const std::vector<BoardPose>& left_from_board) {
  std::vector<Eigen::Vector3d> normals;
  for (const BoardPose& pose : left_from_board) {
    const double z[3] = {0.0, 0.0, 1.0};
    Eigen::Vector3d normal;
    ceres::AngleAxisRotatePoint(pose.data(), z, normal.data());
    normals.push_back(normal);
  }
  double least_cosine = 1.0;
  for (const Eigen::Vector3d& a : normals)
    for (const Eigen::Vector3d& b : normals) least_cosine = std::min(least_cosine, a.dot(b));
  return std::acos(std::max(least_cosine, -1.0));
}

void describe_residuals(const Eigen::VectorXd& residuals, std::size_t views, RigFit& fit) {
  const auto per_view = residuals.size() / static_cast<long>(views);
  for (std::size_t view = 0; view < views; ++view) {
    std::array<double, 2> squares = {0.0, 0.0};
    for (long i = 0; i < per_view; ++i) {
      const double value = residuals[static_cast<long>(view) * per_view + i];
      squares[static_cast<std::size_t>(i / 2 % 2)] += value * value;
    }
    const double corners = static_cast<double>(per_view) / 4.0;
    fit.view_rms_px.push_back({std::sqrt(squares[0] / corners), std::sqrt(squares[1] / corners)});
  }
  fit.rms_px = std::sqrt(2.0 * residuals.squaredNorm() / static_cast<double>(residuals.size()));
}

void check_known(const RigFit& fit) {
  for (std::size_t side = 0; side < 2; ++side)
    if (!(fit.cameras_sd[side][0] < kWorstKnown * fit.cameras[side][0]))
      throw std::runtime_error(
          fmt::format("the views do not determine the focal length ({:.0f} px, sd {:.0f}): tilt the board",
                      fit.cameras[side][0], fit.cameras_sd[side][0]));
}

}  // namespace

RigFit fit_rig(const std::vector<BoardView>& views, const RigFitSettings& settings) {
  if (views.size() < kFewestViews)
    throw std::runtime_error(
        fmt::format("expected at least {} views of the board (got {})", kFewestViews, views.size()));
  RigState state = start_rig(views, settings);
  RigProblem problem(views, settings, state);
  problem.solve();

  const bool one_camera = settings.model == RigModel::kOneCamera;
  if (one_camera) state.cameras[1] = state.cameras[0];
  const Eigen::VectorXd residuals = problem.residuals();
  RigFit fit;
  describe_residuals(residuals, views.size(), fit);
  fit.neighbour_sd_px = neighbour_sd(residuals, settings.board.columns);
  fit.clustering = clustering(residuals, settings.board.columns, settings.board.rows);
  fit.squares_px2 = residuals.squaredNorm();
  fit.tilt_spread_rad = tilt_spread(state.left_from_board);
  if (settings.robust) return fit;  // what outliers leave open is decided without them
  const Eigen::MatrixXd inverse = problem.inverse_information();
  fit.degrees_of_freedom = residuals.size() - inverse.rows();
  fit.corner_sd_px = std::sqrt(fit.squares_px2 / static_cast<double>(fit.degrees_of_freedom));
  const Eigen::VectorXd variances = fit.corner_sd_px * fit.corner_sd_px * inverse.diagonal();
  const std::size_t right = one_camera ? 0 : 1;
  fit.cameras = state.cameras;
  fit.cameras_sd = {problem.sds_of(0, variances), problem.sds_of(right, variances)};
  const Eigen::VectorXd offset_sds = problem.sds_of(right + 1, variances);
  fit.turn_rad = state.left_from_right.head<3>();
  fit.turn_sd_rad = offset_sds.head<3>();
  fit.right_in_left_m = state.left_from_right.tail<3>();
  fit.right_in_left_sd_m = offset_sds.tail<3>();
  check_known(fit);
  return fit;
}

}  // namespace stereobench::harness
