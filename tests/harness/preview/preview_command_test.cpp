#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/harness/commands/program.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class PreviewCommand : public testing::Test {
 protected:
  const TestFolder scratch_;
  std::string place(const char* name) const { return (scratch_.path() / name).string(); }
  void SetUp() override {
    ASSERT_EQ(run_stereobench({"render", scenario_path("ball_circle"), "--set", "path.laps=0.06", "--frames",
                               "0..1", "--set", "rig.width_px=160", "--set", "rig.height_px=120", "--set",
                               "rig.focal_px=140", "--format", "plain,tum", "--out", place("sets")})
                  .exit_code,
              0);
  }
  /// A program that is found in the place of ffmpeg.
  void put_ffmpeg(const std::string& script) const {
    scratch_.write("bin/ffmpeg", "#!/bin/sh\n" + script);
    fs::permissions(scratch_.path() / "bin/ffmpeg", fs::perms::owner_all);
  }
  Outcome preview(const std::vector<std::string>& more, const std::string& path = "/usr/bin:/bin") const {
    std::vector<std::string> words = {"preview", place("sets/plain")};
    words.insert(words.end(), more.begin(), more.end());
    return run_stereobench(words, {"PATH=" + path});
  }
};

TEST_F(PreviewCommand, MakesASheetOfAnyFormat) {
  const Outcome plain = preview({"--out", place("new/sheet.png")});
  EXPECT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_EQ(plain.out, fmt::format("plain: 2 of 2 pairs in {}\n", place("new/sheet.png")));
  EXPECT_LT(fs::file_size(place("new/sheet.png")), 1'000'000U);
  const Outcome tum =
      run_stereobench({"preview", place("sets/tum"), "--frames", "1", "-o", place("tum.png")});
  EXPECT_EQ(tum.out, fmt::format("tum: 1 of 2 pairs in {}\n", place("tum.png"))) << tum.err;
}

// The program gets each picture whole, 320 x 120 of both: here it counts the bytes.
TEST_F(PreviewCommand, HandsAFilmToFfmpeg) {
  put_ffmpeg("for last; do :; done\nprintf '%s ' \"$@\" > '" + place("words") + "'\nwc -c > \"$last\"\n");
  const std::string path = place("bin") + ":/usr/bin:/bin";
  const Outcome outcome = preview({"--out", place("sheet.png"), "--video", place("film.mp4")}, path);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr(fmt::format("plain: a film of 2 pairs in {}\n", place("film.mp4"))));
  EXPECT_EQ(scratch_.read("film.mp4"), fmt::format("{}\n", 2 * 3 * 320 * 120));
  EXPECT_THAT(scratch_.read("words"), HasSubstr("-f rawvideo -pix_fmt bgr24 -s 320x120 -r 10 -i -"));
  put_ffmpeg("cat > /dev/null\necho 'no such encoder' >&2\nexit 1\n");
  const Outcome failed = preview({"--out", place("other.png"), "--video", place("other.mp4")}, path);
  EXPECT_EQ(failed.exit_code, 2);
  EXPECT_EQ(failed.err, fmt::format("stereobench: {}: made no film: no such encoder\n", place("bin/ffmpeg")));
  EXPECT_FALSE(fs::exists(place("other.png")));
  EXPECT_FALSE(fs::exists(place("other.mp4")));
}

TEST_F(PreviewCommand, RefusesInOneLine) {
  fs::create_directory(scratch_.path() / "empty");
  const Outcome none = preview({"--out", place("sheet.png"), "--video", place("film.mp4")}, place("empty"));
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(
      none.err,
      "stereobench: --video: no program called ffmpeg is in the folders of PATH; install it (Debian: apt-get "
      "install ffmpeg) or leave --video out\n");
  EXPECT_FALSE(fs::exists(place("sheet.png")));
  EXPECT_THAT(run_stereobench({"preview", place("empty")}).err, HasSubstr("expected a data set (plain,"));
}

}  // namespace
}  // namespace stereobench::harness
