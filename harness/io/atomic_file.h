/// Files that are either wholly there or not there at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace stereobench::harness {

/// Makes sure that results can be written into a folder, creating it and its parents where needed.
/// @param folder the output folder
/// @throws std::runtime_error naming the folder and the cause: it is a file, it cannot be created or written
void prepare_output_folder(const std::filesystem::path& folder);

/// A file that is written part by part under a temporary name in the same folder, then synced and renamed: a
/// program that is killed leaves the old file or the new one, never a part. A process writes kMostAtATime at
/// most at a time.
class AtomicFile {
 public:
  static constexpr std::size_t kMostAtATime = 64;

  /// @param path the file to write or to replace
  /// @throws std::runtime_error naming the path and the cause (missing folder, no permission), and so below
  explicit AtomicFile(std::filesystem::path path);
  /// Removes what was written, unless it was moved into place.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  void append(std::string_view bytes);
  /// Replaces bytes that were appended before, all of them. @param at the first one's place, from 0
  void overwrite(std::uint64_t at, std::string_view bytes);
  void move_into_place();

 private:
  friend class AtomicFiles;
  void rename_into_place();

  std::filesystem::path path_;
  std::string name_;
  std::size_t place_ = 0;  ///< among the unfinished files
  int descriptor_ = -1;
  bool is_moved_ = false;
};

/// Several AtomicFiles that are synced once, together: a sync costs more than writing a file.
class AtomicFiles {
 public:
  /// Writes a whole file under a temporary name. Of very many files, those so far are first moved into place.
  /// @throws std::runtime_error as AtomicFile
  void write(const std::filesystem::path& path, std::string_view bytes);

  /// The same with the bytes of another file, of which a block at a time is in memory.
  /// @throws std::runtime_error as AtomicFile, and where the other file cannot be read
  void copy(const std::filesystem::path& path, const std::filesystem::path& from);

  /// Moves all of them into place. After a power cut some may be missing, but none is there in part: whoever
  /// says that all are there first calls sync_file_system.
  void move_into_place();

 private:
  AtomicFile& begin(const std::filesystem::path& path);

  std::vector<std::unique_ptr<AtomicFile>> files_;
};

/// Makes what was written and moved on a folder's file system survive a power cut.
/// @throws std::runtime_error naming the folder and the cause
void sync_file_system(const std::filesystem::path& folder);

/// Writes a whole file as an AtomicFile.
/// @param path the file to write or to replace
/// @param bytes all of its content
/// @throws std::runtime_error naming the path and the cause (missing folder, no permission, full disk)
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Removes each AtomicFile that is being written. Safe to call in a signal's handler.
void remove_unfinished_files() noexcept;

/// Removes what processes that were killed left in a folder under temporary names. Those of processes that
/// are still alive stay.
void remove_leftovers_in(const std::filesystem::path& folder);

/// The same for a folder and all below it.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace stereobench::harness
