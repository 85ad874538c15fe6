// Recordings of the bend in which a fault is planted: messages are taken out of the container, changed, and
// written into a new one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/verify/readers/recording/recording.h"
#include "tests/harness/verify/planted_set.h"

namespace stereobench::harness {

inline const std::string kRecordings = "rosbag,mcap";

struct PlantedMessage {
  std::string topic;
  std::int64_t stamp_ns = 0;
  std::uint32_t sequence = 0;
  std::string bytes;
};

class PlantedRecording {
 public:
  explicit PlantedRecording(const std::string& format);

  std::vector<PlantedMessage> messages;

  /// Those of a topic, in their order.
  std::vector<PlantedMessage*> of(const std::string& topic);
  /// Takes out the messages of some topics at a time.
  void remove(const std::vector<std::string>& topics, std::int64_t stamp_ns);

  /// Writes the container anew, and verifies it.
  std::string faults() const;
  /// The container's file, once it is written.
  std::filesystem::path file() const { return folder_.path() / name_; }
  std::filesystem::path folder() const { return folder_.path(); }
  void write() const;

 private:
  TestFolder folder_;
  std::string format_, name_;
};

/// How many bytes the pixels of a picture's message are: its last ones.
inline constexpr std::size_t kPixelBytes = std::size_t{3} * 320 * 240;

/// Exchanges the pixels of two messages.
void swap_pixels(PlantedMessage& one, PlantedMessage& other);

}  // namespace stereobench::harness
