#include <memory>
#include <string>

#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/reference/reference_pages.h"
#include "harness/run/metric_keys.h"

namespace stereobench::harness {

void add_metrics_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("metrics", "say what each key of run.json is");
  auto part = std::make_shared<std::string>();
  command->add_option("part", *part, "only keys that have this in their name, e.g. vision");
  auto markdown = std::make_shared<bool>(false);
  command->add_flag("--markdown", *markdown, "all keys as tables, which are a page of the guide");
  command->footer(
      "One line a key: its name, its unit in brackets, and what it is. `*` stands for the name of a filter, "
      "[]\n"
      "for each entry of a list; gates name numbers that are in no list. Numbers that do not exist are "
      "null.\n\n"
      "Example: stereobench metrics vision");
  command->callback([part, markdown, &action] {
    action = [part, markdown] {
      if (*markdown) {
        fmt::print("{}", metrics_reference());
        return kPassed;
      }
      for (const MetricKey& key : metric_keys()) {
        if (key.path.find(*part) == std::string::npos) continue;
        const std::string unit = unit_of(key.path);
        fmt::print("{}{}: {}\n", key.path, unit.empty() ? "" : " [" + unit + "]", key.says);
      }
      return kPassed;
    };
  });
}

}  // namespace stereobench::harness
