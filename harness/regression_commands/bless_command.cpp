#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/talk.h"
#include "harness/io/atomic_file.h"
#include "harness/io/sha256.h"
#include "harness/io/text_file.h"
#include "harness/io/text_table.h"
#include "harness/regression/metric_rule.h"
#include "harness/regression/result_folder.h"
#include "harness/regression_commands/suite_pictures.h"
#include "harness/regression_commands/test_result.h"
#include "harness/suite/baseline.h"
#include "harness/suite/case_report.h"
#include "harness/suite/findings_file.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

struct BlessArguments {
  fs::path result;
  std::vector<std::string> only;
  std::string reason;
  fs::path baseline;  ///< empty: that of the test
  bool takes_undecided = false;
};

/// A case that may become the baseline, and what would be written.
struct Blessed {
  TestedCase tested;
  Baseline baseline;
  std::string findings;                         ///< empty where there were no pictures
  std::map<std::string, std::string> pictures;  ///< files of golden frames, by their name
  bool is_new = false;                          ///< its baseline differs from what is there
};

/// @throws std::runtime_error for a case that cannot be a baseline
void check(const TestedCase& tested, bool takes_undecided) {
  const auto refuse = [&](const std::string& why) {
    throw std::runtime_error(fmt::format("case {}: {}; nothing was written", tested.name, why));
  };
  if (tested.verdict == text_of(CaseState::kError)) refuse("it broke down: " + tested.error);
  if (!tested.partial.empty()) refuse(tested.partial);
  if (tested.broken_gates > 0) refuse("a gate is broken: mend what it measures, or the gate, and test again");
  // Beside a change that is decided, others may stay open: somebody has looked at it.
  if (tested.verdict == text_of(CaseState::kInconclusive) && !takes_undecided)
    refuse(
        "metrics are inconclusive: test with more seeds (--until-decided), or take them as they are with "
        "--undecided");
}

std::string hash_of(const fs::path& file) {
  return fs::exists(file) ? sha256_of_file(file) : "";
}

bool is_same(const Baseline& a, const Baseline& b) {
  Baseline as_b = a;
  as_b.blessing = b.blessing;
  return baseline_text(as_b) == baseline_text(b);
}

/// The files of golden frames in a folder, by their name.
std::map<std::string, std::string> pictures_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::path& file : golden_files_in(folder)) files[file.filename().string()] = read_text(file);
  return files;
}

Blessed blessed_of(const BlessArguments& arguments, const TestedCase& tested, const fs::path& folder) {
  const StoredResult result = read_result(arguments.result / tested.name);
  const fs::path file = baseline_file(folder, tested.name);
  Blessed blessed{.tested = tested,
                  .baseline = {.scenario = result.scenario,
                               .inputs = tested.inputs,
                               .blessing = {arguments.reason, STEREOBENCH_VERSION, hash_of(file)},
                               .seeds = result.seeds}};
  if (!result.detections.empty()) blessed.findings = findings_csv(read_detected_balls(result.detections));
  blessed.pictures = pictures_in(golden_folder(arguments.result / tested.name));
  const std::optional<Baseline> before = read_baseline(file);
  const fs::path findings = findings_file(folder, tested.name);
  blessed.is_new = !before || !is_same(*before, blessed.baseline) ||
                   pictures_in(golden_baseline(folder, tested.name)) != blessed.pictures ||
                   hash_of(findings) != (blessed.findings.empty() ? "" : sha256_of(blessed.findings));
  return blessed;
}

void write(const Blessed& blessed, const fs::path& folder) {
  const std::string& name = blessed.tested.name;
  const fs::path findings = findings_file(folder, name);
  if (blessed.findings.empty())
    fs::remove(findings);
  else
    write_file_atomically(findings, blessed.findings);
  const fs::path pictures = golden_baseline(folder, name);
  for (const fs::path& file : golden_files_in(pictures)) fs::remove(file);
  std::error_code is_not_empty;
  fs::remove(pictures, is_not_empty);
  if (!blessed.pictures.empty()) prepare_output_folder(pictures);
  for (const auto& [file, bytes] : blessed.pictures) write_file_atomically(pictures / file, bytes);
  write_file_atomically(baseline_file(folder, name), baseline_text(blessed.baseline));
}

void say_changes(const std::vector<Blessed>& cases) {
  AlignedTable table{.header = {"case", "metric", "verdict", "before", "now"}};
  for (const Blessed& blessed : cases) {
    if (!blessed.is_new) table.rows.push_back({blessed.tested.name, "", "unchanged", "", ""});
    if (blessed.is_new && blessed.tested.changes.empty())
      table.rows.push_back({blessed.tested.name, "", blessed.tested.verdict, "", ""});
    for (const TestedMetric& metric : blessed.tested.changes)
      table.rows.push_back({blessed.tested.name, metric.name, metric.verdict, format_number(metric.before),
                            format_number(metric.now)});
  }
  fmt::print("{}", plain_text(table));
}

int bless(const BlessArguments& arguments) {
  if (arguments.reason.find_first_of("\r\n") != std::string::npos)
    throw std::runtime_error("--reason: expected one line");
  const fs::path folder =
      arguments.baseline.empty() ? read_side_file(arguments.result).baseline : arguments.baseline;
  std::vector<Blessed> cases;
  for (const TestedCase& tested : read_test_result(arguments.result)) {
    if (!fits_any(tested.name, arguments.only)) continue;
    check(tested, arguments.takes_undecided);
    cases.push_back(blessed_of(arguments, tested, folder));
  }
  if (cases.empty())
    throw std::runtime_error(
        fmt::format("--only: no case of {} has such a name", (arguments.result / kTestResult).string()));
  say_changes(cases);
  prepare_output_folder(folder);
  const auto changed = std::ranges::count(cases, true, &Blessed::is_new);
  for (const Blessed& blessed : cases)
    if (blessed.is_new) write(blessed, folder);
  fmt::print("\n{} of {} cases written; baseline: {}\n", changed, cases.size(), (folder / "").string());
  return kPassed;
}

void add_options(CLI::App& command, BlessArguments& arguments) {
  command.add_option("result", arguments.result, "the folder of a finished `stereobench test`")->required();
  command.add_option("--reason", arguments.reason, "why this is good, in one line; it is kept")->required();
  repeatable(command.add_option("--only", arguments.only,
                                "bless only cases whose names fit; may be repeated (default: all)"))
      ->type_name("GLOB");
  command.add_option("--baseline", arguments.baseline,
                     "folder of the baseline (default: the one that was tested against)");
  command.add_flag("--undecided", arguments.takes_undecided,
                   "take cases whose metrics are inconclusive, too");
  add_quiet_option(command);
}

}  // namespace

void add_bless_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("bless", "make the result of a test the baseline of later ones");
  auto arguments = std::make_shared<BlessArguments>();
  add_options(*command, *arguments);
  command->footer(
      "Says what changes, and writes one JSON file a case, as text for version control: the metrics of each\n"
      "seed, the hash of the inputs, the renderer's fingerprint, and the reason. A case that broke down, "
      "lacks\n"
      "seeds, breaks a gate or is inconclusive is refused.\n\n"
      "Example: stereobench bless out/quick_suite --only circle --reason 'exact edges: range rms 4 % lower'");
  command->callback([arguments, &action] { action = [arguments] { return bless(*arguments); }; });
}

}  // namespace stereobench::harness
