/// Detectors in Python: what they are shown, and what they answer.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "harness/detector/ball_geometry.h"
#include "harness/detector/detector.h"

namespace stereobench::harness::bindings {

/// A frame as a detector may see it: nothing of the truth.
struct PyFrame {
  std::size_t step = 0;
  std::int64_t stamp_ns = 0;
  vision::StereoPair pair;  ///< empty pictures where the frame is lost
  pybind11::object setup;   ///< dict, as a detector's program is told it
};

/// What a detector's program is told first, as a dict.
pybind11::object setup_dict(const DetectorSetup& setup);

/// A list of dicts as detectors answer it, read as the line of a detector's program is.
/// @throws DetectorFault "detector: frame 3: balls[0]...: expected ..."
std::vector<vision::BallObservation> balls_of(const pybind11::object& balls, std::size_t frame,
                                              const DetectorSetup& setup);

/// The reverse.
pybind11::object dicts_of(const std::vector<vision::BallObservation>& balls, std::size_t frame);

/// Lets `--detector NAME` mean a callable of Python. It takes the interpreter's lock for each call.
/// @param callable is given a Frame, and returns a list of dicts
/// @throws std::invalid_argument for a name that is taken
void register_callable(const std::string& name, const pybind11::function& callable);

}  // namespace stereobench::harness::bindings
