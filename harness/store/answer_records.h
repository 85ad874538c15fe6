/// The records that a file of answers is made of.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace stereobench::harness {

/// Where an answer stands in its file.
struct AnswerPlace {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
};

/// What a file of answers holds.
struct AnswerIndex {
  std::map<std::string, AnswerPlace> places;  ///< by key; of several answers under a key the last one
  std::vector<std::string> damaged;           ///< keys of answers whose bytes have changed since
  std::uint64_t end = 0;                      ///< of the last whole record
  std::uint64_t size = 0;                     ///< of the file: what is behind `end` is torn
};

/// Reads all records of a file, and checks the hash of each.
/// @param file named in complaints
/// @throws std::runtime_error when it cannot be read
AnswerIndex index_of_answers(int descriptor, const std::filesystem::path& file);

/// Reads an answer. @throws std::runtime_error where the file ends before it
std::string read_answer(int descriptor, const AnswerPlace& place, const std::filesystem::path& file);

/// What stands before an answer in its file: "stereobench-answer 2 KEY SIZE SHA256\n", each part of a fixed
/// width; the hash is of the key and the answer. @param key 64 hexadecimal digits
std::string answer_header(const std::string& key, std::string_view answer);

/// @throws std::runtime_error "file: what: the cause" for a value of errno
[[noreturn]] void fail_with_errno(const std::filesystem::path& file, const char* what, int error);

}  // namespace stereobench::harness
