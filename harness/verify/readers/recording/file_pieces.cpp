#include "harness/verify/readers/recording/file_pieces.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <zlib.h>

#include "harness/verify/readers/recording/recording.h"
#include "worlds/yaml/excerpt.h"

namespace stereobench::harness {

namespace {

/// Names from the file are part of what is said.
constexpr std::size_t kMostOfRecord = 400;

}  // namespace

namespace fs = std::filesystem;

FilePieces::FilePieces(const fs::path& file) : file_(file), stream_(file, std::ios::binary) {
  if (!fs::is_regular_file(file) || !stream_)
    throw std::runtime_error(fmt::format("{}: cannot be read", file.string()));
  size_ = fs::file_size(file);
}

void FilePieces::refuse(std::uint64_t at, std::string_view what) const {
  throw AtByte(fmt::format("{}: byte {}: {}", file_.string(), at, worlds::excerpt(what, kMostOfRecord)));
}

void FilePieces::require(std::uint64_t at, std::uint64_t count, std::uint64_t end) const {
  if (at <= end && count <= end - at) return;
  refuse(at, end == size_ ? fmt::format("expected {} bytes more, and the file ends at byte {}: it is cut "
                                        "short, or damaged",
                                        count, end)
                          : fmt::format("expected {} bytes more, and what they are part of ends at byte {}: "
                                        "the file is damaged",
                                        count, end));
}

std::string FilePieces::piece(std::uint64_t at, std::uint64_t count, std::uint64_t end) {
  require(at, count, end);
  std::string bytes(count, '\0');
  stream_.seekg(static_cast<std::streamoff>(at));
  if (!stream_.read(bytes.data(), static_cast<std::streamsize>(count))) refuse(at, "cannot be read");
  return bytes;
}

std::uint32_t FilePieces::crc_of(std::uint64_t at, std::uint64_t end) {
  constexpr std::uint64_t kBlock = std::uint64_t{1} << 20;
  uLong crc = 0;
  for (; at < end; at += std::min(kBlock, end - at)) {
    const std::string block = piece(at, std::min(kBlock, end - at));
    crc = crc32_z(crc, reinterpret_cast<const unsigned char*>(block.data()), block.size());
  }
  return static_cast<std::uint32_t>(crc);
}

std::string_view LittleValues::bytes(std::uint64_t count) {
  if (count > bytes_.size() - at_)
    throw std::runtime_error(
        fmt::format("expected {} bytes more behind byte {} of {}", count, at_, bytes_.size()));
  at_ += count;
  return bytes_.substr(at_ - count, count);
}

std::string message_bytes(const RecordedFile& recording, const RecordedMessage& message, std::uint64_t most) {
  return FilePieces(recording.file).piece(message.at, std::min(message.size, most));
}

}  // namespace stereobench::harness
