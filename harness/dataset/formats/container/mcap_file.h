/// Recordings as MCAP (mcap.dev, version 0), without chunks.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "harness/io/atomic_file.h"

namespace stereobench::harness {

/// A topic of a recording, with the type of its messages.
struct McapChannel {
  std::string topic;
  std::string schema;      ///< the type's name; channels of one type share its definition
  std::string definition;  ///< of the type, as ros2msg
};

/// Writes messages of ROS 2 one after the other, and at the end how many there are of each channel.
class McapFile {
 public:
  /// @param file empty; it outlives this
  McapFile(AtomicFile& file, std::vector<McapChannel> channels);

  /// @param channel index into the channels
  /// @param sequence counts the messages of the channel
  /// @param stamp_ns >= 0
  /// @param message CDR
  void add(std::size_t channel, std::uint32_t sequence, std::int64_t stamp_ns, std::string_view message);

  /// Ends the file.
  void finish();

 private:
  void append(std::string_view bytes);
  std::string schema_records() const;
  std::string channel_records() const;
  std::string statistics_record() const;

  AtomicFile& file_;
  std::vector<McapChannel> channels_;
  std::vector<std::string> schemas_;     ///< names; the number of one is its place + 1
  std::vector<std::uint64_t> messages_;  ///< of each channel
  std::int64_t first_ns_ = 0, last_ns_ = 0;
  std::uint64_t size_ = 0;  ///< of the file so far
  std::uint32_t crc_ = 0;   ///< of it
};

}  // namespace stereobench::harness
