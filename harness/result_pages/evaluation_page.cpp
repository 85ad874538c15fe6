#include "harness/result_pages/evaluation_page.h"

#include <numbers>

#include <fmt/format.h>

#include "harness/page/command_words.h"
#include "harness/page/spaced_steps.h"
#include "harness/result_pages/filter_blocks.h"
#include "harness/result_pages/gates_block.h"
#include "harness/result_pages/map_block.h"
#include "harness/trajectories/path_view.h"

namespace stereobench::harness {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr std::size_t kMostPoses = 2000;  ///< of a line over time

PageRow statistics_row(const std::string& name, const std::vector<double>& errors, double unit) {
  const ErrorStatistics s = statistics_of(errors);
  PageRow row{{{.text = name}, count_cell(static_cast<long>(errors.size()))}};
  for (const double value : {s.rmse, s.mean, s.median, s.sd, s.min, s.max})
    row.cells.push_back(number_cell(unit * value));
  return row;
}

Block errors_block(const Evaluation& evaluation) {
  PageTable table{.header = {"error", "number", "rmse", "mean", "median", "sd", "min", "max"}};
  const std::string over = span_text(evaluation.delta);
  const auto add = [&table](const std::string& name, const PoseErrors& errors) {
    table.rows.push_back(statistics_row(name + ", translation [m]", errors.translation_m, 1.0));
    table.rows.push_back(statistics_row(name + ", rotation [deg]", errors.rotation_rad, kDegrees));
  };
  add("absolute", evaluation.absolute);
  add("relative, over " + over, evaluation.relative);
  return {.title = "Errors",
          .note = "Absolute: of each pose, after the alignment. Relative: of the motion between two poses.",
          .content = std::move(table)};
}

/// KITTI's errors by length; without rows where no piece fits into the path.
Block segments_block(const std::vector<SegmentErrors>& segments) {
  PageTable table{.header = {"length [m]", "pieces", "translation [%]", "rotation [deg/m]"}};
  for (const SegmentErrors& piece : segments) {
    if (piece.count == 0) continue;
    const PageCell length = piece.length_m > 0.0 ? number_cell(piece.length_m) : PageCell{.text = "all"};
    table.rows.push_back({{length, count_cell(piece.count), number_cell(piece.translation_percent),
                           number_cell(piece.rotation_deg_per_m)}});
  }
  return {.title = "Errors by length",
          .note = "Means over pieces of the true path, as KITTI's benchmark has them.",
          .content = std::move(table)};
}

Chart error_chart(const Evaluation& evaluation, const std::string& label, const std::vector<double>& errors,
                  double unit) {
  const std::vector<double> time_s = times_of(evaluation.pairs);
  Series series{.name = "estimate"};
  for (const std::size_t k : spaced_steps(errors.size(), kMostPoses)) {
    series.x.push_back(time_s[k]);
    series.y.push_back(unit * errors[k]);
  }
  const bool has_times = !evaluation.pairs.stamps_ns.empty();
  return {.name = label,
          .x_label = has_times ? "time [s]" : "pose",
          .y_label = label,
          .series = {std::move(series)}};
}

std::vector<std::string> facts_of(const Evaluation& evaluation, const std::string& truth) {
  const TrajectoryPairs& pairs = evaluation.pairs;
  std::vector<std::string> facts = {
      "truth: " + truth, fmt::format("{} poses, {} of them paired with {}", evaluation.estimate_poses,
                                     pairs.truth.size(), evaluation.truth_poses)};
  if (pairs.repeated > 0)
    facts.push_back(fmt::format("{} pairs share a pose with the pair before", pairs.repeated));
  facts.push_back("aligned: " + text_of(evaluation.align));
  if (evaluation.plane) facts.push_back("in the plane " + text_of(*evaluation.plane));
  if (evaluation.alignment.scale != 1.0)
    facts.push_back(fmt::format("the estimate scaled by {:.6g}", evaluation.alignment.scale));
  facts.push_back(fmt::format("{:.6g} m driven", path_lengths_m(pairs.truth).back()));
  facts.push_back(fmt::format("stereobench {}", STEREOBENCH_VERSION));
  return facts;
}

}  // namespace

Page evaluation_page(const Evaluation& evaluation, const std::string& estimate, const std::string& truth,
                     std::span<const Gate> gates, std::span<const std::string> words) {
  const PoseErrors& absolute = evaluation.absolute;
  const PathView view = path_view(evaluation);
  Page page{.title = estimate + ": a trajectory's errors", .facts = facts_of(evaluation, truth)};
  page.blocks = {gates_block(gates, evaluation_json(evaluation, estimate, truth)), errors_block(evaluation)};
  if (Block segments = segments_block(evaluation.segments);
      !std::get<PageTable>(segments.content).rows.empty())
    page.blocks.push_back(std::move(segments));
  page.blocks.push_back(
      {.title = "Absolute error over time",
       .note = "",
       .content =
           PageCharts{{error_chart(evaluation, "position error [m]", absolute.translation_m, 1.0),
                       error_chart(evaluation, "rotation error [deg]", absolute.rotation_rad, kDegrees)}}});
  page.blocks.push_back(
      {.title = "Map",
       .note = fmt::format("Thick: the true path. Line: the estimate, aligned. {} to the right, {} upwards.",
                           view.to_the_right, view.upwards),
       .content = map_of_paths(times_of(evaluation.pairs), view, "estimate")});
  if (!words.empty())
    for (Block& block : page.blocks) block.commands = {shell_line(words)};
  return page;
}

}  // namespace stereobench::harness
