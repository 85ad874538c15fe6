#include "harness/collection/merge.h"

#include <optional>

#include <fmt/format.h>

#include "harness/dataset/rendered_dataset.h"
#include "harness/frames/linked_files.h"
#include "harness/io/atomic_file.h"
#include "harness/io/sha256.h"
#include "harness/io/text_file.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

/// Where a data set is taken from.
struct Source {
  fs::path folder;
  FileHashes files;
};

/// The record that all shards have.
CollectionRecord common_record(const std::vector<fs::path>& shards) {
  const std::string text = read_text(shards.front() / kCollectionFile);
  for (const fs::path& shard : shards)
    if (read_text(shard / kCollectionFile) != text)
      throw std::runtime_error(fmt::format("{} and {}: are parts of different collections; their {} differ",
                                           shards.front().string(), shard.string(), kCollectionFile));
  return read_collection_record(shards.front());
}

/// Makes sure that two data sets have the same files.
void require_same_files(const Source& one, const Source& other) {
  const auto refuse = [&](const std::string& name, const char* what) {
    throw ShardConflict(fmt::format("{} and {}: {}; one of them was rendered by another program or machine",
                                    (one.folder / name).string(), (other.folder / name).string(), what));
  };
  for (const auto& [name, hash] : one.files) {
    const auto found = other.files.find(name);
    if (found == other.files.end()) refuse(name, "only the first one is there");
    if (found->second != hash) refuse(name, "have different bytes");
  }
  for (const auto& [name, hash] : other.files)
    if (!one.files.contains(name)) refuse(name, "only the second one is there");
}

/// The first shard that has a data set, where all that have it agree.
std::optional<Source> source_of(const CollectionEntry& entry, const std::vector<fs::path>& shards) {
  std::optional<Source> first;
  for (const fs::path& shard : shards) {
    std::optional<FinishedEntry> finished = finished_entry(shard, entry);
    if (!finished) continue;
    Source source = {shard / entry.folder, std::move(finished->files)};
    if (!first)
      first = std::move(source);
    else
      require_same_files(*first, source);
  }
  return first;
}

std::vector<Source> sources_of(const CollectionRecord& record, const std::vector<fs::path>& shards) {
  std::vector<Source> sources;
  std::vector<std::string> missing;
  for (const CollectionEntry& entry : record.datasets) {
    std::optional<Source> source = source_of(entry, shards);
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

/// A folder that files of a data set are put into: as links, or as copies that are synced together.
class Placement {
 public:
  Placement(const Source& source, fs::path target) : source_(source), target_(std::move(target)) {}

  /// Puts all files and the manifest there, which comes last.
  void place() {
    for (const auto& [name, hash] : source_.files) place(name, hash);
    files_.move_into_place();
    sync_file_system(target_);
    write_file_atomically(target_ / kManifest, manifest_text(source_.files));
  }

 private:
  void place(const std::string& name, const std::string& hash) {
    const fs::path from = source_.folder / name, to = target_ / name;
    if (fs::is_regular_file(to) && sha256_of_file(to) == hash) return;
    if (!fs::is_regular_file(from) || sha256_of_file(from) != hash)
      throw std::runtime_error(fmt::format(
          "{}: is not as it was rendered; render its shard again, which restores it", from.string()));
    prepare_output_folder(to.parent_path());
    files_.place(from, to);
  }

  const Source& source_;
  fs::path target_;
  LinkedFiles files_;
};

}  // namespace

CollectionTotals merge_shards(const std::vector<fs::path>& shards, const fs::path& out,
                              const std::function<void(double)>& on_progress) {
  const CollectionRecord record = common_record(shards);
  std::vector<fs::path> places = shards;
  if (fs::exists(out / kCollectionFile)) places.push_back(out);
  const std::vector<Source> sources = sources_of(record, places);
  begin_collection(out, record);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const fs::path target = out / record.datasets[i].folder;
    prepare_output_folder(target);
    remove_leftovers(target);
    Placement(sources[i], target).place();
    fs::remove(target / "dataset.unfinished.json");  // of a rendering that was interrupted there
    remove_used_parts(target);
    on_progress(static_cast<double>(i + 1) / static_cast<double>(sources.size()));
  }
  return finish_collection(out, record);
}

}  // namespace stereobench::harness
