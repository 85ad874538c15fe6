/// The page of a run: report.html.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/page/page.h"
#include "harness/regression/gates.h"
#include "harness/result_pages/detection_row.h"
#include "harness/run/run_curves.h"
#include "harness/run/run_result.h"
#include "vision/types.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// The name of a page beside a result.
inline constexpr const char* kReport = "report.html";

/// Words of the command lines that make a result again.
struct ReportCommands {
  std::vector<std::string> result;  ///< all but seeds; empty: no command line is shown
  std::vector<std::string> render;  ///< the same of `render`, for single pairs; empty: nothing renders
};

/// What is told of a run beside what it gave.
struct RunStory {
  ReportCommands commands;
  std::vector<Gate> gates;
  std::vector<worlds::Wall> walls;
  vision::StereoRig rig;  ///< the true one; without meaning for a run without pictures
};

/// @param detections of the run; empty where it has no pictures
/// @param json run_json() of the result, which gates name numbers of
Page run_page(const RunResult& result, const RunCurves& curves, const RunStory& story,
              const std::vector<DetectionRow>& detections, const nlohmann::ordered_json& json);

/// Writes report.html, and the worst stereo pairs into frames/.
/// @param out folder of the result, with its detections
/// @throws std::runtime_error when a file cannot be written
void write_run_report(const std::filesystem::path& out, const RunResult& result, const RunCurves& curves,
                      const RunStory& story);

}  // namespace stereobench::harness
