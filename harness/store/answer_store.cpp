#include "harness/store/answer_store.h"

#include <cerrno>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace stereobench::harness {
namespace {

/// Takes the file for this process, or makes sure that no other one writes to it. The lock ends with the
/// process, however that ends, and its children do not have it. File systems without locks are let be.
/// @param kind F_WRLCK or F_RDLCK
/// @throws std::runtime_error, with the file closed, where another process has it
void lock_answers(int descriptor, short kind, const std::filesystem::path& file) {
  struct flock lock {};
  lock.l_type = kind;
  lock.l_whence = SEEK_SET;
  if (::fcntl(descriptor, F_SETLK, &lock) == 0 || (errno != EACCES && errno != EAGAIN)) return;
  ::close(descriptor);
  throw std::runtime_error(
      fmt::format("{}: another stereobench is writing to this folder; wait for it, or choose another folder",
                  file.string()));
}

}  // namespace

AnswerStore::AnswerStore(std::filesystem::path file) : file_(std::move(file)) {
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail_with_errno(file_, "cannot be written", errno);
  lock_answers(descriptor_, F_WRLCK, file_);
  index_ = index_of_answers(descriptor_, file_);
  if (index_.end < index_.size && ::ftruncate(descriptor_, static_cast<off_t>(index_.end)) != 0)
    fail_with_errno(file_, "cannot be written", errno);
}

AnswerStore::~AnswerStore() {
  if (index_.places.empty()) ::unlink(file_.c_str());
  ::close(descriptor_);
}

std::string AnswerStore::read(const std::string& key) const {
  return read_answer(descriptor_, index_.places.at(key), file_);
}

void AnswerStore::write_all(std::string_view bytes) {
  for (std::uint64_t at = index_.end; !bytes.empty();) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int error = errno;
      if (::ftruncate(descriptor_, static_cast<off_t>(index_.end)) != 0)
        fail_with_errno(file_, "cannot be repaired", errno);
      fail_with_errno(file_, "cannot be written", error);
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
    at += static_cast<std::uint64_t>(written);
  }
}

void AnswerStore::append(const std::string& key, std::string_view answer) {
  append_unsynced(key, answer);
  sync();
}

void AnswerStore::append_unsynced(const std::string& key, std::string_view answer) {
  std::string record = answer_header(key, answer);
  const std::size_t header_bytes = record.size();
  record += answer;
  write_all(record);
  index_.places[key] = {index_.end + header_bytes, answer.size()};
  index_.end += record.size();
}

void AnswerStore::sync() {
  if (::fdatasync(descriptor_) != 0) fail_with_errno(file_, "cannot be written", errno);
}

void AnswerStore::remove() {
  if (::unlink(file_.c_str()) != 0 && errno != ENOENT) fail_with_errno(file_, "cannot be removed", errno);
  index_.places.clear();
}

bool is_in_use(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  struct flock lock {};
  lock.l_type = F_RDLCK;
  lock.l_whence = SEEK_SET;
  const bool is_locked = ::fcntl(descriptor, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  ::close(descriptor);
  return is_locked;
}

AnswerReader::AnswerReader(std::filesystem::path file) : file_(std::move(file)) {
  descriptor_ = ::open(file_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) fail_with_errno(file_, "cannot be read", errno);
  lock_answers(descriptor_, F_RDLCK, file_);
  index_ = index_of_answers(descriptor_, file_);
}

AnswerReader::~AnswerReader() {
  ::close(descriptor_);
}

std::string AnswerReader::read(const std::string& key) const {
  return read_answer(descriptor_, index_.places.at(key), file_);
}

}  // namespace stereobench::harness
