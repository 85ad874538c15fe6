#include "harness/cluster/slurm.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <stdlib.h>
#include <sys/wait.h>

#include "harness/page/command_words.h"
#include "harness/process/supervised_process.h"
#include "worlds/yaml/excerpt.h"

namespace stereobench::harness {
namespace {

using Words = std::vector<std::string>;

/// Slurm's programs wait for a controller that is down for longer than a minute.
constexpr std::chrono::minutes kPatience{3};
constexpr std::size_t kMostBytes = 1 << 20;

/// Why a task waits whose node failed: "launch failed requeued held".
constexpr std::string_view kHeldReason = "launch failed";

/// @return what a program writes, a line each
/// @throws std::runtime_error, one line, where it fails
Words answer_of(const Words& words) {
  std::string scratch = (std::filesystem::temp_directory_path() / "stereobench_XXXXXX").string();
  if (::mkdtemp(scratch.data()) == nullptr) throw std::runtime_error(scratch + ": cannot be created");
  SupervisedProcess process(shell_line(words), scratch);
  process.close_input();
  const auto until = std::chrono::steady_clock::now() + kPatience;
  Words lines;
  std::string line;
  while (process.hear(line, kMostBytes, until) == Heard::kLine) lines.push_back(line);
  const auto status = process.wait_status(until);
  if (status && WIFEXITED(*status) && WEXITSTATUS(*status) == 0) return lines;
  const Words errors = process.last_errors(1);
  throw std::runtime_error(fmt::format("{}: {}", words.front(),
                                       errors.empty() ? "does not answer" : worlds::excerpt(errors.front())));
}

}  // namespace

std::string submit(const std::filesystem::path& script, const Words& options) {
  Words words = {"sbatch", "--parsable"};
  words.insert(words.end(), options.begin(), options.end());
  words.push_back(script.string());
  const Words lines = answer_of(words);
  if (lines.empty()) throw std::runtime_error("sbatch: expected the number of a job, got nothing");
  return lines.back().substr(0, lines.back().find(';'));  // "17;cluster"
}

std::vector<QueuedTask> tasks_in_queue(const Words& jobs) {
  std::vector<QueuedTask> tasks;
  if (jobs.empty()) return tasks;
  const std::set<std::string> asked(jobs.begin(), jobs.end());
  for (const std::string& line : answer_of({"squeue", "--noheader", "--array", "--format=%F %K %r"})) {
    std::istringstream words(line);
    std::string job, task, reason;
    std::size_t number = 0;
    if (!(words >> job >> task) || !asked.contains(job)) continue;
    const auto [end, error] = std::from_chars(task.data(), task.data() + task.size(), number);
    if (error != std::errc() || end != task.data() + task.size()) continue;
    std::getline(words >> std::ws, reason);
    std::ranges::replace(reason, '_', ' ');  // some versions write it so
    tasks.push_back({job, number, reason.starts_with(kHeldReason)});
  }
  return tasks;
}

void release(const QueuedTask& task) {
  answer_of({"scontrol", "release", fmt::format("{}_{}", task.job, task.task)});
}

}  // namespace stereobench::harness
