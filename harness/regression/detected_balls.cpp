#include "harness/regression/detected_balls.h"

#include <cmath>
#include <limits>
#include <string>

#include "harness/io/number_table.h"
#include "harness/vision_scoring/detection_outcome.h"
#include "harness/vision_scoring/detection_table.h"
#include "slam/models/motion.h"

namespace stereobench::harness {
namespace {

/// A line of the table, whose cells are asked for by their columns' names.
class DetectionLine {
 public:
  DetectionLine(const NumberTable& table, const TableRow& row) : table_(table), row_(row) {}

  const std::string& text(const char* name) const { return row_.cells[column(name)]; }
  double number(const char* name) const { return number_in(table_, row_, column(name)); }
  int whole_number(const char* name) const { return whole_number_in(table_, row_, column(name), 0); }
  std::uint64_t seed() const { return seed_in(table_, row_, column("seed")); }
  /// NaN where both cells are empty.
  Eigen::Vector2d pixel(const char* x, const char* y) const {
    if (text(x).empty() && text(y).empty())
      return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
    return {number(x), number(y)};
  }

 private:
  std::size_t column(const char* name) const {
    return static_cast<std::size_t>(std::ranges::find(table_.columns, name) - table_.columns.begin());
  }

  const NumberTable& table_;
  const TableRow& row_;
};

BallTruth truth_of(const DetectionLine& line) {
  return {.is_required = line.whole_number("required") == 1,
          .colour = line.whole_number("colour"),
          .range_m = line.number("true_range_m"),
          .bearing_rad = line.number("true_bearing_rad"),
          .radius_px = line.number("true_radius_px"),
          .fraction = std::min(line.number("left_fraction"), line.number("right_fraction")),
          .border_px = line.number("border_px"),
          .left_px = line.pixel("true_left_x_px", "true_left_y_px"),
          .right_px = line.pixel("true_right_x_px", "true_right_y_px")};
}

/// What was found of a ball.
BallFinding finding_of(const DetectionLine& line, const BallTruth& truth) {
  return {.is_found = true,
          .wrong_colour = {},
          .range_error_m = line.number("range_m") - truth.range_m,
          .bearing_error_rad = slam::wrap_angle(line.number("bearing_rad") - truth.bearing_rad),
          .left_error_px = line.pixel("left_x_px", "left_y_px") - truth.left_px,
          .right_error_px = line.pixel("right_x_px", "right_y_px") - truth.right_px};
}

void add(const DetectionLine& line, DetectedBalls& balls) {
  const std::string& outcome = line.text("outcome");
  const bool is_found = outcome == text_of(DetectionOutcome::kTruePositive);
  const bool is_wrong = outcome == text_of(DetectionOutcome::kWrongIdentity);
  if (!is_found && !is_wrong && outcome != kMiss) return;
  DetectedBall& ball = balls[{line.seed(), line.whole_number("frame"), line.whole_number("ball")}];
  ball.truth = truth_of(line);
  if (is_found) ball.finding = finding_of(line, ball.truth);
  if (is_wrong && !ball.finding.is_found) ball.finding.wrong_colour = line.whole_number("detected_colour");
}

}  // namespace

DetectedBalls read_detected_balls(const std::filesystem::path& file) {
  std::string header = detections_csv_header();
  header.pop_back();
  const NumberTable table = read_csv_table(file, {header});
  DetectedBalls balls;
  for (const TableRow& row : table.rows) add({table, row}, balls);
  return balls;
}

std::vector<PairedBall> pair_balls(const DetectedBalls& first, const DetectedBalls& second) {
  constexpr double kSamePlace_m = 1e-9;
  std::vector<PairedBall> pairs;
  for (const auto& [key, ball] : first) {
    const auto found = second.find(key);
    if (found == second.end()) {
      if (!ball.truth.is_required) pairs.push_back({key, ball.truth, ball.finding, {}});
    } else if (std::abs(found->second.truth.range_m - ball.truth.range_m) < kSamePlace_m) {
      pairs.push_back({key, ball.truth, ball.finding, found->second.finding});
    }
  }
  for (const auto& [key, ball] : second)
    if (!ball.truth.is_required && !first.contains(key)) pairs.push_back({key, ball.truth, {}, ball.finding});
  std::ranges::sort(pairs, {}, &PairedBall::key);
  return pairs;
}

}  // namespace stereobench::harness
