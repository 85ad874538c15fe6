#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/commands/scenario_arguments.h"
#include "harness/commands/talk.h"
#include "harness/dataset/draws_file.h"
#include "harness/experiment/experiment.h"
#include "harness/experiment/write_experiment.h"
#include "harness/io/atomic_file.h"
#include "harness/report/plan_picture.h"
#include "renderer/surfaces/mesh_cache.h"
#include "worlds/drive/path.h"
#include "worlds/scenario/scenario.h"

namespace stereobench::harness {
namespace {

struct WorldArguments {
  std::filesystem::path scenario;
  std::vector<std::string> overrides;
  std::optional<std::uint64_t> seed;
  std::filesystem::path out;
  std::filesystem::path written;
  std::filesystem::path draws;
};

std::string share_of_steps(const ViewCoverage& coverage, int least) {
  const auto steps = static_cast<double>(coverage.balls_in_view.size());
  const auto enough =
      std::ranges::count_if(coverage.balls_in_view, [&](int balls) { return balls >= least; });
  return fmt::format("{:.1f} %", 100.0 * static_cast<double>(enough) / steps);
}

void print_summary(const worlds::Scenario& scenario, const worlds::World& world,
                   const ViewCoverage& coverage) {
  fmt::print("{}: {} balls, {} walls, {} meshes; a drive of {:.1f} m in {} steps\n", scenario.name,
             world.balls.size(), world.walls.size(), world.meshes.size(), worlds::length_m(scenario.path),
             scenario.path.size());
  const auto& seen = coverage.balls_in_view;
  const auto fewest = std::ranges::min_element(seen);
  fmt::print("balls in view: {} to {}, {:.1f} on average; at least 1, 2, 3 in {}, {}, {} of the steps\n",
             *fewest, std::ranges::max(seen),
             std::accumulate(seen.begin(), seen.end(), 0.0) / static_cast<double>(seen.size()),
             share_of_steps(coverage, 1), share_of_steps(coverage, 2), share_of_steps(coverage, 3));
  const auto& worst = scenario.path[static_cast<std::size_t>(fewest - seen.begin())].pose;
  const std::vector<int> unseen = never_in_view(coverage);
  fmt::print("fewest first at ({:.2f}, {:.2f}) m; {} balls never in view{}\n", worst.x_m, worst.y_m,
             unseen.size(), unseen.empty() ? "" : fmt::format(": {}", fmt::join(unseen, ", ")));
}

int show_world(const WorldArguments& arguments) {
  renderer::MeshCache meshes;
  worlds::Scenario scenario =
      read_experiment(arguments.scenario, arguments.overrides, meshes.occluders()).scenario;
  if (scenario.sensor == worlds::SensorKind::kStereo)
    worlds::give_occluders(scenario.world, meshes.occluders());
  const worlds::World world =
      arguments.seed ? worlds::world_for_seed(scenario, *arguments.seed) : scenario.world;
  const ViewCoverage coverage = view_coverage(scenario, world);
  const auto outlines = mesh_outlines(world, scenario.rig.height_m, meshes.forms());
  if (!arguments.out.empty())
    write_file_atomically(arguments.out, draw_plan(scenario, world, coverage, outlines));
  if (!arguments.written.empty())
    write_file_atomically(arguments.written, written_out(arguments.scenario, arguments.overrides,
                                                         arguments.seed, meshes.occluders()));
  if (!arguments.draws.empty())
    write_file_atomically(arguments.draws, draws_jsonl(scenario, std::array{*arguments.seed}));
  print_summary(scenario, world, coverage);
  warn_of_crossings(drive_crossings(world, scenario.path, outlines));
  if (!arguments.out.empty()) fmt::print("plan: {}\n", arguments.out.string());
  if (!arguments.written.empty()) fmt::print("scenario: {}\n", arguments.written.string());
  if (!arguments.draws.empty()) fmt::print("draws: {}\n", arguments.draws.string());
  return kPassed;
}

}  // namespace

void add_world_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("world", "draw a scenario's floor plan, its drive and what is in view along it");
  auto arguments = std::make_shared<WorldArguments>();
  command->add_option("scenario", arguments->scenario, "scenario file (YAML)")->required();
  add_set_option(*command, arguments->overrides);
  CLI::Option* const seed = command->add_option_function<std::string>(
      "--seeds,--seed",
      [arguments](const std::string& text) {
        const auto seeds = parse_seeds_option(text);
        if (seeds.size() > 1)
          throw std::runtime_error(fmt::format("--seeds: a plan is of one seed (got {})", seeds.size()));
        arguments->seed = seeds.front();
      },
      "the world of this seed (default: no ball moved, nothing left to chance drawn)");
  command->add_option("--out,-o", arguments->out, "SVG file for the plan");
  command->add_option(
      "--write", arguments->written,
      "scenario file that says line by line what a generator made and, with --seed, what that "
      "seed drew: to be edited, or rendered again bit for bit");
  command
      ->add_option("--draws", arguments->draws,
                   "file for the log of what the seed drew: a line of JSON for each value")
      ->needs(seed);
  add_quiet_option(*command);
  command->footer(
      "A ball is in view where both cameras see it whole and large enough to be measured; walls and balls\n"
      "hide what is behind them, and so do meshes, boxes and other shapes. For an oracle it is what lies in\n"
      "its sector.\n\n"
      "Example: stereobench world assets/scenarios/corridor.yaml -o out/corridor.svg");
  command->callback([arguments, &action] { action = [arguments] { return show_world(*arguments); }; });
}

}  // namespace stereobench::harness
