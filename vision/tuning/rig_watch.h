/// What a rig may be off by, and how that is told.
#pragma once

#include <cstddef>

namespace stereobench::vision {

/// What is believed of a rig by all pairs so far.
struct RigWatchTuning {
  /// Standard deviation of a turn of the right camera about an axis: 0.6 degrees.
  double usual_turn_rad = 0.0105;
  /// The same of the baseline, of itself.
  double usual_baseline = 0.04;
  /// Least evidence for a fault: chi-square with two degrees of freedom, one in 250,000 by chance. Faults are
  /// tested in every pair, and a false one makes all balls worse.
  double by_chance = 25.0;
  /// Least fault that is corrected, px: beside what outlines are off by, less is all but nothing.
  double matters_px = 0.05;
  /// Disparity at which an error of the baseline is taken for pixels.
  double usual_disparity_px = 40.0;
  /// Fewest balls whose sizes say that it is the rig, not they.
  long fewest_sizes = 2;
};
inline constexpr RigWatchTuning kRigWatch{};

/// How a pair is matched while the rig's faults are being learned.
struct RigMatchTuning {
  /// Difference of rows above which one ball alone tells of a fault: outlines of a rectified rig have less.
  double rows_apart_px = 0.5;
  /// How often one ball is counted on to be seen, with the same error of its size each time.
  double seen_times = 6.0;
  /// Most matches of a pair by a belief that changes.
  int most_matches = 3;
  /// Change of a belief that ends them, rad and relative: rows move by 0.02 px at f = 1000 px.
  double same_fault = 2e-5;
};
inline constexpr RigMatchTuning kRigMatch{};

/// The search for a turn where most outlines have no partner.
struct RigSearchTuning {
  /// Difference of the radii of one ball's outlines, of the larger one, and px.
  double same_size = 0.1;
  double same_size_px = 0.5;
  /// Error of a disparity by size, of itself: a wrong baseline, and a size that is known to a tenth.
  double disparity = 0.1;
  /// Turn about y within which partners are looked for: 0.65 degrees. It moves columns by so much of the
  /// focal length.
  double turn_about_y_rad = 0.0113;
  /// What a turn explains of rows, px: a turn about y moves them by so much in the corners.
  double common_trend_px = 2.0;
  /// Most pairs of outlines that are tried: bounds the work, 1770 pairs of them.
  std::size_t most_candidates = 60;
};
inline constexpr RigSearchTuning kRigSearch{};

}  // namespace stereobench::vision
