#include "harness/shards/shard_record.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "harness/io/atomic_file.h"
#include "harness/io/json_file.h"
#include "harness/json/json_text.h"

namespace stereobench::harness {
namespace {

constexpr std::int64_t kMostDrives = 1'000'000'000;
constexpr std::size_t kMostWords = 1'000'000;

std::string shard_json(const ShardRecord& record) {
  return json_text({{"schema", 1},
                    {"command", record.command},
                    {"folder", record.folder.string()},
                    {"stereobench", record.version},
                    {"shard", record.shard.number},
                    {"shards", record.shard.count},
                    {"plan", record.plan},
                    {"pixels", record.pixels},
                    {"store", record.store},
                    {"drives", record.drives},
                    {"needs_shard_0", record.needs_measured},
                    {"finished", record.is_finished}});
}

bool is_same_shard(const ShardRecord& one, const ShardRecord& other) {
  return one.command == other.command && one.plan == other.plan && one.shard.number == other.shard.number &&
         one.shard.count == other.shard.count;
}

}  // namespace

ShardWork::ShardWork(std::filesystem::path folder, ShardRecord record)
    : folder_(std::move(folder)), record_(std::move(record)), lock_(folder_ / kShardLock) {
  const std::filesystem::path file = folder_ / kShardFile;
  if (std::filesystem::exists(file) && !is_same_shard(read_shard_record(folder_), record_))
    throw std::runtime_error(
        fmt::format("{}: is of another shard, of another command, or of files that have changed since; "
                    "remove the folder, "
                    "or choose another one with --out",
                    file.string()));
  write_file_atomically(file, shard_json(record_));
}

void ShardWork::finish() {
  record_.is_finished = true;
  write_file_atomically(folder_ / kShardFile, shard_json(record_));
}

bool is_under_way(const std::filesystem::path& folder) {
  return is_in_use(folder / kShardLock);
}

ShardRecord read_shard_record(const std::filesystem::path& folder) {
  return read_json_file(folder / kShardFile, [](const JsonValue& json) {
    if (json.at("schema").integer(0, 1000) != 1) json.at("schema").refuse("1");
    ShardRecord record;
    for (const JsonValue& word : json.at("command").list(2, kMostWords))
      record.command.push_back(word.text());
    record.folder = json.at("folder").text();
    record.version = json.at("stereobench").text();
    record.shard.count = static_cast<std::size_t>(json.at("shards").integer(1, kMostDrives));
    record.shard.number =
        static_cast<std::size_t>(json.at("shard").integer(0, static_cast<std::int64_t>(record.shard.count)));
    record.plan = json.at("plan").text();
    record.pixels = json.at("pixels").text();
    record.store = json.at("store").text();
    record.drives = static_cast<std::size_t>(json.at("drives").integer(0, kMostDrives));
    record.needs_measured = json.at("needs_shard_0").flag();
    record.is_finished = json.at("finished").flag();
    return record;
  });
}

}  // namespace stereobench::harness
