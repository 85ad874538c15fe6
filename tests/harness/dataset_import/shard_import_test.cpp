/// Shards of WebDataset, of `render` and of others.
#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include "harness/dataset/formats/container/tar_file.h"
#include "tests/harness/dataset_import/carried.h"
#include "tests/harness/verify/planted_shard.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

Outcome import_shards(const fs::path& folder, const TestFolder& scratch,
                      const std::vector<std::string>& more = {}) {
  return run_stereobench(with({"import", folder.string(), "--out", (scratch.path() / "in").string()}, more));
}

void write_shard(const TestFolder& folder, const std::string& name, const Members& members) {
  AtomicFile file(folder.path() / name);
  TarFile tar(file);
  for (const auto& [member, bytes] : members) tar.add(member, bytes);
  tar.finish();
  file.move_into_place();
}

// Law: the rig, places and instants are what the plain folder has, to the byte; headings to the last digits.
// Mutations: the rig of the pictures for the one that vision is told; the robot's pose for the left camera's.
TEST(ShardImport, HasTheRigAndTheTruePathOfThePlainFolder) {
  const fs::path sets = rendered(kBend, "plain,webdataset",
                                 {"--set", "believed_rig={focal_px: 283.1, baseline_m: 0.1203}", "--set",
                                  "rig.pitch_down_deg=5.3", "--set",
                                  "path={kind: polyline, points_m: [[0, 0], [0.5, 0.11], [0.4, 1.4]], "
                                  "corner_radius_m: 0.3, speed_mps: 1, step_s: 0.1}"});
  const TestFolder scratch;
  const Outcome done = import_shards(sets / "webdataset", scratch);
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("no odometry, which the layout has not"));
  const fs::path in = scratch.path() / "in";
  EXPECT_EQ(bytes_of(in / "calibration.yaml"), bytes_of(sets / "plain/calibration.yaml"));
  EXPECT_EQ(bytes_of(in / "instants.csv"), bytes_of(sets / "plain/instants.csv"));
  std::istringstream found(bytes_of(in / "groundtruth.csv")),
      wanted(bytes_of(sets / "plain/groundtruth.csv"));
  std::string row, other;
  ASSERT_TRUE(std::getline(found, row) && std::getline(wanted, other));
  EXPECT_EQ(row, other);  // the header
  while (std::getline(wanted, other)) {
    ASSERT_TRUE(std::getline(found, row));
    const std::size_t heading = other.rfind(',') + 1;
    ASSERT_EQ(row.substr(0, heading), other.substr(0, heading));
    EXPECT_NEAR(std::stod(row.substr(heading)), std::stod(other.substr(heading)), 1e-15) << row;
  }
  EXPECT_THAT(scratch.read("in/pictures.csv"),
              HasSubstr("\n1,0.100000000,bend_0-000000.tar/bend_0_000001.left.png,bend_0-000000.tar/"));
}

// Bytes of pictures that are members go into files as they are. Mutation: they are decoded.
TEST(ShardImport, LeavesPicturesOfOthersAsTheyAre) {
  const TestFolder folder, scratch;
  std::vector<uchar> jpeg;
  cv::imencode(".jpg", cv::Mat(48, 64, CV_8UC3, cv::Scalar(10, 20, 30)), jpeg);
  const std::string bytes(jpeg.begin(), jpeg.end());
  write_shard(folder, "train-0000.tar",
              {{"a01.left.jpg", bytes},
               {"a01.right.jpg", bytes},
               {"a01.json", "{\"label\": 3}"},
               {"a02.left.jpg", bytes},
               {"a02.right.jpg", bytes},
               {"a02.json", "{\"label\": 4}"}});
  const Outcome done = import_shards(folder.path(), scratch);
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("2 pairs in"));
  EXPECT_THAT(done.out, HasSubstr("no calibration of two cameras: `detect` needs --rig for pairs"));
  EXPECT_EQ(scratch.read("in/left/000000.jpg"), bytes);
  EXPECT_EQ(scratch.read("in/right/000001.jpg"), bytes);
}

// Mutation: a member that is missing ends the import.
TEST(ShardImport, LeavesOutASampleThatHasNotAllOfItsMembers) {
  const PlantedSet set("webdataset");
  change_members(set, [](Members& members) {
    std::erase_if(members, [](const auto& member) { return member.first == "bend_0_000004.right.png"; });
  });
  const TestFolder scratch;
  const Outcome done = import_shards(set.path("."), scratch);
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("5 pairs (1 frames left out)"));
}

/// The bend's samples under another drive's name.
Members of_another_drive(Members members) {
  for (auto& [name, bytes] : members) {
    name.replace(0, 4, "turn");
    if (name.ends_with(".json")) bytes.replace(bytes.find("\"bend\""), 6, "\"turn\"");
  }
  return members;
}

TEST(ShardImport, TakesOneDriveByItsName) {
  const PlantedSet set("webdataset");
  const TestFolder folder, scratch;
  const Members members = members_of(set);
  write_shard(folder, "bend_0-000000.tar", members);
  write_shard(folder, "turn_0-000000.tar", of_another_drive(members));
  const Outcome both = import_shards(folder.path(), scratch);
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.err, HasSubstr("are of two drives; import one by --only"));
  const Outcome one = import_shards(folder.path(), scratch, {"--only", "turn_0"});
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_THAT(one.out, HasSubstr("6 pairs in"));
  EXPECT_THAT(scratch.read("in/pictures.csv"), HasSubstr("\n0,0.200000000,turn_0-000000.tar/turn_0_000002"));
}

// Vision cannot be told two rigs. Mutation: the first one is taken.
TEST(ShardImport, RefusesADriveOfWhichVisionIsToldTwoRigs) {
  const PlantedSet set("webdataset");
  change_samples(set, [](nlohmann::ordered_json& sample, std::size_t i) {
    if (i == 3) sample["believed_rig"]["focal_px"] = 281.0;
  });
  const TestFolder scratch;
  const Outcome refused = import_shards(set.path("."), scratch);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("the rig of bend_0_000005 is not that of bend_0_000002"));
  EXPECT_FALSE(fs::exists(scratch.path() / "in"));
}

}  // namespace
}  // namespace stereobench::harness
