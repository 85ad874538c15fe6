#include "harness/collection/collection_folder.h"

#include <limits>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/collection/collection_card.h"
#include "harness/dataset/card/dataset_facts.h"
#include "harness/dataset/rendered_dataset.h"
#include "harness/io/atomic_file.h"
#include "harness/io/json_file.h"
#include "harness/io/sha256.h"
#include "harness/io/text_file.h"
#include "harness/shards/shard_record.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

std::string index_csv(const std::vector<IndexLine>& lines) {
  std::string csv = std::string(kIndexHeader) + "\n";
  for (const IndexLine& line : lines) {
    const CollectionEntry& entry = *line.entry;
    csv += fmt::format("{},{},{},{},{},{},{},{}\n", entry.folder, entry.split, entry.name, entry.variation,
                       entry.format, entry.scenario, entry.seed, line.pairs);
  }
  return csv;
}

}  // namespace

void refuse_strangers(const fs::path& folder, const CollectionRecord& record) {
  if (holds_rendering(folder))
    throw std::runtime_error(fmt::format(
        "{}: holds a data set itself, and cannot hold several; choose another folder or remove it",
        folder.string()));
  if (!fs::exists(folder / kCollectionFile)) return;
  std::set<std::string> known;
  for (const CollectionEntry& entry : record.datasets) known.insert(entry.folder);
  for (const CollectionEntry& before : read_collection_record(folder).datasets)
    if (!known.contains(before.folder) && fs::exists(folder / before.folder))
      throw std::runtime_error(
          fmt::format("{}: is a data set that {} no longer has; remove it or choose another folder",
                      (folder / before.folder).string(), record.name));
}

std::optional<FinishedEntry> finished_entry(const fs::path& folder, const CollectionEntry& entry) {
  const fs::path place = folder / entry.folder;
  if (!fs::exists(place / kManifest)) return std::nullopt;
  FinishedEntry finished = {.files = read_manifest(place)};
  const nlohmann::json marker = read_json_file(place / kDatasetJson, [&](const JsonValue& json) {
    finished.pairs = json.at(kFrames).list(0, std::numeric_limits<std::size_t>::max()).size();
    return parse_line(read_text(place / kDatasetJson));
  });
  if (identity_hash(marker) != entry.identity_sha256)
    throw std::runtime_error(fmt::format("{}: is not the data set that {} says; render it again",
                                         place.string(), kCollectionFile));
  return finished;
}

void begin_collection(const fs::path& folder, const CollectionRecord& record) {
  refuse_strangers(folder, record);
  prepare_output_folder(folder);
  remove_leftovers_in(folder);
  for (const CollectionEntry& entry : record.datasets) remove_used_parts(folder / entry.folder);
  fs::remove(folder / kManifest);
  const std::string text = collection_json(record);
  if (!fs::exists(folder / kCollectionFile) || read_text(folder / kCollectionFile) != text)
    write_file_atomically(folder / kCollectionFile, text);
}

std::vector<std::string> missing_entries(const fs::path& folder, const CollectionRecord& record) {
  std::vector<std::string> missing;
  for (const CollectionEntry& entry : record.datasets)
    if (!finished_entry(folder, entry)) missing.push_back(entry.folder);
  return missing;
}

CollectionTotals finish_collection(const fs::path& folder, const CollectionRecord& record) {
  FileHashes files;
  std::vector<IndexLine> lines;
  CollectionTotals totals;
  for (const CollectionEntry& entry : record.datasets) {
    const FinishedEntry finished = finished_entry(folder, entry).value();
    for (const auto& [name, hash] : finished.files) files[fmt::format("{}/{}", entry.folder, name)] = hash;
    const std::string manifest = fmt::format("{}/{}", entry.folder, kManifest);
    files[manifest] = sha256_of_file(folder / manifest);
    lines.push_back({&entry, finished.pairs});
    ++totals.datasets;
    totals.pairs += finished.pairs;
  }
  std::vector<std::pair<std::string, std::string>> own = {
      {kCollectionFile, read_text(folder / kCollectionFile)}, {kIndexFile, index_csv(lines)}};
  own.emplace_back(kCardFile, collection_card(record, lines));
  own.emplace_back(kCroissantFile, collection_croissant(record, files, own));
  AtomicFiles written;
  for (const auto& [name, text] : own) {
    if (name != kCollectionFile) written.write(folder / name, text);
    files[name] = sha256_of(text);
  }
  written.move_into_place();
  for (const char* part : {kShardFile, kShardLock}) fs::remove(folder / part);  // that the others came to
  sync_file_system(folder);  // the manifest says that all of it is there
  write_file_atomically(folder / kManifest, manifest_text(files));
  return totals;
}

}  // namespace stereobench::harness
