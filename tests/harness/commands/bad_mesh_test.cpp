/// A mesh file that assimp cannot take is bad input of the scenario that names it: exit 2, one line, in time.
#include <algorithm>
#include <chrono>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;

std::string scenario_with(const std::string& mesh, const std::string& limits, const std::string& more = {}) {
  return R"(name: meshed
seeds: 0
particles: 5
sensor: stereo
identity: known
rig: {width_px: 64, height_px: 48, focal_px: 50, baseline_m: 0.1, height_m: 0.3}
odometry_noise: {v_per_v: 0.1}
path: {kind: circle, radius_m: 1, speed_mps: 0.5, laps: 0.1, step_s: 0.5}
world:
  balls: [{colour: 0, at_m: [2, 0, 0.1]}]
  mesh_limits: {)" +
         limits + "}\n  meshes: [{file: " + mesh + ", at_m: [1, 1, 0]" + more + "}]\n";
}

struct BadMesh {
  std::string name;
  std::string text;
  std::string limits;
  std::string message;
};

void PrintTo(const BadMesh& bad, std::ostream* out) {
  *out << bad.name;
}

std::string triangles(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n";
  return text;
}

class BadMeshTest : public testing::TestWithParam<BadMesh> {};

TEST_P(BadMeshTest, IsBadInputWithinFiveSecondsAndLeavesNothing) {
  const TestFolder scratch;
  const std::string mesh = scratch.write(GetParam().name, GetParam().text);
  const std::string file = scratch.write("meshed.yaml", scenario_with(mesh, GetParam().limits));
  const std::filesystem::path out = scratch.path() / "out";
  const std::vector<std::string> scattered = {"--set", "randomise={clutter: {}}"};
  for (const auto& [command, more] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"run", {}}, {"render", {}}, {"run", scattered}, {"world", {}}, {"world", scattered}}) {
    const auto start = std::chrono::steady_clock::now();
    std::vector<std::string> arguments = {command, file, "--out", out.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_stereobench(arguments);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(mesh + ": " + GetParam().message));
    EXPECT_FALSE(std::filesystem::exists(out / "run.json"));
    EXPECT_FALSE(std::filesystem::is_regular_file(out)) << "a plan";
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BadMeshTest,
    testing::Values(BadMesh{"empty.obj", "", "", "not a readable mesh"},
                    BadMesh{"broken.gltf", "{\"asset\": [", "", "not a readable mesh"},
                    BadMesh{"many.obj", triangles(11), "triangles: 10", "has more than 10 triangles"},
                    BadMesh{"big.obj", triangles(40000), "file_mib: 1", "is larger than 1 MiB"},
                    BadMesh{"slow.obj", triangles(100000), "seconds: 0.01", "takes longer than 0.01 s"}),
    [](const auto& test) { return test.param.name.substr(0, test.param.name.find('.')); });

// The scenario's other text is another data set, but there is no frame of the first one. Mutation: a folder
// that is taken before anything can be drawn.
TEST(RenderCommand, TakesTheRepairedScenarioWhereAMeshCouldNotBeRead) {
  const TestFolder scratch;
  const std::filesystem::path out = scratch.path() / "out";
  const auto render = [&](const std::string& mesh, const std::string& seeds) {
    const std::string file = scratch.write(
        "meshed.yaml", scenario_with(scratch.write(mesh + ".obj", triangles(mesh == "bad" ? 0 : 2)), ""));
    return run_stereobench({"render", file, "--seeds", seeds, "--jobs", "2", "--out", out.string()});
  };
  EXPECT_EQ(render("bad", "0").exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(out)) << "empty folders";
  EXPECT_EQ(render("bad", "0..1").exit_code, 2);
  const Outcome repaired = render("good", "0");
  EXPECT_EQ(repaired.exit_code, 0) << repaired.err;
  EXPECT_EQ(render("bad", "0").exit_code, 2) << "now there are frames";
}

// Mutation: the warning for the scenario as it stands, which allows nothing.
TEST(MissingTextures, AreAnErrorOrAWarningForEachFile) {
  const TestFolder scratch;
  scratch.write("house.mtl", "newmtl a\nmap_Kd gone.png\nnewmtl b\nmap_Kd ../out.png\n");
  const std::string mesh = scratch.write("house.obj",
                                         "mtllib house.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 1\nvt 0 0\nusemtl a\n"
                                         "f 1/1 2/1 3/1\nusemtl b\nf 1/1 3/1 2/1\n");
  const std::string file = scratch.write("meshed.yaml", scenario_with(mesh, "", ", material: file"));
  const std::string out = (scratch.path() / "out").string();
  const Outcome refused = run_stereobench({"render", file, "--out", out});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr(mesh + ": its texture gone.png does not exist"));
  EXPECT_THAT(refused.err, HasSubstr("its texture ../out.png leads out of the mesh's folder"));
  const Outcome grey = run_stereobench(
      {"run", file, "--out", out, "--set", "world.missing_texture=grey", "--set", "gates=[]"});
  EXPECT_EQ(grey.exit_code, 0) << grey.err;
  EXPECT_THAT(grey.err,
              HasSubstr("warning: drawn in grey: " + mesh + ": its texture gone.png does not exist"));
}

}  // namespace
}  // namespace stereobench::harness
