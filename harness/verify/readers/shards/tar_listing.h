/// What an archive of POSIX (IEEE Std 1003.1, pax, "ustar interchange format") holds, whoever wrote it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace stereobench::harness {

/// A file of an archive.
struct TarMember {
  std::string name;
  std::uint64_t at = 0;    ///< its first byte's place in the archive
  std::uint64_t size = 0;  ///< bytes
};

struct TarListing {
  std::vector<TarMember> members;  ///< in the archive's order, up to where it is broken
  std::string broken;              ///< what is wrong with the archive itself; empty where nothing is
};

/// Lists the files of an archive. Long names of pax and GNU tar are read; folders and links are left out.
/// @throws std::runtime_error when it cannot be opened
TarListing list_tar(const std::filesystem::path& archive);

/// All bytes of a member. @throws std::runtime_error, one line, when they cannot be read
std::string read_member(const std::filesystem::path& archive, const TarMember& member);

}  // namespace stereobench::harness
