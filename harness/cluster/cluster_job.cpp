#include "harness/cluster/cluster_job.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "worlds/yaml/fields.h"
#include "worlds/yaml/plain_name.h"
#include "worlds/yaml/yaml_document.h"

namespace stereobench::harness {
namespace {

using worlds::Fields;
using worlds::flag;
using worlds::group;
using worlds::text;
using worlds::whole;
using worlds::YamlValue;

constexpr std::size_t kMostWords = 10'000;
constexpr int kMostShards = 1'000'000;

/// Commands whose work can be cut into shards.
constexpr std::array<std::string_view, 9> kCommands = {
    "run", "sweep", "budget", "attribute", "sensitivity", "calibrate", "test", "render", "dataset"};

/// Its shards are cut by count alone.
constexpr std::string_view kDatasetCommand = "dataset";

/// What a job says of its shards, and the command must not.
constexpr std::array<std::string_view, 6> kOfShards = {"--shard", "--shard-costs", "--shard-overlap", "--out",
                                                       "-o",      "--dry-run"};

const Fields<SlurmWishes>& slurm_keys() {
  static const Fields<SlurmWishes> keys({
      whole("at_once", 0, kMostShards, "Shards that run at a time at most; 0: as many as there is room for.")
          .fills(&SlurmWishes::at_once),
      text("partition", "Where they run.").fills(&SlurmWishes::partition),
      text("account", "Who pays.").fills(&SlurmWishes::account),
      text("time", "Of a shard at most: minutes, or HH:MM:SS.").fills(&SlurmWishes::time),
      text("memory", "Of a shard, e.g. 2G.").fills(&SlurmWishes::memory),
      whole("cpus", 1, 1024, "Of a shard: so many drives at a time.").fills(&SlurmWishes::cpus),
      text("options", "Further options of sbatch, as they are.").list(0, 100).fills(&SlurmWishes::options),
      text("container", "An image of Apptainer that the program runs in.")
          .by<SlurmWishes>(
              [](const YamlValue& value, SlurmWishes& wishes) { wishes.container = value.text(); }),
  });
  return keys;
}

void read_command(const YamlValue& value, ClusterJob& job) {
  for (const YamlValue& word : value.list(1, kMostWords)) {
    job.command.push_back(word.text());
    const std::string option = job.command.back().substr(0, job.command.back().find('='));
    if (std::ranges::count(kOfShards, option) > 0)
      word.fail("expected a command without it: the job says so for its shards");
  }
  if (std::ranges::count(kCommands, job.command.front()) == 0)
    value.fail(fmt::format("expected one of {}", fmt::join(kCommands, ", ")));
}

const Fields<ClusterJob>& job_keys() {
  static const Fields<ClusterJob> keys({
      text("job", "Its name: letters, digits, _ and -.", worlds::kPlainNamePattern)
          .needed()
          .by<ClusterJob>(
              [](const YamlValue& value, ClusterJob& job) { job.name = worlds::plain_name(value); }),
      text("command", "Words behind `stereobench`; paths in them are relative to this file.")
          .list(1, kMostWords)
          .needed()
          .by<ClusterJob>(read_command),
      whole("shards", 1, kMostShards, "How many parts the work is cut into.")
          .needed()
          .by<ClusterJob>([](const YamlValue& value, ClusterJob& job) {
            job.shards = static_cast<std::size_t>(value.integer(1, kMostShards));
          }),
      whole("overlap", 0, 1000, "Drives of the next shard that each does too, so that machines are compared.")
          .by<ClusterJob>([](const YamlValue& value, ClusterJob& job) {
            job.overlap = static_cast<std::size_t>(value.integer(0, 1000));
          }),
      flag("measure",
           "Do one drive of each kind first, and cut the rest by what they cost; not of "
           "a dataset.")
          .fills(&ClusterJob::measures),
      text("out", "Folder for shards and result, which all nodes see; relative to this file.")
          .by<ClusterJob>([](const YamlValue& value, ClusterJob& job) { job.out = value.text(); }),
      text("program", "How the program is called on the nodes.").fills(&ClusterJob::program),
      group("slurm", slurm_keys(), "What Slurm is told.").fills(&ClusterJob::slurm),
  });
  return keys;
}

}  // namespace

std::filesystem::path ClusterJob::folder() const {
  return std::filesystem::absolute(file).parent_path().lexically_normal();
}

std::filesystem::path ClusterJob::shard_folder(std::size_t number) const {
  return out / "shards" / std::to_string(number);
}

ClusterJob read_cluster_job(const std::filesystem::path& file) {
  const worlds::YamlDocument document = worlds::load_yaml(file, {}, job_keys());
  const YamlValue top(document, "", document.root, document.root.Mark());
  check_keys(top, job_keys());
  ClusterJob job = job_keys().read(top);
  job.file = file;
  if (job.command.front() == kDatasetCommand) {
    job.measures = false;
    if (job.overlap > 0)
      worlds::YamlMap(top, job_keys())
          .at("overlap")
          .fail("expected 0 with a dataset, whose shards share no drives");
  }
  const std::filesystem::path out = job.out.empty() ? std::filesystem::path("out") / job.name : job.out;
  job.out = (job.folder() / out).lexically_normal();
  return job;
}

std::vector<std::string> shard_words(const ClusterJob& job, const std::string& number) {
  std::vector<std::string> words = {job.program};
  words.insert(words.end(), job.command.begin(), job.command.end());
  words.insert(words.end(), {"--shard", fmt::format("{}/{}", number, job.shards), "--jobs",
                             std::to_string(job.slurm.cpus)});
  if (job.overlap > 0) words.insert(words.end(), {"--shard-overlap", std::to_string(job.overlap)});
  if (job.measures && number != "0") words.insert(words.end(), {"--shard-costs", job.costs().string()});
  return words;
}

std::vector<std::string> merge_words(const ClusterJob& job) {
  std::vector<std::string> words = {"merge"};
  for (std::size_t number = job.first_shard(); number <= job.shards; ++number)
    words.push_back(job.shard_folder(number).string());
  words.insert(words.end(), {"--out", job.result_folder().string()});
  return words;
}

}  // namespace stereobench::harness
