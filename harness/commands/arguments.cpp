#include "harness/commands/arguments.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/commands/talk.h"
#include "harness/experiment/seeds.h"
#include "harness/regression/gates.h"
#include "renderer/backend.h"
#include "slam/filter_registry.h"
#include "worlds/yaml/advice.h"

namespace stereobench::harness {
namespace {

renderer::Backend parse_backend(const std::string& name) {
  try {
    return renderer::backend_named(name);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("--backend: {}", error.what()));
  }
}

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  if (text.empty() || text.back() == ',') parts.emplace_back();
  return parts;
}

}  // namespace

std::vector<std::uint64_t> parse_seeds_option(const std::string& text) {
  try {
    return parse_seeds(text);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("--seeds: {}", error.what()));
  }
}

std::vector<std::string> parse_filters(const std::string& text) {
  const std::vector<std::string> known = slam::filter_names();
  const std::vector<std::string_view> names(known.begin(), known.end());
  std::vector<std::string> filters = {kBaselineFilter};
  for (const std::string& name : split_at_commas(text)) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      const auto meant = name.empty() ? std::nullopt : worlds::nearest_word(name, names);
      throw std::runtime_error(fmt::format("--filters: no filter is called '{}'{}; there are {}", name,
                                           meant ? fmt::format(", did you mean {}?", *meant) : "",
                                           fmt::join(known, ", ")));
    }
    if (std::find(filters.begin(), filters.end(), name) == filters.end()) filters.push_back(name);
  }
  return filters;
}

void add_run_options(CLI::App& command, RunArguments& arguments) {
  command.add_option_function<std::string>(
      "--filters", [&arguments](const std::string& text) { arguments.filters = parse_filters(text); },
      fmt::format("comma-separated, of: {} (dead reckoning is always run beside them)",
                  fmt::join(slam::filter_names(), ", ")));
  command.add_option("--particles", arguments.particles, "particles of each particle filter")
      ->check(CLI::Range(1, 1'000'000));
  add_seed_options(command, arguments);
  add_gate_option(command, arguments.gates);
}

void add_seed_options(CLI::App& command, RunArguments& arguments) {
  command.add_option_function<std::string>(
      "--seeds,--seed", [&arguments](const std::string& text) { arguments.seeds = parse_seeds_option(text); },
      "which seeds to run: 0..9, or 0,2,5");
  arguments.jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  command
      .add_option("--jobs,-j", arguments.jobs,
                  "processes at a time (default: one a processor); the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  command.add_option("--out,-o", arguments.out, "folder for the results (default: out/<name>)");
  command.add_flag("--dry-run", arguments.dry_run,
                   "check the input, say what would be done, and write nothing");
  add_quiet_option(command);
}

CLI::Validator real_between(double least, double greatest) {
  const auto complaint = [least, greatest](const std::string& text) {
    double value = 0.0;
    if (CLI::detail::lexical_cast(text, value) && value >= least && value <= greatest) return std::string();
    return fmt::format("expected a number from {} to {} (got '{}')", least, greatest, text);
  };
  return {[complaint](std::string& text) { return complaint(text); },
          fmt::format("FLOAT in [{} - {}]", least, greatest)};
}

CLI::Option* repeatable(CLI::Option* option) {
  return option->expected(1)->take_all()->allow_extra_args(false);
}

void add_gate_option(CLI::App& command, std::vector<Gate>& gates) {
  repeatable(
      command.add_option_function<std::vector<std::string>>(
          "--gate",
          [&gates](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) gates.push_back(parse_gate(text));
          },
          "a limit on a number of the result, e.g. --gate 'vision.recall>=0.98'; exit code 1 where it is "
          "broken; may be repeated"))
      ->type_name("METRIC<=LIMIT");
}

void add_set_option(CLI::App& command, std::vector<std::string>& overrides) {
  repeatable(command.add_option(
                 "--set", overrides,
                 "change a line of the scenario, e.g. --set camera.noise_sd_levels=4; may be repeated"))
      ->type_name("KEY=VALUE");
  repeatable(
      command.add_option_function<std::vector<std::string>>(
          "--faults",
          [&overrides](const std::vector<std::string>& faults) {  // behind --set, which fills the list anew
            for (const std::string& fault : faults) overrides.push_back("faults." + fault);
          },
          "a named fault of detector, camera or rig by its severity from 0 to 5, e.g. --faults "
          "camera.blur=3, which is --set faults.camera.blur=3; `stereobench faults` lists them; may be "
          "repeated"))
      ->type_name("NAME=SEVERITY");
}

void add_backend_option(CLI::App& command, renderer::Backend& backend) {
  command
      .add_option_function<std::string>(
          "--backend", [&backend](const std::string& name) { backend = parse_backend(name); },
          "what renders: osmesa, egl (the same software and pixels through EGL) or egl-gpu (a graphics card; "
          "other pixels); without it osmesa where its library is, else egl")
      ->type_name("NAME");
}

namespace {

/// Options that have no part in what comes out.
constexpr std::array<std::string_view, 8> kNoInputs = {
    "--jobs", "--out", "--dry-run", "--quiet", "--html", "--shard", "--shard-costs", "--shard-overlap"};

std::vector<std::string> words_of_inputs(const CLI::App& command, std::string_view left_out) {
  std::vector<std::string> words = {"stereobench", command.get_name()};
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    const bool is_hidden = option->get_group().empty();
    if (option->count() == 0 || is_hidden || name == left_out || std::ranges::count(kNoInputs, name) > 0)
      continue;
    const std::vector<std::string> values = option->results();
    const char delimiter = option->get_delimiter();
    if (option->get_positional() || option->get_expected_max() == 0) {
      if (option->get_positional())
        words.insert(words.end(), values.begin(), values.end());
      else
        words.push_back(name);
    } else if (delimiter != '\0') {
      words.insert(words.end(), {name, CLI::detail::join(values, std::string(1, delimiter))});
    } else {
      for (const std::string& value : values) words.insert(words.end(), {name, value});
    }
  }
  return words;
}

}  // namespace

std::vector<std::string> words_of(const CLI::App& command) {
  return words_of_inputs(command, "--seeds");
}

std::vector<std::string> whole_words_of(const CLI::App& command) {
  return words_of_inputs(command, {});
}

void add_shard_options(CLI::App& command, ShardArguments& arguments) {
  command
      .add_option_function<std::string>(
          "--shard", [&arguments](const std::string& text) { arguments.shard = parse_shard(text); },
          "do a part of the work alone: 2/40 is the second of 40, auto/40 that of the task in Slurm's array "
          "or of the pod in Kubernetes' Indexed Job; 0/40 does one drive of each kind, and measures them; "
          "`merge` joins the parts")
      ->type_name("I/N");
  command.add_option(
      "--shard-costs", arguments.costs,
      "costs.json of shard 0, or of earlier work: shards are cut by these times, not by count; "
      "the same file for all shards");
  command
      .add_option("--shard-overlap", arguments.overlap,
                  "do so many drives of the next shard as well, so that `merge` can compare two machines")
      ->check(CLI::Range(0, 1000).description(""))
      ->type_name("N");
  command.add_option("--plan", arguments.plan, "")->group("");  // of `merge`: not for people
}

std::filesystem::path output_folder(const RunArguments& arguments, const std::string& name) {
  if (!arguments.out.empty()) return arguments.out;
  const auto& shard = arguments.shards.shard;
  return std::filesystem::path("out") /
         (shard ? fmt::format("{}_shard_{}_of_{}", name, shard->number, shard->count) : name);
}

}  // namespace stereobench::harness
