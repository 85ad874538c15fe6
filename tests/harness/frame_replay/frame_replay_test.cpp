/// Frames that are rendered again give what the run gave.
#include "harness/frame_replay/frame_replay.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "harness/experiment/experiment.h"
#include "harness/experiment/write_experiment.h"
#include "harness/io/sha256.h"
#include "harness/run/seed_drive.h"
#include "renderer/backend.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

using testing::AllOf;
using testing::HasSubstr;
using Lines = std::vector<std::string>;

constexpr const char* kBlobs = "/assets/detectors/colour_blobs.py";

/// A short drive in small pictures.
Invocation short_invocation(Lines more = {}) {
  Lines overrides = {"path.laps=0.15", "rig.width_px=512", "rig.height_px=384", "rig.focal_px=443.5"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return {.scenario = STEREOBENCH_SOURCE_DIR "/assets/scenarios/ball_circle.yaml",
          .overrides = overrides,
          .folder = fs::current_path()};
}

/// The lines of detections.csv of a seed, as `run` gets them.
std::string lines_of_run(const Invocation& invocation, std::uint64_t seed) {
  renderer::MeshCache meshes;
  const Experiment experiment =
      read_experiment(invocation.scenario, invocation.overrides, meshes.occluders());
  return drive_seed({&experiment, seed, {.detections = true}}, [](double) {}).detections;
}

/// Those of frames that are rendered again, each in a call of its own.
std::string lines_of_replay(const Invocation& invocation, std::uint64_t seed, bool with_before = false) {
  renderer::MeshCache meshes;
  const std::size_t steps =
      read_experiment(invocation.scenario, invocation.overrides, meshes.occluders()).scenario.path.size();
  std::string lines;
  for (std::size_t step = 0; step < steps; ++step) {
    const FrameName name{seed, step};
    lines += replay_frames(invocation, std::span(&name, 1), with_before).front().rows;
  }
  return lines;
}

// Mutations: the noise or the world of seed 0; a rig as it is believed to be.
TEST(FrameReplay, OfEachFrameGivesItsLinesOfTheRun) {
  for (const std::uint64_t seed : {0u, 3u}) {
    const std::string lines = lines_of_run(short_invocation(), seed);
    EXPECT_GT(std::count(lines.begin(), lines.end(), '\n'), 10);
    EXPECT_EQ(lines_of_replay(short_invocation(), seed), lines);
  }
}

// Mutations: --detector's line of the run forgotten; the command called from here.
TEST(FrameReplay, CallsAProgramFromWhereTheRunDid) {
  const std::string root = STEREOBENCH_SOURCE_DIR;
  const std::string lines =
      lines_of_run(short_invocation({"detector=/usr/bin/python3 '" + root + kBlobs + "'"}), 1);
  EXPECT_NE(lines, lines_of_run(short_invocation(), 1));
  const TestFolder folder;
  fs::create_directory(folder.path() / "it's here");
  fs::copy_file(root + kBlobs, folder.path() / "it's here/blobs.py");
  Invocation relative = short_invocation({"detector=/usr/bin/python3 blobs.py"});
  relative.folder = folder.path() / "it's here";
  std::vector<FrameName> names;
  for (std::size_t step = 0; step < 7; ++step) names.push_back({1, step});
  std::string lines_now;
  for (const ReplayedFrame& frame : replay_frames(relative, names)) lines_now += frame.rows;
  EXPECT_EQ(lines_now, lines);
}

// Our detector learns by how many rows the cameras of this rig are apart. Mutation: with_before ignored.
TEST(FrameReplay, ShowsADetectorWithAMemoryTheFramesBefore) {
  const Invocation turned =
      short_invocation({"rig.right_turn_deg=[0.2,0,0.1]", "believed_rig={right_turn_deg: [0, 0, 0]}"});
  const std::string lines = lines_of_run(turned, 0);
  EXPECT_NE(lines_of_replay(turned, 0), lines);
  EXPECT_EQ(lines_of_replay(turned, 0, true), lines);
}

// Mutations: the order in which frames are asked for; one twice.
TEST(FrameReplay, IsInTheOrderOfSeedsAndSteps) {
  const std::vector<FrameName> asked = {{2, 3}, {0, 4}, {2, 1}, {0, 4}};
  std::vector<FrameName> got;
  for (const ReplayedFrame& frame : replay_frames(short_invocation(), asked)) got.push_back(frame.name);
  EXPECT_EQ(got, (std::vector<FrameName>{{0, 4}, {2, 1}, {2, 3}}));
}

TEST(FrameReplay, RefusesFramesThatThereAreNot) {
  const auto refusal = [](const Invocation& invocation, std::size_t step) {
    const FrameName name{0, step};
    try {
      replay_frames(invocation, std::span(&name, 1));
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal(short_invocation(), 99), HasSubstr("ball_circle has the steps 0 to 6 (got 99)"));
  Invocation oracle = short_invocation();
  oracle.scenario = STEREOBENCH_SOURCE_DIR "/assets/scenarios/open_field.yaml";
  oracle.overrides = {};
  EXPECT_THAT(refusal(oracle, 0), HasSubstr("open_field is the oracle, which has no pictures"));
  EXPECT_THAT(refusal(short_invocation({"shutter.drop_probability=1"}), 2),
              HasSubstr("seed 0 step 2: the shutter drops this frame"));
}

TEST(FrameName, IsReadStrictly) {
  EXPECT_EQ(parse_frame_name("18446744073709551615:120"), (FrameName{18446744073709551615u, 120}));
  for (const char* bad :
       {"", "3", ":", "3:", ":3", "-1:3", "1:-3", "1:2:3", "1 :2", "99999999999999999999:0"})
    EXPECT_THROW(parse_frame_name(bad), std::runtime_error) << bad;
  EXPECT_EQ(file_stem({3, 7}), "seed3_step0007");
}

/// A folder as `run` leaves it behind, of a copy of a scenario with its mesh.
class ResultFolder : public testing::Test {
 protected:
  ResultFolder() {
    const std::string assets = STEREOBENCH_SOURCE_DIR "/assets";
    for (const char* name : {"scenarios/ball_circle.yaml", "meshes/column.obj"}) {
      fs::create_directories((folder_.path() / name).parent_path());
      fs::copy_file(fs::path(assets) / name, folder_.path() / name);
    }
    invocation_ = short_invocation({R"(description=a "quoted" word, it's here)"});
    invocation_.scenario = folder_.path() / "scenarios/ball_circle.yaml";
    folder_.write("out/" + std::string(kInvocation), invocation_text(invocation_));
    nlohmann::json files;
    files["../meshes/column.obj"] = sha256_of_file(folder_.path() / "meshes/column.obj");
    const std::string scenario = with_overrides(invocation_.scenario, invocation_.overrides);
    const nlohmann::json made_from = {{"scenario_sha256", sha256_of(scenario)}, {"files_sha256", files}};
    folder_.write("out/run.json", nlohmann::json{{"made_from", made_from}}.dump());
  }

  std::string refusal(const fs::path& scenario = {}) const {
    try {
      read_invocation(folder_.path() / "out", scenario);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  TestFolder folder_;
  Invocation invocation_;
};

TEST_F(ResultFolder, IsReadBack) {
  const Invocation read = read_invocation(folder_.path() / "out/run.json");
  EXPECT_EQ(read.scenario, invocation_.scenario);
  EXPECT_EQ(read.overrides, invocation_.overrides);
  EXPECT_EQ(read.folder, invocation_.folder);
  EXPECT_STREQ(renderer::name_of(read.backend), renderer::name_of(invocation_.backend));
}

// Mutations: hashes that are not compared; of the scenario alone.
TEST_F(ResultFolder, OfAnotherScenarioIsRefused) {
  const std::string before = folder_.read("scenarios/ball_circle.yaml");
  folder_.write("scenarios/ball_circle.yaml", before + "\ndraw_every: 3\n");
  EXPECT_THAT(refusal(), AllOf(HasSubstr("ball_circle.yaml is not as it was"), HasSubstr("run it again")));
  folder_.write("scenarios/ball_circle.yaml", before + "\n# a comment is no change\n");
  EXPECT_EQ(refusal(), "");
  folder_.write("meshes/column.obj", folder_.read("meshes/column.obj") + "\n");
  EXPECT_THAT(refusal(), HasSubstr("the file ../meshes/column.obj of "));
}

// Mutation: --scenario ignored.
TEST_F(ResultFolder, MayBeAskedForWithAScenarioThatMoved) {
  fs::rename(folder_.path() / "scenarios", folder_.path() / "moved");
  EXPECT_THAT(refusal(), HasSubstr("scenarios/ball_circle.yaml is not there: --scenario says where"));
  EXPECT_EQ(refusal(folder_.path() / "moved/ball_circle.yaml"), "");
}

TEST_F(ResultFolder, OfWhichSomethingIsMissingIsRefused) {
  folder_.write("out/run.json", "{}");
  EXPECT_THAT(refusal(), HasSubstr("run.json: expected \"made_from\""));
  folder_.write("out/run.json", R"({"made_from": 3})");
  EXPECT_THAT(refusal(), HasSubstr("run.json: made_from: expected"));
  folder_.write("out/run.json", R"({"made_from": {"scenario_sha256": "x", "files_sha256": []}})");
  EXPECT_THAT(refusal(), HasSubstr("made_from.files_sha256: expected an object"));
  folder_.write("out/invocation.json",
                R"({"scenario": "/a", "folder": "/b", "overrides": 3, "backend": "egl"})");
  EXPECT_THAT(refusal(), HasSubstr("invocation.json: overrides: expected a list"));
  folder_.write("out/invocation.json",
                R"({"scenario": "/a", "folder": "/b", "overrides": [], "backend": "x"})");
  EXPECT_THAT(refusal(), HasSubstr("invocation.json: backend: expected the name of a back end"));
  fs::remove(folder_.path() / "out/invocation.json");
  EXPECT_THAT(refusal(), HasSubstr("has no invocation.json"));
  fs::remove(folder_.path() / "out/run.json");
  EXPECT_THAT(refusal(), HasSubstr("expected a folder with a run.json"));
  folder_.write("out/plain/run.json", "{}");  // a suite's folder in place of its case's
  EXPECT_THAT(refusal(), HasSubstr("; in it have one: plain"));
}

}  // namespace
}  // namespace stereobench::harness
