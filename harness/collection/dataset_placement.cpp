#include "harness/collection/dataset_placement.h"

#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "harness/dataset/rendered_dataset.h"
#include "harness/frames/linked_files.h"
#include "harness/io/atomic_file.h"
#include "harness/io/sha256.h"
#include "harness/shards/shard_conflict.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

/// A folder that files of a data set are put into: as links, or as copies that are synced together.
class Placement {
 public:
  Placement(const DatasetSource& source, fs::path target) : source_(source), target_(std::move(target)) {}

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

  const DatasetSource& source_;
  fs::path target_;
  LinkedFiles files_;
};

}  // namespace

void require_same_files(const DatasetSource& one, const DatasetSource& other) {
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

void place_dataset(const DatasetSource& source, const fs::path& target) {
  prepare_output_folder(target);
  remove_leftovers(target);
  Placement(source, target).place();
  fs::remove(target / "dataset.unfinished.json");  // of a rendering that was interrupted there
  remove_used_parts(target);
}

void place_datasets(const std::vector<fs::path>& shards, const fs::path& out) {
  std::map<fs::path, DatasetSource> sources;  // by their place
  for (const fs::path& shard : shards)
    for (const auto& entry : fs::recursive_directory_iterator(shard)) {
      if (entry.path().filename() != kManifest) continue;
      const fs::path folder = entry.path().parent_path();
      const DatasetSource source = {folder, read_manifest(folder)};
      const auto [place, is_new] = sources.try_emplace(folder.lexically_relative(shard), source);
      if (!is_new) require_same_files(place->second, source);
    }
  for (const auto& [place, source] : sources) place_dataset(source, out / place);
}

}  // namespace stereobench::harness
