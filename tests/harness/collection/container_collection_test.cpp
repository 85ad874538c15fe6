/// Collections whose drives are one file each.
#include <gmock/gmock.h>

#include "tests/harness/collection/small_collection.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

// Law: joined from parts it is the same folder as in one piece, of recordings, archives and logs too; whoever
// was killed right after a manifest left parts, which go. Meant to catch: parts that were left are linked;
// that of a finished drive stay.
TEST(ContainerCollection, IsTheSameInPartsAndJoined) {
  const TestFolder scratch;
  const fs::path file = write_collection(scratch, "", "rosbag, mcap, webdataset, mrclam");
  const auto dataset = [&](const std::string& out, const std::string& shard) {
    const fs::path place = scratch.path() / out;
    EXPECT_EQ(
        run_stereobench({"dataset", file.string(), "--shard", shard, "--out", place.string()}).exit_code, 0);
    return place.string();
  };
  const fs::path whole = dataset("whole", "1/1");
  const std::string first = dataset("first", "1/2"), second = dataset("second", "2/2");
  const auto expected = files_below(whole);
  for (const char* name : {"train/circle-good/rosbag/seed_1/ball_circle_1.bag",
                           "test/circle-noisy/mcap/seed_7/ball_circle_7.mcap",
                           "train/circle-noisy/webdataset/seed_0/ball_circle_0-000000.tar",
                           "test/circle-good/mrclam/seed_7/Barcodes.dat"})
    EXPECT_TRUE(expected.contains(name)) << name;
  for (const auto& [name, bytes] : expected) EXPECT_EQ(name.find("dataset.parts"), std::string::npos) << name;
  EXPECT_TRUE(sha256sum_agrees(whole));
  const fs::path left_over = "train/circle-good/rosbag/seed_0/dataset.parts/left/000000.png";
  fs::create_directories((whole / left_over).parent_path());
  fs::copy(file, whole / left_over);
  dataset("whole", "1/1");
  EXPECT_TRUE(files_below(whole) == expected);
  const fs::path joined = scratch.path() / "joined";
  ASSERT_EQ(run_stereobench({"merge", first, second, "--out", joined.string()}).exit_code, 0);
  EXPECT_TRUE(files_below(joined) == expected);
}

}  // namespace
}  // namespace stereobench::harness
