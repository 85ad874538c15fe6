/// SHA-256 (FIPS 180-4), by OpenSSL's libcrypto: what files and results are told apart by.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace stereobench::harness {

/// A hash is written as so many hexadecimal digits.
inline constexpr std::size_t kSha256Digits = 64;

/// A hash of bytes that come in parts.
class Sha256 {
 public:
  Sha256();
  void add(std::string_view bytes);
  /// Ends the hash. @return 64 lower-case hexadecimal digits, as `sha256sum` prints them
  std::string hex();

 private:
  struct Free {
    void operator()(void* state) const;
  };
  std::unique_ptr<void, Free> state_;
};

/// The hash of bytes, as 64 hexadecimal digits.
std::string sha256_of(std::string_view bytes);

/// The hash of a file's content, which is read in parts.
/// @throws std::runtime_error when the file cannot be read
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace stereobench::harness
