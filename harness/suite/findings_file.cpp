#include "harness/suite/findings_file.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "harness/io/number_table.h"

namespace stereobench::harness {
namespace {

constexpr const char* kHeader =
    "seed,frame,ball,required,found,taken_for,range_error_m,left_x_error_px,left_y_error_px,right_x_error_px,"
    "right_y_error_px";

constexpr int kRangeDecimals = 7;
constexpr int kPixelDecimals = 4;

enum Column : std::size_t {
  kSeed,
  kFrame,
  kBall,
  kRequired,
  kFound,
  kTakenFor,
  kRange,
  kLeftX,
  kLeftY,
  kRightX,
  kRightY
};

std::string rounded(double value, int decimals) {
  if (!std::isfinite(value)) return "";
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.find_first_not_of("-0.") == std::string::npos ? "0" : text;  // zero has no sign
}

std::string pixels(const Eigen::Vector2d& error_px) {
  return rounded(error_px.x(), kPixelDecimals) + "," + rounded(error_px.y(), kPixelDecimals);
}

Eigen::Vector2d pixels_in(const NumberTable& table, const TableRow& row, std::size_t x, std::size_t y) {
  if (row.cells[x].empty()) return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  return {number_in(table, row, x), number_in(table, row, y)};
}

BallFinding finding_in(const NumberTable& table, const TableRow& row) {
  BallFinding finding;
  if (!row.cells[kTakenFor].empty()) finding.wrong_colour = whole_number_in(table, row, kTakenFor, 0);
  finding.is_found = whole_number_in(table, row, kFound, 0) == 1;
  if (!finding.is_found) return finding;
  finding.range_error_m = number_in(table, row, kRange);
  finding.left_error_px = pixels_in(table, row, kLeftX, kLeftY);
  finding.right_error_px = pixels_in(table, row, kRightX, kRightY);
  return finding;
}

/// A finding as it is after it was written and read.
BallFinding as_written(BallFinding finding) {
  const auto through_text = [](double value, int decimals) {
    const std::string text = rounded(value, decimals);
    return text.empty() ? std::numeric_limits<double>::quiet_NaN() : std::stod(text);
  };
  finding.range_error_m = through_text(finding.range_error_m, kRangeDecimals);
  for (Eigen::Vector2d* error_px : {&finding.left_error_px, &finding.right_error_px})
    for (double& coordinate : *error_px) coordinate = through_text(coordinate, kPixelDecimals);
  return finding;
}

}  // namespace

std::string findings_csv(const DetectedBalls& balls) {
  std::string csv = std::string(kHeader) + "\n";
  for (const auto& [key, ball] : balls) {
    const BallFinding& finding = ball.finding;
    csv += fmt::format("{},{},{},{:d},{:d},{}", key.seed, key.frame, key.ball, ball.truth.is_required,
                       finding.is_found, finding.wrong_colour ? std::to_string(*finding.wrong_colour) : "");
    csv += finding.is_found ? fmt::format(",{},{},{}\n", rounded(finding.range_error_m, kRangeDecimals),
                                          pixels(finding.left_error_px), pixels(finding.right_error_px))
                            : ",,,,,\n";
  }
  return csv;
}

DetectedBalls read_findings(const std::filesystem::path& file) {
  const NumberTable table = read_csv_table(file, {kHeader});
  DetectedBalls balls;
  for (const TableRow& row : table.rows)
    balls[{seed_in(table, row, kSeed), whole_number_in(table, row, kFrame, 0),
           whole_number_in(table, row, kBall, 0)}] = {
        {.is_required = whole_number_in(table, row, kRequired, 0) == 1}, finding_in(table, row)};
  return balls;
}

PairedBalls pair_findings(const DetectedBalls& first, const DetectedBalls& second) {
  DetectedBalls balls;
  for (const auto& [key, ball] : first) {
    const auto same = second.find(key);
    if (same == second.end() && !ball.truth.is_required) continue;
    DetectedBall& with_truth = balls[key] = ball;
    if (same == second.end()) continue;
    with_truth.truth = same->second.truth;
    with_truth.truth.is_required = ball.truth.is_required;
  }
  DetectedBalls rounded_alike = second;
  for (auto& [key, ball] : rounded_alike) ball.finding = as_written(ball.finding);
  return pair_balls(balls, rounded_alike);
}

}  // namespace stereobench::harness
