/// Detections as lines of JSON, one a frame: what detectors answer, what files of detections hold, and what
/// `stereobench detect` writes.
///
///     {"frame": 12, "balls": [{"colour": 3, "left_px": [511.5, 380.2], "right_px": [402.9, 380.2]}]}
///
/// A ball has
/// - `colour`: an index into the palette, or null; `name`: what a learned colour is called;
/// - `left_px` and `right_px`: [column, row] of its outline's centre in each camera, (0, 0) the centre of the
///   top-left pixel; `left_radius_px` and `right_radius_px` where they are known;
/// - or, or beside them, `range_m` and `bearing_rad`: horizontal, left-positive, from the robot's origin;
/// - `covariance`: [[of range, both], [both, of bearing]], in m and rad; or `centre_sd_px`, the standard
///   deviation of each coordinate of a centre, which the covariance then follows from;
/// - `truncated`, `occluded`: true where it is not to be trusted.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/detector/ball_geometry.h"
#include "vision/outline/outline_fit.h"
#include "vision/types.h"

namespace stereobench::harness {

/// What a ball's error is taken to be that states none: of each coordinate of its centre, in each camera.
inline constexpr double kUnstatedSd_px = 0.5;

/// Reads a frame's line. Pixels without a range are triangulated as our own detector's are, and the other way
/// round a range without pixels is given those of a ball at the height of the cameras.
/// @param frame that the line must be about
/// @return in the order of the line
/// @throws BadLine for whatever is not exactly as above
std::vector<vision::BallObservation> read_detections(const std::string& line, std::size_t frame,
                                                     const BallGeometry& geometry);

/// The line of a frame, without its end. Numbers are read back exactly.
/// @param pictures the files it is about, left and right, where that is of use to a reader
/// @param names of colours that were learned, for `name` beside `colour`
std::string detections_line(std::size_t frame, std::span<const vision::BallObservation> balls,
                            std::span<const std::string> pictures = {},
                            std::span<const std::string> names = {});

/// The line of a single picture: centres, radii and colours.
std::string outlines_line(std::size_t frame, std::span<const vision::MeasuredOutline> outlines,
                          const std::string& picture, std::span<const std::string> names = {});

}  // namespace stereobench::harness
