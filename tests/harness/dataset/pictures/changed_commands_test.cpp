#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/harness/commands/program.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class ChangedCommands : public testing::Test {
 protected:
  const TestFolder scratch_;
  std::string place(const char* name) const { return (scratch_.path() / name).string(); }
  Outcome render(const std::vector<std::string>& more, const char* out) const {
    return run_stereobench(with(
        {"render", scenario_path("ball_circle"), "--set", "path.laps=0.1", "--set", "rig.width_px=160",
         "--set", "rig.height_px=120", "--set", "rig.focal_px=140", "--frames", "0..2", "--out", place(out)},
        more));
  }
};

// Law: the commands of a changed set's card, and `export --as plain`, write the same bytes; `verify` finds
// nothing.
TEST_F(ChangedCommands, WriteTheSameOnBothWays) {
  const std::vector<std::string> options = {"--every", "2",   "--crop",    "7,9,150,105",
                                            "--scale", "1/3", "--picture", "grey"};
  const std::vector<std::string> truth = {"--truth", "balls,disparity,flow"};
  ASSERT_EQ(render(truth, "whole").exit_code, 0);
  const Outcome rendered = render(with(options, truth), "rendered");
  ASSERT_EQ(rendered.exit_code, 0) << rendered.err;
  const Outcome exported =
      run_stereobench(with({"export", place("whole"), "--as", "plain", "--out", place("exported")}, options));
  ASSERT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_EQ(scratch_.read("rendered/manifest-sha256.txt"), scratch_.read("exported/manifest-sha256.txt"));
  EXPECT_THAT(scratch_.read("exported/README.md"),
              AllOf(HasSubstr(" --every 2 --crop 7,9,150,105 --scale 1/3 --picture grey "),
                    HasSubstr("They are grey, of 8 bits: the BT.601 luma of the stored levels.")));
  const Outcome verified = run_stereobench({"verify", place("exported")});
  EXPECT_EQ(verified.exit_code, 0) << verified.out;
}

TEST_F(ChangedCommands, RefuseInOneLineAndMakeNothing) {
  for (const auto& [options, complaint] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--scale", "1/7"},
            "--scale: 160 x 120 px are no multiple of 7; cut them with --crop 0,0,154,119"},
           {{"--crop", "0,0,161,8"}, "--crop: 0,0,161,8 reaches out of the pictures, which are 160 x 120 px"},
           {{"--every", "0"},
            "--every: expected a whole number from 1 on, as 10 for each tenth pair (got '0')"},
           {{"--picture", "rgb"}, "--picture: expected colour, grey, bayer-rggb, linear16 (got 'rgb')"},
           {{"--picture", "grey", "--format", "plain,tum"},
            "the format tum has no place for pictures of the kind grey; it holds colour"},
           {{"--picture", "linear16", "--format", "euroc"},
            "the format euroc has no place for pictures of the kind linear16; it holds colour, grey"},
           {{"--scale", "1/2", "--set", "shutter.readout_s=0.01"},
            "--scale: rows of a rolling shutter (shutter.readout_s) look one after another, and poses hold "
            "for "
            "the middle row of the whole picture; leave it out"}}) {
    const Outcome outcome = render(options, "none");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err, fmt::format("stereobench: {}\n", complaint));
    EXPECT_FALSE(fs::exists(place("none")));
  }
}

// A mosaic and 16 bits are proved as other pictures are.
TEST_F(ChangedCommands, OtherKindsOfPictureAreProved) {
  for (const char* kind : {"bayer-rggb", "linear16"}) {
    ASSERT_EQ(render({"--picture", kind}, kind).exit_code, 0);
    const Outcome verified = run_stereobench({"verify", place(kind)});
    EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
    EXPECT_THAT(scratch_.read(fmt::format("{}/dataset.json", kind)),
                HasSubstr(fmt::format("\"kind\": \"{}\"", kind)));
  }
}

}  // namespace
}  // namespace stereobench::harness
