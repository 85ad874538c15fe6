/// What became of a case of a suite.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "harness/regression/judgement.h"
#include "harness/suite/baseline.h"

namespace stereobench::harness {

/// The worst that is so of a case, worst first.
enum class CaseState {
  kError,           ///< it broke down, and has no result
  kRegressed,       ///< a metric got worse or vanished
  kGateBroken,      ///< a metric is beyond its limit
  kPictureChanged,  ///< a golden picture is not as it was
  kNoBaseline,      ///< there is nothing to compare with
  kInconclusive,    ///< more seeds are needed
  kImproved,        ///< a metric got better
  kPassed,
};

/// "REGRESSED" and so on, as tables and files have it.
const char* text_of(CaseState state);

/// A look at the first seeds of a case.
struct LookRecord {
  std::size_t seeds = 0;
  double alpha = 0.0;  ///< that this look had
  long inconclusive = 0;
};

/// A golden picture, held against that of the baseline.
struct PictureRecord {
  std::string name;
  bool is_as_before = true;
  std::string text;  ///< one line: what changed
};

struct CaseReport {
  std::string name;
  BaselineInputs inputs;
  std::string error;         ///< one line: why it broke down; empty where it did not
  std::string partial;       ///< one line: what the suite asks for and this is not; empty where it is all
  std::string not_compared;  ///< one line: why nothing was compared, and what to do; empty where it was
  std::string measured;      ///< one line: what the detector found
  std::size_t gates = 0;
  std::vector<std::string> broken_gates;  ///< a line each
  std::vector<LookRecord> looks;          ///< where seeds came by steps
  std::vector<PictureRecord> pictures;
  VerdictSettings settings;  ///< of the last look
  std::optional<Judgement> judgement;
};

CaseState state_of(const CaseReport& report);

}  // namespace stereobench::harness
