#include "harness/io/answer_store.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "harness/io/sha256.h"

namespace stereobench::harness {
namespace {

constexpr std::string_view kMagic = "stereobench-answer 1 ";
constexpr std::size_t kSizeDigits = 20;
constexpr std::size_t kHeaderBytes = kMagic.size() + kSha256Digits + 1 + kSizeDigits + 1 + kSha256Digits + 1;

/// What stands before an answer: "stereobench-answer 1 KEY SIZE SHA256\n", each part of a fixed width.
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

[[noreturn]] void fail_with_errno(const std::filesystem::path& file, const char* what, int error) {
  throw std::runtime_error(fmt::format("{}: {}: {}", file.string(), what, std::strerror(error)));
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

std::string sha256_at(int descriptor, std::uint64_t offset, std::uint64_t bytes) {
  constexpr std::uint64_t kPart = 1 << 20;
  Sha256 hash;
  for (std::uint64_t done = 0; done < bytes; done += kPart)
    hash.add(read_at(descriptor, offset + done, std::min(kPart, bytes - done)));
  return hash.hex();
}

/// Takes the file for this process. The lock ends with the process, however that ends, and its children do
/// not have it. File systems without locks are let be.
bool is_taken_by_another(int descriptor) {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  return ::fcntl(descriptor, F_SETLK, &lock) != 0 && (errno == EACCES || errno == EAGAIN);
}

}  // namespace

AnswerStore::AnswerStore(std::filesystem::path file) : file_(std::move(file)) {
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail_with_errno(file_, "cannot be written", errno);
  if (is_taken_by_another(descriptor_)) {
    ::close(descriptor_);
    throw std::runtime_error(fmt::format(
        "{}: another stereobench is writing to this folder; wait for it, or choose another folder",
        file_.string()));
  }
  index();
}

AnswerStore::~AnswerStore() {
  if (places_.empty()) ::unlink(file_.c_str());
  ::close(descriptor_);
}

void AnswerStore::index() {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) fail_with_errno(file_, "cannot be read", errno);
  const auto size = static_cast<std::uint64_t>(status.st_size);
  while (end_ + kHeaderBytes <= size) {
    const auto header = header_in(read_at(descriptor_, end_, kHeaderBytes));
    const std::uint64_t offset = end_ + kHeaderBytes;
    if (!header || header->bytes > size - offset) break;  // torn
    if (sha256_at(descriptor_, offset, header->bytes) == header->sha256)
      places_[header->key] = {offset, header->bytes};
    end_ = offset + header->bytes;
  }
  if (end_ < size && ::ftruncate(descriptor_, static_cast<off_t>(end_)) != 0)
    fail_with_errno(file_, "cannot be written", errno);
}

std::string AnswerStore::read(const std::string& key) const {
  const Place place = places_.at(key);
  std::string answer = read_at(descriptor_, place.offset, place.bytes);
  if (answer.size() != place.bytes)
    throw std::runtime_error(fmt::format("{}: cannot be read to its end", file_.string()));
  return answer;
}

void AnswerStore::write_all(std::string_view bytes) {
  for (std::uint64_t at = end_; !bytes.empty();) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int error = errno;
      if (::ftruncate(descriptor_, static_cast<off_t>(end_)) != 0)
        fail_with_errno(file_, "cannot be repaired", errno);
      fail_with_errno(file_, "cannot be written", error);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
    at += static_cast<std::uint64_t>(written);
  }
}

void AnswerStore::append(const std::string& key, std::string_view answer) {
  if (key.size() != kSha256Digits)
    throw std::invalid_argument("AnswerStore: a key has 64 hexadecimal digits");
  std::string record = text_of({key, answer.size(), sha256_of(answer)});
  record += answer;
  write_all(record);
  if (::fdatasync(descriptor_) != 0) fail_with_errno(file_, "cannot be written", errno);
  places_[key] = {end_ + kHeaderBytes, answer.size()};
  end_ += record.size();
}

void AnswerStore::remove() {
  if (::unlink(file_.c_str()) != 0 && errno != ENOENT) fail_with_errno(file_, "cannot be removed", errno);
  places_.clear();
}

}  // namespace stereobench::harness
