/// A map to look at: where the robot drove, where the filters believe it drove, and the landmarks.
#pragma once

#include <string>
#include <vector>

#include "harness/report/axes.h"
#include "harness/types.h"
#include "slam/types.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// What one filter believes: the path as it was estimated step by step, and the final map.
struct MapEstimate {
  std::string filter;
  std::vector<slam::Pose> path;
  std::vector<slam::LandmarkEstimate> landmarks;
};

struct MapPicture {
  std::string title;
  std::vector<worlds::Wall> walls;
  std::vector<slam::Pose> true_path;     ///< empty when the truth is not known
  std::vector<LandmarkTruth> landmarks;  ///< discs in their ball's colour, crosses when it has none
  std::vector<MapEstimate> estimates;    ///< dead reckoning among them, by its name
  std::string to_the_right = "x";        ///< what its axes are called
  std::string upwards = "y";
};

/// A sheet of paper for a map and where metres lie on it.
struct MapSheet {
  int width_px = 0;
  int height_px = 0;
  Axes axes;
};

/// Chooses a sheet on which all of the map can be seen, both axes to one scale; covariances do not count.
MapSheet lay_out_map(const MapPicture& picture);

/// Draws the map in metres, east to the right, both axes to one scale; 95 % ellipses about estimated
/// landmarks.
/// @return the bytes of a PNG file; what is not finite is left out, nothing at all gives empty axes
std::string draw_map_picture(const MapPicture& picture);

}  // namespace stereobench::harness
