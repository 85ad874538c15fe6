/// Archives as POSIX has them (IEEE Std 1003.1, pax, "ustar interchange format"), without anything of a
/// machine.
#pragma once

#include <string_view>

#include "harness/io/atomic_file.h"

namespace stereobench::harness {

/// Writes files one after the other; all belong to user and group 0, and are of 1970.
class TarFile {
 public:
  /// @param file empty; it outlives this
  explicit TarFile(AtomicFile& file) : file_(file) {}

  /// @param name at most 100 bytes
  /// @throws std::invalid_argument for a longer name, or a content of 8 GiB or more
  void add(std::string_view name, std::string_view content);

  /// Ends the archive.
  void finish();

 private:
  AtomicFile& file_;
};

}  // namespace stereobench::harness
