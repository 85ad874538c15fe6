#include <fmt/format.h>
#include <gmock/gmock.h>

#include "harness/io/file_list.h"
#include "harness/io/picture_file.h"
#include "tests/harness/verify/planted_shard.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using testing::AllOf;
using testing::HasSubstr;

constexpr std::array kPoseKeys = {"world_from_robot", "world_from_left_camera", "world_from_right_camera"};

/// A fault, and what the message says of it.
struct ShardCase {
  const char* name;
  void (*plant)(const PlantedSet&);
  const char* cause;
};

void PrintTo(const ShardCase& planted, std::ostream* out) {
  *out << planted.name;
}

/// The bytes of a member.
std::string& member(Members& members, const std::string& name) {
  for (auto& [other, bytes] : members)
    if (other == name) return bytes;
  throw std::invalid_argument(name);
}

void erase(const PlantedSet& set, const std::string& start) {
  change_members(set, [&](Members& members) {
    ASSERT_GT(std::erase_if(members, [&](const auto& one) { return one.first.starts_with(start); }), 0U);
  });
}

void flip_bit_of_picture(const PlantedSet& set) {
  change_members(set, [](Members& members) {
    std::string& picture = member(members, "bend_0_000003.left.png");
    picture.at(picture.size() / 2) = static_cast<char>(picture.at(picture.size() / 2) ^ 4);
  });
}
void flip_bit_of_header(const PlantedSet& set) {
  std::string bytes = set.text(kShard);
  bytes.at(bytes.find("bend_0_000004.left.png") + 5) ^= 1;
  set.write(kShard, bytes);
}
void cut_short(const PlantedSet& set) {
  const std::string bytes = set.text(kShard);
  set.write(kShard, bytes.substr(0, bytes.size() - 4096));
}
void leave_out_the_end(const PlantedSet& set) {
  const std::string bytes = set.text(kShard);
  set.write(kShard, bytes.substr(0, bytes.size() - 1024));
}
void lose_a_picture(const PlantedSet& set) {
  erase(set, "bend_0_000004.right.png");
}
void lose_a_sample(const PlantedSet& set) {
  fs::copy_file(whole_set("webdataset") / kDatasetJson, set.path(kDatasetJson));
  erase(set, "bend_0_000004");
}
void lose_a_shard(const PlantedSet& set) {
  fs::rename(set.path(kShard), set.path("bend_0-000001.tar"));
}
void part_a_sample(const PlantedSet& set) {
  change_members(set,
                 [](Members& members) { std::rotate(members.begin(), members.begin() + 1, members.end()); });
}
void write_twice(const PlantedSet& set) {
  change_members(set, [](Members& members) { members.insert(members.begin(), members.front()); });
}
void rename_a_sample(const PlantedSet& set) {
  change_members(set, [](Members& members) {
    for (auto& [name, bytes] : members)
      if (name.starts_with("bend_0_000007")) name.replace(7, 6, "000009");
  });
}
void exchange_all_pictures(const PlantedSet& set) {
  change_members(set, [](Members& members) {
    for (std::size_t i = 0; i < members.size(); i += 3)
      std::swap(members[i + 1].second, members[i + 2].second);
  });
}
void exchange_pictures_of_one(const PlantedSet& set) {
  change_members(set, [](Members& members) { std::swap(members[7].second, members[8].second); });
}
void delay_pictures_of_shard(const PlantedSet& set) {
  change_members(set, [](Members& members) {
    for (std::size_t i = members.size(); i-- > 3;)
      if (!members[i].first.ends_with(".json")) members[i].second = members[i - 3].second;
  });
}
void put_small_picture(const PlantedSet& set) {
  change_members(set, [](Members& members) {
    member(members, "bend_0_000005.right.png") = encoded(".png", cv::Mat::zeros(10, 12, CV_8UC3));
  });
}
void delay_poses_of_samples(const PlantedSet& set) {
  std::vector<ordered_json> poses;
  change_samples(set, [&](ordered_json& sample, std::size_t i) {
    poses.push_back(sample);
    for (const char* key : kPoseKeys) sample[key] = poses[i == 0 ? 0 : i - 1][key];
  });
}
void write_centimetres_of_samples(const PlantedSet& set) {
  change_samples(set, [](ordered_json& sample, std::size_t) {
    for (const char* key : kPoseKeys)
      for (std::size_t row = 0; row < 3; ++row)
        sample[key][row][3] = 100.0 * sample[key][row][3].get<double>();
  });
}
void lengthen_baseline_of_rig(const PlantedSet& set) {
  change_samples(set, [](ordered_json& sample, std::size_t) {
    sample["rig"]["baseline_m"] = 1.01 * sample["rig"]["baseline_m"].get<double>();
  });
}
void lengthen_focal_of_rig(const PlantedSet& set) {
  change_samples(set, [](ordered_json& sample, std::size_t) { sample["rig"]["focal_px"] = 1.02 * 280.0; });
}
void change_rig_of_one(const PlantedSet& set) {
  change_samples(set, [](ordered_json& sample, std::size_t i) {
    if (i == 3) sample["rig"]["cx_px"] = 160.0;
  });
}
void move_robot_of_one(const PlantedSet& set) {
  change_samples(set, [](ordered_json& sample, std::size_t i) {
    if (i == 2) sample["world_from_robot"][0][3] = 0.0;
  });
}
void move_a_ball(const PlantedSet& set) {
  change_samples(set, [](ordered_json& sample, std::size_t i) {
    if (i == 1) sample["balls"][0]["centre_in_world_m"][0] = 2.7;
  });
}
void exchange_boxes(const PlantedSet& set) {
  change_samples(set, [](ordered_json& sample, std::size_t) {
    for (auto& ball : sample["balls"]) std::swap(ball["left"]["bbox_visib"], ball["right"]["bbox_visib"]);
  });
}
void put_a_box_far_out(const PlantedSet& set) {
  change_samples(set, [](ordered_json& sample, std::size_t i) {
    if (i == 4) sample["balls"][0]["left"]["bbox_visib"][0] = 3e9;  // more than an int has
  });
}
void exchange_cameras_of_balls(const PlantedSet& set) {
  change_samples(set, [](ordered_json& sample, std::size_t) {
    for (auto& ball : sample["balls"]) std::swap(ball["left"], ball["right"]);
  });
}
void repeat_a_time(const PlantedSet& set) {
  change_samples(set, [](ordered_json& sample, std::size_t i) {
    if (i == 4) sample["t_s"] = 0.5;
  });
}
void write_nan(const PlantedSet& set) {
  change_samples(set, [](ordered_json& sample, std::size_t i) {
    if (i == 4) sample["world_from_robot"][1][3] = std::numeric_limits<double>::quiet_NaN();  // null in JSON
  });
}

constexpr ShardCase kShardCases[] = {
    {"bit_of_a_picture", flip_bit_of_picture,
     "bend_0-000000.tar/bend_0_000003.left.png: frame bend_0_000003: "},
    {"bit_of_a_header", flip_bit_of_header, "expected the header of a member, or its sum is wrong"},
    {"cut_short", cut_short, "bend_0-000000.tar: the archive is cut short: bend_0_000007.right.png has"},
    {"no_end", leave_out_the_end, "bend_0-000000.tar: the archive is cut short: expected its end"},
    {"lost_member", lose_a_picture,
     "bend_0-000000.tar/bend_0_000004.right.png: frame bend_0_000004: missing member"},
    {"lost_frame", lose_a_sample, "dataset.json: frame 000004: missing frame"},
    {"lost_shard", lose_a_shard, "bend_0-000000.tar: missing file: there is bend_0-000001.tar"},
    {"parted", part_a_sample, "frame bend_0_000002: members of this sample are also in bend_0-000000.tar"},
    {"twice", write_twice,
     "bend_0_000002.json: frame bend_0_000002: the archive has a member of this name twice"},
    {"other_name", rename_a_sample,
     "frame bend_0_000009: drive, seed and step are those of a sample bend_0_000007"},
    {"swapped", exchange_all_pictures, "swapped cameras"},
    {"swapped_once", exchange_pictures_of_one,
     "bend_0-000000.tar/bend_0_000004.left.png: frame bend_0_000004: rows of corners in both pictures"},
    {"late_pictures", delay_pictures_of_shard, "pictures are a frame late"},
    {"late_poses", delay_poses_of_samples, "poses are a frame late"},
    {"small", put_small_picture,
     "bend_0_000005.right.png: frame bend_0_000005: expected 320 x 240 pixels (got 12 x 10)"},
    {"centimetres", write_centimetres_of_samples, "places of poses in centimetres"},
    {"baseline", lengthen_baseline_of_rig,
     "in 6 of 6 samples, first in bend_0_000002: world_from_right_camera is 0.0012 m"},
    {"focal", lengthen_focal_of_rig, "focal length too long by"},
    {"rig_of_one", change_rig_of_one,
     "bend_0_000005.json: frame bend_0_000005: `rig` is not that of bend_0_000004"},
    {"robot_of_one", move_robot_of_one, "frame bend_0_000004: world_from_left_camera is 1 m"},
    {"ball", move_a_ball, "frame bend_0_000003: ball 0: colour 0, radius 0.1 m, centre [2.7, 0.3, 0.1]"},
    {"boxes", exchange_boxes, "frame bend_0_000002: ball 0: its left bbox_visib [88, 136, 32, 31] is "},
    {"box_far_out", put_a_box_far_out,
     "frame bend_0_000006: balls[0].left.bbox_visib[0]: expected a whole number from -1 to 1048576"},
    {"cameras_of_balls", exchange_cameras_of_balls, "points of the world in pictures, against poses"},
    {"time", repeat_a_time, "frame bend_0_000006: time 500000000 ns is not after that of the frame before"},
    {"nan", write_nan, "bend_0_000006.json: frame bend_0_000006: world_from_robot[1][3]: expected a number"},
};

class PlantedInShard : public testing::TestWithParam<ShardCase> {};

// Law: a fault that the format has redundancy for is found, and called what it is.
TEST_P(PlantedInShard, IsFoundAndNamed) {
  const PlantedSet set("webdataset");
  GetParam().plant(set);
  EXPECT_THAT(set.faults(), HasSubstr(GetParam().cause));
}

INSTANTIATE_TEST_SUITE_P(Faults, PlantedInShard, testing::ValuesIn(kShardCases),
                         [](const auto& test) { return std::string(test.param.name); });

// Mutation: the place is a view of a product that is gone: asan_scopes and the fuzzer see it.
TEST(ShardFaults, SayWhereTheRightCameraIs) {
  const PlantedSet set("webdataset");
  lengthen_baseline_of_rig(set);
  EXPECT_THAT(set.faults(), AllOf(HasSubstr(": the right camera is [0.12, "),
                                  HasSubstr("] m beside the left one, and baseline_m is 0.1212")));
}

// Whoever names an archive by a date has no millions of others. Mutation: a line for each.
TEST(MissingShards, AreOneLine) {
  const TestFolder set;
  set.write("day-20260131.tar", std::string(1024, '\0'));
  set.write("night-000000.tar", std::string(1024, '\0'));
  set.write("night-000003.tar", std::string(1024, '\0'));
  EXPECT_EQ(
      faults_of(set.path(), "webdataset"),
      "day-00000000.tar: missing files: those up to day-20260130.tar as well, and there is day-20260131.tar\n"
      "night-000001.tar: missing files: those up to night-000002.tar as well, and there is "
      "night-000003.tar\n");
}

// Samples of others: keys in folders, JPEG's other name, and a .json that says nothing of cameras.
TEST(ShardsOfOthers, AreReadWithoutRigs) {
  const PlantedSet set("webdataset");
  const auto rename = [](Members& members) {
    Members others;
    for (std::size_t i = 0; i < members.size(); i += 3) {
      others.emplace_back(fmt::format("train/{}.png", 9 - i / 3), members[i + 1].second);
      others.emplace_back(fmt::format("train/{}.json", 9 - i / 3), R"({"label": 3})");
      others.emplace_back(fmt::format("train/{}.seg.png", 9 - i / 3), "no picture of a camera");
    }
    members = others;
  };
  change_members(set, rename);
  fs::rename(set.path(kShard), set.path("shard.tar"));
  EXPECT_EQ(reader_of(set.path("")).format, "webdataset");
  const Verification clean = verify_dataset(set.path(""), dataset_reader("webdataset"), [](double) {});
  EXPECT_TRUE(clean.faults.empty()) << line_of(clean.faults.front());
  EXPECT_EQ(clean.checked.front(), "6 frames");
  EXPECT_THAT(clean.cannot.front(), HasSubstr("no sample has a .json with a `rig`"));
  std::string bytes = set.text("shard.tar");
  bytes.at(bytes.find("IDAT") + 2000) ^= 1;
  set.write("shard.tar", bytes);
  EXPECT_THAT(set.faults(), HasSubstr("shard.tar/train/9.png: frame train/9: "));
}

}  // namespace
}  // namespace stereobench::harness
