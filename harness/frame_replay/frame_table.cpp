#include "harness/frame_replay/frame_table.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/io/number_table.h"
#include "harness/io/text_table.h"
#include "harness/vision_scoring/detection_outcome.h"
#include "harness/vision_scoring/detection_table.h"
#include "harness/vision_scoring/vision_score.h"

namespace stereobench::harness {
namespace {

using Cells = std::vector<std::string>;

constexpr double kMilli = 1e3;

/// Words in place of those with underscores.
std::string spoken(std::string outcome) {
  for (char& letter : outcome)
    if (letter == '_') letter = ' ';
  return outcome;
}

std::string pixel_text(const Eigen::Vector2d& error_px) {
  return error_px.allFinite() ? fmt::format("({:+.3f}, {:+.3f})", error_px.x(), error_px.y()) : "-";
}

/// Number, colour, true range and radius; "-" where there is no ball.
Cells ball_cells(const ReplayedFrame& frame, const BallInPair* ball) {
  if (ball == nullptr) return {"-", "-", "-", "-", "-"};
  return {fmt::format("{}", ball->ball),
          fmt::format("{}", frame.world.balls[static_cast<std::size_t>(ball->ball)].colour),
          format_number(ball->ball_in_robot.head<2>().norm(), 4),
          fmt::format("{:.1f}", std::min(ball->left.radius_px(), ball->right.radius_px())),
          fmt::format("{:.0f} %", 100.0 * std::min(ball->left_fraction, ball->right_fraction))};
}

/// What was detected and by how much it is off the ball.
Cells detection_cells(const BallInPair* ball, const vision::BallObservation& seen) {
  const std::string colour = seen.colour == slam::kUnknown ? "?" : fmt::format("{}", seen.colour);
  if (ball == nullptr) return {colour, "-", "-", "-", "-", "-"};
  const DetectionError error = detection_error(*ball, seen);
  const bool has_pixels = seen.has_pixels;
  return {colour,
          fmt::format("{:+.3f}", kMilli * error.range_m),
          fmt::format("{:+.4f}", kMilli * error.bearing_rad),
          has_pixels ? pixel_text(seen.left_px - ball->left.centre_px) : "-",
          has_pixels ? pixel_text(seen.right_px - ball->right.centre_px) : "-",
          format_number(error.normalised)};
}

Cells row_of(const std::string& outcome, const Cells& ball, const Cells& detection) {
  Cells row = {outcome};
  row.insert(row.end(), ball.begin(), ball.end());
  row.insert(row.end(), detection.begin(), detection.end());
  return row;
}

}  // namespace

std::string frame_table(const ReplayedFrame& frame) {
  AlignedTable table{.header = {"outcome", "ball", "colour", "range [m]", "radius [px]", "visible", "seen as",
                                "range error [mm]", "bearing error [mrad]", "left error [px]",
                                "right error [px]", "NIS / 2"},
                     .rows = {}};
  const PairOutcome outcome = judge_detections(frame.match);
  for (std::size_t i = 0; i < frame.match.observations.size(); ++i) {
    const MatchedObservation& seen = frame.match.observations[i];
    const BallInPair* const ball = seen.outline ? &frame.match.outlines[*seen.outline] : nullptr;
    table.rows.push_back(row_of(spoken(text_of(outcome.detections[i])), ball_cells(frame, ball),
                                detection_cells(ball, seen.undistorted)));
  }
  for (std::size_t i = 0; i < frame.match.outlines.size(); ++i)
    if (outcome.is_required[i] && !outcome.is_found[i])
      table.rows.push_back(row_of(kMiss, ball_cells(frame, &frame.match.outlines[i]), Cells(6, "-")));
  return plain_text(table);
}

std::string rows_in_table(const std::filesystem::path& detections, const FrameName& frame) {
  std::string header = detections_csv_header();
  header.pop_back();
  const NumberTable table = read_csv_table(detections, {header});
  std::string rows;
  for (const TableRow& row : table.rows)
    if (seed_in(table, row, 0) == frame.seed &&
        static_cast<std::size_t>(whole_number_in(table, row, 1, 0)) == frame.step)
      rows += fmt::format("{}\n", fmt::join(row.cells, ","));
  return rows;
}

}  // namespace stereobench::harness
