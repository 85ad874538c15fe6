/// Recordings of ROS 1: the bag format, version 2.0 (wiki.ros.org/Bags/Format/2.0).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "harness/io/atomic_file.h"

namespace stereobench::harness {

/// A topic of a bag.
struct BagConnection {
  std::string topic;
  std::string type;
  std::string md5;         ///< of the definition
  std::string definition;  ///< of the type
  bool is_latched = false;
};

/// Writes messages in chunks without compression, each followed by its index, and the list of chunks at the
/// end.
class BagFile {
 public:
  /// @param file empty; it outlives this
  BagFile(AtomicFile& file, std::vector<BagConnection> connections);

  /// @param connection index into the connections
  /// @param stamp_ns > 0; not before that of the message before
  void add(std::size_t connection, std::int64_t stamp_ns, std::string_view message);

  /// Ends the file.
  void finish();

 private:
  struct IndexEntry {
    std::int64_t stamp_ns = 0;
    std::size_t offset = 0;  ///< in the chunk
  };
  struct ChunkInfo {
    std::uint64_t place = 0;  ///< in the file
    std::int64_t first_ns = 0, last_ns = 0;
    std::map<std::size_t, std::size_t> messages;  ///< of each connection
  };

  void append(std::string_view bytes);
  std::string connection_record(std::size_t connection) const;
  std::string head_record(std::uint64_t index_place, std::size_t connections) const;
  void end_chunk();

  AtomicFile& file_;
  std::vector<BagConnection> connections_;
  std::uint64_t size_ = 0;  ///< of the file so far
  std::string chunk_;
  std::map<std::size_t, std::vector<IndexEntry>> chunk_index_;  ///< of each connection
  std::vector<ChunkInfo> chunks_;
  std::vector<bool> is_used_;
};

}  // namespace stereobench::harness
