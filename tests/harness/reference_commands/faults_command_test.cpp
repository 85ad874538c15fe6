// Named faults on the command line.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// Mutations: all faults whatever is asked for; keys left out.
TEST(FaultsCommand, ListsWhatThereIs) {
  const Outcome outcome = run_stereobench({"faults", "rig.cal"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(StartsWith("rig.calibration: "),
                                 HasSubstr("\n    believed_rig.focal_px / rig.focal_px: 1.001  "),
                                 Not(HasSubstr("camera."))));
  EXPECT_THAT(run_stereobench({"faults", "--markdown"}).out, StartsWith("# Named faults\n"));
}

class RunWithFaults : public testing::Test {
 protected:
  nlohmann::ordered_json result_of(const std::string& name, const std::vector<std::string>& more) {
    const auto out = (folder_.path() / name).string();
    const Outcome outcome =
        run_stereobench(with({"run", scenario_path("open_field"), "--seeds", "0", "--filters",
                              "dead_reckoning", "--set", "gates=[]", "--out", out},
                             more));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::ordered_json::parse(bytes_of(out + "/run.json"));
  }

  TestFolder folder_;
};

// run.json says what was asked for, and all else is that of the plain lines. Mutations: a scenario's hash
// with the fault's name in it; severity 0 that makes a group.
TEST_F(RunWithFaults, IsARunOfThePlainLines) {
  const auto differs_in_set_alone = [](nlohmann::ordered_json a, nlohmann::ordered_json b) {
    EXPECT_NE(a["made_from"]["set"], b["made_from"]["set"]);
    a["made_from"].erase("set");
    b["made_from"].erase("set");
    EXPECT_EQ(a.dump(), b.dump());
  };
  differs_in_set_alone(result_of("named", {"--faults", "detector.misses=3"}),
                       result_of("plain", {"--set", "detector_noise.miss_probability=0.2"}));
  differs_in_set_alone(result_of("none", {"--faults", "camera.blur=0"}), result_of("without", {}));
}

TEST_F(RunWithFaults, RefusesInOneLine) {
  const Outcome outcome = run_stereobench(
      {"sweep", scenario_path("open_field"), "--vary", "faults.camera.blur=0,1", "--dry-run"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--set faults.camera.blur: this fault is of cameras"));
}

}  // namespace
}  // namespace stereobench::harness
