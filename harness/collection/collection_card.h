/// What a collection says of itself: a data card for people, a Croissant file for machines.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "harness/collection/collection_record.h"
#include "harness/io/file_list.h"

namespace stereobench::harness {

/// The header of index.csv.
inline constexpr const char* kIndexHeader = "folder,split,name,variation,format,scenario,seed,pairs";

/// A data set in the index.
struct IndexLine {
  const CollectionEntry* entry = nullptr;
  std::size_t pairs = 0;
};

/// @return Markdown, which has no path, time or host of the machine
std::string collection_card(const CollectionRecord& record, const std::vector<IndexLine>& lines);

/// @param files of all data sets
/// @param own what the collection adds to them, with their texts
std::string collection_croissant(const CollectionRecord& record, const FileHashes& files,
                                 const std::vector<std::pair<std::string, std::string>>& own);

}  // namespace stereobench::harness
