/// What was found in photographs, held against what is there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tests/studies/photograph.h"
#include "vision/colour/learned_palette.h"
#include "vision/outline/outline_fit.h"

namespace stereobench {

/// What was made of pictures; sums over them.
struct PhotographScore {
  long pictures = 0;
  long whole = 0;           ///< balls of which 95 % are seen, within the picture
  long found = 0;           ///< of these
  long trusted = 0;         ///< of these that were found: neither flagged as cut nor as hidden
  long hidden = 0;          ///< balls of which 15 to 70 % are hidden or cut
  long hidden_trusted = 0;  ///< of these, found and not flagged
  long nothings = 0;        ///< detections of no ball, or of another colour or size
  long nothings_trusted = 0;
  std::vector<double> errors_px;  ///< of the centres of whole balls that are trusted

  void add(const PhotographScore& other);
};

/// Colours as a person marks them: whole balls of the first four pictures, from a seed on, that show all
/// colours between them; each by a circle of four fifths of its radius.
/// @return in the order of photograph::kNames
std::vector<vision::LearnedColour> palette_of_four_photographs(std::uint64_t first_seed);

/// Holds what is found in a picture against what is there.
PhotographScore score_of(const photograph::Photograph& photograph,
                         std::span<const vision::MeasuredOutline> found);

/// What is found in a picture by colours that were learned.
/// @param learned of levels as they are stored (vision::Levels::kSrgb)
std::vector<vision::MeasuredOutline> look_at(const cv::Mat& levels, const vision::ColourTable& learned);

}  // namespace stereobench
