#include "harness/regression/judgement.h"

#include <algorithm>

namespace stereobench::harness {
namespace {

bool is_worse(const ResultComparison& comparison, const std::string& metric) {
  return std::ranges::any_of(comparison.metrics, [&](const MetricVerdict& judged) {
    return judged.metric == metric && judged.verdict == Verdict::kRegressed;
  });
}

}  // namespace

std::string detection_lines(const Judgement& judgement, const std::string& result) {
  return judgement.changes ? judgement.detections + replay_line(*judgement.changes, result) : "";
}

Judgement judge(const SeedTable& first, const SeedTable& second, const VerdictSettings& settings,
                const std::optional<PairedBalls>& balls) {
  Judgement judgement;
  if (balls) judgement.changes = detection_changes(*balls);
  judgement.comparison = compare_results(first, second, settings,
                                         judgement.changes ? counts_of(*judgement.changes) : PairedCounts{});
  if (judgement.changes)
    judgement.detections =
        changes_text(*judgement.changes, is_worse(judgement.comparison, "vision.range_rms_m"));
  return judgement;
}

}  // namespace stereobench::harness
