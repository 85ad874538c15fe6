/// What the subcommands share on their command lines.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "harness/experiment/types.h"
#include "harness/shards/shard.h"
#include "renderer/types.h"

namespace stereobench::harness {

/// What the command line says of shards.
struct ShardArguments {
  std::optional<Shard> shard;   ///< the part of the work that is done; none: all of it
  std::filesystem::path costs;  ///< a costs.json; empty: all drives cost the same
  std::size_t overlap = 0;      ///< further units of work, of the next shard, that are done too
  std::string plan;             ///< of `merge`: ShardRecord::plan of the shards; empty: not known
  std::vector<std::string>
      words;  ///< of the command line for all of the work, as whole_words_of() gives them

  bool is_used() const { return shard.has_value() || !plan.empty(); }
};

/// Options that every command which runs filters takes; empty means "as the scenario says".
struct RunArguments {
  std::vector<std::string> filters;
  int particles = 0;  ///< 0: as the scenario says
  std::vector<std::uint64_t> seeds;
  int jobs = 1;
  std::filesystem::path out;       ///< empty: out/<name>
  bool dry_run = false;            ///< check everything, say what would be done, and stop
  std::vector<Gate> gates;         ///< beside those of the scenario
  std::vector<std::string> words;  ///< of the command line, as words_of() gives them; empty: not known
  ShardArguments shards;
};

/// The filter that is always run, as the yardstick of the others.
inline constexpr const char* kBaselineFilter = "dead_reckoning";

/// Reads "ufastslam,fastslam2"; dead reckoning is put first when it is missing.
/// @throws std::runtime_error that names the unknown filter and the ones there are
std::vector<std::string> parse_filters(const std::string& text);

/// Reads "0..9", "3" or "0,4,7". @throws std::runtime_error that begins with "--seeds: "
std::vector<std::uint64_t> parse_seeds_option(const std::string& text);

/// Adds --seeds, --jobs, --out, --dry-run and --quiet to a command.
void add_seed_options(CLI::App& command, RunArguments& arguments);

/// Adds --filters, --particles and --gate, and the options above.
void add_run_options(CLI::App& command, RunArguments& arguments);

/// A finite number within limits, both included. CLI::Range lets NaN through.
CLI::Validator real_between(double least, double greatest);

/// Adds --gate, a limit on the result; may be repeated.
void add_gate_option(CLI::App& command, std::vector<Gate>& gates);

/// Adds --set KEY=VALUE, a change of the scenario, and --faults NAME=SEVERITY, which is --set
/// faults.NAME=SEVERITY.
void add_set_option(CLI::App& command, std::vector<std::string>& overrides);

/// Adds --backend, what renders.
void add_backend_option(CLI::App& command, renderer::Backend& backend);

/// The words of a command line that decide what comes out, but for the seeds: "stereobench", the command, and
/// what was said of its options.
/// @param command parsed
std::vector<std::string> words_of(const CLI::App& command);

/// The same with the seeds: what `merge` calls when all shards are done.
std::vector<std::string> whole_words_of(const CLI::App& command);

/// Adds --shard, --shard-costs and --shard-overlap.
void add_shard_options(CLI::App& command, ShardArguments& arguments);

/// Lets an option be given several times, each time with one value: what follows is not taken for a second
/// one.
/// @return the option
CLI::Option* repeatable(CLI::Option* option);

/// Where results go: --out, or out/<name>; of a shard out/<name>_shard_2_of_3.
std::filesystem::path output_folder(const RunArguments& arguments, const std::string& name);

}  // namespace stereobench::harness
