/// What a detector answered on a drive: all that the stages behind it need of the pictures. A study that
/// varies only those stages renders once.
#pragma once

#include <cstddef>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "harness/drive/recording.h"
#include "harness/vision_scoring/ball_outline.h"

namespace stereobench::harness {

/// A pair's answer, and where the balls were.
struct SeenFrame {
  std::size_t step = 0;
  std::vector<BallInPair> outlines;                   ///< see ball_outlines
  std::vector<vision::BallObservation> observations;  ///< as the detector gave them, without its faults
};

/// The answers to a drive's pairs, in order of time; frames that were lost have none.
struct SeenDrive {
  std::string detector;  ///< see Recording
  CoarseBlur blur;
  std::vector<SeenFrame> frames;
  Timing timing;
};

/// Renders a drive once, and shows each pair to the detectors of several experiments.
/// @param experiments at least one, of sensors with pixels; see record_together for what they have in common.
/// Their detector_noise and perfect_detections are left out
/// @param on_progress told of the fraction done, in [0, 1]
/// @return one an experiment
/// @throws std::runtime_error as record_together; DetectorFault when a program does not do what it should
std::vector<SeenDrive> see_together(const std::vector<const Experiment*>& experiments,
                                    const StreamSeeds& seeds, renderer::Backend backend,
                                    const std::function<void(double)>& on_progress);

/// What record() would give, without its timing, from what was seen on the drive.
/// @param experiment with the pictures and the detector that `seen` is of; the rest may differ
/// @param seeds whose world and sensor are those of `seen`
Recording recording_of(const Experiment& experiment, const StreamSeeds& seeds, const SeenDrive& seen);

/// As bytes (CBOR), exact to the last bit.
std::string to_bytes(const SeenDrive& seen);

/// What to_bytes made bytes of.
SeenDrive seen_drive_from_bytes(std::string_view bytes);

}  // namespace stereobench::harness
