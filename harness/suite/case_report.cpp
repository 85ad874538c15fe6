#include "harness/suite/case_report.h"

#include <algorithm>

namespace stereobench::harness {

const char* text_of(CaseState state) {
  switch (state) {
    case CaseState::kError:
      return "ERROR";
    case CaseState::kRegressed:
      return "REGRESSED";
    case CaseState::kGateBroken:
      return "GATE BROKEN";
    case CaseState::kPictureChanged:
      return "PICTURE CHANGED";
    case CaseState::kNoBaseline:
      return "NO BASELINE";
    case CaseState::kInconclusive:
      return "INCONCLUSIVE";
    case CaseState::kImproved:
      return "IMPROVED";
    case CaseState::kPassed:
      break;
  }
  return "PASS";
}

CaseState state_of(const CaseReport& report) {
  if (!report.error.empty()) return CaseState::kError;
  const auto has = [&](Verdict verdict) {
    return report.judgement && report.judgement->comparison.has(verdict);
  };
  if (has(Verdict::kRegressed) || has(Verdict::kVanished)) return CaseState::kRegressed;
  if (!report.broken_gates.empty()) return CaseState::kGateBroken;
  if (std::ranges::count(report.pictures, false, &PictureRecord::is_as_before) > 0)
    return CaseState::kPictureChanged;
  if (!report.judgement) return CaseState::kNoBaseline;
  if (has(Verdict::kInconclusive)) return CaseState::kInconclusive;
  return has(Verdict::kImproved) ? CaseState::kImproved : CaseState::kPassed;
}

}  // namespace stereobench::harness
