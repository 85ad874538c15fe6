/// --backend: what each of them is on machines that have it, and the one line on machines that have not.
#include <algorithm>

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "renderer/gl/context_osmesa.h"
#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string kBallCircle = scenario_path("ball_circle");

void expect_one_line(const Outcome& outcome, const std::string& message) {
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_THAT(outcome.err, StartsWith("stereobench: "));
  EXPECT_THAT(outcome.err, HasSubstr(message));
}

/// The end of the line that begins so.
std::string line_of(const Outcome& outcome, const std::string& begin) {
  const std::size_t at = outcome.out.find("\n" + begin);
  EXPECT_NE(at, std::string::npos) << outcome.out;
  const std::size_t from = at + 1 + begin.size();
  return outcome.out.substr(from, outcome.out.find('\n', from) - from);
}

class EglOption : public testing::Test {
 protected:
  void SetUp() override {
    if (::dlopen("libEGL.so.1", RTLD_LAZY) == nullptr) GTEST_SKIP() << "no libEGL.so.1 on this machine";
  }
};

class BothOptions : public EglOption {
 protected:
  void SetUp() override {
    EglOption::SetUp();
    if (!renderer::has_osmesa()) GTEST_SKIP() << "no libOSMesa.so.8 on this machine";
  }
};

/// An environment without a library. A file of its name that is no library stops the search for another, as
/// if there were none.
/// @param folder for that file
Environment without(const std::string& library, const TestFolder& folder) {
  folder.write(library, "");
  return {"LD_LIBRARY_PATH=" + folder.path().string()};
}

/// The commands that render, a short one of each.
std::vector<std::vector<std::string>> rendering_commands() {
  return {{"run", kBallCircle, "--set", "path.laps=0.02"},
          {"render", kBallCircle, "--set", "path.laps=0.02"},
          {"sweep", kBallCircle, "--vary", "path.laps=0.02,0.04"},
          {"doctor"}};
}

TEST(BackendOption, AnUnknownOneIsOneLine) {
  for (const auto& command : rendering_commands()) {
    expect_one_line(run_stereobench(with(command, {"--backend", "opengl"})),
                    "--backend: no back end is called 'opengl'; there are osmesa, egl, egl-gpu");
  }
}

// Mutations: a command that renders with osmesa whatever it is told; a program that is linked with libEGL.
TEST_F(BothOptions, WithoutLibeglOsmesaRendersAndTheOthersAreOneLine) {
  const TestFolder scratch;
  const Environment no_egl = without("libEGL.so.1", scratch);
  EXPECT_EQ(run_stereobench({"doctor"}, no_egl).exit_code, 0);
  for (const auto& command : rendering_commands()) {
    for (const char* backend : {"egl", "egl-gpu"}) {
      std::vector<std::string> arguments = with(command, {"--backend", backend});
      if (command != std::vector<std::string>{"doctor"})
        arguments = with(arguments, {"--out", (scratch.path() / command.front() / backend).string()});
      expect_one_line(run_stereobench(arguments, no_egl), "install it (Debian: libegl1)");
    }
  }
}

TEST_F(EglOption, WithoutADriverIsOneLine) {
  const TestFolder scratch;
  const Environment no_driver = {"__EGL_VENDOR_LIBRARY_DIRS=" + scratch.path().string()};
  expect_one_line(run_stereobench({"doctor", "--backend", "egl"}, no_driver),
                  "install Mesa's (Debian: libegl-mesa0,");
  expect_one_line(run_stereobench({"doctor", "--backend", "egl-gpu"}, no_driver), "none of EGL's 0 devices");
}

// Mutation: a display of X11's, which the variable asks for, instead of a device's.
TEST_F(BothOptions, DoctorFindsTheRasteriserAndThePixelsOfOsmesa) {
  const Outcome osmesa = run_stereobench({"doctor"});
  const Outcome egl = run_stereobench({"doctor", "--backend", "egl"}, {"EGL_PLATFORM=x11"});
  ASSERT_EQ(egl.exit_code, 0) << egl.err;
  EXPECT_THAT(line_of(osmesa, "GL "), HasSubstr("osmesa: "));
  EXPECT_THAT(line_of(egl, "GL "), HasSubstr("egl: "));
  EXPECT_EQ(line_of(egl, "fingerprint "), line_of(osmesa, "fingerprint "));
}

// Without fused multiply-add the same rasteriser of the same width draws other pixels.
// Mutation: a hash of nothing.
TEST(Doctor, FingerprintsSeeTheSmallestDifferenceOfPixels) {
  const Outcome usual = run_stereobench({"doctor"}, {"LP_NATIVE_VECTOR_WIDTH=256"});
  if (line_of(usual, "CPU ").find(" fma") == std::string::npos) GTEST_SKIP() << "no fused multiply-add here";
  const Outcome lesser =
      run_stereobench({"doctor"}, {"LP_NATIVE_VECTOR_WIDTH=256", "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1"});
  EXPECT_EQ(line_of(lesser, "GL "), line_of(usual, "GL "));
  EXPECT_NE(line_of(lesser, "fingerprint "), line_of(usual, "fingerprint "));
}

// Property: back ends of equal pixels give equal results; run.json differs in the name alone.
TEST_F(BothOptions, RunsAsOsmesaDoesAndSaysSo) {
  const TestFolder scratch;
  const auto json_of = [&](const std::string& backend) {
    const std::filesystem::path out = scratch.path() / backend;
    const Outcome outcome = run_stereobench({"run", kBallCircle, "--set", "path.laps=0.05", "--seeds", "0..1",
                                             "--particles", "10", "--set", "gates=[]", "--jobs", "2",
                                             "--backend", backend, "--out", out.string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(bytes_of(out / "run.json"));
  };
  nlohmann::json egl = json_of("egl");
  nlohmann::json osmesa = json_of("osmesa");
  EXPECT_EQ(egl["renderer"]["backend"], "egl");
  EXPECT_EQ(osmesa["renderer"]["backend"], "osmesa");
  egl["renderer"] = osmesa["renderer"] = nullptr;
  EXPECT_EQ(egl, osmesa);
  EXPECT_EQ(bytes_of(scratch.path() / "egl/frames/seed0_step0000.png"),
            bytes_of(scratch.path() / "osmesa/frames/seed0_step0000.png"));
}

// Red where a command takes osmesa for the default, where the name is written that was asked for and not that
// which drew, and where the program needs libOSMesa to start.
TEST_F(EglOption, WithoutLibosmesaItIsTheDefault) {
  const TestFolder scratch;
  const Environment no_osmesa = without("libOSMesa.so.8", scratch);
  const auto run = [&](const std::string& name, const std::vector<std::string>& options) {
    const std::string out = (scratch.path() / name).string();
    const Outcome outcome =
        run_stereobench(with({"run", kBallCircle, "--set", "path.laps=0.05", "--seeds", "0", "--particles",
                              "10", "--set", "gates=[]", "--out", out},
                             options),
                        no_osmesa);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return bytes_of(out + "/run.json");
  };
  const std::string by_default = run("default", {});
  EXPECT_EQ(nlohmann::json::parse(by_default)["renderer"]["backend"], "egl");
  EXPECT_EQ(by_default, run("egl", {"--backend", "egl"}));
  EXPECT_THAT(line_of(run_stereobench({"doctor"}, no_osmesa), "GL "), HasSubstr("egl: "));
  for (const auto& command : rendering_commands()) {
    const std::vector<std::string> elsewhere = {"--out", (scratch.path() / command.front()).string()};
    const bool is_doctor = command == std::vector<std::string>{"doctor"};
    expect_one_line(run_stereobench(with(with(command, {"--backend", "osmesa"}),
                                         is_doctor ? std::vector<std::string>() : elsewhere),
                                    no_osmesa),
                    "install it (Debian: libosmesa6) or render with egl");
  }
}

// Red where the search ends at the first library that is not there.
TEST(BackendOption, WithoutAnyIsOneLine) {
  const TestFolder scratch;
  without("libOSMesa.so.8", scratch);
  const Environment neither = without("libEGL.so.1", scratch);
  expect_one_line(run_stereobench({"doctor"}, neither), "install it (Debian: libegl1) or render with osmesa");
}

TEST_F(EglOption, SweepsWithIt) {
  const TestFolder scratch;
  const Outcome outcome =
      run_stereobench({"sweep", kBallCircle, "--set", "gates=[]", "--vary", "path.laps=0.02,0.04", "--seeds",
                       "0", "--particles", "5", "--backend", "egl", "--out", scratch.path().string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(bytes_of(scratch.path() / "sweep.json"));
  for (const auto& cell : json["cells"]) EXPECT_EQ(cell["run"]["renderer"]["backend"], "egl");
}

// Mutation: the back end left out of the data set's identity.
TEST_F(BothOptions, ADataSetIsNotFinishedByAnotherBackEnd) {
  const TestFolder scratch;
  const std::vector<std::string> render = {"render",         kBallCircle, "--set",
                                           "path.laps=0.02", "--out",     (scratch.path() / "data").string()};
  ASSERT_EQ(run_stereobench(with(render, {"--backend", "osmesa"})).exit_code, 0);
  expect_one_line(run_stereobench(with(render, {"--backend", "egl"})),
                  "holds a data set of another backend;");
}

TEST(BackendOption, AnOracleIsRenderedByNone) {
  const TestFolder scratch;
  const Outcome outcome = run_stereobench({"run", scenario_path("open_field"), "--seeds", "0", "--particles",
                                           "5", "--backend", "egl-gpu", "--out", scratch.path().string()});
  EXPECT_LE(outcome.exit_code, 1) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(bytes_of(scratch.path() / "run.json"))["renderer"]["backend"], "none");
}

/// EGL with a software device, a card that does not start and one that does: see tests/fake_egl.
Environment with_card(const std::string& renderer) {
  return {std::string("LD_LIBRARY_PATH=") + STEREOBENCH_FAKE_EGL, "FAKE_EGL_RENDERER=" + renderer};
}

// Mutation: an end at the first card that does not start.
TEST_F(EglOption, GpuIsTheFirstCardThatStarts) {
  const Outcome outcome = run_stereobench({"doctor", "--backend", "egl-gpu"}, with_card("Card 7"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(line_of(outcome, "GL "), HasSubstr("egl-gpu: OpenGL 4.5"));
  EXPECT_THAT(line_of(outcome, "GL "), HasSubstr("Card 7"));
  EXPECT_THAT(line_of(outcome, "fingerprint "), HasSubstr("Card 7"));
}

// Mutation: not asking what draws.
TEST_F(EglOption, ACardThatFallsBackOnSoftwareIsNone) {
  for (const char* renderer :
       {"llvmpipe (LLVM 15.0.6, 256 bits)", "zink (llvmpipe (LLVM 15.0.6, 256 bits))"}) {
    expect_one_line(run_stereobench({"doctor", "--backend", "egl-gpu"}, with_card(renderer)),
                    "none of EGL's 3 devices is a graphics card");
  }
}

// Mutation: trying all devices, whatever their kind, until one draws by llvmpipe.
TEST_F(EglOption, SoftwareLeavesCardsAlone) {
  const Environment no_touching = {std::string("LD_LIBRARY_PATH=") + STEREOBENCH_FAKE_EGL};
  const Outcome outcome = run_stereobench({"doctor", "--backend", "egl"}, no_touching);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

// Mutation: not asking what draws.
TEST_F(EglOption, SoftwareThatIsNotLlvmpipeIsNone) {
  expect_one_line(run_stereobench({"doctor", "--backend", "egl"}, with_card("softpipe")),
                  "EGL has no OpenGL 4.5 by llvmpipe");
}

}  // namespace
}  // namespace stereobench::harness
