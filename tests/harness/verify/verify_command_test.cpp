#include <gmock/gmock.h>

#include "tests/harness/commands/program.h"
#include "tests/harness/verify/planted_set.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(VerifyCommand, EndsWithWhatItFound) {
  const PlantedSet set("plain");
  const std::string folder = set.path("").string();
  const Outcome clean = run_stereobench({"verify", folder});
  EXPECT_EQ(clean.exit_code, 0) << clean.err;
  EXPECT_THAT(clean.out,
              AllOf(HasSubstr("plain: plain, no faults; checked: 6 frames"),
                    HasSubstr("could not check: bytes of files: there is no manifest-sha256.txt")));
  std::filesystem::remove(set.path("left/000004.png"));
  const Outcome faulty = run_stereobench({"verify", folder, "--as", "plain"});
  EXPECT_EQ(faulty.exit_code, 1);
  EXPECT_THAT(faulty.out,
              AllOf(HasSubstr("left/000004.png: frame 000004: missing frame"), HasSubstr(" fault")));
  const Outcome none = run_stereobench({"verify", scenario_path("office")});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(run_stereobench({"verify", folder, "--as", "tum"}).exit_code, 2);
}

}  // namespace
}  // namespace stereobench::harness
