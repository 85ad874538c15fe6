/// The checks of a data set: each takes values and gives faults.
#pragma once

#include <vector>

#include "harness/verify/geometry/frame_links.h"

namespace stereobench::harness {

/// What the files of a data set sum up to.
struct ChecksumResult {
  std::vector<Fault> faults;
  std::size_t files = 0;            ///< that were compared
  std::vector<std::string> cannot;  ///< lists that are not there
};

/// Files against manifest-sha256.txt (BagIt, RFC 8493), where there is one.
ChecksumResult check_checksums(const std::filesystem::path& folder);

/// Sizes of pictures against their camera and each other; numbers that are not finite or cannot be.
std::vector<Fault> check_pictures(const DatasetView& view, const LoadedFrame& frame);

/// Depth along the ray, where a format has it beside planar Z, against that.
std::vector<Fault> check_range(const DatasetView& view, const LoadedFrame& frame, const cv::Mat& range_m,
                               vision::Side side, Margins& margins);

/// What files of balls say of pixels, against identities: boxes, counts, balls that are hidden.
std::vector<Fault> check_boxes(const DatasetView& view, const LoadedFrame& frame, Margins& margins);

/// Boxes of balls against the outlines of spheres of their size, at the place that the file says.
std::vector<Fault> check_outlines(const DatasetView& view, const ViewFrame& frame, Margins& margins);

/// Pictures of what only some pixels have, against those of all pixels: KITTI's `noc` and `occ`.
std::vector<Fault> check_parts(const DatasetView& view, const LoadedFrame& frame);

/// The next instant of a frame that no other frame is: whether flow and both disparities are of one rigid
/// motion, which most pixels must share, and whether flow and disparity lead to where the second pictures
/// show the same.
std::vector<Fault> check_next_instant(const DatasetView& view, const LoadedFrame& frame, Margins& margins);

/// Times of frames and poses: in order, equal between cameras.
std::vector<Fault> check_stamps(const DatasetView& view);

/// Rotations that are rotations, and poses without leaps.
std::vector<Fault> check_poses(const DatasetView& view, Margins& margins);

}  // namespace stereobench::harness
