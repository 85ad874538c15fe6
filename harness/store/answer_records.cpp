#include "harness/store/answer_records.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "harness/io/sha256.h"

namespace stereobench::harness {
namespace {

constexpr std::string_view kMagic = "stereobench-answer 2 ";
constexpr std::size_t kSizeDigits = 20;
constexpr std::size_t kHeaderBytes = kMagic.size() + kSha256Digits + 1 + kSizeDigits + 1 + kSha256Digits + 1;

struct AnswerHeader {
  std::string key;
  std::uint64_t bytes = 0;
  std::string sha256;
};

std::string text_of(const AnswerHeader& header) {
  return fmt::format("{}{} {:0{}} {}\n", kMagic, header.key, header.bytes, kSizeDigits, header.sha256);
}

/// @return empty where the text is not exactly a header
std::optional<AnswerHeader> header_in(const std::string& text) {
  AnswerHeader header;
  header.key = text.substr(kMagic.size(), kSha256Digits);
  header.bytes = std::strtoull(text.c_str() + kMagic.size() + kSha256Digits + 1, nullptr, 10);
  header.sha256 = text.substr(text.size() - 1 - kSha256Digits, kSha256Digits);
  return text_of(header) == text ? std::optional(header) : std::nullopt;
}

/// Reads bytes from a place in a file. @return fewer at the file's end
std::string read_at(int descriptor, std::uint64_t offset, std::size_t bytes) {
  std::string read(bytes, '\0');
  std::size_t done = 0;
  while (done < bytes) {
    const ssize_t count =
        ::pread(descriptor, read.data() + done, bytes - done, static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    done += static_cast<std::size_t>(count);
  }
  read.resize(done);
  return read;
}

/// Of a key and the answer in a file.
std::string sha256_at(int descriptor, std::uint64_t offset, const AnswerHeader& header) {
  constexpr std::uint64_t kPart = 1 << 20;
  Sha256 hash;
  hash.add(header.key);
  const std::uint64_t bytes = header.bytes;
  for (std::uint64_t done = 0; done < bytes; done += kPart)
    hash.add(read_at(descriptor, offset + done, std::min(kPart, bytes - done)));
  return hash.hex();
}

}  // namespace

AnswerIndex index_of_answers(int descriptor, const std::filesystem::path& file) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) fail_with_errno(file, "cannot be read", errno);
  AnswerIndex index;
  index.size = static_cast<std::uint64_t>(status.st_size);
  while (index.end + kHeaderBytes <= index.size) {
    const auto header = header_in(read_at(descriptor, index.end, kHeaderBytes));
    const std::uint64_t offset = index.end + kHeaderBytes;
    if (!header || header->bytes > index.size - offset) break;  // torn
    if (sha256_at(descriptor, offset, *header) == header->sha256) {
      index.places[header->key] = {offset, header->bytes};
      std::erase(index.damaged, header->key);  // it was made again
    } else {
      index.damaged.push_back(header->key);
    }
    index.end = offset + header->bytes;
  }
  return index;
}

std::string read_answer(int descriptor, const AnswerPlace& place, const std::filesystem::path& file) {
  std::string answer = read_at(descriptor, place.offset, place.bytes);
  if (answer.size() != place.bytes)
    throw std::runtime_error(fmt::format("{}: cannot be read to its end", file.string()));
  return answer;
}

std::string answer_header(const std::string& key, std::string_view answer) {
  if (key.size() != kSha256Digits) throw std::invalid_argument("an answer's key has 64 hexadecimal digits");
  return text_of({key, answer.size(), sha256_of(key + std::string(answer))});
}

void fail_with_errno(const std::filesystem::path& file, const char* what, int error) {
  throw std::runtime_error(fmt::format("{}: {}: {}", file.string(), what, std::strerror(error)));
}

}  // namespace stereobench::harness
