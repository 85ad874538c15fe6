#include "harness/rig_calibration/calibration_report.h"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/io/text_table.h"
#include "harness/json/json_numbers.h"
#include "harness/rig_calibration/calibration_warnings.h"
#include "slam/math/angles.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, kCameraSize> kParameterNames = {
    "focal_px", "cx_px", "cy_px", "k1", "k2", "p1", "p2", "k3", "pixel_aspect"};
constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};

/// A parameter, its standard deviation, and where it is told.
struct Entry {
  std::string name;
  double value;
  double sd;
};

std::vector<Entry> camera_entries(const RigFit& fit, std::size_t side) {
  std::vector<Entry> entries;
  for (int i = 0; i < kCameraSize; ++i)
    entries.push_back(
        {kParameterNames[static_cast<std::size_t>(i)], fit.cameras[side][i], fit.cameras_sd[side][i]});
  return entries;
}

std::vector<Entry> offset_entries(const RigFit& fit) {
  std::vector<Entry> entries;
  for (int i = 0; i < 3; ++i)
    entries.push_back({fmt::format("right_eye_{}_m", kAxes[static_cast<std::size_t>(i)]),
                       fit.right_in_left_m[i], fit.right_in_left_sd_m[i]});
  for (int i = 0; i < 3; ++i)
    entries.push_back({fmt::format("turn_{}_deg", kAxes[static_cast<std::size_t>(i)]),
                       fit.turn_rad[i] * slam::kDegreesPerRad, fit.turn_sd_rad[i] * slam::kDegreesPerRad});
  return entries;
}

std::string value_with_sd(const Entry& entry) {
  return entry.sd > 0.0 ? format_with_sd(entry.value, entry.sd) : fmt::format("{:g}", entry.value);
}

Json json_of(const std::vector<Entry>& entries) {
  Json json;
  for (const Entry& entry : entries)
    json[entry.name] = {{"value", number(entry.value)}, {"sd", number(entry.sd)}};
  return json;
}

AlignedTable views_table(const BoardCalibration& calibration) {
  AlignedTable table{{"view", "left rms px", "right rms px", "row rms px", "row max px"}, {}};
  for (const ViewOutcome& view : calibration.outcomes) {
    if (!view.dropped.empty()) continue;
    const auto& rms = calibration.fit.view_rms_px[view.index];
    table.rows.push_back({view.name, fmt::format("{:.3f}", rms[0]), fmt::format("{:.3f}", rms[1]),
                          fmt::format("{:.3f}", view.row_rms_px), fmt::format("{:.3f}", view.row_worst_px)});
  }
  return table;
}

std::string verdict_of(const ModelTrial& trial) {
  if (!trial.refused.empty()) return "refused";
  return trial.taken ? "taken" : trial.p < kRejected ? "rejected" : "";
}

/// The models that were compared: how far off each leaves the corners, and how it stands up to the fullest.
AlignedTable models_table(const std::vector<ModelTrial>& trials) {
  AlignedTable table{{"model", "rms px", "F", "p", ""}, {}};
  for (const ModelTrial& trial : trials) {
    const bool tested = trial.refused.empty() && std::isfinite(trial.p);
    table.rows.push_back({trial.name, trial.refused.empty() ? fmt::format("{:.3f}", trial.rms_px) : "",
                          tested ? fmt::format("{:.3g}", trial.f) : "",
                          tested ? fmt::format("{:.2g}", trial.p) : "", verdict_of(trial)});
  }
  return table;
}

Json models_json(const std::vector<ModelTrial>& trials) {
  Json list = Json::array();
  for (const ModelTrial& trial : trials) {
    Json entry = {{"model", trial.name}, {"taken", trial.taken}};
    if (trial.refused.empty()) {
      entry["rms_px"] = number(trial.rms_px);
      entry["f"] = number(trial.f);
      entry["p"] = number(trial.p);
    } else {
      entry["refused"] = trial.refused;
    }
    list.push_back(entry);
  }
  return list;
}

AlignedTable parameters_table(const RigFit& fit) {
  AlignedTable table{{"", "left", "right"}, {}};
  const auto left = camera_entries(fit, 0);
  const auto right = camera_entries(fit, 1);
  for (std::size_t i = 0; i < left.size(); ++i)
    table.rows.push_back({left[i].name, value_with_sd(left[i]), value_with_sd(right[i])});
  for (const Entry& entry : offset_entries(fit)) table.rows.push_back({entry.name, "", value_with_sd(entry)});
  return table;
}

}  // namespace

std::string calibration_text(const BoardCalibration& calibration, const BoardSettings& settings) {
  const RigFit& fit = calibration.fit;
  std::string text = plain_text(views_table(calibration)) + "\n";
  for (const ViewOutcome& view : calibration.outcomes)
    if (!view.dropped.empty()) text += fmt::format("dropped {}: {}\n", view.name, view.dropped);
  if (calibration.models.size() > 1) text += plain_text(models_table(calibration.models)) + "\n";
  for (const ModelTrial& trial : calibration.models)
    if (!trial.refused.empty()) text += fmt::format("refused {}: {}\n", trial.name, trial.refused);
  text += plain_text(parameters_table(fit)) + "\n";
  text += fmt::format("{} of {} views, {} corners each: rms {:.3f} px, a corner's coordinate {:.3f} px\n",
                      calibration.used.size(), calibration.outcomes.size(), settings.board.corners(),
                      fit.rms_px, fit.corner_sd_px);
  text += fmt::format("rows once rectified: rms {:.3f} px, mean {:.3f} px; baseline {:.5g} m\n",
                      calibration.row_rms_px, calibration.row_mean_px, calibration.rig.rig.baseline_m);
  text += fmt::format("squares of {:g} m measured by the rig: mean {:.6g} m, rms error {:.2g} m\n",
                      settings.board.square_m, calibration.square_mean_m, calibration.square_rms_m);
  return text;
}

std::string calibration_json(const BoardCalibration& calibration, const BoardSettings& settings) {
  const RigFit& fit = calibration.fit;
  Json json;
  json["board"] = {{"columns", settings.board.columns},
                   {"rows", settings.board.rows},
                   {"square_m", settings.board.square_m}};
  json["model"] = settings.model == RigModel::kTwoCameras ? "two" : "one";
  json["models"] = models_json(calibration.models);
  json["warnings"] = warnings_of(calibration, settings);
  json["rms_px"] = number(fit.rms_px);
  json["corner_sd_px"] = number(fit.corner_sd_px);
  json["neighbour_sd_px"] = number(fit.neighbour_sd_px);
  json["clustering"] = number(fit.clustering);
  json["row_rms_px"] = number(calibration.row_rms_px);
  json["row_mean_px"] = number(calibration.row_mean_px);
  json["square_mean_m"] = number(calibration.square_mean_m);
  json["square_rms_m"] = number(calibration.square_rms_m);
  json["baseline_m"] = number(calibration.rig.rig.baseline_m);
  json["left"] = json_of(camera_entries(fit, 0));
  json["right"] = json_of(camera_entries(fit, 1));
  json["left_from_right"] = json_of(offset_entries(fit));
  json["views"] = Json::array();
  for (const ViewOutcome& view : calibration.outcomes) {
    Json entry = {{"name", view.name}, {"used", view.dropped.empty()}};
    if (view.dropped.empty()) {
      entry["left_rms_px"] = number(fit.view_rms_px[view.index][0]);
      entry["right_rms_px"] = number(fit.view_rms_px[view.index][1]);
      entry["row_rms_px"] = number(view.row_rms_px);
      entry["row_worst_px"] = number(view.row_worst_px);
    } else {
      entry["dropped"] = view.dropped;
    }
    json["views"].push_back(entry);
  }
  return json.dump(2) + "\n";
}

}  // namespace stereobench::harness
