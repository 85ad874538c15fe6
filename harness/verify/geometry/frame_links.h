/// The links of one frame: what its files and pictures say of points that other places speak of, too.
#pragma once

#include <array>
#include <vector>

#include "harness/verify/geometry/link.h"

namespace stereobench::harness {

/// The channels of a frame that could be read. Arrays are by vision::Side; empty where there is none.
struct LoadedFrame {
  std::size_t index = 0;
  std::array<cv::Mat, 2> picture, disparity_px, depth_m, flow_px, ball_id, next_picture;
  cv::Mat next_disparity_px;
};

/// A frame and its neighbours; null where there is none.
struct Neighbourhood {
  const LoadedFrame* before = nullptr;
  const LoadedFrame* now = nullptr;
  const LoadedFrame* after = nullptr;
};

/// What files say of each other.
/// @param most links of each kind
void add_file_links(const DatasetView& view, const Neighbourhood& frames, std::size_t most,
                    std::vector<Link>& links);

/// What pictures show of what files say: corners of the left picture are searched in the right one and in the
/// next frame's.
/// @param most corners
void add_picture_links(const DatasetView& view, const Neighbourhood& frames, std::size_t most,
                       std::vector<Link>& links);

/// A point's depth, or place in the other camera's picture, at the pixel of a frame and its neighbours.
void set_source(const Neighbourhood& frames, vision::Side side, const Eigen::Vector2d& pixel_px, Link& link);

}  // namespace stereobench::harness
