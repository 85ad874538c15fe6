#include <limits>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/dataset/formats/container/mcap_records.h"
#include "harness/verify/readers/recording/file_pieces.h"
#include "harness/verify/readers/recording/recording.h"

namespace stereobench::harness {
namespace {

constexpr std::uint64_t kMcapHeadBytes = sizeof(std::uint8_t) + sizeof(std::uint64_t);

struct ReadMcapRecord {
  std::uint64_t at = 0;  ///< in the file
  McapOp op = McapOp::kHeader;
  std::uint64_t data_at = 0, data_size = 0;

  std::uint64_t end() const { return data_at + data_size; }
};

/// "sensor_msgs/msg/Image" as ROS 1 calls it.
std::string plain_type(std::string_view name) {
  constexpr std::string_view kPart = "/msg/";
  std::string type(name);
  const std::size_t at = type.find(kPart);
  if (at != std::string::npos) type.replace(at, kPart.size(), "/");
  return type;
}

class McapReading {
 public:
  explicit McapReading(const std::filesystem::path& file) : file_(file) { recording_.file = file; }

  RecordedFile read() {
    const std::uint64_t magic = kMcapMagic.size(), end = file_.size();
    if (end < magic || file_.piece(0, magic) != kMcapMagic)
      file_.refuse(0, "expected the magic bytes of MCAP, version 0");
    std::uint64_t at = magic;
    while (!is_at_footer_) {
      const ReadMcapRecord record = record_at(at, end);
      file_.at_record(at, [&] { read_record(record); });
      at = record.end();
    }
    if (end - at != magic || file_.piece(at, magic) != kMcapMagic)
      file_.refuse(at, "expected the magic bytes of MCAP behind the footer, and nothing else");
    recording_.checked.push_back(fmt::format("checksums of MCAP ({})", checksums_));
    return std::move(recording_);
  }

 private:
  ReadMcapRecord record_at(std::uint64_t at, std::uint64_t end) {
    const std::string head = file_.piece(at, kMcapHeadBytes, end);
    LittleValues values(head);
    ReadMcapRecord record = {.at = at, .op = static_cast<McapOp>(values.number<std::uint8_t>())};
    record.data_at = at + kMcapHeadBytes;
    record.data_size = values.number<std::uint64_t>();
    file_.require(record.data_at, record.data_size, end);
    return record;
  }
  std::string data_of(const ReadMcapRecord& record) { return file_.piece(record.data_at, record.data_size); }

  void read_record(const ReadMcapRecord& record);
  void read_schema(const ReadMcapRecord& record);
  void read_channel(const ReadMcapRecord& record);
  void read_message(const ReadMcapRecord& record);
  void read_chunk(const ReadMcapRecord& record);
  void read_statistics(const ReadMcapRecord& record);

  /// @param said 0: nothing is
  void compare_crc(const char* of, std::uint32_t said, std::uint64_t at, std::uint64_t end) {
    if (said == 0) return;
    ++checksums_;
    if (file_.crc_of(at, end) != said)
      recording_.faults.push_back(
          fmt::format("checksum of the {} at byte {}: its bytes are not those that were written (a flipped "
                      "bit, or edited)",
                      of, at));
  }

  FilePieces file_;
  RecordedFile recording_;
  std::map<std::uint16_t, std::string> types_;     ///< by number of the schema
  std::map<std::uint16_t, std::size_t> topic_of_;  ///< by number of the channel
  bool is_at_end_of_data_ = false, is_at_footer_ = false;
  int checksums_ = 0;
};

void McapReading::read_record(const ReadMcapRecord& record) {
  // The summary repeats schemas and channels.
  if (record.op == McapOp::kSchema) return read_schema(record);
  if (record.op == McapOp::kChannel) return read_channel(record);
  if (record.op == McapOp::kMessage) return read_message(record);
  if (record.op == McapOp::kChunk) return read_chunk(record);
  if (record.op == McapOp::kStatistics) return read_statistics(record);
  if (record.op == McapOp::kDataEnd) {
    if (is_at_end_of_data_) throw std::runtime_error("expected one end of the data (got a second one)");
    is_at_end_of_data_ = true;
    const std::string data = data_of(record);
    compare_crc("data", LittleValues(data).number<std::uint32_t>(), 0, record.at);
  }
  if (record.op == McapOp::kFooter) {
    if (!is_at_end_of_data_) throw std::runtime_error("expected the end of the data before the footer");
    is_at_footer_ = true;
    const std::string data = data_of(record);
    LittleValues values(data);
    const auto summary_at = values.number<std::uint64_t>();
    values.number<std::uint64_t>();  // offsets
    const std::uint64_t said_at = record.data_at + values.at();
    const auto said = values.number<std::uint32_t>();
    if (summary_at > said_at) throw std::runtime_error("expected the summary before the footer");
    if (summary_at != 0) compare_crc("summary", said, summary_at, said_at);
  }
}

void McapReading::read_schema(const ReadMcapRecord& record) {
  const std::string data = data_of(record);
  LittleValues values(data);
  const auto number = values.number<std::uint16_t>();
  types_[number] = plain_type(values.text());
}

void McapReading::read_channel(const ReadMcapRecord& record) {
  const std::string data = data_of(record);
  LittleValues values(data);
  const auto number = values.number<std::uint16_t>();
  if (topic_of_.contains(number)) return;
  const auto schema = values.number<std::uint16_t>();
  const std::string_view topic = values.text(), encoding = values.text();
  const bool is_one = encoding == "ros1";
  if (schema != 0 && !types_.contains(schema))
    throw std::runtime_error(fmt::format("{}: its schema {} is not described", topic, schema));
  topic_of_[number] = recording_.topics.size();
  recording_.topics.push_back({std::string(topic), is_one || encoding == kMcapCdr ? types_[schema] : "",
                               is_one ? RosVersion::kOne : RosVersion::kTwo});
}

void McapReading::read_message(const ReadMcapRecord& record) {
  if (is_at_end_of_data_) throw std::runtime_error("a message behind the end of the data");
  constexpr std::uint64_t kHeadBytes = 2 + 4 + 8 + 8;
  const std::string head = file_.piece(record.data_at, kHeadBytes, record.end());
  LittleValues values(head);
  const auto topic = topic_of_.find(values.number<std::uint16_t>());
  if (topic == topic_of_.end()) throw std::runtime_error("a message of a channel that is not described");
  const auto sequence = values.number<std::uint32_t>();
  const auto stamp_ns = values.number<std::uint64_t>();
  if (stamp_ns > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
    throw std::runtime_error(fmt::format("the time {} ns is none", stamp_ns));
  recording_.messages.push_back({topic->second, static_cast<std::int64_t>(stamp_ns),
                                 record.data_at + kHeadBytes, record.data_size - kHeadBytes, sequence});
}

void McapReading::read_chunk(const ReadMcapRecord& record) {
  constexpr std::uint64_t kTimes = 8 + 8, kMostHead = kTimes + 8 + 4 + 4 + 255 + 8;
  const std::string head = file_.piece(record.data_at, std::min(kMostHead, record.data_size));
  LittleValues values(head);
  values.bytes(kTimes);
  values.number<std::uint64_t>();  // size without compression
  const auto crc = values.number<std::uint32_t>();
  if (const std::string_view compression = values.text(); !compression.empty())
    throw std::runtime_error(
        fmt::format("the chunk is compressed by {}; run `mcap decompress`", compression));
  const auto size = values.number<std::uint64_t>();
  std::uint64_t at = record.data_at + values.at();
  file_.require(at, size, record.end());
  const std::uint64_t end = at + size;
  compare_crc("chunk", crc, at, end);
  while (at < end) {
    const ReadMcapRecord inner = record_at(at, end);
    if (inner.op != McapOp::kSchema && inner.op != McapOp::kChannel && inner.op != McapOp::kMessage)
      throw std::runtime_error(fmt::format("a record of kind {} in a chunk", static_cast<int>(inner.op)));
    file_.at_record(at, [&] { read_record(inner); });
    at = inner.end();
  }
}

void McapReading::read_statistics(const ReadMcapRecord& record) {
  const std::string data = data_of(record);
  const auto said = LittleValues(data).number<std::uint64_t>();
  if (said != recording_.messages.size())
    recording_.faults.push_back(
        fmt::format("{} messages by the statistics, and {} are there", said, recording_.messages.size()));
}

}  // namespace

RecordedFile read_mcap(const std::filesystem::path& file) {
  return McapReading(file).read();
}

}  // namespace stereobench::harness
