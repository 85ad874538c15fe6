/// Which pictures of a list are the two of a pair.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace stereobench::harness {

/// One instant of a list of pictures.
struct PicturePair {
  std::string name;                                 ///< "000004": without ending and the camera's folder
  std::array<std::optional<std::size_t>, 2> place;  ///< in the list, by vision::Side
};

/// Pictures whose names differ in a folder `left` or `right` alone are a pair; others are left ones alone.
/// @param names "left/000004.png", "images/right/000004.png", "frame_00001.jpg"; a name that is there again
/// is
///   left out
/// @return in order of the names
std::vector<PicturePair> picture_pairs(const std::vector<std::string>& names);

/// Pairs of which a half is not in the list, where most are whole: "there is right/000004.png".
/// @return the names of the halves that are missing, and of those that are there
std::vector<std::pair<std::string, std::string>> missing_halves(const std::vector<PicturePair>& pairs,
                                                                const std::vector<std::string>& names);

}  // namespace stereobench::harness
