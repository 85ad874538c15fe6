#include <filesystem>

#include <gmock/gmock.h>

#include "tests/harness/commands/program.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class ExportCommand : public testing::Test {
 protected:
  const TestFolder scratch_;
  const std::string plain_ = (scratch_.path() / "plain").string();
  void SetUp() override {
    ASSERT_EQ(run_stereobench({"render", scenario_path("ball_circle"), "--set", "path.laps=0.06", "--frames",
                               "0..1", "--truth", "disparity", "--out", plain_})
                  .exit_code,
              0);
  }
  Outcome export_as(const std::string& names, const std::string& folder) const {
    return run_stereobench({"export", plain_, "--as", names, "--out", (scratch_.path() / folder).string()});
  }
};

// Mutations: one folder for both; a complete one written again without a word.
TEST_F(ExportCommand, WritesAFolderForEachFormat) {
  const Outcome both = export_as("euroc,middlebury", "both");
  EXPECT_EQ(both.exit_code, 0) << both.err;
  EXPECT_THAT(both.out, AllOf(HasSubstr("plain: 2 stereo pairs with poses, as in EuRoC MAV in "),
                              HasSubstr("both/middlebury/")));
  EXPECT_TRUE(fs::exists(scratch_.path() / "both/euroc/mav0/cam1/sensor.yaml"));
  EXPECT_TRUE(fs::exists(scratch_.path() / "both/middlebury/000001/disp0.pfm"));
  const Outcome alone = export_as("euroc", "alone");
  EXPECT_TRUE(fs::exists(scratch_.path() / "alone/mav0/cam1/sensor.yaml"));
  EXPECT_THAT(export_as("euroc", "alone").out, HasSubstr("is complete and is left as it is"));
}

// Mutations: each check left out.
TEST_F(ExportCommand, RefusesWhatItCannotWrite) {
  for (const auto& [names, folder, complaint] :
       {std::tuple("plain", "out", "--as: plain is the format that is exported from"),
        std::tuple("tun", "out", "--as: no format is called 'tun', did you mean tum?; there are"),
        std::tuple("tum,tum", "out", "--as: 'tum' stands there twice"),
        std::tuple("sceneflow", "out", "has no flow in the format exact; render it with --truth flow"),
        std::tuple("tum,euroc", "plain", "holds a data set itself, and cannot hold several"),
        std::tuple("tum", "plain", "holds a data set of another truth, format")}) {
    const Outcome outcome = export_as(names, folder);
    EXPECT_EQ(outcome.exit_code, 2) << names;
    EXPECT_THAT(outcome.err, HasSubstr(complaint));
    EXPECT_FALSE(fs::exists(scratch_.path() / "out")) << names;
  }
  EXPECT_FALSE(fs::exists(fs::path(plain_) / "tum"));
}

}  // namespace
}  // namespace stereobench::harness
