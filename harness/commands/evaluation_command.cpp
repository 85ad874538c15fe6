#include "harness/commands/evaluation_command.h"

#include <algorithm>
#include <array>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/talk.h"
#include "harness/io/atomic_file.h"
#include "harness/regression/gates.h"
#include "harness/result_pages/evaluation_page.h"
#include "harness/result_pages/run_page.h"
#include "harness/trajectories/evaluation_pictures.h"
#include "harness/trajectories/trajectory_file.h"

namespace stereobench::harness {
namespace {

constexpr const char* kGroup = "Score a trajectory made elsewhere";

/// Options of `slam` that --evaluate takes too.
constexpr std::array<std::string_view, 5> kShared = {"--help", "--gate", "--out", "--dry-run", "--quiet"};

constexpr std::array kAlignments = {AlignmentKind::kNone, AlignmentKind::kOrigin, AlignmentKind::kSe2,
                                    AlignmentKind::kSim2, AlignmentKind::kSe3,    AlignmentKind::kSim3};
constexpr std::array kPlanes = {Plane::kXy, Plane::kXz, Plane::kYz};

/// The value of a name. @throws std::runtime_error that lists the names there are
template <class Values>
auto named(const char* option, const Values& values, const std::string& name) {
  std::vector<std::string> names;
  for (const auto value : values) {
    if (text_of(value) == name) return value;
    names.push_back(text_of(value));
  }
  throw std::runtime_error(
      fmt::format("{}: expected one of {} (got '{}')", option, fmt::join(names, ", "), name));
}

/// A file's name as it can be shown anywhere: what is not printable ASCII becomes `?`.
std::string shown_name(const std::filesystem::path& file) {
  std::string name = file.filename().string();
  std::ranges::replace_if(
      name, [](char c) { return c < ' ' || c > '~'; }, '?');
  return name;
}

/// Where results go unless --out says so.
std::filesystem::path usual_folder(const std::filesystem::path& estimate) {
  const bool packed = estimate.extension() == ".gz";
  const std::string name = (packed ? estimate.stem() : estimate.filename()).stem().string();
  const bool is_dots = name.find_first_not_of('.') == std::string::npos;
  return std::filesystem::path("out") / ((is_dots ? "estimate" : name) + "_evaluation");
}

void print_summary(const Evaluation& evaluation, const std::string& estimate, const std::string& truth) {
  const TrajectoryPairs& pairs = evaluation.pairs;
  fmt::print("{}: {} poses, {} of them paired with the {} of {}; {:.6g} m driven", estimate,
             evaluation.estimate_poses, pairs.truth.size(), evaluation.truth_poses, truth,
             path_lengths_m(pairs.truth).back());
  if (!pairs.stamps_ns.empty()) fmt::print(" in {:.6g} s", times_of(pairs).back());
  fmt::print("\naligned: {}", text_of(evaluation.align));
  if (evaluation.plane) fmt::print(" in the plane {}", text_of(*evaluation.plane));
  if (evaluation.align == AlignmentKind::kSim2 || evaluation.align == AlignmentKind::kSim3)
    fmt::print(", the estimate scaled by {:.6g}", evaluation.alignment.scale);
  if (pairs.repeated > 0)
    say(fmt::format("\nwarning: pairs that share a pose with the pair before: {}", pairs.repeated));
  fmt::print("\n\n{}\n", evaluation_table(evaluation));
}

/// Adds the options that say how, all of which need --evaluate.
std::vector<CLI::Option*> add_rules(CLI::App& command, EvaluationRules& rules) {
  const auto text_option = [&command](const char* name, const char* type, const auto& read,
                                      const char* says) {
    return command.add_option_function<std::string>(name, read, says)->type_name(type);
  };
  return {
      text_option(
          "--align", "KIND",
          [&rules](const std::string& name) { rules.align = named("--align", kAlignments, name); },
          "how the estimate is brought to the truth: none; origin, by the first pose; se2 or se3, "
          "turned and shifted to fit best, in a plane or in space; sim2 or sim3, scaled too (default: "
          "se3; se2 if either file has poses in the plane alone)"),
      text_option(
          "--plane", "PLANE",
          [&rules](const std::string& name) { rules.plane = named("--plane", kPlanes, name); },
          "plane of se2 and sim2: xy, xz or yz (default: xy)"),
      text_option(
          "--delta", "DELTA",
          [&rules](const std::string& text) {
            const bool every = rules.delta.all_pairs;
            rules.delta = parse_delta(text);
            rules.delta.all_pairs = every;
          },
          "length of the relative error: poses, metres or seconds, e.g. 1, 10m, 0.5s (default: 1)"),
      command.add_flag("--all-pairs", rules.delta.all_pairs,
                       "pairs for the relative error from every pose on, not from where the last one ended"),
      command
          .add_option("--segments-m", rules.segments_m,
                      "lengths of KITTI's errors by length, m (default: 100,200,...,800)")
          ->delimiter(',')
          ->check(real_between(1e-6, 1e9).description(""))
          ->type_name("A,B,..."),
      command
          .add_option("--most-dt-s", rules.pairing.most_dt_s,
                      "largest difference between the times of two poses that belong together")
          ->check(real_between(0.0, 1e6))
          ->capture_default_str(),
      command.add_option("--offset-s", rules.pairing.offset_s, "what is added to the times of the estimate")
          ->check(real_between(-1e9, 1e9))
          ->capture_default_str()};
}

}  // namespace

void add_evaluation_options(CLI::App& command, EvaluationArguments& arguments) {
  CLI::Option* evaluate = command.add_option(
      "--evaluate", arguments.estimate,
      "score this trajectory against --truth in place of running filters: TUM, EuRoC, KITTI, or "
      "t_s,x_m,y_m,theta_rad; results go to out/<name>_evaluation");
  CLI::Option* truth =
      command.add_option("--truth", arguments.truth, "the true trajectory, in any of these formats");
  evaluate->needs(truth)->group(kGroup);
  truth->needs(evaluate)->group(kGroup);
  for (CLI::Option* option : add_rules(command, arguments.rules)) option->needs(evaluate)->group(kGroup);
}

void check_evaluation_options(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    const bool shared = std::ranges::find(kShared, name) != kShared.end();
    if (option->count() > 0 && option->get_group() != kGroup && !shared)
      throw CLI::ValidationError(
          fmt::format("{} has no meaning beside --evaluate, which runs no filter", name));
  }
}

int run_evaluation(const EvaluationArguments& arguments, std::filesystem::path out,
                   const std::vector<Gate>& gates, bool dry_run) {
  const std::vector<double>& segments_m = arguments.rules.segments_m;
  if (std::set<double>(segments_m.begin(), segments_m.end()).size() != segments_m.size())
    throw std::runtime_error("--segments-m: expected each length once");
  const std::string estimate = shown_name(arguments.estimate);
  const std::string truth = shown_name(arguments.truth);
  const Evaluation evaluation =
      evaluate(read_trajectory(arguments.estimate), read_trajectory(arguments.truth), arguments.rules);
  const nlohmann::ordered_json json = evaluation_json(evaluation, estimate, truth);
  check_metrics(gates, json);
  if (out.empty()) out = usual_folder(arguments.estimate);
  if (dry_run) {
    fmt::print("{}: would score {} pairs of poses; results: {}\n", estimate, evaluation.pairs.truth.size(),
               (out / "").string());
    return kPassed;
  }
  const std::string error_picture = error_picture_of(evaluation, estimate);
  const std::string path_picture = path_picture_of(evaluation, estimate);
  prepare_output_folder(out);
  remove_leftovers_in(out);
  write_file_atomically(out / "errors.csv", errors_csv(evaluation));
  write_file_atomically(out / "error.png", error_picture);
  write_file_atomically(out / "path.png", path_picture);
  write_file_atomically(out / kReport,
                        page_html(evaluation_page(evaluation, estimate, truth, gates, arguments.words)));
  write_file_atomically(out / "evaluation.json", json.dump(2) + "\n");
  print_summary(evaluation, estimate, truth);
  const auto broken = broken_gates(json, gates);
  say_gates(gate_report(broken, gates.size()), !broken.empty());
  fmt::print("results: {}\n", (out / "").string());
  return broken.empty() ? kPassed : kGateBroken;
}

}  // namespace stereobench::harness
