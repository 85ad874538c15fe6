/// Results of tasks on disk, so that a program that is killed loses none that was finished.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "harness/store/answer_records.h"

namespace stereobench::harness {

/// The store in the folder of a run, a study or a shard: results of drives that were finished.
inline constexpr const char* kDrivesFile = "unfinished.drives";

/// One file of answers that only grows. Each answer stands under a key, the SHA-256 of all that it was made
/// from, with its size and SHA-256; it is synced before append() returns. In memory there are the keys alone.
///
/// A kill leaves at most one torn record, at the file's end: it is dropped when the file is opened. An answer
/// whose bytes have changed since is passed over.
class AnswerStore {
 public:
  /// Opens the file for this process alone, or makes it.
  /// @throws std::runtime_error when it cannot be written, or another process has it open
  explicit AnswerStore(std::filesystem::path file);
  /// Deletes the file where it holds no answer.
  ~AnswerStore();
  AnswerStore(const AnswerStore&) = delete;
  AnswerStore& operator=(const AnswerStore&) = delete;

  std::size_t size() const { return index_.places.size(); }
  bool holds(const std::string& key) const { return index_.places.contains(key); }
  /// The answer of a key.
  /// @throws std::out_of_range when there is none; std::runtime_error when the file cannot be read
  std::string read(const std::string& key) const;
  /// Adds an answer. @param key 64 hexadecimal digits
  /// @throws std::runtime_error when it cannot be written; the file is then as it was before
  void append(const std::string& key, std::string_view answer);
  /// Adds an answer that a power cut may take away again until sync().
  void append_unsynced(const std::string& key, std::string_view answer);
  void sync();
  /// Deletes the file: its answers are no longer needed.
  void remove();

 private:
  void write_all(std::string_view bytes);

  std::filesystem::path file_;
  int descriptor_ = -1;
  AnswerIndex index_;
};

/// A file of answers that is only read, and left as it is.
class AnswerReader {
 public:
  /// @throws std::runtime_error when it cannot be read, or another process is writing to it
  explicit AnswerReader(std::filesystem::path file);
  ~AnswerReader();
  AnswerReader(const AnswerReader&) = delete;
  AnswerReader& operator=(const AnswerReader&) = delete;

  const std::filesystem::path& file() const { return file_; }
  const AnswerIndex& index() const { return index_; }
  /// The answer of a key. @throws as AnswerStore::read
  std::string read(const std::string& key) const;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
  AnswerIndex index_;
};

}  // namespace stereobench::harness
