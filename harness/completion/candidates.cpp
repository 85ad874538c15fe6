#include "harness/completion/candidates.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "harness/completion/option_values.h"

namespace stereobench::harness {
namespace {

bool takes_value(const CLI::Option& option) {
  return option.get_expected_max() > 0;
}

bool may_be_repeated(const CLI::Option& option) {
  return option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll ||
         option.get_items_expected_max() > 1;
}

/// A command line up to the word that is being written.
struct Position {
  std::vector<const CLI::Option*> given;
  std::size_t positionals = 0;        ///< that are there already
  const CLI::Option* asks = nullptr;  ///< the option whose value comes next
};

/// @param word "--out", "-o" or "--out=x"
const CLI::Option* option_of(const CLI::App& command, std::string_view word) {
  const std::string name(word.substr(0, word.find('=')));
  for (const CLI::Option* option : command.get_options())
    if (!option->get_positional() && option->check_name(name)) return option;
  return nullptr;
}

Position walk(const CLI::App& command, std::span<const std::string> words) {
  Position position;
  for (const std::string& word : words) {
    if (position.asks) {
      position.asks = nullptr;
    } else if (!word.starts_with("-")) {
      ++position.positionals;
    } else if (const CLI::Option* option = option_of(command, word)) {
      position.given.push_back(option);
      if (takes_value(*option) && word.find('=') == std::string::npos) position.asks = option;
    }
  }
  return position;
}

/// @return null where there is none
const CLI::App* command_of(const CLI::App& program, const std::string& name) {
  for (const CLI::App* command : program.get_subcommands({}))
    if (command->check_name(name)) return command;
  return nullptr;
}

std::vector<Candidate> commands_of(const CLI::App& program, std::string_view word) {
  std::vector<Candidate> found;
  for (const CLI::App* command : program.get_subcommands({}))
    if (!command->get_group().empty()) found.push_back({command->get_name(), command->get_description()});
  return that_begin_with(word, std::move(found));
}

/// Options that may still be given; by their long names, where they have one.
std::vector<Candidate> options_of(const CLI::App& command, const Position& position, std::string_view word) {
  std::vector<Candidate> found;
  for (const CLI::Option* option : command.get_options()) {
    const bool is_given = std::ranges::find(position.given, option) != position.given.end();
    if (option->get_positional() || option->get_group().empty() || (is_given && !may_be_repeated(*option)))
      continue;
    for (const std::string& name : option->get_lnames())
      found.push_back({"--" + name, option->get_description()});
    if (option->get_lnames().empty())
      for (const std::string& name : option->get_snames())
        found.push_back({"-" + name, option->get_description()});
  }
  return that_begin_with(word, std::move(found));
}

/// The positional argument that is next; the last one where it takes several.
const CLI::Option* next_positional(const CLI::App& command, std::size_t given) {
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) continue;
    const auto most = static_cast<std::size_t>(option->get_items_expected_max());
    if (given < most) return option;
    given -= most;
  }
  return nullptr;
}

/// The value in "--out=x", with what stands before it.
std::vector<Candidate> values_behind_equals(const CLI::App& command, std::string_view word) {
  const CLI::Option* const option = option_of(command, word);
  if (!option || !takes_value(*option)) return {};
  const std::size_t value = word.find('=') + 1;
  std::vector<Candidate> found = values_of(command, *option, word.substr(value));
  for (Candidate& one : found) one.text.insert(0, word.substr(0, value));
  return found;
}

}  // namespace

std::vector<Candidate> candidates(const CLI::App& program, std::span<const std::string> words) {
  if (words.empty()) return {};
  const std::string& word = words.back();
  if (words.size() == 1)
    return word.starts_with("-") ? options_of(program, {}, word) : commands_of(program, word);
  const CLI::App* const command = command_of(program, words.front());
  if (!command) return {};
  const Position position = walk(*command, words.subspan(1, words.size() - 2));
  if (position.asks) return values_of(*command, *position.asks, word);
  if (word.starts_with("--") && word.find('=') != std::string::npos)
    return values_behind_equals(*command, word);
  if (word.starts_with("-")) return options_of(*command, position, word);
  const CLI::Option* const next = next_positional(*command, position.positionals);
  return next ? values_of(*command, *next, word) : std::vector<Candidate>();
}

}  // namespace stereobench::harness
