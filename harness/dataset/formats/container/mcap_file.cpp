#include "harness/dataset/formats/container/mcap_file.h"

#include <algorithm>
#include <concepts>
#include <initializer_list>
#include <numeric>
#include <utility>

#include <zlib.h>

#include "harness/dataset/formats/container/mcap_records.h"

namespace stereobench::harness {
namespace {

/// The content of a record.
class McapContent {
 public:
  template <std::unsigned_integral Number>
  McapContent& number(Number value) {
    for (std::size_t i = 0; i < sizeof(Number); ++i)
      bytes_.push_back(static_cast<char>((static_cast<std::uint64_t>(value) >> (8 * i)) & 0xff));
    return *this;
  }
  McapContent& number16(std::size_t value) { return number(static_cast<std::uint16_t>(value)); }
  McapContent& number32(std::size_t value) { return number(static_cast<std::uint32_t>(value)); }
  McapContent& number64(std::size_t value) { return number(static_cast<std::uint64_t>(value)); }
  McapContent& text(std::string_view text) {
    number32(text.size());
    bytes_.append(text);
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// What stands before the content of a record.
std::string mcap_head(McapOp op, std::size_t bytes) {
  return McapContent().number(static_cast<std::uint8_t>(op)).number64(bytes).bytes();
}

std::string mcap_record(McapOp op, const McapContent& content) {
  return mcap_head(op, content.bytes().size()) + content.bytes();
}

std::uint32_t crc_of(std::uint32_t crc, std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(crc, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

}  // namespace

McapFile::McapFile(AtomicFile& file, std::vector<McapChannel> channels)
    : file_(file), channels_(std::move(channels)), messages_(channels_.size(), 0) {
  for (const McapChannel& channel : channels_)
    if (std::ranges::find(schemas_, channel.schema) == schemas_.end()) schemas_.push_back(channel.schema);
  append(kMcapMagic);
  append(mcap_record(McapOp::kHeader, McapContent().text("ros2").text("stereobench")));
  append(schema_records());
  append(channel_records());
}

void McapFile::append(std::string_view bytes) {
  file_.append(bytes);
  size_ += bytes.size();
  crc_ = crc_of(crc_, bytes);
}

std::string McapFile::schema_records() const {
  std::string records;
  for (std::size_t i = 0; i < schemas_.size(); ++i) {
    const McapChannel& channel = *std::ranges::find(channels_, schemas_[i], &McapChannel::schema);
    records +=
        mcap_record(McapOp::kSchema,
                    McapContent().number16(i + 1).text(schemas_[i]).text("ros2msg").text(channel.definition));
  }
  return records;
}

std::string McapFile::channel_records() const {
  const std::string no_quality = McapContent().text("offered_qos_profiles").text("").bytes();
  std::string records;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const auto schema = std::ranges::find(schemas_, channels_[i].schema) - schemas_.begin();
    records += mcap_record(McapOp::kChannel, McapContent()
                                                 .number16(i)
                                                 .number16(static_cast<std::size_t>(schema) + 1)
                                                 .text(channels_[i].topic)
                                                 .text(kMcapCdr)
                                                 .text(no_quality));
  }
  return records;
}

void McapFile::add(std::size_t channel, std::uint32_t sequence, std::int64_t stamp_ns,
                   std::string_view message) {
  const bool is_first = std::ranges::count(messages_, 0U) == std::ssize(messages_);
  first_ns_ = is_first ? stamp_ns : std::min(first_ns_, stamp_ns);
  last_ns_ = std::max(last_ns_, stamp_ns);
  ++messages_[channel];
  const auto time = static_cast<std::uint64_t>(stamp_ns);
  const McapContent head = McapContent().number16(channel).number(sequence).number(time).number(time);
  append(mcap_head(McapOp::kMessage, head.bytes().size() + message.size()));
  append(head.bytes());
  append(message);
}

std::string McapFile::statistics_record() const {
  McapContent counts;
  for (std::size_t i = 0; i < messages_.size(); ++i) counts.number16(i).number64(messages_[i]);
  McapContent content;
  content.number64(std::accumulate(messages_.begin(), messages_.end(), std::uint64_t{0}))
      .number16(schemas_.size())
      .number32(channels_.size());
  for (int none = 0; none < 3; ++none) content.number32(0);  // attachments, metadata, chunks
  content.number64(static_cast<std::uint64_t>(first_ns_))
      .number64(static_cast<std::uint64_t>(last_ns_))
      .text(counts.bytes());
  return mcap_record(McapOp::kStatistics, content);
}

void McapFile::finish() {
  append(mcap_record(McapOp::kDataEnd, McapContent().number(crc_)));
  const std::uint64_t summary_place = size_;
  std::string summary, offsets;
  for (const auto& [op, group] :
       {std::pair(McapOp::kSchema, schema_records()), std::pair(McapOp::kChannel, channel_records()),
        std::pair(McapOp::kStatistics, statistics_record())}) {
    offsets += mcap_record(McapOp::kSummaryOffset, McapContent()
                                                       .number(static_cast<std::uint8_t>(op))
                                                       .number64(summary_place + summary.size())
                                                       .number64(group.size()));
    summary += group;
  }
  const McapContent places = McapContent().number64(summary_place).number64(summary_place + summary.size());
  summary += offsets;
  summary += mcap_head(McapOp::kFooter, places.bytes().size() + sizeof(std::uint32_t)) + places.bytes();
  append(summary);
  append(McapContent().number(crc_of(0, summary)).bytes());
  append(kMcapMagic);
}

}  // namespace stereobench::harness
