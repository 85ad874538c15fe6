#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/harness/commands/program.h"
#include "tests/harness/verify/planted_set.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

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

// Mutations: the first data set alone; files named from the data set's folder; the manifest of the whole not
// looked at; a data set that is gone passed over.
TEST(VerifyCommand, ProvesCollectionsByTheirDataSets) {
  const TestFolder folder;
  folder.write("two.yaml", fmt::format(R"(
dataset: two
drives:
  - name: bend
    scenario: {}
    frames: 3..5
    seeds: {{train: 0, test: 1}}
)",
                                       kBend));
  const std::string out = (folder.path() / "two").string();
  ASSERT_EQ(run_stereobench({"dataset", (folder.path() / "two.yaml").string(), "--out", out}).exit_code, 0);
  const Outcome clean = run_stereobench({"verify", out});
  EXPECT_EQ(clean.exit_code, 0) << clean.out;
  EXPECT_THAT(clean.out, HasSubstr("two: collection, no faults; checked: 2 data sets, "));

  std::string picture = folder.read("two/test/bend/seed_1/right/000004.png");
  picture.back() = static_cast<char>(picture.back() ^ 1);
  folder.write("two/test/bend/seed_1/right/000004.png", picture);
  folder.write("two/index.csv", "folder\n");
  const Outcome faulty = run_stereobench({"verify", out});
  EXPECT_EQ(faulty.exit_code, 1);
  EXPECT_THAT(faulty.out, AllOf(HasSubstr("test/bend/seed_1/right/000004.png: "), HasSubstr("index.csv: "),
                                Not(HasSubstr("train/bend/seed_0"))));

  std::filesystem::remove_all(folder.path() / "two/train/bend/seed_0");
  EXPECT_THAT(run_stereobench({"verify", out}).out,
              HasSubstr("train/bend/seed_0: missing data set: collection.json lists it"));
}

}  // namespace
}  // namespace stereobench::harness
