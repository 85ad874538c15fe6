/// Pieces of a file, and the values in them: nothing is read that is not there.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace stereobench::harness {

/// What is wrong at a place of a file: "FILE: byte 123: ...".
class AtByte : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that is read piece by piece.
class FilePieces {
 public:
  /// @throws std::runtime_error, one line, where it cannot be read
  explicit FilePieces(const std::filesystem::path& file);

  std::uint64_t size() const { return size_; }

  /// @param end where the piece has to end at the latest: that of the file, or of what it is a part of
  /// @throws AtByte where it does not
  std::string piece(std::uint64_t at, std::uint64_t count, std::uint64_t end);
  std::string piece(std::uint64_t at, std::uint64_t count) { return piece(at, count, size_); }
  /// The same check without reading. @throws AtByte
  void require(std::uint64_t at, std::uint64_t count, std::uint64_t end) const;

  /// CRC-32 of a part of the file.
  std::uint32_t crc_of(std::uint64_t at, std::uint64_t end);

  /// Runs what reads a record. What it throws is said with the record's place.
  template <class Read>
  void at_record(std::uint64_t at, const Read& read) const {
    try {
      read();
    } catch (const AtByte&) {
      throw;
    } catch (const std::runtime_error& error) {
      refuse(at, error.what());
    }
  }

  /// @throws AtByte
  [[noreturn]] void refuse(std::uint64_t at, std::string_view what) const;

 private:
  std::filesystem::path file_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
};

/// Values one after the other, the least byte first.
class LittleValues {
 public:
  explicit LittleValues(std::string_view bytes) : bytes_(bytes) {}

  bool is_at_end() const { return at_ == bytes_.size(); }
  std::size_t at() const { return at_; }

  /// @throws std::runtime_error where there are not so many
  std::string_view bytes(std::uint64_t count);

  template <class Number>
  requires std::integral<Number> || std::floating_point<Number> Number number() {
    static_assert(std::endian::native == std::endian::little, "values are taken as they lie in memory");
    Number value;
    std::memcpy(&value, bytes(sizeof(Number)).data(), sizeof(Number));
    return value;
  }

  /// Its length, then itself.
  std::string_view text() { return bytes(number<std::uint32_t>()); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace stereobench::harness
