/// The cameras of a recording.
#pragma once

#include <array>
#include <optional>

#include "harness/verify/readers/recording/recorded_topics.h"

namespace stereobench::harness {

struct RecordedCameras {
  std::array<ViewCamera, 2> cameras;
  bool are_on_body = false;  ///< transforms lead from the body to them; else the left camera is the body
};

/// Takes lenses from camera_info, and places from /tf_static, or where that does not lead to the cameras from
/// the projection of camera_info. What these say twice and differently is a fault.
/// @param frames the cameras' frames
/// @param cannot is told why there is no calibration
/// @return empty where nothing says how the cameras see, or where they are
std::optional<RecordedCameras> recorded_cameras(OpenRecording& from, const std::array<std::string, 2>& frames,
                                                std::vector<std::string>& cannot);

}  // namespace stereobench::harness
