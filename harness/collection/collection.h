/// Collections: the data sets of several scenarios, seeds and variations with their splits, read from strict
/// YAML.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/dataset/formats/format_registry.h"
#include "harness/dataset/pictures/picture_change.h"
#include "harness/dataset/truth/truth_request.h"
#include "harness/drive/frame_choice.h"

namespace stereobench::harness {

/// What a drive is for. No world is in two of them.
enum class Split { kTrain, kVal, kTest };

inline constexpr std::array kSplits = {Split::kTrain, Split::kVal, Split::kTest};

/// "train", "val", "test", as folders are called.
std::string_view name_of(Split split);

/// What the owner says of a collection. Empty: nothing.
struct CollectionAbout {
  std::string description;
  std::string licence;
  std::string creator;
  std::string url;
  std::string published;  ///< YYYY-MM-DD
};

/// The same worlds with something changed, e.g. a noisier camera.
struct DriveVariation {
  std::string name;              ///< empty: nothing is changed
  std::vector<std::string> set;  ///< "key.path=value"
};

/// Drives of one scenario: each seed of each split in each variation.
struct DriveGroup {
  std::string name;
  std::filesystem::path scenario;
  std::vector<std::string> set;                        ///< "key.path=value", of all variations
  FrameChoice frames;                                  ///< as it was asked for
  std::array<std::vector<std::uint64_t>, 3> seeds_of;  ///< by Split
  std::vector<DriveVariation> variations;              ///< at least one
};

/// What the folder of a variation's drives is called: NAME, or NAME-VARIATION.
std::string folder_name(const DriveGroup& drives, const DriveVariation& variation);

struct Collection {
  std::filesystem::path file;
  std::string name;
  CollectionAbout about;
  std::vector<const DatasetFormat*> formats = {&dataset_formats().front()};
  TruthRequest truth;
  PictureChange change;  ///< of all drives
  std::vector<DriveGroup> drives;
};

/// Reads a collection.
/// @param file the YAML file; scenarios in it are relative to its folder
/// @throws std::runtime_error of one line, "file:line: key: expected ... (got ...)"; of a line for each
///   unknown or missing key. A world, that is a scenario with a seed, which two splits have is an error
Collection read_collection(const std::filesystem::path& file);

}  // namespace stereobench::harness
