/// `stereobench sweep` as its users run it: cells are what runs are, with pictures shared or not.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::vector<std::string> kQuick = {"--set",     "path.laps=0.12",
                                         "--set",     "rig.width_px=512",
                                         "--set",     "rig.height_px=384",
                                         "--set",     "rig.focal_px=443",
                                         "--filters", "ekf",
                                         "--seeds",   "0..2",
                                         "--set",     "gates=[]"};

std::filesystem::path sweep_in(const TestFolder& scratch, const std::string& name,
                               const std::vector<std::string>& more) {
  const auto out = scratch.path() / name;
  const Outcome outcome = run_stereobench(
      with(with({"sweep", scenario_path("ball_circle"), "--out", out.string()}, kQuick), more));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return out;
}

json metrics_of_run(const TestFolder& scratch, const std::vector<std::string>& set) {
  const auto out = scratch.path() / "run";
  std::filesystem::remove_all(out);
  std::vector<std::string> words = {"run", scenario_path("ball_circle"), "--out", out.string()};
  for (const std::string& line : set) words.insert(words.end(), {"--set", line});
  EXPECT_EQ(run_stereobench(with(words, kQuick)).exit_code, 0);
  return json::parse(bytes_of(out / "run.json"));
}

// Cells that share their pictures have what a run of their own has, also where they are few to a picture.
// Mutations: the first cell's sight for all; faults of one cell in the next; a sight without the rig that is
// believed in.
TEST(SweepCommand, CellsThatSharePicturesAreAsRuns) {
  const TestFolder scratch;
  const auto out = sweep_in(scratch, "sweep",
                            {"--vary", "detector_noise.centre_sd_px=0,0.5", "--vary",
                             "believed_rig.baseline_m=0.12,0.1212", "--vary", "camera.noise_sd_levels=2,4"});
  const json sweep = json::parse(bytes_of(out / "sweep.json"));
  ASSERT_EQ(sweep["cells"].size(), 8U);
  for (const std::size_t index : {0U, 3U, 6U, 7U}) {
    const json& cell = sweep["cells"][index];
    std::vector<std::string> set;
    for (const auto& [key, value] : cell["values"].items())
      set.push_back(key + "=" + value.get<std::string>());
    const json run = metrics_of_run(scratch, set);
    for (const char* block : {"vision", "filters", "bound", "batch", "detector_noise"})
      EXPECT_EQ(cell["run"][block], run[block]) << index << " " << block;
  }
}

// A detector's program is asked once for each pair, however many cells there are. Mutation: a look for each
// cell.
TEST(SweepCommand, OfDetectorNoiseLooksOnce) {
  const TestFolder scratch;
  const auto script = scratch.path() / "counting.py";
  const auto frames = scratch.path() / "frames";
  std::ofstream(script) << "import sys, json\n"
                           "for line in sys.stdin:\n"
                           "    asked = json.loads(line)\n"
                           "    if 'frame' not in asked: continue\n"
                        << "    open('" << frames.string() << "', 'a').write('frame\\n')\n"
                        << "    print(json.dumps({'frame': asked['frame'], 'balls': []}), flush=True)\n";
  const auto frames_for = [&](const std::string& levels) {
    std::filesystem::remove(frames);
    sweep_in(scratch, "sweep",
             {"--vary", "detector_noise.false_per_frame=" + levels, "--detector",
              "/usr/bin/python3 '" + script.string() + "'"});
    return bytes_of(frames).size();
  };
  const std::size_t one = frames_for("1");
  EXPECT_GT(one, 0U);
  EXPECT_EQ(frames_for("0,1,2,3,4"), one);
}

// Mutations: differences to the cell before; the sign.
TEST(SweepCommand, ComparesCellsWithTheReference) {
  const TestFolder scratch;
  const auto out =
      sweep_in(scratch, "sweep", {"--vary", "detector_noise.centre_sd_px=0,0.5,2", "--paired-to", "0.5"});
  const json sweep = json::parse(bytes_of(out / "sweep.json"));
  EXPECT_EQ(sweep["paired_to"], "0.5");
  const auto mean_of = [&](std::size_t cell) {
    return sweep["cells"][cell]["run"]["filters"]["ekf"]["ate_rms_m"]["mean"].get<double>();
  };
  for (std::size_t cell = 0; cell < 3; ++cell) {
    const json& difference = sweep["cells"][cell]["differences"][1];
    EXPECT_EQ(difference["filter"], "ekf");
    EXPECT_NEAR(difference["ate_m"]["mean"].get<double>(), mean_of(cell) - mean_of(1), 1e-12);
  }
  EXPECT_THAT(bytes_of(out / "sweep.csv"), HasSubstr("ate_difference_m,ate_difference_ci95_m,p"));
}

// The table stays in order. Mutations: values at the end of the list; no value at all.
TEST(SweepCommand, AddsValuesInOrder) {
  const TestFolder scratch;
  const auto out = sweep_in(
      scratch, "sweep", {"--vary", "detector_noise.range_scale=0.8,1,1.2", "--adaptive", "2", "--jobs", "2"});
  const json sweep = json::parse(bytes_of(out / "sweep.json"));
  double before = 0.0;
  for (const json& cell : sweep["cells"]) {
    const double value = std::stod(cell["values"]["detector_noise.range_scale"].get<std::string>());
    EXPECT_GT(value, before);
    before = value;
  }
  EXPECT_EQ(sweep["cells"].size(), 5U);
}

TEST(SweepCommand, RefusesWhatDoesNotGoTogether) {
  const auto complaint = [](const std::vector<std::string>& more) {
    const Outcome outcome = run_stereobench(
        with({"sweep", scenario_path("open_field"), "--dry-run", "--vary", "particles=1,2,3"}, more));
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.err;
  };
  EXPECT_THAT(complaint({"--paired-to", "4"}),
              HasSubstr("--paired-to: expected one of the values of --vary particles"));
  EXPECT_THAT(complaint({"--adaptive", "2", "--vary", "draw_every=1,2"}),
              HasSubstr("--adaptive: expected one --vary, of one key"));
}

}  // namespace
}  // namespace stereobench::harness
