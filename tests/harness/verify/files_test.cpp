#include <fmt/format.h>
#include <gmock/gmock.h>

#include "harness/io/file_list.h"
#include "harness/io/float_picture.h"
#include "harness/io/picture_file.h"
#include "harness/io/picture_reader.h"
#include "harness/io/sha256.h"
#include "harness/verify/checks/checks.h"
#include "tests/harness/verify/planted_set.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

void flip_a_bit(const PlantedSet& set, const std::string& name) {
  std::string bytes = set.text(name);
  bytes.at(bytes.size() / 2) = static_cast<char>(bytes.at(bytes.size() / 2) ^ 4);
  set.write(name, bytes);
}

/// What says how the set was rendered, and the manifest, as they are in the set that was copied.
void put_manifest_back(const PlantedSet& set, const std::string& format) {
  for (const char* name : {kDatasetJson, kManifest}) fs::copy_file(whole_set(format) / name, set.path(name));
}

TEST(FilesOfASet, HaveTheBytesThatTheManifestLists) {
  for (const auto& [format, file] :
       {std::pair("plain", "right_depth/000003.pfm"), std::pair("euroc", "mav0/body.yaml"),
        std::pair("kitti-odometry", "sequences/00/image_3/000002.png"),
        std::pair("webdataset", "bend_0-000000.tar"), std::pair("mrclam", "Robot1_Odometry.dat")}) {
    const PlantedSet set(format);
    put_manifest_back(set, format);
    EXPECT_EQ(set.faults(), "") << format;
    flip_a_bit(set, file);
    EXPECT_THAT(
        set.faults(),
        HasSubstr(fmt::format("{}: checksum: its bytes are not those that manifest-sha256.txt lists", file)));
    fs::remove(set.path(file));
    EXPECT_THAT(set.faults(), HasSubstr(fmt::format("{}: missing file: manifest-sha256.txt lists it", file)));
  }
}

// The form is RFC 8493's: a hash, blanks, and a name in which line ends and % are written as in URLs.
TEST(FilesOfASet, HaveTheBytesThatABagItManifestLists) {
  const PlantedSet set("tum");
  set.write("100%.txt", "whole");
  std::string hash = sha256_of("whole");
  for (char& digit : hash) digit = static_cast<char>(std::toupper(digit));
  set.write("manifest-sha256.txt", hash + "  100%25.txt\n");
  EXPECT_EQ(set.faults(), "");
  set.write("100%.txt", "whale");
  EXPECT_THAT(set.faults(),
              HasSubstr("100%.txt: checksum: its bytes are not those that manifest-sha256.txt lists"));
  set.write("manifest-sha256.txt", hash + "  ../tum/rgb.txt\nnothing\n");
  EXPECT_THAT(set.faults(), AllOf(HasSubstr("line 1: expected the name of a file in the folder"),
                                  HasSubstr("line 2: expected 64 hexadecimal digits")));
}

// A PNG has sums of its own, so that a bit is found without a list, too.
TEST(FilesOfASet, AreReadToTheirEnds) {
  const PlantedSet set("vslamlab");
  flip_a_bit(set, "rgb_1/1500000000300000000.png");
  EXPECT_THAT(set.faults(), HasSubstr("rgb_1/1500000000300000000.png: frame 1500000000300000000: "));
}

TEST(FilesOfASet, AreThereForEachFrame) {
  for (const auto& [format, file] :
       {std::pair("plain", "right/000004.png"), std::pair("plain", "left_flow/000004.pfm"),
        std::pair("kitti-odometry", "sequences/00/image_1/000002.png"),
        std::pair("kitti-stereo", "image_2/000004_10.png"),
        std::pair("kitti-scene-flow", "image_3/000004_11.png"),
        std::pair("kitti-stereo-2012", "disp_occ/000004_10.png"),
        std::pair("euroc", "mav0/cam1/data/1500000000400000000.png"),
        std::pair("tum", "depth/1500000000.400000000.png"), std::pair("middlebury", "000004/im1.png"),
        std::pair("eth3d", "two_view_training_gt/000004/disp0GT.pfm"),
        std::pair("sceneflow", "frames_cleanpass/bend_0/right/0004.png"),
        std::pair("vslamlab", "rgb_0/1500000000400000000.png")}) {
    const PlantedSet set(format);
    ASSERT_TRUE(fs::remove(set.path(file))) << file;
    const std::vector<Fault> faults = dataset_reader(format).read(set.path("")).faults;
    EXPECT_TRUE(std::ranges::any_of(faults,
                                    [&](const Fault& fault) {
                                      return line_of(fault).find("missing frame") != std::string::npos &&
                                             line_of(fault).find(file) != std::string::npos;
                                    }))
        << format << " without " << file;
  }
}

// Both halves of a pair, and their truth, are gone: only the lists know of them.
TEST(FilesOfASet, AreThereForEachLineOfAList) {
  const PlantedSet set("plain");
  for (const auto& entry : fs::directory_iterator(set.path("")))
    if (entry.is_directory())
      for (const char* ending : {".png", ".pfm", ".jsonl"})
        fs::remove(entry.path() / fmt::format("000004{}", ending));
  EXPECT_THAT(
      set.faults(),
      HasSubstr("left/000004.png: frame 000004: missing frame: frames.csv says that it has pictures"));
}

TEST(BallsOfASet, AreBoxedWhereTheyAreSeen) {
  const PlantedSet set("plain");
  const std::string file = "left_balls/000002.jsonl";
  ASSERT_EQ(faults_of(set.path(""), "plain"), "");
  // The balls of the picture are whole or half hidden. One of them is taken out of the identities.
  cv::Mat ids = read_exact_png(set.path("left_id/000002.png"));
  ids.setTo(0, ids == 1);
  set.write("left_id/000002.png", encoded(".png", ids));
  EXPECT_THAT(set.faults(),
              AllOf(HasSubstr(file + ": frame 000002: ball 0: box ["), HasSubstr("of a hidden ball")));
}

TEST(PicturesOfASet, HoldNumbersOfTheirSize) {
  const PlantedSet set("plain");
  cv::Mat depth_m = read_float_picture(set.path("left_depth/000003.pfm"));
  depth_m.at<float>(7, 5) = std::numeric_limits<float>::quiet_NaN();
  set.write("left_depth/000003.pfm", encoded(".pfm", depth_m));
  set.write("left_id/000005.png", encoded(".png", cv::Mat::zeros(10, 12, CV_8UC1)));
  EXPECT_THAT(set.faults(),
              AllOf(HasSubstr("left_depth/000003.pfm: frame 000003: NaN at column 5, row 7"),
                    HasSubstr("left_id/000005.png: frame 000005: expected 320 x 240 pixels (got 12 x 10)")));
}

// Mutation: the reader looks for PFM alone.
TEST(PicturesOfASet, HoldNumbersInTiffToo) {
  const PlantedSet set("plain");
  cv::Mat depth_m = read_float_picture(set.path("left_depth/000003.pfm"));
  depth_m.at<float>(7, 5) = std::numeric_limits<float>::quiet_NaN();
  fs::remove(set.path("left_depth/000003.pfm"));
  set.write("left_depth/000003.tiff", encoded(".tiff", depth_m));
  EXPECT_THAT(set.faults(), HasSubstr("left_depth/000003.tiff: frame 000003: NaN at column 5, row 7"));
}

// A picture of another frame, in one file: the frame is named, and no cause that is of the whole set.
TEST(PicturesOfASet, AreOfTheirFrame) {
  const PlantedSet set("plain");
  set.write("left_depth/000005.pfm", set.text("left_depth/000002.pfm"));
  EXPECT_THAT(set.faults(),
              AllOf(HasSubstr("left_disparity/000005.pfm: frame 000005: disparity against depth"),
                    HasSubstr("where other frames agree"), Not(HasSubstr("000004"))));
}

TEST(TimesOfASet, AreInOrderAndEqual) {
  const PlantedSet set("vslamlab");
  std::string pairs = set.text("rgb.csv");
  pairs.replace(pairs.find(".png,1500000000300000000"), 24, ".png,1500000000300000007");
  set.write("rgb.csv", pairs);
  EXPECT_THAT(set.faults(),
              HasSubstr("frame 1500000000300000000: the right picture is of 1500000000300000007 ns"));
  const PlantedSet path("tum");
  std::string poses = path.text("groundtruth.txt");
  poses.replace(poses.find("\n1500000000.400"), 15, "\n1500000000.200");
  path.write("groundtruth.txt", poses);
  EXPECT_THAT(path.faults(), HasSubstr("is not after that of the one before"));
}

TEST(PosesOfASet, AreRigid) {
  const PlantedSet mirrored("kitti-odometry"), long_one("euroc");
  mirrored.change_poses([](PlantedSet::Path& path) { path[2].col(1) *= -1.0; });
  EXPECT_THAT(mirrored.faults(), HasSubstr("poses/00.txt: line 3: the axes are left-handed"));
  const std::string file = "mav0/state_groundtruth_estimate0/data.csv";
  std::string states = long_one.text(file);
  const std::size_t at = states.find("\n1500000000300000000,");
  states.replace(states.find(",1,0,0,0,", at), 9, ",1.1,0,0,0,");
  long_one.write(file, states);
  EXPECT_THAT(long_one.faults(), HasSubstr("the quaternion has length 1.1: expected 1"));
}

// A name that no file can have is that of a file that is missing. Mutation: asking for it may throw.
TEST(FilesOfASet, MayHaveAnyNameInAManifest) {
  const TestFolder set;
  const std::string hash = sha256_of(""), name = std::string(5000, 'n') + "%0A";
  set.write(kManifest, hash + "  " + name + "\n");
  const ChecksumResult result = check_checksums(set.path());
  ASSERT_EQ(result.faults.size(), 1U);
  EXPECT_EQ(result.faults.front().what, "missing file: manifest-sha256.txt lists it");
  EXPECT_EQ(changed_files(set.path(), read_manifest(set.path())).size(), 1U);
  const std::string line = line_of(result.faults.front());
  EXPECT_EQ(std::ranges::count(line, '\n'), 0);
  EXPECT_LT(line.size(), 1200U);
}

TEST(Readers, SayWhatIsNoDataSet) {
  const TestFolder empty;
  EXPECT_THAT([&] { reader_of(empty.path()); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("expected a data set (plain, euroc,")));
  EXPECT_THAT([] { dataset_reader("kiti-stereo"); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("did you mean kitti-stereo?")));
  EXPECT_THAT([&] { reader_of(empty.path() / "nowhere"); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("no such folder")));
}

}  // namespace
}  // namespace stereobench::harness
