#include "harness/trajectories/evaluation.h"

#include <array>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/json/json_numbers.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchema = 1;

Json statistics_json(const std::vector<double>& errors) {
  const ErrorStatistics s = statistics_of(errors);
  return {{"rmse", number(s.rmse)}, {"mean", number(s.mean)}, {"median", number(s.median)},
          {"sd", number(s.sd)},     {"min", number(s.min)},   {"max", number(s.max)},
          {"sse", number(s.sse)}};
}

Json errors_json(const PoseErrors& errors) {
  return {{"translation_m", statistics_json(errors.translation_m)},
          {"rotation_rad", statistics_json(errors.rotation_rad)}};
}

Json alignment_json(const Evaluation& evaluation) {
  const auto& [rotation, translation_m, scale] = evaluation.alignment;
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < 3; ++i) rows.push_back({rotation(i, 0), rotation(i, 1), rotation(i, 2)});
  return {{"kind", text_of(evaluation.align)},
          {"plane", evaluation.plane ? Json(text_of(*evaluation.plane)) : Json(nullptr)},
          {"scale", scale},
          {"rotation", rows},
          {"translation_m", {translation_m.x(), translation_m.y(), translation_m.z()}}};
}

Json segment_json(const SegmentErrors& segment) {
  return {{"count", segment.count},
          {"translation_percent", number(segment.translation_percent)},
          {"rotation_deg_per_m", number(segment.rotation_deg_per_m)}};
}

Json segments_json(const std::vector<SegmentErrors>& segments) {
  Json json = Json::object();
  for (const SegmentErrors& segment : segments)
    json[segment.length_m > 0.0 ? fmt::format("{}m", segment.length_m) : "all"] = segment_json(segment);
  return json;
}

std::vector<std::string> row_of(const std::string& what, const std::vector<double>& errors, double unit) {
  const ErrorStatistics s = statistics_of(errors);
  std::vector<std::string> row{what, std::to_string(errors.size())};
  for (const double value : {s.rmse, s.mean, s.median, s.sd, s.min, s.max})
    row.push_back(format_number(unit * value, 4));
  return row;
}

std::string segment_table(const std::vector<SegmentErrors>& segments) {
  AlignedTable table{{"pieces of", "number", "translation [%]", "rotation [deg/m]"}, {}};
  for (const SegmentErrors& segment : segments)
    if (segment.count > 0)
      table.rows.push_back({segment.length_m > 0.0 ? fmt::format("{} m", segment.length_m) : "all",
                            std::to_string(segment.count), format_number(segment.translation_percent, 4),
                            format_number(segment.rotation_deg_per_m, 4)});
  return table.rows.empty() ? "" : "\n" + plain_text(table);
}

}  // namespace

Evaluation evaluate(const Trajectory& estimate, const Trajectory& truth, const EvaluationRules& rules) {
  TrajectoryPairs pairs = pair_trajectories(estimate, truth, rules.pairing);
  const AlignmentKind kind =
      rules.align.value_or(pairs.is_planar ? AlignmentKind::kSe2 : AlignmentKind::kSe3);
  std::optional<Plane> plane = rules.plane;
  if (plane && !is_in_plane(kind))
    throw std::runtime_error("--plane: expected --align se2 or sim2 beside it");
  if (is_in_plane(kind) && !plane) plane = Plane::kXy;
  if (pairs.is_planar && plane && *plane != Plane::kXy)
    throw std::runtime_error("--plane: a file has x, y and a heading alone; expected xy");
  if (plane) pairs = in_plane(std::move(pairs), *plane);
  const Alignment alignment = align(pairs, kind);
  pairs.estimate = aligned(pairs.estimate, alignment);
  Evaluation evaluation{.estimate_poses = estimate.poses.size(),
                        .truth_poses = truth.poses.size(),
                        .pairing = rules.pairing,
                        .align = kind,
                        .plane = plane,
                        .alignment = alignment,
                        .absolute = absolute_errors(pairs),
                        .delta = rules.delta,
                        .relative = relative_errors(pairs, rules.delta),
                        .segments = segment_errors(pairs, rules.segments_m)};
  evaluation.pairs = std::move(pairs);
  return evaluation;
}

std::string text_of(AlignmentKind kind) {
  constexpr std::array kNames = {"none", "origin", "se2", "sim2", "se3", "sim3"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string text_of(Plane plane) {
  return plane == Plane::kXy ? "xy" : plane == Plane::kXz ? "xz" : "yz";
}

Json evaluation_json(const Evaluation& evaluation, const std::string& estimate, const std::string& truth) {
  const TrajectoryPairs& pairs = evaluation.pairs;
  const bool timed = !pairs.stamps_ns.empty();
  Json relative = {{"delta", text_of(evaluation.delta)},
                   {"all_pairs", evaluation.delta.all_pairs},
                   {"count", evaluation.relative.translation_m.size()}};
  relative.update(errors_json(evaluation.relative));
  return {{"schema", kSchema},
          {"estimate", estimate},
          {"truth", truth},
          {"estimate_poses", evaluation.estimate_poses},
          {"truth_poses", evaluation.truth_poses},
          {"pairs", pairs.truth.size()},
          {"repeated_pairs", pairs.repeated},
          {"most_dt_s", timed ? Json(evaluation.pairing.most_dt_s) : Json(nullptr)},
          {"offset_s", timed ? Json(evaluation.pairing.offset_s) : Json(nullptr)},
          {"duration_s", timed ? Json(times_of(pairs).back()) : Json(nullptr)},
          {"path_length_m", path_lengths_m(pairs.truth).back()},
          {"alignment", alignment_json(evaluation)},
          {"ape", errors_json(evaluation.absolute)},
          {"rpe", relative},
          {"segments", segments_json(evaluation.segments)}};
}

std::string errors_csv(const Evaluation& evaluation) {
  std::string csv = evaluation.pairs.stamps_ns.empty() ? "pose" : "time_s";
  csv += ",translation_m,rotation_rad\n";
  const std::vector<double> times = times_of(evaluation.pairs);
  for (std::size_t i = 0; i < evaluation.pairs.truth.size(); ++i)
    csv += fmt::format("{},{},{}\n", times[i], evaluation.absolute.translation_m[i],
                       evaluation.absolute.rotation_rad[i]);
  return csv;
}

std::string evaluation_table(const Evaluation& evaluation) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  AlignedTable table{{"error", "number", "rmse", "mean", "median", "sd", "min", "max"}, {}};
  table.rows.push_back(row_of("APE, translation [m]", evaluation.absolute.translation_m, 1.0));
  table.rows.push_back(row_of("APE, rotation [deg]", evaluation.absolute.rotation_rad, kDegrees));
  const std::string over = span_text(evaluation.delta);
  table.rows.push_back(
      row_of(fmt::format("RPE over {}, translation [m]", over), evaluation.relative.translation_m, 1.0));
  table.rows.push_back(
      row_of(fmt::format("RPE over {}, rotation [deg]", over), evaluation.relative.rotation_rad, kDegrees));
  return plain_text(table) + segment_table(evaluation.segments);
}

}  // namespace stereobench::harness
