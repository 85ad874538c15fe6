/// What changed from one result to another, as a page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/page/page.h"
#include "harness/regression/detection_changes.h"
#include "harness/regression/result_folder.h"
#include "harness/regression/verdict_report.h"

namespace stereobench::harness {

/// Two results and what was found between them. All that it refers to must outlive it.
struct ComparisonStory {
  ComparedNames names;
  const StoredResult& first;
  const StoredResult& second;
  const ResultComparison& comparison;
  const VerdictSettings& settings;
  std::optional<DetectionChanges> changes;     ///< none where one of them has no table of detections
  std::vector<std::string> words = {};         ///< of the command line; empty: none is shown
  std::optional<DetectedBalls> findings = {};  ///< of the first, where it has them in place of a table
};

/// Verdicts, changes seed by seed, what changed detections have in common, errors against range and noise,
/// and the frames that changed most, before and after side by side. Pictures come from frames/ beside the
/// tables of detections; where one result alone has kept a pair, its picture stands for both.
/// @throws std::runtime_error for a table of detections or a calibration that cannot be read
std::vector<Block> comparison_blocks(const ComparisonStory& story);

/// A page of one comparison.
Page comparison_page(const ComparisonStory& story);

/// A comparison among others, e.g. a case of a suite.
struct ComparedCase {
  std::string name;
  std::string verdict;  ///< e.g. the worst of its metrics
  CellMark mark = CellMark::kNone;
  std::string says;    ///< one line
  std::string reason;  ///< one line: which detections changed; empty where none did
  std::vector<Block> blocks;
};

/// A page of many comparisons: a table of them that links to each, then the blocks of each below its name.
Page cases_page(const std::string& title, const std::vector<std::string>& facts,
                std::vector<ComparedCase> cases);

/// How a verdict is coloured.
CellMark mark_of(Verdict verdict);

}  // namespace stereobench::harness
