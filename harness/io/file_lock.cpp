#include "harness/io/file_lock.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace stereobench::harness {
namespace {

/// A lock of a whole file.
struct flock whole_file(short kind) {
  struct flock lock {};
  lock.l_type = kind;
  lock.l_whence = SEEK_SET;
  return lock;
}

}  // namespace

void lock_file(int descriptor, short kind, const std::filesystem::path& file) {
  struct flock lock = whole_file(kind);
  if (::fcntl(descriptor, F_SETLK, &lock) == 0 || (errno != EACCES && errno != EAGAIN)) return;
  ::close(descriptor);
  throw std::runtime_error(
      fmt::format("{}: another stereobench is writing to this folder; wait for it, or choose another folder",
                  file.string()));
}

bool is_in_use(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  struct flock lock = whole_file(F_RDLCK);
  const bool is_locked = ::fcntl(descriptor, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  ::close(descriptor);
  return is_locked;
}

FileLock::FileLock(const std::filesystem::path& file)
    : descriptor_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0)
    throw std::runtime_error(fmt::format("{}: cannot be written: {}", file.string(), std::strerror(errno)));
  lock_file(descriptor_, F_WRLCK, file);
}

FileLock::~FileLock() {
  ::close(descriptor_);
}

}  // namespace stereobench::harness
