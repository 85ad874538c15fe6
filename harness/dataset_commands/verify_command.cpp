#include <cstdio>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/commands/commands.h"
#include "harness/process/progress.h"
#include "harness/verify/verify_collection.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

struct VerifyArguments {
  fs::path folder;
  std::string format;
};

int verify(const VerifyArguments& arguments) {
  const std::string name = fs::absolute(arguments.folder / "").parent_path().filename().string();
  Verification found;
  {
    Progress progress("verify " + name, 1.0);
    found = verify_folder(arguments.folder, arguments.format, [&](double done) { progress.show(done); });
  }
  for (const Fault& fault : found.faults) fmt::print("{}\n", line_of(fault));
  fmt::print("{}: {}, {}; checked: {}\n", name, found.format,
             found.faults.empty()       ? std::string("no faults")
             : found.faults.size() == 1 ? std::string("1 fault")
                                        : fmt::format("{} faults", found.faults.size()),
             fmt::join(found.checked, ", "));
  if (!found.cannot.empty()) fmt::print("{}: could not check: {}\n", name, fmt::join(found.cannot, "; "));
  return found.faults.empty() ? kPassed : kGateBroken;
}

}  // namespace

void add_verify_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("verify", "prove a data set of any format, whoever wrote it");
  auto arguments = std::make_shared<VerifyArguments>();
  command->add_option("dataset", arguments->folder, "folder of a data set or a collection")->required();
  command->add_option("--as", arguments->format, "its format, where the folder does not tell")
      ->type_name("NAME");
  command->footer(
      "Opens each file, and holds all that the folder says twice against itself. A line names each fault "
      "with its\n"
      "file, its frame and, where it can be told, its cause. Exit codes: 0 no faults, 1 faults, 2 no data "
      "set.\n\n"
      "Example: stereobench verify out/dataset");
  command->callback([arguments, &action] { action = [arguments] { return verify(*arguments); }; });
}

}  // namespace stereobench::harness
