#include "harness/dataset/formats/container/bag_file.h"

#include <algorithm>
#include <concepts>

#include "harness/dataset/formats/container/bag_records.h"
#include "harness/types.h"

namespace stereobench::harness {
namespace {

/// The record after it has this size, so that it can be replaced when the rest is known.
constexpr std::size_t kHeadRecord = 4096;
/// A chunk ends with the message that makes it larger, as those of the `rosbag` program.
constexpr std::size_t kChunkBytes = 768 * 1024;

/// Unsigned, least byte first.
template <std::unsigned_integral Number>
std::string little(Number value) {
  std::string bytes;
  for (std::size_t i = 0; i < sizeof(Number); ++i)
    bytes.push_back(static_cast<char>((static_cast<std::uint64_t>(value) >> (8 * i)) & 0xff));
  return bytes;
}

std::string little32(std::size_t value) {
  return little(static_cast<std::uint32_t>(value));
}

std::string bag_time(std::int64_t ns) {
  return little32(static_cast<std::size_t>(ns / kSecond_ns)) +
         little32(static_cast<std::size_t>(ns % kSecond_ns));
}

/// The fields of a record.
class BagFields {
 public:
  BagFields() = default;
  explicit BagFields(BagOp op) { add(bag_field::kOp, little(static_cast<std::uint8_t>(op))); }
  BagFields& add(std::string_view name, std::string_view value) {
    bytes_ += little32(name.size() + 1 + value.size());
    bytes_.append(name).append("=").append(value);
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// What stands before the data of a record.
std::string record_head(const BagFields& fields, std::size_t data_bytes) {
  return little32(fields.bytes().size()) + fields.bytes() + little32(data_bytes);
}

std::string bag_record(const BagFields& fields, std::string_view data) {
  return record_head(fields, data.size()).append(data);
}

}  // namespace

BagFile::BagFile(AtomicFile& file, std::vector<BagConnection> connections)
    : file_(file), connections_(std::move(connections)), is_used_(connections_.size(), false) {
  append(kBagMagic);
  append(head_record(0, 0));
}

void BagFile::append(std::string_view bytes) {
  file_.append(bytes);
  size_ += bytes.size();
}

std::string BagFile::connection_record(std::size_t connection) const {
  const BagConnection& about = connections_[connection];
  BagFields fields(BagOp::kConnection), data;
  fields.add(bag_field::kConnection, little32(connection)).add(bag_field::kTopic, about.topic);
  data.add(bag_field::kTopic, about.topic)
      .add(bag_field::kType, about.type)
      .add("md5sum", about.md5)
      .add("message_definition", about.definition);
  if (about.is_latched) data.add("latching", "1");
  return bag_record(fields, data.bytes());
}

std::string BagFile::head_record(std::uint64_t index_place, std::size_t connections) const {
  BagFields fields(BagOp::kHead);
  fields.add(bag_field::kIndexPlace, little(index_place))
      .add(bag_field::kConnectionCount, little32(connections))
      .add(bag_field::kChunkCount, little32(chunks_.size()));
  const std::size_t padding = kHeadRecord - record_head(fields, 0).size();
  return bag_record(fields, std::string(padding, ' '));
}

void BagFile::add(std::size_t connection, std::int64_t stamp_ns, std::string_view message) {
  if (!is_used_[connection]) chunk_ += connection_record(connection);
  is_used_[connection] = true;
  if (chunk_index_.empty()) chunks_.push_back({.place = size_, .first_ns = stamp_ns});
  chunk_index_[connection].push_back({stamp_ns, chunk_.size()});
  chunks_.back().last_ns = stamp_ns;
  BagFields fields(BagOp::kMessage);
  fields.add(bag_field::kConnection, little32(connection)).add(bag_field::kTime, bag_time(stamp_ns));
  chunk_ += record_head(fields, message.size());
  chunk_ += message;
  if (chunk_.size() > kChunkBytes) end_chunk();
}

void BagFile::end_chunk() {
  if (chunk_index_.empty()) return;
  BagFields chunk(BagOp::kChunk);
  chunk.add(bag_field::kCompression, kBagUncompressed).add("size", little32(chunk_.size()));
  append(record_head(chunk, chunk_.size()));
  append(chunk_);
  for (const auto& [connection, entries] : chunk_index_) {
    std::string data;
    for (const IndexEntry& entry : entries) data += bag_time(entry.stamp_ns) + little32(entry.offset);
    BagFields index(BagOp::kIndex);
    index.add("ver", little32(1))
        .add(bag_field::kConnection, little32(connection))
        .add("count", little32(entries.size()));
    append(bag_record(index, data));
    chunks_.back().messages[connection] = entries.size();
  }
  chunk_.clear();
  chunk_index_.clear();
}

void BagFile::finish() {
  end_chunk();
  const std::uint64_t index_place = size_;
  for (std::size_t connection = 0; connection < connections_.size(); ++connection)
    if (is_used_[connection]) append(connection_record(connection));
  for (const ChunkInfo& chunk : chunks_) {
    std::string data;
    for (const auto& [connection, count] : chunk.messages) data += little32(connection) + little32(count);
    BagFields fields(BagOp::kChunkInfo);
    fields.add("ver", little32(1))
        .add("chunk_pos", little(chunk.place))
        .add("start_time", bag_time(chunk.first_ns))
        .add("end_time", bag_time(chunk.last_ns))
        .add("count", little32(chunk.messages.size()));
    append(bag_record(fields, data));
  }
  const auto used = static_cast<std::size_t>(std::ranges::count(is_used_, true));
  file_.overwrite(kBagMagic.size(), head_record(index_place, used));
}

}  // namespace stereobench::harness
