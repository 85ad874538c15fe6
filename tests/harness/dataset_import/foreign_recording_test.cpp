/// Recordings that other people's programs wrote: made by hand, byte by byte, from the specifications.
#include <cstdint>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <zlib.h>

#include "harness/io/picture_reader.h"
#include "tests/harness/dataset_import/carried.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::uint32_t kFirst_s = 1'600'000'000, kHalf_ns = 500'000'000;

/// Values one after the other; of CDR, each at a multiple of its size.
class HandBytes {
 public:
  explicit HandBytes(bool is_cdr = false) : is_cdr_(is_cdr) {
    if (is_cdr_) bytes_.assign({0, 1, 0, 0});
  }
  template <class Number>
  HandBytes& put(Number value) {
    while (is_cdr_ && bytes_.size() % sizeof(Number) != 4 % sizeof(Number)) bytes_.push_back('\x55');
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(value));
    return *this;
  }
  HandBytes& text(const std::string& text) {
    put(static_cast<std::uint32_t>(text.size() + (is_cdr_ ? 1 : 0)));
    bytes_ += text;
    if (is_cdr_) bytes_.push_back('\0');
    return *this;
  }
  HandBytes& block(const std::string& bytes) {
    put(static_cast<std::uint32_t>(bytes.size()));
    bytes_ += bytes;
    return *this;
  }
  HandBytes& doubles(const std::vector<double>& values) {
    for (const double value : values) put(value);
    return *this;
  }
  HandBytes& header(int half_seconds, const std::string& frame) {
    if (!is_cdr_) put(std::uint32_t{7});  // who counts nothing
    put(kFirst_s + static_cast<std::uint32_t>(half_seconds) / 2);
    put(half_seconds % 2 == 0 ? 0U : kHalf_ns);
    return text(frame);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  bool is_cdr_;
  std::string bytes_;
};

struct HandMessage {
  std::string topic, type;
  int half_seconds = 0;
  std::string bytes;
};

/// What may be otherwise.
struct HandDrive {
  bool is_cdr = false;
  double ahead_m = 0.0;  ///< of the mast on the body
  std::string encoding = "rgb8";
  double sideways_mps = 0.0;
};

/// Rows of four bytes beyond their pixels. The level of a pixel is 10 times its row, and its column; the
/// left camera's red is 200, the right one's 100.
std::string hand_picture(const HandDrive& drive, int half_seconds, bool is_left) {
  constexpr std::uint32_t kWidth = 5, kHeight = 3, kStep = 3 * kWidth + 4;
  std::string data;
  for (std::uint32_t v = 0; v < kHeight; ++v) {
    for (std::uint32_t u = 0; u < kWidth; ++u)
      for (const std::uint32_t level : {is_left ? 200U : 100U, 10 * v, u})
        data.push_back(static_cast<char>(level));
    data += "\x11\x22\x33\x44";
  }
  HandBytes out(drive.is_cdr);
  out.header(half_seconds, is_left ? "/left_optical" : "right_optical");
  out.put(kHeight).put(kWidth).text(drive.encoding).put(std::uint8_t{0}).put(kStep).block(data);
  return out.bytes();
}

std::string hand_info(const HandDrive& drive, int half_seconds, bool is_left) {
  HandBytes out(drive.is_cdr);
  out.header(half_seconds, "");
  out.put(std::uint32_t{3}).put(std::uint32_t{5}).text("plumb_bob").put(std::uint32_t{5});
  out.doubles({0, 0, 0, 0, 0, 100.5, 0, 2.25, 0, 100.5, 1.5, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  out.doubles({100.5, 0, 2.25, is_left ? 0.0 : -100.5 * 0.2, 0, 100.5, 1.5, 0, 0, 0, 1, 0});
  for (int i = 0; i < 6; ++i) out.put(std::uint32_t{0});
  out.put(std::uint8_t{0});
  return out.bytes();
}

/// The cameras are 0.25 m up a mast, whose foot is 0.5 m up the body.
std::string hand_frames(const HandDrive& drive) {
  const std::vector<double> optical = {-0.5, 0.5, -0.5, 0.5};
  HandBytes out(drive.is_cdr);
  out.put(std::uint32_t{3});
  out.header(0, "mast").text("left_optical").doubles({0, 0.1, 0.25}).doubles(optical);
  out.header(0, "mast").text("right_optical").doubles({0, -0.1, 0.25}).doubles(optical);
  out.header(0, "base_footprint").text("mast").doubles({drive.ahead_m, 0, 0.5, 0, 0, 0, 1});
  return out.bytes();
}

std::string hand_odometry(const HandDrive& drive, int half_seconds, double v_mps, double w_radps) {
  HandBytes out(drive.is_cdr);
  out.header(half_seconds, "odom").text("base_footprint").doubles({1, 2, 0, 0, 0, 0, 1});
  out.doubles(std::vector<double>(36, 0.5)).doubles({v_mps, drive.sideways_mps, 0, 0, 0, w_radps});
  out.doubles(std::vector<double>(36, 0.25));
  return out.bytes();
}

std::vector<HandMessage> hand_messages(const HandDrive& drive) {
  std::vector<HandMessage> messages = {{"/tf_static", "tf2_msgs/TFMessage", 0, hand_frames(drive)}};
  const std::vector<std::pair<double, double>> speeds = {{0.1, 0.2}, {0.3, -0.1}, {0.5, 0.05}};
  for (int i = 0; i < 3; ++i) {
    const auto& [v_mps, w_radps] = speeds[static_cast<std::size_t>(i)];
    messages.push_back({"/wheels/odometry", "nav_msgs/Odometry", i, hand_odometry(drive, i, v_mps, w_radps)});
    for (const bool is_left : {false, true}) {
      const std::string camera = is_left ? "/rig/left/" : "/rig/right/";
      messages.push_back({camera + "camera_info", "sensor_msgs/CameraInfo", i, hand_info(drive, i, is_left)});
      messages.push_back({camera + "image_raw", "sensor_msgs/Image", i, hand_picture(drive, i, is_left)});
    }
  }
  messages.push_back({"/chatter", "std_msgs/String", 2, "no text"});
  return messages;
}

std::string hand_record(const std::map<std::string, std::string>& fields, const std::string& data) {
  HandBytes head;
  for (const auto& [name, value] : fields) head.block(name + "=" + value);
  return HandBytes().block(head.bytes()).block(data).bytes();
}

template <class Number>
std::string hand_number(Number value) {
  return HandBytes().put(value).bytes();
}

std::string hand_time(const HandMessage& message) {
  const auto halves = static_cast<std::uint32_t>(message.half_seconds);
  return HandBytes().put(kFirst_s + halves / 2).put(halves % 2 == 0 ? 0U : kHalf_ns).bytes();
}

/// A bag of one chunk. @param compression what the chunk says of itself
std::string hand_bag(const std::vector<HandMessage>& messages, const std::string& compression) {
  std::map<std::string, std::uint32_t> numbers;
  std::map<std::string, std::string> connections, entries;
  std::string chunk;
  for (const HandMessage& message : messages) {
    if (!numbers.contains(message.topic)) {
      const std::uint32_t number = numbers[message.topic] = static_cast<std::uint32_t>(10 + numbers.size());
      const std::string about = HandBytes().block("type=" + message.type).block("md5sum=*").bytes();
      connections[message.topic] =
          hand_record({{"op", "\x07"}, {"conn", hand_number(number)}, {"topic", message.topic}}, about);
      chunk += connections[message.topic];
    }
    entries[message.topic] += hand_time(message) + hand_number(static_cast<std::uint32_t>(chunk.size()));
    chunk += hand_record(
        {{"op", "\x02"}, {"conn", hand_number(numbers[message.topic])}, {"time", hand_time(message)}},
        message.bytes);
  }
  const auto count = static_cast<std::uint32_t>(numbers.size());
  std::string body = hand_record({{"op", "\x05"},
                                  {"compression", compression},
                                  {"size", hand_number(static_cast<std::uint32_t>(chunk.size()))}},
                                 chunk);
  std::string counts, lists;
  for (const auto& [topic, number] : numbers) {
    const auto of_topic = static_cast<std::uint32_t>(entries[topic].size() / 12);
    body += hand_record({{"op", "\x04"},
                         {"ver", hand_number(1U)},
                         {"conn", hand_number(number)},
                         {"count", hand_number(of_topic)}},
                        entries[topic]);
    counts += hand_number(number) + hand_number(of_topic);
    lists += connections[topic];
  }
  const auto head = [&](std::uint64_t index_at) {
    return "#ROSBAG V2.0\n" + hand_record({{"op", "\x03"},
                                           {"index_pos", hand_number(index_at)},
                                           {"conn_count", hand_number(count)},
                                           {"chunk_count", hand_number(1U)}},
                                          std::string(40, ' '));
  };
  const std::size_t begin = head(0).size();
  lists += hand_record({{"op", "\x06"},
                        {"ver", hand_number(1U)},
                        {"chunk_pos", hand_number(static_cast<std::uint64_t>(begin))},
                        {"start_time", hand_time(messages.front())},
                        {"end_time", hand_time(messages.back())},
                        {"count", hand_number(count)}},
                       counts);
  return head(begin + body.size()) + body + lists;
}

std::string hand_piece(std::uint8_t op, const std::string& content) {
  return HandBytes().put(op).put(static_cast<std::uint64_t>(content.size())).bytes() + content;
}

/// An MCAP file of one chunk, without summary. @param compression what the chunk says of itself
std::string hand_mcap(const std::vector<HandMessage>& messages, const std::string& compression) {
  const std::string magic = "\x89MCAP0\r\n";
  std::map<std::string, std::uint16_t> numbers;
  std::string chunk;
  for (const HandMessage& message : messages) {
    if (!numbers.contains(message.topic)) {
      const auto number = numbers[message.topic] = static_cast<std::uint16_t>(40 + numbers.size());
      std::string type = message.type;
      type.insert(type.find('/'), "/msg");
      chunk += hand_piece(3, HandBytes().put(number).text(type).text("ros2msg").text("").bytes());
      chunk += hand_piece(
          4, HandBytes().put(number).put(number).text(message.topic).text("cdr").block("").bytes());
    }
    const std::uint64_t time =
        std::uint64_t{kFirst_s} * 1'000'000'000 + static_cast<std::uint64_t>(message.half_seconds) * kHalf_ns;
    chunk += hand_piece(
        5, HandBytes().put(numbers[message.topic]).put(0U).put(time).put(time).bytes() + message.bytes);
  }
  const auto size = static_cast<std::uint64_t>(chunk.size());
  const auto crc = static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const unsigned char*>(chunk.data()), chunk.size()));
  HandBytes about;
  about.put(std::uint64_t{0}).put(std::uint64_t{0}).put(size).put(crc).text(compression).put(size);
  return magic + hand_piece(1, HandBytes().text("ros2").text("by hand").bytes()) +
         hand_piece(6, about.bytes() + chunk) + hand_piece(0x8c, "of a later version") +
         hand_piece(15, hand_number(0U)) +
         hand_piece(2, HandBytes().put(std::uint64_t{0}).put(std::uint64_t{0}).put(0U).bytes()) + magic;
}

class ForeignRecording : public testing::TestWithParam<bool> {
 protected:
  HandDrive drive_{.is_cdr = GetParam()};
  TestFolder folder_, scratch_;

  void write(const std::string& compression) {
    const auto messages = hand_messages(drive_);
    GetParam() ? folder_.write("drive.mcap", hand_mcap(messages, compression))
               : folder_.write("drive.bag", hand_bag(messages, compression));
  }
  Outcome run(const std::vector<std::string>& arguments) {
    write(GetParam() ? "" : "none");
    return run_stereobench(arguments);
  }
  Outcome imported(const std::vector<std::string>& more = {}) {
    return run(with({"import", folder_.path().string(), "--out", (scratch_.path() / "in").string()}, more));
  }
};

// Mutations: a message's speeds hold from it on; transforms in the other order; red and blue stay as they
// are; rows without what is beyond their pixels.
TEST_P(ForeignRecording, ComesWithItsOdometry) {
  const Outcome outcome = imported();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("3 pairs in"));
  EXPECT_THAT(outcome.out,
              HasSubstr("5 x 3 px, focal length 100.50 px, baseline 0.2000 m, looking 0.00 deg down"));
  EXPECT_THAT(outcome.out, HasSubstr("no true poses; 2 recorded odometry readings, 0 sightings"));
  EXPECT_EQ(scratch_.read("in/odometry.csv"),
            "t_s,v_mps,w_radps\n1600000000.000000000,0.3,-0.1\n1600000000.500000000,0.5,0.05\n");
  EXPECT_EQ(scratch_.read("in/instants.csv"),
            "t_s\n1600000000.000000000\n1600000000.500000000\n1600000001.000000000\n");
  EXPECT_THAT(scratch_.read("in/calibration.yaml"), HasSubstr("0., 7.5000000000000000e-01,"));  // up
  for (const bool is_left : {true, false}) {
    const cv::Mat picture =
        read_levels(scratch_.path() / (is_left ? "in/left/000001.png" : "in/right/000001.png"));
    ASSERT_EQ(picture.size(), cv::Size(5, 3));
    EXPECT_EQ(picture.at<cv::Vec3b>(2, 4), cv::Vec3b(4, 20, is_left ? 200 : 100));
  }
  const Outcome slam = run_stereobench({"slam", (scratch_.path() / "in").string(), "--filters", "ekf",
                                        "--out", (scratch_.path() / "out").string()});
  EXPECT_EQ(slam.exit_code, 0) << slam.err;
}

TEST_P(ForeignRecording, HasNoFaults) {
  const Outcome outcome = run({"verify", folder_.path().string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("no faults"));
}

// Mutation: where the cameras are on the body is not looked at.
TEST_P(ForeignRecording, OdometryOfAnotherPointIsLeftOut) {
  drive_.ahead_m = 0.31;
  const Outcome outcome = imported();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("the recorded odometry is left out, it is that of a point from which the "
                        "middle of the cameras is 0.310 m ahead"));
  EXPECT_FALSE(fs::exists(scratch_.path() / "in/odometry.csv"));
  EXPECT_TRUE(fs::exists(scratch_.path() / "in/instants.csv"));
}

TEST_P(ForeignRecording, OdometryThatSlidesIsLeftOut) {
  drive_.sideways_mps = 0.2;
  EXPECT_THAT(imported().out, HasSubstr("is left out, it slides sideways, by 0.200 m/s"));
}

TEST_P(ForeignRecording, OtherPicturesAreRefused) {
  drive_.encoding = "bayer_rggb8";
  const Outcome outcome = imported();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              HasSubstr("expected pictures of mono8, bgr8, rgb8, bgra8 or rgba8 (got bayer_rggb8)"));
  EXPECT_FALSE(fs::exists(scratch_.path() / "in"));
}

TEST_P(ForeignRecording, CompressedChunksAreRefused) {
  write("lz4");
  const Outcome outcome = run_stereobench({"verify", folder_.path().string()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("the chunk is compressed by lz4; run `"));
}

TEST_P(ForeignRecording, OfNoPairSaysWhatThereIs) {
  const std::vector<HandMessage> only = {hand_messages(drive_).front()};
  GetParam() ? folder_.write("drive.mcap", hand_mcap(only, ""))
             : folder_.write("drive.bag", hand_bag(only, "none"));
  const Outcome outcome = run_stereobench({"verify", folder_.path().string()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              HasSubstr("expected sensor_msgs/Image as .../left/image_raw and .../right/image_raw (got "
                        "/tf_static tf2_msgs/TFMessage)"));
}

INSTANTIATE_TEST_SUITE_P(Containers, ForeignRecording, testing::Bool(),
                         [](const auto& is_mcap) { return is_mcap.param ? "mcap" : "rosbag"; });

}  // namespace
}  // namespace stereobench::harness
