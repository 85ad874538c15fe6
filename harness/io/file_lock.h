/// Files that one process alone writes to.
#pragma once

#include <filesystem>

namespace stereobench::harness {

/// Takes a file for this process, or makes sure that no other one writes to it. The lock ends with the
/// process, however that ends, or when this process closes the file, by whichever descriptor. Its children do
/// not have it. File systems without locks are let be.
/// @param kind F_WRLCK or F_RDLCK
/// @throws std::runtime_error, with the file closed, where another process has it
void lock_file(int descriptor, short kind, const std::filesystem::path& file);

/// Whether another process has taken a file. @return false where there is no such file
bool is_in_use(const std::filesystem::path& file);

/// A file that is taken as long as this lives.
class FileLock {
 public:
  /// @param file is made where it is not there. Nothing may replace it
  /// @throws std::runtime_error where it cannot be opened, or as lock_file
  explicit FileLock(const std::filesystem::path& file);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace stereobench::harness
