/// Faults in bags of ROS 1 and MCAP files of ROS 2.
#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/harness/verify/planted_recording.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr std::int64_t kBegin_ns = 1'500'000'000'000'000'000, kStep_ns = 100'000'000;
constexpr std::int64_t kFifth_ns = kBegin_ns + 4 * kStep_ns;
const std::string kLeftPicture = "/stereo/left/image_raw", kRightPicture = "/stereo/right/image_raw";
const std::string kLeftInfo = "/stereo/left/camera_info", kRightInfo = "/stereo/right/camera_info";

class RecordingFaults : public testing::TestWithParam<std::string> {
 protected:
  PlantedRecording set_{GetParam()};
  std::string place(const std::string& topic) const { return set_.file().filename().string() + topic; }
};

/// Adds to the number of 64 bits that is `from_end` bytes before a message's end.
void add_to_number(PlantedMessage& message, std::size_t from_end, double more) {
  double value = 0.0;
  char* const at = message.bytes.data() + message.bytes.size() - from_end;
  std::memcpy(&value, at, sizeof(value));
  value += more;
  std::memcpy(at, &value, sizeof(value));
}

TEST_P(RecordingFaults, AreNoneInWhatWasWrittenAgain) {
  EXPECT_EQ(set_.faults(), "");
  EXPECT_EQ(reader_of(set_.folder()).format, GetParam());
}

// Mutations: the numbers of messages are not looked at; a picture is not held against its camera_info; a
// right picture is not held against the left one.
TEST_P(RecordingFaults, MissingPairIsNamed) {
  set_.remove({kLeftPicture, kRightPicture, kLeftInfo, kRightInfo}, kFifth_ns);
  EXPECT_EQ(
      set_.faults(),
      fmt::format("{0}: frame {2}: missing frame: the message before has the number 1, and this one 3\n"
                  "{1}: frame {2}: missing frame: the message before has the number 1, and this one 3\n",
                  place(kLeftPicture), place(kRightPicture), kFifth_ns + kStep_ns));
}

TEST_P(RecordingFaults, MissingPictureIsNamed) {
  set_.remove({kRightPicture}, kFifth_ns);
  EXPECT_THAT(set_.faults(),
              AllOf(HasSubstr(fmt::format("{}: frame {}: missing frame: {} has a message of this time\n",
                                          place(kRightPicture), kFifth_ns, kRightInfo)),
                    HasSubstr(fmt::format(
                        "{}: frame {}: missing frame: the other camera has a picture of this time\n",
                        place(kRightPicture), kFifth_ns))));
}

TEST_P(RecordingFaults, SwappedCamerasAreNamed) {
  const auto left = set_.of(kLeftPicture), right = set_.of(kRightPicture);
  for (std::size_t i = 0; i < left.size(); ++i) swap_pixels(*left[i], *right[i]);
  EXPECT_THAT(set_.faults(), HasSubstr("swapped cameras: left is right"));
}

// Without depth, pictures that are late are poses that are early.
TEST_P(RecordingFaults, LatePicturesAreNamed) {
  for (const std::string& topic : {kLeftPicture, kRightPicture}) {
    const auto pictures = set_.of(topic);
    for (std::size_t i = pictures.size(); i-- > 1;) swap_pixels(*pictures[i], *pictures[i - 1]);
  }
  EXPECT_THAT(set_.faults(), HasSubstr("/ground_truth/pose: poses are a frame early"));
}

TEST_P(RecordingFaults, OneLatePairIsNamed) {
  for (const std::string& topic : {kLeftPicture, kRightPicture}) {
    const auto pictures = set_.of(topic);
    swap_pixels(*pictures[3], *pictures[4]);
  }
  EXPECT_THAT(set_.faults(),
              HasSubstr(fmt::format("{}: frame {}: corners of a picture in the next one, against poses",
                                    place(kLeftPicture), kFifth_ns + kStep_ns)));
}

TEST_P(RecordingFaults, PictureBeforeItsTurnIsNamed) {
  const auto pictures = set_.of(kLeftPicture);
  std::swap(pictures[2]->bytes, pictures[3]->bytes);
  EXPECT_THAT(set_.faults(),
              HasSubstr(fmt::format("{}: frame {}: the time is not after that of the picture before, {} ns",
                                    place(kLeftPicture), kFifth_ns, kFifth_ns + kStep_ns)));
}

// P of 12 numbers, binning and region of 6 words and a flag are the last ones of camera_info; P[3] is the
// fourth.
TEST_P(RecordingFaults, BaselineThatIsSaidTwiceIsCompared) {
  constexpr std::size_t kP3 = 6 * 4 + 1 + 9 * 8;
  for (PlantedMessage* info : set_.of(kRightInfo)) add_to_number(*info, kP3, -0.01 * 280.0 * 0.12);
  EXPECT_EQ(set_.faults(), place(kRightInfo) + ": the baseline is 0.1212 m by P, and 0.12 m by /tf_static\n");
}

TEST_P(RecordingFaults, CameraThatChangesIsNamed) {
  constexpr std::size_t kP3 = 6 * 4 + 1 + 9 * 8;
  add_to_number(*set_.of(kRightInfo)[2], kP3, 0.001);
  EXPECT_EQ(set_.faults(), fmt::format("{}: frame {}: the camera is another one than in the first message\n",
                                       place(kRightInfo), kFifth_ns));
}

TEST_P(RecordingFaults, PosesThatAreSaidTwiceAreCompared) {
  constexpr std::size_t kX = 3 * 8;
  add_to_number(*set_.of("/ground_truth/pose_2d")[4], kX, 1e-6);
  EXPECT_EQ(set_.faults(),
            fmt::format("{}: frame {}: the pose is off that of /ground_truth/pose_2d by 1e-06\n",
                        place("/ground_truth/pose"), kFifth_ns));
}

TEST_P(RecordingFaults, MessageThatIsCutShortIsNamed) {
  PlantedMessage& odometry = *set_.of("/odom")[3];
  odometry.bytes.resize(odometry.bytes.size() - 288 - 8);  // the covariance, and the turn rate before it
  EXPECT_THAT(set_.faults(), HasSubstr(place("/odom") + ": message 4: expected 8 bytes more behind byte "));
}

TEST_P(RecordingFaults, PictureWithoutItsLastRowIsNamed) {
  PlantedMessage& picture = *set_.of(kLeftPicture)[1];
  picture.bytes.resize(picture.bytes.size() - 3 * 320);
  EXPECT_THAT(set_.faults(),
              HasSubstr(fmt::format("{}: frame {}: expected ", place(kLeftPicture), kFifth_ns - kStep_ns)));
}

// A bit of a pixel: by the manifest, and in MCAP by its own sum. Mutation: the sum is not looked at.
TEST_P(RecordingFaults, FlippedBitIsFound) {
  const TestFolder copy;
  const fs::path from = rendered(kBend, kRecordings, {"--frames", "2..7"}) / GetParam();
  fs::copy(from, copy.path(), fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  EXPECT_EQ(faults_of(copy.path(), GetParam()), "");
  const std::string name = set_.file().filename().string();
  std::string bytes = copy.read(name);
  const std::size_t pixel = bytes.size() / 2;
  bytes[pixel] = static_cast<char>(bytes[pixel] ^ 4);
  copy.write(name, bytes);
  const std::string faults = faults_of(copy.path(), GetParam());
  EXPECT_THAT(faults, HasSubstr(name + ": checksum: its bytes are not those that manifest-sha256.txt lists"));
  fs::remove(copy.path() / "manifest-sha256.txt");
  if (GetParam() == "mcap") {
    EXPECT_THAT(faults_of(copy.path(), "mcap"), HasSubstr(name + ": checksum of the data at byte 0: "));
  }
}

// The index of the first chunk of the bag leads elsewhere. Mutation: indices are not read.
TEST(BagFaults, IndexThatLeadsElsewhereIsNamed) {
  const PlantedRecording set("rosbag");
  set.write();
  std::ifstream stream(set.file(), std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  const std::size_t index = bytes.find(std::string("op=\x04", 4));
  ASSERT_NE(index, std::string::npos);
  // The record ends with entries of time and place; the place of its first one is behind the length of all.
  const std::size_t entries = bytes.find("ver=", index) + 8 + 4;
  bytes[entries + 8] = static_cast<char>(bytes[entries + 8] ^ 1);
  std::ofstream(set.file(), std::ios::binary) << bytes;
  EXPECT_THAT(faults_of(set.folder(), "rosbag"),
              HasSubstr("the index of a chunk is not that of its messages"));
}

/// What ends the reading of a recording; empty where nothing does.
std::string end_of_reading(const fs::path& folder, const std::string& format) {
  try {
    const DatasetView view = dataset_reader(format).read(folder);
    for (const ViewFrame& frame : view.frames)
      for (const auto& channels : frame.channels)
        for (const auto& [channel, file] : channels) try {
            file.read();
          } catch (const std::runtime_error&) {
            // Is a fault.
          }
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

/// A small recording: few pictures, of few pixels.
fs::path small_recording(const std::string& format) {
  const fs::path from =
      rendered(kBend, kRecordings,
               {"--frames", "2..3", "--set",
                "rig={width_px: 32, height_px: 24, focal_px: 28, baseline_m: 0.12, height_m: 0.3}"});
  return from / format / (format == "rosbag" ? "bend_0.bag" : "bend_0.mcap");
}

// Law: a file that was cut anywhere is refused, in one line that names it. Mutations: the index's place is
// not looked at; the magic bytes behind the footer are not.
TEST_P(RecordingFaults, FileThatIsCutShortIsRefused) {
  const TestFolder folder;
  const fs::path from = small_recording(GetParam());
  const std::string name = from.filename().string();
  std::ifstream stream(from, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  constexpr std::size_t kCuts = 300;
  for (std::size_t i = 0; i < kCuts; ++i) {
    const std::size_t cut = i < kCuts / 2 ? bytes.size() * 2 * i / kCuts : bytes.size() - (kCuts - i);
    folder.write(name, bytes.substr(0, cut));
    const std::string end = end_of_reading(folder.path(), GetParam());
    EXPECT_THAT(end, testing::StartsWith((folder.path() / name).string() + ": byte ")) << cut;
    EXPECT_EQ(std::ranges::count(end, '\n'), 0) << end;
  }
}

// Between two records nothing is missing but what the head speaks of. Mutation: the index's place is not
// looked at.
TEST(BagFaults, FileThatEndsBeforeItsIndexIsRefused) {
  const TestFolder folder;
  const fs::path from = small_recording("rosbag");
  std::ifstream stream(from, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  constexpr std::size_t kLengths = 8;  // of the record's fields, and of the first one
  folder.write("bend_0.bag", bytes.substr(0, bytes.find(std::string("op=\x05", 4)) - kLengths));
  EXPECT_THAT(end_of_reading(folder.path(), "rosbag"), HasSubstr(": the index is said to begin at byte "));
}

// Law: whatever byte is wrong, reading ends, and never but by its own errors. Lengths are among the bytes.
TEST_P(RecordingFaults, WrongBytesEndNothing) {
  const TestFolder folder;
  const fs::path from = small_recording(GetParam());
  std::ifstream stream(from, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
  constexpr std::size_t kTries = 400;
  std::size_t refused = 0;
  for (std::size_t i = 0; i < kTries; ++i) {
    std::string wrong = bytes;
    const std::size_t at = (i * 2654435761U) % bytes.size();
    wrong[at] = static_cast<char>(i % 2 == 0 ? 0xff : wrong[at] ^ 1);
    folder.write(from.filename().string(), wrong);
    if (!end_of_reading(folder.path(), GetParam()).empty()) ++refused;
  }
  EXPECT_GT(refused, 0U);
  EXPECT_LT(refused, kTries);
}

TEST_P(RecordingFaults, FolderOfTwoIsRefused) {
  set_.write();
  fs::copy_file(set_.file(), set_.folder() / ("another" + set_.file().extension().string()));
  EXPECT_THAT(end_of_reading(set_.folder(), GetParam()), HasSubstr(": expected one file ."));
}

INSTANTIATE_TEST_SUITE_P(Containers, RecordingFaults, testing::Values("rosbag", "mcap"),
                         [](const auto& format) { return format.param; });

}  // namespace
}  // namespace stereobench::harness
