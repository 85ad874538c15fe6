/// Causes that geometric faults are known to have: each is a change of what a data set claims after which its
/// parts agree.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "harness/verify/geometry/link.h"

namespace stereobench::harness {

/// Which file is at fault where a hypothesis holds.
enum class Suspect { kCalibration, kPoses, kDepth, kPicture };

struct Hypothesis {
  Suspect suspect = Suspect::kCalibration;
  /// What is wrong. Of a hypothesis with an amount, {} stands for it.
  std::string cause;
  /// Undoes the fault. @param amount found by `fit`; without meaning where there is none
  std::function<void(Claims& claims, double amount)> undo;
  /// Whose poses it can be wrong in.
  std::set<PosesOf> poses_of = {PosesOf::kBody, PosesOf::kLeftCamera, PosesOf::kEachCamera};
  bool has_amount = false;
  double first_step = 0.0;   ///< of the search for the amount
  double least = 0.0;        ///< a smaller amount is no fault: what a calibration by pictures may be off
  const char* unit = "";     ///< of the amount in messages
  double shown_scale = 1.0;  ///< messages show the amount times this
};

/// All, the ones without an amount first: what explains as much is named in this order.
std::vector<Hypothesis> known_hypotheses();

}  // namespace stereobench::harness
