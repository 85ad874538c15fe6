/// collection.json: which data sets a collection has, whether or not they are there yet.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/collection/collection.h"

namespace stereobench::harness {

/// The record of a collection, in its folder. It is there from the start, and in each shard.
inline constexpr const char* kCollectionFile = "collection.json";

/// One data set of a collection.
struct CollectionEntry {
  std::string folder;  ///< within the collection: "train/ball_circle/seed_3"
  std::string split;
  std::string name;  ///< of its group of drives
  std::string variation;
  std::string format;
  std::string scenario;  ///< the drive's name
  std::uint64_t seed = 0;
  std::string identity_sha256;  ///< of what it is rendered from (identity_hash)
};

struct CollectionRecord {
  std::string name;
  std::string version;  ///< of the program
  CollectionAbout about;
  std::vector<CollectionEntry> datasets;
};

/// The hash of what a data set is rendered from. @param marker dataset.json, or what it begins with
std::string identity_hash(const nlohmann::json& marker);

/// The text of collection.json.
std::string collection_json(const CollectionRecord& record);

/// Reads a folder's collection.json.
/// @throws std::runtime_error "file: key: what was expected"
CollectionRecord read_collection_record(const std::filesystem::path& folder);

}  // namespace stereobench::harness
