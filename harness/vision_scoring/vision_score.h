/// How well balls were found in a stereo pair, against the renderer's truth.
#pragma once

#include <vector>

#include "harness/vision_scoring/frame_match.h"
#include "harness/vision_scoring/rig_check.h"

namespace stereobench::harness {

/// What became of the balls of some pairs. Scores of any pairs can be merged, in any order.
struct VisionScore {
  long visible = 0;                    ///< balls that had to be found, see judge_detections
  long found = 0;                      ///< of these, the ones that were
  long observations = 0;               ///< those that are to be trusted
  long right = 0;                      ///< of these, the first of each ball, with the ball's colour
  long misidentified = 0;              ///< of these, the ones on a ball of another colour
  long spurious = 0;                   ///< of these, the ones on no ball
  long repeated = 0;                   ///< of these, the ones on a ball that is observed already
  long flagged = 0;                    ///< observations that are not to be trusted, which are not scored
  std::vector<double> range_errors_m;  ///< of the right ones, measured minus true, horizontal
  std::vector<double> bearing_errors_rad;
  std::vector<double> disparity_errors_px;
  std::vector<double> normalised_errors;  ///< e' R^-1 e / 2 with the covariance that SLAM is told

  RigCheck rig;  ///< what the observations tell of the rig; filled by who knows what it is believed to be

  double recall() const;       ///< found / visible; NaN when nothing was visible
  double precision() const;    ///< right / observations; NaN when there is none
  double range_rms_m() const;  ///< NaN when there is none, and so below
  double bearing_rms_rad() const;
  double disparity_rms_px() const;
  double range_bias_m() const;  ///< the mean error, measured minus true
  double bearing_bias_rad() const;
  double disparity_bias_px() const;
  double mean_normalised_error() const;  ///< 1 when the covariance is consistent

  VisionScore& operator+=(const VisionScore& other);
};

/// Scores the observations of one pair, judged by judge_detections().
VisionScore score_match(const FrameMatch& match);

/// Measured minus true, of one ball.
struct DetectionError {
  double range_m = 0.0;
  double bearing_rad = 0.0;  ///< in (-pi, pi]
  double normalised = 0.0;   ///< squared error in units of the stated covariance, over 2; 1 on average
};

/// @param undistorted of a MatchedObservation
DetectionError detection_error(const BallInPair& ball, const vision::BallObservation& undistorted);

/// Measured minus true. @param undistorted of a MatchedObservation @return NaN for one without pixels
double disparity_error_px(const BallInPair& ball, const vision::BallObservation& undistorted);

}  // namespace stereobench::harness
