/// What bags of ROS 1 are made of (wiki.ros.org/Bags/Format/2.0), for those that write and that read them.
#pragma once

#include <cstdint>
#include <string_view>

namespace stereobench::harness {

/// What a bag begins with.
inline constexpr std::string_view kBagMagic = "#ROSBAG V2.0\n";

/// Kinds of records.
enum class BagOp : std::uint8_t {
  kMessage = 2,
  kHead = 3,
  kIndex = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7
};

/// Names of a record's fields.
namespace bag_field {
inline constexpr const char* kOp = "op";
inline constexpr const char* kConnection = "conn";
inline constexpr const char* kTime = "time";
inline constexpr const char* kTopic = "topic";
inline constexpr const char* kType = "type";
inline constexpr const char* kCompression = "compression";
inline constexpr const char* kIndexPlace = "index_pos";
inline constexpr const char* kConnectionCount = "conn_count";
inline constexpr const char* kChunkCount = "chunk_count";
}  // namespace bag_field

/// The compression of a chunk that has none.
inline constexpr std::string_view kBagUncompressed = "none";

}  // namespace stereobench::harness
