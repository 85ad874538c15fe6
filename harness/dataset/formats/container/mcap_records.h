/// What MCAP files are made of (mcap.dev/spec), for those that write and that read them.
#pragma once

#include <cstdint>
#include <string_view>

namespace stereobench::harness {

/// What a file of version 0 begins and ends with.
inline constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";

/// Kinds of records.
enum class McapOp : std::uint8_t {
  kHeader = 1,
  kFooter = 2,
  kSchema = 3,
  kChannel = 4,
  kMessage = 5,
  kChunk = 6,
  kStatistics = 11,
  kSummaryOffset = 14,
  kDataEnd = 15
};

/// The encoding of ROS 2's messages.
inline constexpr std::string_view kMcapCdr = "cdr";

}  // namespace stereobench::harness
