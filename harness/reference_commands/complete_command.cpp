#include "harness/reference_commands/complete_command.h"

#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/completion/candidates.h"

namespace stereobench::harness {
namespace {

/// On one line, whatever line breaks a description has.
std::string on_one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\t') c = ' ';
  return text;
}

}  // namespace

int complete(const CLI::App& program, std::span<const std::string> words) {
  if (words.empty() || words.front() != "--")
    throw std::runtime_error("complete: expected '--' and the words of a command line; shells call this");
  for (const Candidate& one : candidates(program, words.subspan(1)))
    fmt::print("{}{}\t{}\n", one.text, one.is_whole ? " " : "", on_one_line(one.says));
  return kPassed;
}

}  // namespace stereobench::harness
