/// What is known of a data set when all its files are there: what its card and its Croissant file are made
/// of.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/io/file_list.h"

namespace stereobench::harness {

/// The data card of a data set or of a collection.
inline constexpr const char* kCardFile = "README.md";
/// Its metadata for machines: Croissant 1.0 of MLCommons.
inline constexpr const char* kCroissantFile = "croissant.json";

struct DatasetFacts {
  std::filesystem::path folder;   ///< where the files are; it is in no text
  nlohmann::ordered_json marker;  ///< dataset.json
  FileHashes files;               ///< all but what the data set itself adds to those of its format
};

/// Files of a data set that hold the same kind of thing.
struct FileGroup {
  std::string glob;  ///< fits all of them; one file's name where there is one by that name
  std::string says;  ///< what they hold; empty where nobody has said so
  std::vector<std::string> names;
  std::uintmax_t bytes = 0;

  /// Whether it is one certain file.
  bool is_file() const { return glob.find('*') == std::string::npos; }
};

/// The files in groups, in the order of format_layout.h; what nobody has described stands at the end, file by
/// file.
std::vector<FileGroup> file_groups(const DatasetFacts& facts);

/// The format's name.
std::string format_of(const DatasetFacts& facts);

/// What follows on the number of stereo pairs where their pictures are not there; empty where they are.
std::string lack_of_pictures(const DatasetFacts& facts);

/// The drive's name; "drive" where the marker has none.
std::string drive_name_of(const DatasetFacts& facts);

/// The drive's name and seed as a title: "ball_circle, seed 3".
std::string title_of(const DatasetFacts& facts);

}  // namespace stereobench::harness
