#include "harness/rig_calibration/rig_calibration.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "harness/io/picture_reader.h"
#include "harness/rig_calibration/board_corners.h"
#include "harness/rig_calibration/rectified_rig.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

constexpr double kOutlier = 3.0;       // times the median error of views
constexpr double kFineView_px = 0.05;  // of a view's error: no outlier, however good the others are

/// The views in which both cameras see the board, and what became of all.
struct FoundBoards {
  std::vector<BoardView> views;
  std::vector<ViewOutcome> outcomes;
  cv::Size size;
};

/// The size that most pictures on the left have: others are not of this rig.
cv::Size usual_size(const std::vector<std::array<cv::Mat, 2>>& pairs) {
  std::map<std::pair<int, int>, int> counts;
  for (const auto& pair : pairs) ++counts[{pair[0].cols, pair[0].rows}];
  const auto usual = std::max_element(counts.begin(), counts.end(),
                                      [](const auto& a, const auto& b) { return a.second < b.second; });
  return {usual->first.first, usual->first.second};
}

/// Looks for the board in a pair. @return why it cannot be used; empty when `view` can
std::string look(const std::array<cv::Mat, 2>& pair, const cv::Size& size, const Board& board,
                 BoardView& view) {
  for (std::size_t side = 0; side < 2; ++side)
    if (pair[side].size() != size)
      return fmt::format("the {} picture has {} x {} pixels, most have {} x {}", side == 0 ? "left" : "right",
                         pair[side].cols, pair[side].rows, size.width, size.height);
  const auto left = find_corners(pair[0], board);
  const auto right = find_corners(pair[1], board);
  if (!left || !right)
    return fmt::format("no board of {} x {} inner corners in the {}", board.columns, board.rows,
                       !left && !right ? "pictures of both cameras"
                       : !left         ? "left picture"
                                       : "right picture");
  view.corners_px = {*left, *right};
  align_orders(view);
  return {};
}

FoundBoards find_boards(const std::vector<ViewFiles>& files, const Board& board) {
  std::vector<std::array<cv::Mat, 2>> pairs;
  for (const ViewFiles& file : files)
    pairs.push_back({read_grey_picture(file.left), read_grey_picture(file.right)});
  FoundBoards boards;
  boards.size = usual_size(pairs);
  for (std::size_t i = 0; i < files.size(); ++i) {
    BoardView view{.name = files[i].name};
    const std::string dropped = look(pairs[i], boards.size, board, view);
    boards.outcomes.push_back({.name = files[i].name, .dropped = dropped, .index = boards.views.size()});
    if (dropped.empty()) boards.views.push_back(view);
  }
  return boards;
}

[[noreturn]] void refuse_too_few(const FoundBoards& boards, std::size_t expected) {
  std::string reasons;
  for (const ViewOutcome& outcome : boards.outcomes)
    if (!outcome.dropped.empty()) reasons += fmt::format("; {}: {}", outcome.name, outcome.dropped);
  throw std::runtime_error(
      fmt::format("expected at least {} views in which both cameras see the board (got {}){}", expected,
                  boards.views.size(), reasons));
}

double error_of(const std::array<double, 2>& cameras) {
  return std::sqrt(0.5 * (cameras[0] * cameras[0] + cameras[1] * cameras[1]));
}

/// Takes out the views that do not suit the others.
void drop_outliers(FoundBoards& boards, const RigFitSettings& settings, const Compared& compared) {
  RigFitSettings robust = fullest(settings, compared);
  robust.robust = true;
  const RigFit fit = fit_rig(boards.views, robust);
  std::vector<double> errors;
  for (const auto& cameras : fit.view_rms_px) errors.push_back(error_of(cameras));
  std::vector<double> sorted = errors;
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted[sorted.size() / 2];
  const double most = std::max(kOutlier * median, kFineView_px);
  std::vector<BoardView> kept;
  for (ViewOutcome& outcome : boards.outcomes) {
    if (!outcome.dropped.empty()) continue;
    const std::size_t view = outcome.index;
    outcome.index = kept.size();
    if (errors[view] <= most)
      kept.push_back(boards.views[view]);
    else
      outcome.dropped = fmt::format("its corners are {:.3g} px off, those of the other views {:.3g} px",
                                    errors[view], median);
  }
  boards.views = kept;
}

/// Rows: how far apart the cameras' corners are across the epipolar lines, once rectified.
void judge_rows(BoardCalibration& calibration) {
  double squares = 0.0;
  double sizes = 0.0;
  std::size_t count = 0;
  for (ViewOutcome& outcome : calibration.outcomes) {
    if (!outcome.dropped.empty()) continue;
    const auto& [left, right] = calibration.used[outcome.index].corners_px;
    double view_squares = 0.0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const auto a = rectified_px(calibration.rig, left[i], vision::Side::kLeft);
      const auto b = rectified_px(calibration.rig, right[i], vision::Side::kRight);
      const double error = a && b ? std::abs(a->y() - b->y()) : 1e9;
      view_squares += error * error;
      sizes += error;
      outcome.row_worst_px = std::max(outcome.row_worst_px, error);
    }
    outcome.row_rms_px = std::sqrt(view_squares / static_cast<double>(left.size()));
    squares += view_squares;
    count += left.size();
  }
  calibration.row_rms_px = std::sqrt(squares / static_cast<double>(count));
  calibration.row_mean_px = sizes / static_cast<double>(count);
}

/// The board as the rig sees it in space: a corner's depth is f B / disparity.
std::vector<Eigen::Vector3d> corners_in_space(const RigCalibration& calibration, const BoardView& view) {
  const vision::Intrinsics& camera = calibration.rig.intrinsics;
  std::vector<Eigen::Vector3d> corners;
  for (std::size_t i = 0; i < view.corners_px[0].size(); ++i) {
    const auto a = rectified_px(calibration, view.corners_px[0][i], vision::Side::kLeft);
    const auto b = rectified_px(calibration, view.corners_px[1][i], vision::Side::kRight);
    if (!a || !b) continue;
    const double depth_m = camera.focal_px * calibration.rig.baseline_m / (a->x() - b->x());
    corners.push_back(depth_m * vision::pixel_ray(camera, *a));
  }
  return corners;
}

/// What the rig makes of the board's known size.
void judge_squares(const Board& board, BoardCalibration& calibration) {
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (const BoardView& view : calibration.used) {
    const auto corners = corners_in_space(calibration.rig, view);
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      if ((i + 1) % static_cast<std::size_t>(board.columns) == 0) continue;
      const double side_m = (corners[i + 1] - corners[i]).norm();
      sum += side_m;
      squares += (side_m - board.square_m) * (side_m - board.square_m);
      count += 1.0;
    }
  }
  calibration.square_mean_m = sum / count;
  calibration.square_rms_m = std::sqrt(squares / count);
}

}  // namespace

BoardCalibration calibrate_rig(const std::vector<ViewFiles>& files, const BoardSettings& settings) {
  FoundBoards boards = find_boards(files, settings.board);
  if (boards.views.size() < settings.fewest_views) refuse_too_few(boards, settings.fewest_views);
  const RigFitSettings fit{.board = settings.board,
                           .width_px = boards.size.width,
                           .height_px = boards.size.height,
                           .model = settings.model,
                           .lens = settings.lens,
                           .square_pixels = settings.compared.aspect || settings.square_pixels};
  drop_outliers(boards, fit, settings.compared);
  if (boards.views.size() < settings.fewest_views) refuse_too_few(boards, settings.fewest_views);
  ModelChoice choice = choose_model(boards.views, fit, settings.compared);
  BoardCalibration calibration{.fit = choice.fit, .models = std::move(choice.trials)};
  calibration.rig = rectified_rig(calibration.fit, settings.model, fit.width_px, fit.height_px);
  calibration.used = std::move(boards.views);
  calibration.outcomes = std::move(boards.outcomes);
  judge_rows(calibration);
  judge_squares(settings.board, calibration);
  return calibration;
}

}  // namespace stereobench::harness
