/// Which pictures of a folder belong together.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace stereobench::harness {

/// The two pictures of one view, and what it is called: the left one's name, without its ending.
struct ViewFiles {
  std::string name;
  std::filesystem::path left, right;
};

/// Finds the pairs of a folder: files whose names match the two patterns, with the same text for `*` in both.
/// @param patterns for left and right, each with one `*`, e.g. "left*" or "cam0/*.png"; both empty: "left/*"
///        and "right/*" where there are such folders, else "left*" and "right*"
/// @return sorted by name
/// @throws std::runtime_error for a pattern without one `*`, for no folder, and where there is no pair
std::vector<ViewFiles> find_view_files(const std::filesystem::path& folder,
                                       const std::array<std::string, 2>& patterns);

}  // namespace stereobench::harness
