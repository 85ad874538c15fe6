#include "harness/store/answer_store.h"

#include <cerrno>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "harness/io/file_lock.h"

namespace stereobench::harness {

AnswerStore::AnswerStore(std::filesystem::path file) : file_(std::move(file)) {
  descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail_with_errno(file_, "cannot be written", errno);
  lock_file(descriptor_, F_WRLCK, file_);
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

AnswerReader::AnswerReader(std::filesystem::path file) : file_(std::move(file)) {
  descriptor_ = ::open(file_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) fail_with_errno(file_, "cannot be read", errno);
  lock_file(descriptor_, F_RDLCK, file_);
  index_ = index_of_answers(descriptor_, file_);
}

AnswerReader::~AnswerReader() {
  ::close(descriptor_);
}

std::string AnswerReader::read(const std::string& key) const {
  return read_answer(descriptor_, index_.places.at(key), file_);
}

}  // namespace stereobench::harness
