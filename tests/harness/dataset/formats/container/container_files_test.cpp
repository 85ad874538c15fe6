/// Bags and archives byte by byte, and what the formats refuse; tests/readers/ has readers of whole drives.
#include <map>
#include <tuple>

#include <gmock/gmock.h>

#include "harness/dataset/formats/container/bag_file.h"
#include "harness/dataset/formats/container/tar_file.h"
#include "tests/harness/dataset/formats/written_drive.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::uint64_t little_at(const std::string& bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = size; i-- > 0;) value = (value << 8) | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

/// A record of a bag: its fields, its data, and where the next one begins.
struct BagRecord {
  std::map<std::string, std::string> fields;
  std::string data;
  std::size_t end = 0;

  std::uint64_t number(const std::string& name) const {
    return little_at(fields.at(name), 0, fields.at(name).size());
  }
};

BagRecord record_at(const std::string& bytes, std::size_t at) {
  BagRecord record;
  const std::size_t fields_end = at + 4 + little_at(bytes, at, 4);
  for (at += 4; at < fields_end;) {
    const std::string field = bytes.substr(at + 4, little_at(bytes, at, 4));
    const std::size_t equals = field.find('=');
    record.fields[field.substr(0, equals)] = field.substr(equals + 1);
    at += 4 + field.size();
  }
  record.data = bytes.substr(at + 4, little_at(bytes, at, 4));
  record.end = at + 4 + record.data.size();
  return record;
}

constexpr std::size_t kMagicBytes = 13;

std::string bag_of(const std::vector<std::tuple<std::size_t, std::int64_t, std::string>>& messages) {
  const TestFolder folder;
  AtomicFile file(folder.path() / "a.bag");
  BagFile bag(file, {{"/a", "p/A", "md", "int8 a\n", false}, {"/b", "p/B", "md", "int8 b\n", true}});
  for (const auto& [connection, stamp_ns, message] : messages) bag.add(connection, stamp_ns, message);
  bag.finish();
  file.move_into_place();
  return folder.read("a.bag");
}

// Law: each entry of an index leads to its message. Meant to catch: offsets from the file's begin; from
// behind the message; the place of the chunk a record later; the index's place left at 0.
TEST(BagFile, LeadsToEachMessage) {
  const std::string large(800'000, 'x');
  const std::string bytes =
      bag_of({{0, 5'000'000'001, "one"}, {1, 5'000'000'002, large}, {0, 6'000'000'003, "three"}});
  const BagRecord head = record_at(bytes, kMagicBytes);
  EXPECT_EQ(head.end, kMagicBytes + 4096);
  EXPECT_EQ(head.number("chunk_count"), 2U);
  EXPECT_EQ(head.number("conn_count"), 2U);
  std::vector<std::string> found;
  for (std::size_t at = head.number("index_pos"); at < bytes.size();) {
    const BagRecord info = record_at(bytes, at);
    at = info.end;
    if (info.number("op") != 6) continue;
    const BagRecord chunk = record_at(bytes, info.number("chunk_pos"));
    ASSERT_EQ(chunk.number("op"), 5U);
    EXPECT_EQ(chunk.number("size"), chunk.data.size());
    BagRecord index = record_at(bytes, chunk.end);
    for (std::uint64_t i = 0; i < info.number("count"); ++i) {
      ASSERT_EQ(index.number("op"), 4U);
      EXPECT_EQ(index.number("conn"), little_at(info.data, 8 * i, 4));
      EXPECT_EQ(index.number("count"), little_at(info.data, 8 * i + 4, 4));
      for (std::size_t entry = 0; entry < index.data.size(); entry += 12) {
        const BagRecord message = record_at(chunk.data, little_at(index.data, entry + 8, 4));
        EXPECT_EQ(message.number("op"), 2U);
        EXPECT_EQ(message.number("conn"), index.number("conn"));
        EXPECT_EQ(message.fields.at("time"), index.data.substr(entry, 8));
        found.push_back(message.data.substr(0, 5));
      }
      if (i + 1 < info.number("count")) index = record_at(bytes, index.end);
    }
  }
  EXPECT_THAT(found, testing::ElementsAre("one", "xxxxx", "three"));
}

// A topic without messages is in no list. Meant to catch: all of them listed.
TEST(BagFile, NamesTheTopicsThatHaveMessages) {
  const BagRecord head = record_at(bag_of({{1, 5'000'000'001, "one"}}), kMagicBytes);
  EXPECT_EQ(head.number("conn_count"), 1U);
  EXPECT_EQ(record_at(bag_of({}), kMagicBytes).number("chunk_count"), 0U);
}

// Meant to catch: a sum over what stands in its place; the size in decimal digits; no padding.
TEST(TarFile, HasTheHeaderOfPosix) {
  const TestFolder folder;
  AtomicFile file(folder.path() / "a.tar");
  TarFile tar(file);
  tar.add("a.json", std::string(600, 'j'));
  tar.add("b.json", "");
  tar.finish();
  file.move_into_place();
  const std::string bytes = folder.read("a.tar");
  ASSERT_EQ(bytes.size(), 512U + 1024U + 512U + 1024U);
  EXPECT_EQ(bytes.substr(124, 12), std::string("00000001130\0", 12));
  EXPECT_EQ(bytes.substr(257, 8), std::string("ustar\00000", 8));
  std::string header = bytes.substr(0, 512);
  const auto sum = static_cast<unsigned>(std::stoul(header.substr(148, 6), nullptr, 8));
  header.replace(148, 8, 8, ' ');
  unsigned wanted = 0;
  for (const char byte : header) wanted += static_cast<unsigned char>(byte);
  EXPECT_EQ(sum, wanted);
  EXPECT_EQ(bytes.substr(1536, 6), "b.json");
  EXPECT_THROW(tar.add(std::string(101, 'n'), ""), std::invalid_argument);
}

/// A format and a change of the scenario that it has no place for.
struct RefusedChange {
  const char* format;
  const char* key;
  void (*change)(worlds::Scenario&);
};

class ContainerRefuses : public testing::TestWithParam<RefusedChange> {};

// Meant to catch: each check left out.
TEST_P(ContainerRefuses, WhatItHasNoPlaceFor) {
  worlds::Scenario scenario = tilted_drive();
  GetParam().change(scenario);
  const DatasetDrive drive = drive_of(scenario, scenario.world, 0);
  EXPECT_THAT([&] { dataset_format(GetParam().format).check(drive); },
              ThrowsMessage<std::runtime_error>(HasSubstr(std::string("the format ") + GetParam().format +
                                                          " has no place for " + GetParam().key)));
  dataset_format("mrclam").check(drive);
  if (std::string_view(GetParam().key) != "shutter.readout_s") dataset_format("webdataset").check(drive);
}

const auto kTurned = [](worlds::Scenario& scenario) {
  scenario.rig.right_turn_rad.x() = scenario.believed_rig.right_turn_rad.x() = 0.01;
};
const auto kWrong = [](worlds::Scenario& scenario) { scenario.believed_rig.baseline_m = 0.2; };
const auto kLate = [](worlds::Scenario& scenario) { scenario.shutter.late_probability = 0.5; };
const auto kDelayed = [](worlds::Scenario& scenario) { scenario.shutter.right_delay_s = 0.01; };
const auto kRolling = [](worlds::Scenario& scenario) { scenario.shutter.readout_s = 0.01; };

INSTANTIATE_TEST_SUITE_P(Changes, ContainerRefuses,
                         testing::Values(RefusedChange{"rosbag", "rig.right_turn_deg", kTurned},
                                         RefusedChange{"rosbag", "believed_rig", kWrong},
                                         RefusedChange{"rosbag", "shutter.late_probability", kLate},
                                         RefusedChange{"rosbag", "shutter.right_delay_s", kDelayed},
                                         RefusedChange{"rosbag", "shutter.readout_s", kRolling},
                                         RefusedChange{"mcap", "rig.right_turn_deg", kTurned},
                                         RefusedChange{"mcap", "shutter.readout_s", kRolling},
                                         RefusedChange{"webdataset", "shutter.readout_s", kRolling}));

}  // namespace
}  // namespace stereobench::harness
