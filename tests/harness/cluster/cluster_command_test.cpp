/// `stereobench cluster`, with programs in the place of Slurm's that write down what they are asked.
/// tests/cluster/slurm_test.py has a real Slurm.
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/collection/small_collection.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class ClusterCommand : public testing::Test {
 protected:
  ClusterCommand() {
    fs::create_directories(path("bin"));
    write_program("sbatch", "echo \"$@\" >> " + path("asked").string() + "\necho \"$(wc -l < " +
                                path("asked").string() + ");cluster\"");
    set_queue("");
    scratch_.write("job.yaml",
                   fmt::format("job: field\n"
                               "command: [sweep, '{}', --vary, 'oracle.range_sd_m=0.1,0.3', --seeds, 0..3,"
                               " --filters, ekf, --set, 'gates=[]', --set,"
                               " 'path.points_m=[[-15, -18], [5, -18]]', --set, path.closed=false]\n"
                               "shards: 3\nout: work\nslurm: {{at_once: 2}}\n",
                               scenario_path("open_field")));
  }
  fs::path path(const std::string& name) const { return scratch_.path() / name; }
  void write_program(const std::string& name, const std::string& lines) {
    scratch_.write("bin/" + name, "#!/bin/bash\n" + lines + "\n");
    fs::permissions(path("bin/" + name), fs::perms::owner_all);
  }
  void set_queue(const std::string& lines) { write_program("squeue", "printf '" + lines + "'"); }
  Outcome cluster(const std::string& step) const {
    return run_stereobench({"cluster", step, path("job.yaml").string()},
                           {"PATH=" + path("bin").string() + ":/usr/bin:/bin"});
  }
  /// Runs a script of the job as Slurm does. @return its exit code
  int run_script(const std::string& name, int task = -1) const {
    const std::string variable = task < 0 ? "" : fmt::format("SLURM_ARRAY_TASK_ID={} ", task);
    const std::string log = path(fmt::format("log_{}_{}", name, task)).string();
    return std::system((variable + "bash " + path("work/" + name).string() + " >" + log + " 2>&1").c_str());
  }
  std::string asked() const { return bytes_of(path("asked")); }

  TestFolder scratch_;
};

// The whole way: shards on the disk decide what is missing, whatever the scheduler thinks. Mutations: an
// array that begins with 1; finished shards submitted again; those in the queue submitted again; the merge
// that does not wait.
TEST_F(ClusterCommand, SubmitsWhatIsMissingAndMergesIt) {
  const Outcome submitted = cluster("submit");
  ASSERT_EQ(submitted.exit_code, 0) << submitted.err;
  const std::string scripts = path("work").string();
  EXPECT_EQ(asked(), fmt::format("--parsable {0}/measure.sbatch\n"
                                 "--parsable --array=0-2%2 --dependency=afterany:1 {0}/shards.sbatch\n"
                                 "--parsable --dependency=afterany:2 {0}/merge.sbatch\n",
                                 scripts));
  EXPECT_THAT(cluster("submit").err, HasSubstr("was submitted before"));
  EXPECT_EQ(run_script("measure.sbatch"), 0);
  EXPECT_EQ(run_script("shards.sbatch", 1), 0);
  const Outcome status = cluster("status");
  EXPECT_EQ(status.exit_code, 3);
  EXPECT_THAT(status.out,
              AllOf(HasSubstr("finished:      2 shards: 0,2"), HasSubstr("not begun:      2 shards: 1,3")));
  EXPECT_NE(run_script("merge.sbatch"), 0);
  set_queue("2 2 None\\n17 0 Priority\\n");  // 17 is somebody else's
  EXPECT_EQ(cluster("resume").exit_code, 0);
  EXPECT_THAT(asked(), HasSubstr(fmt::format("--parsable --array=0%2 {}/shards.sbatch\n", scripts)));
  EXPECT_EQ(run_script("shards.sbatch", 0), 0);
  EXPECT_EQ(run_script("shards.sbatch", 2), 0);
  EXPECT_EQ(cluster("status").exit_code, 0);
  EXPECT_THAT(cluster("resume").out, HasSubstr("no shard is missing"));
  EXPECT_EQ(run_script("merge.sbatch"), 0);
  EXPECT_TRUE(fs::exists(path("work/result/sweep.json")));
  EXPECT_EQ(cluster("merge").exit_code, 0);
}

// A task whose node failed while it was launched waits for ever, and is no work for another array. One that a
// person holds is left alone. Mutations: each held task released; none; one that is released also submitted;
// the job's number without its task.
TEST_F(ClusterCommand, ReleasesWhatSlurmHoldsAsANodeFailed) {
  ASSERT_EQ(cluster("submit").exit_code, 0);
  EXPECT_EQ(run_script("measure.sbatch"), 0);
  write_program("scontrol", "echo \"scontrol $@\" >> " + path("asked").string());
  set_queue("2 0 launch_failed_requeued_held\\n2 1 JobHeldUser\\n2 2 Priority\\n17 3 launch failed\\n");
  const std::string before = asked();
  const Outcome resumed = cluster("resume");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_THAT(resumed.out, AllOf(HasSubstr("held them after their node failed: shards 1\n"),
                                 HasSubstr("no shard is missing")));
  EXPECT_EQ(asked(), before + "scontrol release 2_0\n");
}

// Data sets are no results in a store: their shards say themselves how far they are, and nothing is measured.
// Mutations: shard 0 asked for; a shard that never says that it is finished.
TEST_F(ClusterCommand, RendersACollection) {
  write_collection(scratch_);
  scratch_.write("job.yaml", "job: set\ncommand: [dataset, small.yaml]\nshards: 2\nout: work\n");
  ASSERT_EQ(cluster("submit").exit_code, 0);
  const std::string scripts = path("work").string();
  EXPECT_EQ(asked(), fmt::format("--parsable --array=0-1 {0}/shards.sbatch\n"
                                 "--parsable --dependency=afterany:1 {0}/merge.sbatch\n",
                                 scripts));
  EXPECT_EQ(run_script("shards.sbatch", 1), 0);
  EXPECT_THAT(cluster("status").out,
              AllOf(HasSubstr("finished:      1 shards: 2"), HasSubstr("not begun:      1")));
  EXPECT_EQ(run_script("shards.sbatch", 0), 0);
  EXPECT_EQ(cluster("status").exit_code, 0);
  EXPECT_EQ(run_script("merge.sbatch"), 0);
  EXPECT_EQ(
      run_stereobench({"dataset", path("small.yaml").string(), "--out", path("whole").string()}).exit_code,
      0);
  EXPECT_TRUE(files_below(path("work/result")) == files_below(path("whole")));
}

// Mutation: sbatch's exit code not looked at.
TEST_F(ClusterCommand, SaysWhatSlurmSays) {
  write_program("sbatch", "echo 'invalid partition' >&2; exit 1");
  const Outcome outcome = cluster("submit");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("sbatch: invalid partition"));
  EXPECT_FALSE(fs::exists(path("work/submitted.json")));
}

TEST_F(ClusterCommand, RefusesACommandThatCannotBeRun) {
  scratch_.write("job.yaml", "job: field\ncommand: [run, nowhere.yaml]\nshards: 3\n");
  const Outcome outcome = cluster("submit");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("nowhere.yaml"));
  EXPECT_FALSE(fs::exists(path("asked")));
}

}  // namespace
}  // namespace stereobench::harness
