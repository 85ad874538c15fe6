#include <algorithm>
#include <functional>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "harness/cluster/batch_script.h"
#include "harness/cluster/cluster_job.h"
#include "harness/cluster/shard_states.h"
#include "harness/cluster/slurm.h"
#include "harness/cluster/submissions.h"
#include "harness/commands/commands.h"
#include "harness/commands/talk.h"
#include "harness/io/atomic_file.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

ClusterJob job_of(const fs::path& file) {
  ClusterJob job = read_cluster_job(file);
  if (!job.program.empty()) return job;
  const bool is_in_container = !job.slurm.container.empty();
  job.program = is_in_container ? "stereobench" : fs::read_symlink("/proc/self/exe").string();
  return job;
}

/// Makes sure that the command can be run, and writes the scripts.
int plan(const ClusterJob& job, const Call& call) {
  const fs::path here = fs::current_path();
  fs::current_path(job.folder());
  Words words = shard_words(job, "1");
  words.front() = "stereobench";
  words.insert(words.end(), {"--out", job.shard_folder(1).string(), "--dry-run"});
  if (const int outcome = call(words); outcome != kPassed) return outcome;
  fs::current_path(here);
  prepare_output_folder(job.out / "logs");
  prepare_output_folder(job.out / "shards");
  if (job.measures) write_file_atomically(job.out / kMeasureScript, measure_script(job));
  write_file_atomically(job.out / kShardsScript, shards_script(job));
  write_file_atomically(job.out / kMergeScript, merge_script(job));
  fmt::print("{}: {} shards{}; scripts and results: {}\n", job.name, job.shards,
             job.measures ? ", after shard 0 has measured what drives cost" : "", (job.out / "").string());
  return kPassed;
}

/// Hands shards to Slurm, and the merge behind them.
/// @param shards their numbers, from 1
void submit_shards(const ClusterJob& job, bool measures, const std::vector<std::size_t>& shards) {
  std::string after;
  if (measures) after = submit(job.out / kMeasureScript, {});
  if (!shards.empty()) {
    std::vector<std::size_t> tasks;
    for (const std::size_t number : shards) tasks.push_back(number - 1);
    std::string array = "--array=" + ranges_of(tasks);
    if (job.slurm.at_once > 0) array += fmt::format("%{}", job.slurm.at_once);
    Words options = {array};
    if (!after.empty()) options.push_back("--dependency=afterany:" + after);
    after = submit(job.out / kShardsScript, options);
    Words arrays = read_submissions(job.out);
    arrays.push_back(after);
    write_submissions(job.out, arrays);
  }
  const std::string merge = submit(job.out / kMergeScript, {"--dependency=afterany:" + after});
  fmt::print("{}: {} shards are submitted, job {}; then job {} merges them into {}\n", job.name,
             shards.size() + (measures ? 1 : 0), after, merge, (job.result_folder() / "").string());
}

int submit_job(const ClusterJob& job, const Call& call) {
  if (!read_submissions(job.out).empty())
    throw std::runtime_error(fmt::format(
        "{}: was submitted before; `stereobench cluster resume` submits what is missing", job.name));
  if (const int outcome = plan(job, call); outcome != kPassed) return outcome;
  std::vector<std::size_t> all;
  for (std::size_t number = 1; number <= job.shards; ++number) all.push_back(number);
  submit_shards(job, job.measures, all);
  return kPassed;
}

/// The numbers of shards in a state.
std::vector<std::size_t> shards_in(const ClusterJob& job, const std::vector<ShardState>& states,
                                   ShardState state) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < states.size(); ++i)
    if (states[i] == state) numbers.push_back(job.first_shard() + i);
  return numbers;
}

int status(const ClusterJob& job) {
  const std::vector<ShardState> states = states_of(job);
  for (const ShardState state :
       {ShardState::kFinished, ShardState::kRunning, ShardState::kStopped, ShardState::kNotBegun}) {
    const auto numbers = shards_in(job, states, state);
    if (!numbers.empty())
      fmt::print("{:>9}: {:>6} shards: {}\n", name_of(state), numbers.size(), ranges_of(numbers));
  }
  const bool is_done =
      std::ranges::all_of(states, [](ShardState state) { return state == ShardState::kFinished; });
  fmt::print("{}: {} of {} shards are finished\n", job.name,
             shards_in(job, states, ShardState::kFinished).size(), states.size());
  return is_done ? kPassed : kInconclusive;
}

/// Lets the tasks run that Slurm holds. @return the numbers of the shards that wait or run
std::set<std::size_t> release_held_shards(const ClusterJob& job) {
  std::set<std::size_t> queued, released;
  for (const QueuedTask& task : tasks_in_queue(read_submissions(job.out))) {
    queued.insert(task.task + 1);
    if (!task.is_held) continue;
    release(task);
    released.insert(task.task + 1);
  }
  if (!released.empty())
    fmt::print("{}: released, as Slurm held them after their node failed: shards {}\n", job.name,
               ranges_of({released.begin(), released.end()}));
  return queued;
}

int resume(const ClusterJob& job) {
  const std::set<std::size_t> queued = release_held_shards(job);
  const std::vector<ShardState> states = states_of(job);
  std::vector<std::size_t> missing;
  bool measures = false;
  for (const ShardState state : {ShardState::kNotBegun, ShardState::kStopped})
    for (const std::size_t number : shards_in(job, states, state)) {
      if (number == 0)
        measures = true;
      else if (!queued.contains(number))
        missing.push_back(number);
    }
  std::ranges::sort(missing);
  if (missing.empty() && !measures) {
    fmt::print("{}: no shard is missing that is not in the queue\n", job.name);
    return kPassed;
  }
  submit_shards(job, measures, missing);
  return kPassed;
}

int merge_job(const ClusterJob& job, const Call& call) {
  Words words = merge_words(job);
  words.insert(words.begin(), "stereobench");
  return call(words);
}

using JobAction = std::function<int(const ClusterJob&)>;

void add_step(CLI::App& cluster, Action& action, const char* name, const char* says, const JobAction& act) {
  CLI::App* command = cluster.add_subcommand(name, says);
  auto file = std::make_shared<fs::path>();
  command->add_option("job", *file, "the job's file (YAML)")->required();
  add_quiet_option(*command);
  command->callback([file, act, &action] { action = [file, act] { return act(job_of(*file)); }; });
}

}  // namespace

void add_cluster_command(CLI::App& program, Action& action, const Call& call) {
  CLI::App* command =
      program.add_subcommand("cluster", "run a command's work as shards on a cluster (Slurm)");
  command->require_subcommand(1);
  add_step(*command, action, "plan", "check the job, and write its scripts, which can be read and changed",
           [call](const ClusterJob& job) { return plan(job, call); });
  add_step(*command, action, "submit", "plan, and hand all shards and their merge to Slurm",
           [call](const ClusterJob& job) { return submit_job(job, call); });
  add_step(*command, action, "status", "say how far the shards are; exits with 3 while some are missing",
           status);
  add_step(*command, action, "resume",
           "submit the shards that are neither finished nor in the queue, and release held ones", resume);
  add_step(*command, action, "merge", "join the shards here and now",
           [call](const ClusterJob& job) { return merge_job(job, call); });
  command->footer(
      "What is done is read from the files of the shards, not from the scheduler. A shard that was killed "
      "or\n"
      "preempted goes on where it was. docs/guide/scale.md shows a job's file.\n\n"
      "Example: stereobench cluster submit job.yaml");
}

}  // namespace stereobench::harness
