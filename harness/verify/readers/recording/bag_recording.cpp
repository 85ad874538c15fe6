#include <algorithm>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/dataset/formats/container/bag_records.h"
#include "harness/types.h"
#include "harness/verify/readers/recording/file_pieces.h"
#include "harness/verify/readers/recording/recording.h"

namespace stereobench::harness {
namespace {

/// What bags of any version begin with.
constexpr std::string_view kAnyBagMagic = kBagMagic.substr(0, kBagMagic.find('V') + 1);

/// "name=value" after "name=value", each behind its length.
std::map<std::string, std::string> bag_fields(std::string_view bytes) {
  std::map<std::string, std::string> fields;
  for (LittleValues values(bytes); !values.is_at_end();) {
    const std::string_view field = values.text();
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos) throw std::runtime_error("expected name=value as a field");
    fields[std::string(field.substr(0, equals))] = field.substr(equals + 1);
  }
  return fields;
}

struct ReadBagRecord {
  std::uint64_t at = 0;  ///< in the file
  std::map<std::string, std::string> fields;
  std::uint64_t data_at = 0, data_size = 0;

  std::uint64_t end() const { return data_at + data_size; }
  BagOp op() const { return static_cast<BagOp>(number<std::uint8_t>(bag_field::kOp)); }
  const std::string& field(const std::string& name) const {
    const auto found = fields.find(name);
    if (found == fields.end()) throw std::runtime_error(fmt::format("expected a field {}", name));
    return found->second;
  }
  template <class Number>
  Number number(const std::string& name) const {
    return LittleValues(field(name)).number<Number>();
  }
};

std::int64_t bag_time_of(LittleValues& values) {
  const std::int64_t seconds = values.number<std::uint32_t>();
  return seconds * kSecond_ns + values.number<std::uint32_t>();
}

class BagReading {
 public:
  explicit BagReading(const std::filesystem::path& file) : file_(file) { recording_.file = file; }

  RecordedFile read() {
    const std::string begin = file_.piece(0, std::min<std::uint64_t>(kBagMagic.size(), file_.size()));
    if (begin != kBagMagic)
      file_.refuse(0, begin.starts_with(kAnyBagMagic) ? "expected a bag of version 2.0; run `rosbag fix`"
                                                      : "expected \"#ROSBAG V2.0\": it is no bag of ROS 1");
    const ReadBagRecord head = record_at(kBagMagic.size(), file_.size());
    file_.at_record(head.at, [&] { read_head(head); });
    for (std::uint64_t at = head.end(); at < file_.size();) {
      const ReadBagRecord record = record_at(at, file_.size());
      file_.at_record(record.at, [&] { read_record(record); });
      at = record.end();
    }
    compare("connections", connections_, topic_of_.size());
    compare("chunks", chunks_, chunks_found_);
    compare("chunks in the index", chunks_, infos_found_);
    compare("messages in the index", messages_in_infos_, recording_.messages.size());
    recording_.checked.push_back(fmt::format("index of the bag ({} messages)", recording_.messages.size()));
    return std::move(recording_);
  }

 private:
  ReadBagRecord record_at(std::uint64_t at, std::uint64_t end) {
    ReadBagRecord record = {.at = at, .fields = {}};
    const std::uint64_t fields_size = size_at(at, end), fields_at = at + sizeof(std::uint32_t);
    const std::string fields = file_.piece(fields_at, fields_size, end);
    file_.at_record(record.at, [&] { record.fields = bag_fields(fields); });
    record.data_size = size_at(fields_at + fields_size, end);
    record.data_at = fields_at + fields_size + sizeof(std::uint32_t);
    file_.require(record.data_at, record.data_size, end);
    return record;
  }
  std::uint64_t size_at(std::uint64_t at, std::uint64_t end) {
    return LittleValues(file_.piece(at, sizeof(std::uint32_t), end)).number<std::uint32_t>();
  }
  std::string data_of(const ReadBagRecord& record) { return file_.piece(record.data_at, record.data_size); }

  void read_head(const ReadBagRecord& head) {
    if (head.op() != BagOp::kHead) throw std::runtime_error("expected the bag's head");
    connections_ = head.number<std::uint32_t>(bag_field::kConnectionCount);
    chunks_ = head.number<std::uint32_t>(bag_field::kChunkCount);
    const auto index_at = head.number<std::uint64_t>(bag_field::kIndexPlace);
    if (index_at == 0) throw std::runtime_error("the bag was never closed; run `rosbag reindex`");
    if (index_at > file_.size())
      throw std::runtime_error(
          fmt::format("the index is said to begin at byte {}, and the file ends at byte {}: it is "
                      "cut short",
                      index_at, file_.size()));
  }
  void read_record(const ReadBagRecord& record);
  void read_connection(const ReadBagRecord& record);
  void read_chunk(const ReadBagRecord& chunk);
  void read_message(const ReadBagRecord& record);
  void read_index(const ReadBagRecord& record);
  void read_chunk_info(const ReadBagRecord& record);

  void compare(const char* what, std::uint64_t said, std::uint64_t found) {
    if (said == found) return;
    recording_.faults.push_back(
        fmt::format("{} {} by the bag's head or index, and {} are there", said, what, found));
  }

  FilePieces file_;
  RecordedFile recording_;
  std::map<std::uint32_t, std::size_t> topic_of_;  ///< by number of the connection
  /// Of the last chunk: by connection, where its messages begin, and when they were recorded.
  std::map<std::uint32_t, std::vector<std::pair<std::int64_t, std::uint64_t>>> in_chunk_;
  std::uint64_t connections_ = 0, chunks_ = 0, chunks_found_ = 0, infos_found_ = 0, messages_in_infos_ = 0;
};

void BagReading::read_record(const ReadBagRecord& record) {
  switch (record.op()) {
    case BagOp::kChunk:
      return read_chunk(record);
    case BagOp::kConnection:
      return read_connection(record);
    case BagOp::kIndex:
      return read_index(record);
    case BagOp::kChunkInfo:
      return read_chunk_info(record);
    case BagOp::kMessage:
      return read_message(record);
    default:
      return;  // of later versions
  }
}

void BagReading::read_connection(const ReadBagRecord& record) {
  const auto number = record.number<std::uint32_t>(bag_field::kConnection);
  if (topic_of_.contains(number)) return;  // each stands in a chunk and in the index
  topic_of_[number] = recording_.topics.size();
  ReadBagRecord about;
  about.fields = bag_fields(data_of(record));
  recording_.topics.push_back(
      {record.field(bag_field::kTopic), about.field(bag_field::kType), RosVersion::kOne});
}

void BagReading::read_chunk(const ReadBagRecord& chunk) {
  if (chunk.field(bag_field::kCompression) != kBagUncompressed)
    throw std::runtime_error(fmt::format("the chunk is compressed by {}; run `rosbag decompress`",
                                         chunk.field(bag_field::kCompression)));
  ++chunks_found_;
  in_chunk_.clear();
  for (std::uint64_t at = chunk.data_at; at < chunk.end();) {
    const ReadBagRecord record = record_at(at, chunk.end());
    file_.at_record(record.at, [&] {
      if (record.op() == BagOp::kConnection) read_connection(record);
      if (record.op() != BagOp::kMessage) return;
      read_message(record);
      in_chunk_[record.number<std::uint32_t>(bag_field::kConnection)].emplace_back(
          recording_.messages.back().stamp_ns, at - chunk.data_at);
    });
    at = record.end();
  }
}

void BagReading::read_message(const ReadBagRecord& record) {
  const auto topic = topic_of_.find(record.number<std::uint32_t>(bag_field::kConnection));
  if (topic == topic_of_.end()) throw std::runtime_error("a message of a connection that is not described");
  LittleValues time(record.field(bag_field::kTime));
  recording_.messages.push_back({topic->second, bag_time_of(time), record.data_at, record.data_size, {}});
}

void BagReading::read_index(const ReadBagRecord& record) {
  const auto number = record.number<std::uint32_t>(bag_field::kConnection);
  std::vector<std::pair<std::int64_t, std::uint64_t>> entries;
  const std::string data = data_of(record);
  for (LittleValues values(data); !values.is_at_end();) {
    const std::int64_t stamp_ns = bag_time_of(values);
    entries.emplace_back(stamp_ns, values.number<std::uint32_t>());
  }
  // Not those of another length: a chunk may be followed by any number of indices.
  std::vector<std::pair<std::int64_t, std::uint64_t>>& there = in_chunk_[number];
  const bool may_be_same = entries.size() == there.size();
  if (may_be_same) {  // messages need not be in order of time
    std::ranges::sort(entries);
    std::ranges::sort(there);
  }
  if (!may_be_same || entries != there)
    recording_.faults.push_back(
        fmt::format("byte {}: the index of a chunk is not that of its messages "
                    "(connection {})",
                    record.at, number));
}

void BagReading::read_chunk_info(const ReadBagRecord& record) {
  ++infos_found_;
  const std::string data = data_of(record);
  for (LittleValues values(data); !values.is_at_end();) {
    values.number<std::uint32_t>();  // the connection
    messages_in_infos_ += values.number<std::uint32_t>();
  }
}

}  // namespace

RecordedFile read_bag(const std::filesystem::path& file) {
  return BagReading(file).read();
}

}  // namespace stereobench::harness
