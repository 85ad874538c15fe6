#include "harness/collection/merge.h"

#include <optional>

#include <fmt/format.h>

#include "harness/collection/dataset_placement.h"
#include "harness/io/text_file.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

/// The record that all shards have.
CollectionRecord common_record(const std::vector<fs::path>& shards) {
  const std::string text = read_text(shards.front() / kCollectionFile);
  for (const fs::path& shard : shards)
    if (read_text(shard / kCollectionFile) != text)
      throw std::runtime_error(fmt::format("{} and {}: are parts of different collections; their {} differ",
                                           shards.front().string(), shard.string(), kCollectionFile));
  return read_collection_record(shards.front());
}

/// The first shard that has a data set, where all that have it agree.
std::optional<DatasetSource> source_of(const CollectionEntry& entry, const std::vector<fs::path>& shards) {
  std::optional<DatasetSource> first;
  for (const fs::path& shard : shards) {
    std::optional<FinishedEntry> finished = finished_entry(shard, entry);
    if (!finished) continue;
    DatasetSource source = {shard / entry.folder, std::move(finished->files)};
    if (!first)
      first = std::move(source);
    else
      require_same_files(*first, source);
  }
  return first;
}

std::vector<DatasetSource> sources_of(const CollectionRecord& record, const std::vector<fs::path>& shards) {
  std::vector<DatasetSource> sources;
  std::vector<std::string> missing;
  for (const CollectionEntry& entry : record.datasets) {
    std::optional<DatasetSource> source = source_of(entry, shards);
    if (source)
      sources.push_back(std::move(*source));
    else
      missing.push_back(entry.folder);
  }
  if (!missing.empty())
    throw std::runtime_error(fmt::format(
        "{} of {} data sets are finished in no shard (the first: {}); render the shards that have "
        "them",
        missing.size(), record.datasets.size(), missing.front()));
  return sources;
}

}  // namespace

CollectionTotals merge_shards(const std::vector<fs::path>& shards, const fs::path& out,
                              const std::function<void(double)>& on_progress) {
  const CollectionRecord record = common_record(shards);
  std::vector<fs::path> places = shards;
  if (fs::exists(out / kCollectionFile)) places.push_back(out);
  const std::vector<DatasetSource> sources = sources_of(record, places);
  begin_collection(out, record);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    place_dataset(sources[i], out / record.datasets[i].folder);
    on_progress(static_cast<double>(i + 1) / static_cast<double>(sources.size()));
  }
  return finish_collection(out, record);
}

}  // namespace stereobench::harness
