#include "harness/cluster/batch_script.h"

#include <vector>

#include <fmt/format.h>

#include "harness/page/command_words.h"

namespace stereobench::harness {
namespace {

using Words = std::vector<std::string>;

/// What Slurm reads before the first command. Output is appended: a task that is put back into the queue goes
/// on where it was.
std::string head_of(const ClusterJob& job, const std::string& name, const std::string& log) {
  const SlurmWishes& slurm = job.slurm;
  std::string text = "#!/bin/bash\n";
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) text += fmt::format("#SBATCH --{}={}\n", option, shell_word(value));
  };
  add("job-name", job.name + "_" + name);
  add("output", (job.out / "logs" / log).string());
  add("partition", slurm.partition);
  add("account", slurm.account);
  add("time", slurm.time);
  add("mem", slurm.memory);
  add("cpus-per-task", std::to_string(slurm.cpus));
  text += "#SBATCH --open-mode=append\n#SBATCH --requeue\n";
  for (const std::string& option : slurm.options) text += "#SBATCH " + option + "\n";
  return text + fmt::format("cd {} || exit 2\n", shell_word(job.folder().string()));
}

/// Words as a line of shell, within the job's container.
std::string line_of(const ClusterJob& job, const Words& words) {
  Words all;
  if (!job.slurm.container.empty()) all = {"apptainer", "exec", job.slurm.container.string()};
  all.insert(all.end(), words.begin(), words.end());
  return "exec " + shell_line(all);
}

}  // namespace

std::string measure_script(const ClusterJob& job) {
  return head_of(job, "measure", "measure.txt") + line_of(job, shard_words(job, "0")) + " --out " +
         shell_word(job.shard_folder(0).string()) + "\n";
}

std::string shards_script(const ClusterJob& job) {
  return head_of(job, "shards", "task_%a.txt") + line_of(job, shard_words(job, "auto")) + " --out " +
         shell_word((job.out / "shards").string()) + "/$((SLURM_ARRAY_TASK_ID + 1))\n";
}

std::string merge_script(const ClusterJob& job) {
  Words words = merge_words(job);
  words.insert(words.begin(), job.program);
  words.insert(words.end(), {"--jobs", std::to_string(job.slurm.cpus)});
  return head_of(job, "merge", "merge.txt") + line_of(job, words) + "\n";
}

}  // namespace stereobench::harness
