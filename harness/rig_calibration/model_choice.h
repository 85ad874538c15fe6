/// How much of a camera has to be in a rig's model: what the views decide.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "harness/rig_calibration/rig_fit.h"

namespace stereobench::harness {

/// A model whose p-value is lower is rejected.
constexpr double kRejected = 0.001;

/// What a model may do without: the models with and without each are compared.
struct Compared {
  bool aspect = true;  ///< pixels that are not square
  bool k3 = true;      ///< a lens's third radial coefficient
};

/// A model that was tried.
struct ModelTrial {
  std::string name;     ///< e.g. "fx, fy, k1 k2 p1 p2"
  std::string refused;  ///< why it cannot be had of these views; empty when it can
  double rms_px = std::numeric_limits<double>::quiet_NaN();
  double f = std::numeric_limits<double>::quiet_NaN();  ///< against the fullest model; NaN for that one
  double p = std::numeric_limits<double>::quiet_NaN();
  double aspect_sd = 0.0;  ///< of the less known camera; 0 where it was not fitted
  bool taken = false;
};

/// The model that was taken, and all that were tried, the simplest first.
struct ModelChoice {
  RigFit fit;
  std::vector<ModelTrial> trials;
};

/// The settings with all that is compared.
RigFitSettings fullest(RigFitSettings settings, const Compared& compared);

/// Takes the simplest model that explains the corners as well as the fullest does: the first, by its number
/// of parameters and then its residuals, that an F test at kRejected does not reject:
///     F = (S - S_full) / (m - m_full) / (c S_full / m_full),
/// S sums of squares, m degrees of freedom, and c how much the errors of a view hang together
/// (RigFit::clustering), since those of real boards do. Models whose lens folds the picture are not taken.
/// @param settings of the simplest model
/// @throws std::runtime_error, of the simplest model, where none can be had
ModelChoice choose_model(const std::vector<BoardView>& views, const RigFitSettings& settings,
                         const Compared& compared);

}  // namespace stereobench::harness
