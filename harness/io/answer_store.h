/// Results of tasks on disk, so that a program that is killed loses none that was finished.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace stereobench::harness {

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

  std::size_t size() const { return places_.size(); }
  bool holds(const std::string& key) const { return places_.contains(key); }
  /// The answer of a key.
  /// @throws std::out_of_range when there is none; std::runtime_error when the file cannot be read
  std::string read(const std::string& key) const;
  /// Adds an answer. @param key 64 hexadecimal digits
  /// @throws std::runtime_error when it cannot be written; the file is then as it was before
  void append(const std::string& key, std::string_view answer);
  /// Deletes the file: its answers are no longer needed.
  void remove();

 private:
  /// Where an answer stands in the file.
  struct Place {
    std::uint64_t offset;
    std::uint64_t bytes;
  };
  void index();
  void write_all(std::string_view bytes);

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::uint64_t end_ = 0;  ///< of the last whole record
  std::map<std::string, Place> places_;
};

}  // namespace stereobench::harness
