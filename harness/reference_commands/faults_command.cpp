#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/commands/commands.h"
#include "harness/experiment/fault_presets.h"
#include "harness/reference/reference_pages.h"
#include "worlds/yaml/advice.h"

namespace stereobench::harness {
namespace {

std::string lines_of(const FaultPreset& preset) {
  std::string text = fmt::format("{}: {}\n", preset.name, preset.says);
  for (const FaultSetting& setting : preset.settings)
    text += fmt::format("    {}: {}\n", quantity_of(setting), fmt::join(setting.levels, "  "));
  return text;
}

/// @throws std::runtime_error where no fault has `part` in its name
std::string lines_of_faults(const std::string& part) {
  std::string text;
  std::vector<std::string_view> names = {"detector", "camera", "rig"};
  for (const FaultPreset& preset : fault_presets()) {
    names.push_back(preset.name);
    if (preset.name.find(part) != std::string_view::npos) text += lines_of(preset);
  }
  if (text.empty())
    throw std::runtime_error(
        fmt::format("no fault has '{}' in its name, {}", part, worlds::advice(part, names)));
  return text;
}

}  // namespace

void add_faults_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("faults", "list the named faults, and what severities 1 to 5 are");
  auto part = std::make_shared<std::string>();
  command->add_option("part", *part, "only faults that have this in their name, e.g. camera");
  auto markdown = std::make_shared<bool>(false);
  command->add_flag("--markdown", *markdown, "all faults as tables, which are a page of the guide");
  command->footer(
      "A fault stands for the keys below it, each with its values for the severities 1 to 5; 0 is "
      "without.\n\n"
      "Example: stereobench faults camera\n"
      "         stereobench run assets/scenarios/ball_circle.yaml --faults camera.blur=3");
  command->callback([part, markdown, &action] {
    action = [part, markdown] {
      if (*markdown) {
        fmt::print("{}", faults_reference());
        return kPassed;
      }
      fmt::print("{}", lines_of_faults(*part));
      return kPassed;
    };
  });
}

}  // namespace stereobench::harness
