#include "harness/result_pages/detection_row.h"

#include <algorithm>
#include <limits>
#include <map>

#include "harness/io/number_table.h"
#include "harness/vision_scoring/detection_outcome.h"
#include "harness/vision_scoring/detection_table.h"

namespace stereobench::harness {
namespace {

/// The cells of one line, by their columns' names.
class RowCells {
 public:
  RowCells(const NumberTable& table, const TableRow& row) : table_(table), row_(row) {}

  const std::string& text(const char* name) const { return row_.cells[column(name)]; }
  double number(const char* name) const {
    return text(name).empty() ? std::numeric_limits<double>::quiet_NaN()
                              : number_in(table_, row_, column(name));
  }
  std::optional<int> whole_number(const char* name) const {
    if (text(name).empty()) return {};
    return whole_number_in(table_, row_, column(name), 0);
  }
  std::uint64_t seed() const { return seed_in(table_, row_, column("seed")); }
  std::size_t frame() const {
    return static_cast<std::size_t>(whole_number_in(table_, row_, column("frame"), 0));
  }
  Eigen::Vector2d pixel(const char* x, const char* y) const { return {number(x), number(y)}; }

 private:
  std::size_t column(const char* name) const {
    return static_cast<std::size_t>(std::ranges::find(table_.columns, name) - table_.columns.begin());
  }

  const NumberTable& table_;
  const TableRow& row_;
};

DetectionRow detection_row(const RowCells& cells) {
  DetectionRow row{.seed = cells.seed(),
                   .frame = cells.frame(),
                   .outcome = cells.text("outcome"),
                   .ball = cells.whole_number("ball"),
                   .is_required = cells.whole_number("required") == 1,
                   .colour = cells.whole_number("colour"),
                   .true_range_m = cells.number("true_range_m"),
                   .true_bearing_rad = cells.number("true_bearing_rad"),
                   .true_left_px = cells.pixel("true_left_x_px", "true_left_y_px"),
                   .true_right_px = cells.pixel("true_right_x_px", "true_right_y_px"),
                   .true_radius_px = cells.number("true_radius_px"),
                   .detected_colour = cells.whole_number("detected_colour"),
                   .range_m = cells.number("range_m"),
                   .bearing_rad = cells.number("bearing_rad"),
                   .left_px = cells.pixel("left_x_px", "left_y_px"),
                   .right_px = cells.pixel("right_x_px", "right_y_px")};
  const double both = cells.number("range_bearing_covariance_m_rad");
  row.covariance << cells.number("range_variance_m2"), both, both, cells.number("bearing_variance_rad2");
  return row;
}

/// A ball's truth, without a detection.
DetectionRow truth_alone(DetectionRow row) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  row.detected_colour.reset();
  row.range_m = row.bearing_rad = kNone;
  row.left_px = row.right_px = Eigen::Vector2d::Constant(kNone);
  row.covariance = Eigen::Matrix2d::Constant(kNone);
  return row;
}

void append_finding(const BallFinding& finding, const DetectionRow& truth, std::vector<DetectionRow>& rows) {
  if (finding.is_found) {
    DetectionRow& row = rows.emplace_back(truth);
    row.outcome = text_of(DetectionOutcome::kTruePositive);
    row.detected_colour = truth.colour;
    row.range_m = truth.true_range_m + finding.range_error_m;
    row.left_px = truth.true_left_px + finding.left_error_px;
    row.right_px = truth.true_right_px + finding.right_error_px;
  }
  if (finding.wrong_colour) {
    DetectionRow& row = rows.emplace_back(truth);
    row.outcome = text_of(DetectionOutcome::kWrongIdentity);
    row.detected_colour = finding.wrong_colour;
  }
  if (finding.is_found || !truth.is_required) return;
  rows.push_back(truth);
  rows.back().outcome = kMiss;
}

}  // namespace

std::vector<DetectionRow> read_detection_rows(const std::filesystem::path& file) {
  std::string header = detections_csv_header();
  header.pop_back();
  const NumberTable table = read_csv_table(file, {header});
  std::vector<DetectionRow> rows;
  rows.reserve(table.rows.size());
  for (const TableRow& row : table.rows) rows.push_back(detection_row({table, row}));
  return rows;
}

std::vector<DetectionRow> rows_of_findings(const DetectedBalls& findings,
                                           std::span<const DetectionRow> rows) {
  std::map<BallKey, DetectionRow> truth;
  for (const DetectionRow& row : rows)
    if (row.ball) truth.insert({{row.seed, static_cast<int>(row.frame), *row.ball}, truth_alone(row)});
  std::vector<DetectionRow> made;
  for (const auto& [key, ball] : findings)
    if (const auto found = truth.find(key); found != truth.end())
      append_finding(ball.finding, found->second, made);
  return made;
}

}  // namespace stereobench::harness
