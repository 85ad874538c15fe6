#include "harness/cluster/cluster_job.h"

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "harness/cluster/batch_script.h"
#include "harness/cluster/shard_states.h"
#include "tests/complaint.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class WrittenJob {
 public:
  explicit WrittenJob(const std::string& text) { folder_.write("job.yaml", text); }
  ClusterJob read() const { return read_cluster_job(folder_.path() / "job.yaml"); }
  std::string complaint() const {
    return complaint_of([this] { read(); });
  }
  std::string folder() const { return folder_.path().string(); }

 private:
  TestFolder folder_;
};

TEST(ClusterJob, IsReadFromItsFile) {
  const WrittenJob written(
      "job: noise\ncommand: [run, a.yaml, --seeds, 0..9]\nshards: 40\noverlap: 2\nmeasure: false\n"
      "slurm: {at_once: 16, partition: long, cpus: 3, options: [--qos=low]}\n");
  const ClusterJob job = written.read();
  EXPECT_EQ(job.shards, 40U);
  EXPECT_EQ(job.out, written.folder() + "/out/noise");
  EXPECT_EQ(job.folder(), written.folder());
  EXPECT_EQ(job.first_shard(), 1U);
  EXPECT_THAT(shard_words(job, "7"), ElementsAre("", "run", "a.yaml", "--seeds", "0..9", "--shard", "7/40",
                                                 "--jobs", "3", "--shard-overlap", "2"));
}

TEST(ClusterJob, SaysWhatIsWrongWithIt) {
  const std::string good = "job: noise\ncommand: [run, a.yaml]\nshards: 2\n";
  EXPECT_EQ(WrittenJob(good).complaint(), "no complaint");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"job: noise\nshards: 2\n", "command"},
      {"job: noise\ncommand: [slam, log]\nshards: 2\n", "expected one of run, sweep"},
      {"job: noise\ncommand: [run, a.yaml, --out, b]\nshards: 2\n", "job.yaml:2: command"},
      {"job: noise\ncommand: [run, a.yaml, --shard=1/2]\nshards: 2\n", "expected a command without it"},
      {"job: a/b\ncommand: [run, a.yaml]\nshards: 2\n", "job.yaml:1: job"},
      {"job: noise\ncommand: [run, a.yaml]\nshards: 0\n", "job.yaml:3: shards"},
      {good + "slurm: {nodes: 3}\n", "job.yaml:4: slurm.nodes: unknown key"},
      {"job: noise\ncommand: [dataset, a.yaml]\nshards: 2\noverlap: 1\n", "job.yaml:4: overlap: expected 0"},
  };
  for (const auto& [text, expected] : cases) {
    const std::string complaint = WrittenJob(text).complaint();
    EXPECT_THAT(complaint, HasSubstr(expected)) << text;
    EXPECT_EQ(complaint.find('\n'), std::string::npos) << complaint;
  }
}

// Mutations: wishes left out of a script; names with blanks that are not quoted.
TEST(BatchScript, SaysWhatWasAskedFor) {
  const ClusterJob job =
      WrittenJob(
          "job: noise\ncommand: [run, 'a b.yaml']\nshards: 40\nprogram: /opt/stereobench\nout: /data/x y\n"
          "slurm: {partition: long, account: me, time: \"01:00:00\", memory: 2G, options: [--qos=low], "
          "container: s.sif}\n")
          .read();
  const std::string script = shards_script(job);
  for (const char* line :
       {"#!/bin/bash\n", "#SBATCH --job-name=noise_shards\n", "#SBATCH --partition=long\n",
        "#SBATCH --account=me\n", "#SBATCH --time=01:00:00\n", "#SBATCH --mem=2G\n",
        "#SBATCH --cpus-per-task=1\n", "#SBATCH --requeue\n", "#SBATCH --open-mode=append\n",
        "#SBATCH --qos=low\n", "#SBATCH --output='/data/x y/logs/task_%a.txt'\n"})
    EXPECT_THAT(script, HasSubstr(line));
  EXPECT_THAT(script,
              HasSubstr("exec apptainer exec s.sif /opt/stereobench run 'a b.yaml' --shard auto/40 --jobs 1 "
                        "--shard-costs '/data/x y/shards/0/costs.json' --out '/data/x "
                        "y/shards'/$((SLURM_ARRAY_TASK_ID + 1))\n"));
  EXPECT_THAT(measure_script(job), AllOf(HasSubstr("--shard 0/40"), Not(HasSubstr("--shard-costs"))));
  EXPECT_THAT(merge_script(job),
              AllOf(HasSubstr("merge '/data/x y/shards/0' "), HasSubstr("'/data/x y/shards/40' ")));
}

/// A block of the guide that begins with these words.
std::string block_of_guide(const std::string& begin) {
  std::ifstream stream(STEREOBENCH_SOURCE_DIR "/docs/guide/scale.md");
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  const std::size_t place = text.find("```yaml\n" + begin) + 8;
  return text.substr(place, text.find("```", place) - place);
}

TEST(ScaleGuide, HasAJobThatIsRead) {
  const WrittenJob written(block_of_guide("job:"));
  EXPECT_EQ(written.complaint(), "no complaint");
  EXPECT_EQ(written.read().shards, 40U);
  EXPECT_EQ(written.read().slurm.at_once, 16);
}

TEST(ScaleGuide, HasAManifestWithAsManyPodsAsShards) {
  const YAML::Node manifest = YAML::Load(block_of_guide("apiVersion:"));
  const YAML::Node job = manifest["spec"];
  const auto command = job["template"]["spec"]["containers"][0]["command"][2].as<std::string>();
  EXPECT_THAT(command, HasSubstr("--shard auto/" + job["completions"].as<std::string>() + " "));
  EXPECT_EQ(job["completionMode"].as<std::string>(), "Indexed");
  const YAML::Node rules = job["podFailurePolicy"]["rules"];
  EXPECT_EQ(rules[0]["action"].as<std::string>(), "FailIndex");
  EXPECT_EQ(rules[0]["onExitCodes"]["values"][0].as<int>(), 2);
}

// Mutation: two in a row as two numbers.
TEST(Ranges, AreAsSlurmWritesThem) {
  EXPECT_EQ(ranges_of({}), "");
  EXPECT_EQ(ranges_of({2}), "2");
  EXPECT_EQ(ranges_of({0, 1, 2, 7, 9, 10}), "0-2,7,9-10");
}

}  // namespace
}  // namespace stereobench::harness
