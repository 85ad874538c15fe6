/// Files that are put into a folder without being written anew.
#pragma once

#include <filesystem>

#include "harness/io/atomic_file.h"

namespace stereobench::harness {

/// Files as hard links to others, or as copies where the file system has no such links. Copies are synced
/// together.
class LinkedFiles {
 public:
  /// Puts a file there, in place of what has that name. Of links to a file, the file is taken.
  /// @throws std::runtime_error naming the path and the cause
  void place(const std::filesystem::path& from, const std::filesystem::path& to);

  /// Moves the copies that wait into place.
  void move_into_place();

 private:
  AtomicFiles copies_;
};

}  // namespace stereobench::harness
