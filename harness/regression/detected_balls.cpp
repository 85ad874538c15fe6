#include "harness/regression/detected_balls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "harness/io/number_table.h"
#include "harness/vision_scoring/detection_outcome.h"
#include "harness/vision_scoring/detection_table.h"

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
          .left_px = {line.number("true_left_x_px"), line.number("true_left_y_px")},
          .right_px = {line.number("true_right_x_px"), line.number("true_right_y_px")}};
}

/// What was found of a ball.
BallFinding finding_of(const DetectionLine& line, const BallTruth& truth) {
  return {.is_found = true,
          .wrong_colour = {},
          .range_error_m = line.number("range_m") - truth.range_m,
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
  if (is_found) {
    const std::optional<int> wrong_colour = ball.finding.wrong_colour;
    ball.finding = finding_of(line, ball.truth);
    ball.finding.wrong_colour = wrong_colour;
  }
  if (is_wrong) ball.finding.wrong_colour = line.whole_number("detected_colour");
}

std::set<std::uint64_t> shared_seeds_of(const DetectedBalls& first, const DetectedBalls& second) {
  std::set<std::uint64_t> of_first, shared;
  for (const auto& [key, ball] : first) of_first.insert(key.seed);
  for (const auto& [key, ball] : second)
    if (of_first.contains(key.seed)) shared.insert(key.seed);
  return shared;
}

/// Whether a ball is the same, seen from the same place.
bool is_same(const BallTruth& a, const BallTruth& b) {
  constexpr double kSame = 1e-9;  // m, rad
  return a.is_required == b.is_required && a.colour == b.colour && std::abs(a.range_m - b.range_m) < kSame &&
         std::abs(a.bearing_rad - b.bearing_rad) < kSame;
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

PairedBalls pair_balls(const DetectedBalls& first, const DetectedBalls& second) {
  const std::set<std::uint64_t> seeds = shared_seeds_of(first, second);
  PairedBalls pairs;
  for (const auto& [key, ball] : first) {
    if (!seeds.contains(key.seed)) continue;
    const auto found = second.find(key);
    if (found != second.end() && is_same(found->second.truth, ball.truth))
      pairs.balls.push_back({key, ball.truth, ball.finding, found->second.finding});
    else if (ball.truth.is_required)
      ++pairs.unpaired;
    else if (found == second.end())
      pairs.balls.push_back({key, ball.truth, ball.finding, {}});
  }
  for (const auto& [key, ball] : second) {
    if (!seeds.contains(key.seed) || first.contains(key)) continue;
    if (ball.truth.is_required)
      ++pairs.unpaired;
    else
      pairs.balls.push_back({key, ball.truth, {}, ball.finding});
  }
  std::ranges::sort(pairs.balls, {}, &PairedBall::key);
  return pairs;
}

}  // namespace stereobench::harness
