/// Lists within lists within lists, in each file that people bring.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;

std::string nested(std::size_t levels) {
  return std::string(levels, '[') + std::string(levels, ']');
}

void expect_one_line(const Outcome& outcome, int exit_code, const std::string& message) {
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(message));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_LT(outcome.err.size(), 1000U);
}

// Mutation: no limit in parse_line, or in parse_yaml (each ended with signal 11).
TEST(NestedInput, IsBadInputWhereverItStands) {
  const TestFolder scratch;
  const std::string deep = nested(80'000);
  const std::string marks = scratch.write("marks.json", R"({"marks": [{"picture": )" + deep + "}]}");
  const std::string palette = scratch.write("palette.json", R"({"format": )" + deep + "}");
  const std::string rig = scratch.write("rig.yaml", "%YAML:1.0\n---\nK: " + deep + "\n");
  const std::string scenario = scratch.write("deep.yaml", "name: deep\nworld: " + deep + "\n");
  const std::string out = (scratch.path() / "out").string();
  expect_one_line(run_stereobench({"learn-palette", marks, "-o", out}), 2, "marks.json: expected lists");
  expect_one_line(run_stereobench({"detect", "a.png", "--palette", palette}), 2,
                  "palette.json: expected lists");
  expect_one_line(run_stereobench({"detect", "a.png", "--rig", rig}), 2, "rig.yaml: expected a calibration");
  expect_one_line(run_stereobench({"world", scenario}), 2, "deep.yaml:2: expected YAML (lists and maps at");
  expect_one_line(run_stereobench({"world", scenario_path("ball_circle"), "--set", "rig=" + nested(60'000)}),
                  2, "--set rig: expected a YAML value (lists and maps");
}

TEST(NestedInput, AsADetectorsAnswerEndsTheRun) {
  const TestFolder scratch;
  const std::string script =
      scratch.write("deep.sh", R"(read setup; read frame; printf '{"frame": 0, "balls": [{"colour": '
head -c 80000 /dev/zero | tr '\0' '['; head -c 80000 /dev/zero | tr '\0' ']'; echo '}]}'; cat >/dev/null
)");
  const Outcome outcome =
      run_stereobench({"run", scenario_path("ball_circle"), "--set", "path.laps=0.06", "--seeds", "0",
                       "--detector", "sh " + script, "--out", (scratch.path() / "out").string()});
  expect_one_line(outcome, 4, "frame 0: expected lists and objects at most 64 deep");
}

}  // namespace
}  // namespace stereobench::harness
