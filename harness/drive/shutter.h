/// What a moving camera sees while its shutter is open.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/renderer.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// Rows that look at one instant.
struct RowBand {
  cv::Range rows;
  double offset_s;  ///< from the instant of the middle row
};

/// The bands of a picture, from the first row to the last; one where all rows look at once.
std::vector<RowBand> row_bands(const worlds::Shutter& shutter, int height_px);

/// When the cameras look at a step of a drive, which the shutter leaves to chance.
/// @return by how much later than the step's time, in seconds; none where the frame is dropped
std::optional<double> lateness_s(const worlds::Shutter& shutter, std::uint64_t seed, std::size_t step);

/// What both cameras see while their shutters are open.
struct ExposedFrame {
  renderer::StereoFrame frame;
  /// How far the fastest point of a blurred picture goes from one of its instants to the next, px. Above 1
  /// the blur is a row of copies.
  double blur_step_px = 0.0;
};

/// Renders a step of a drive as its camera sees it: the average of the instants while the shutter is open,
/// row after row while the chip is read out, the right camera later by its delay.
///
/// @param index of the step; the left shutter opens half its time before the step and closes half after, the
///   middle row halfway through the readout
/// @param late_s by how much both cameras are late this time
/// @return light as an average over instants, rounded: as many that no point moves by more than a pixel from
///   one to the next, at least shutter.samples and at most shutter.most_samples; identity and depth are those
///   of the middle of each row's exposure
ExposedFrame open_shutter(renderer::Renderer& renderer, const worlds::GroundTruth& path, std::size_t index,
                          const worlds::Shutter& shutter, double late_s = 0.0);

}  // namespace stereobench::harness
