#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/io/atomic_file.h"
#include "harness/reference/reference_pages.h"
#include "harness/reference/scenario_schema.h"

namespace stereobench::harness {

void add_schema_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("schema", "print the JSON Schema of scenario files, for editors");
  auto out = std::make_shared<std::filesystem::path>();
  command->add_option("--out,-o", *out, "file for it (default: stdout)");
  auto markdown = std::make_shared<bool>(false);
  command->add_flag("--markdown", *markdown, "the keys as tables, which are a page of the guide");
  command->footer(
      "Editors with a YAML language server then complete keys, show what they are, and underline what is "
      "wrong:\n"
      "  # yaml-language-server: $schema=scenario.schema.json\n"
      "as the first line of a scenario.\n\n"
      "Example: stereobench schema -o scenario.schema.json");
  command->callback([out, markdown, &action] {
    action = [out, markdown] {
      const std::string text = *markdown ? scenario_reference() : scenario_schema().dump(2) + "\n";
      if (out->empty())
        fmt::print("{}", text);
      else
        write_file_atomically(*out, text);
      return kPassed;
    };
  });
}

}  // namespace stereobench::harness
