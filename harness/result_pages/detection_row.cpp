#include "harness/result_pages/detection_row.h"

#include <algorithm>
#include <limits>

#include "harness/io/number_table.h"
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

}  // namespace stereobench::harness
