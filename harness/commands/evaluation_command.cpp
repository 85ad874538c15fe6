#include "harness/commands/evaluation_command.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/commands/talk.h"
#include "harness/io/atomic_file.h"
#include "harness/regression/gates.h"
#include "harness/trajectories/evaluation_pictures.h"
#include "harness/trajectories/trajectory_file.h"

namespace stereobench::harness {
namespace {

constexpr const char* kGroup = "Score a trajectory made elsewhere";

/// Options of `slam` that --evaluate takes too.
constexpr std::array<std::string_view, 5> kShared = {"--help", "--gate", "--out", "--dry-run", "--quiet"};

void print_summary(const Evaluation& evaluation, const std::string& estimate, const std::string& truth) {
  const TrajectoryPairs& pairs = evaluation.pairs;
  fmt::print("{}: {} poses, {} of them paired with the {} of {}; {:.6g} m driven", estimate,
             evaluation.estimate_poses, pairs.truth.size(), evaluation.truth_poses, truth,
             path_lengths_m(pairs.truth).back());
  if (pairs.has_stamps) fmt::print(" in {:.6g} s", pairs.time_s.back());
  fmt::print("\naligned: {}", name_of(evaluation.align));
  if (evaluation.align == AlignmentKind::kSim2 || evaluation.align == AlignmentKind::kSim3)
    fmt::print(", the estimate scaled by {:.6g}", evaluation.alignment.scale);
  fmt::print("\n\n{}\n", evaluation_table(evaluation));
}

}  // namespace

void add_evaluation_options(CLI::App& command, EvaluationArguments& arguments) {
  EvaluationRules& rules = arguments.rules;
  CLI::Option* evaluate = command.add_option("--evaluate", arguments.estimate,
                                             "score this trajectory against --truth in place of running "
                                             "filters: TUM, EuRoC, KITTI, or t_s,x_m,y_m,theta_rad");
  CLI::Option* truth =
      command.add_option("--truth", arguments.truth, "the true trajectory, in any of these formats");
  evaluate->needs(truth);
  const std::map<std::string, AlignmentKind> kinds = {
      {"none", AlignmentKind::kNone}, {"origin", AlignmentKind::kOrigin}, {"se2", AlignmentKind::kSe2},
      {"sim2", AlignmentKind::kSim2}, {"se3", AlignmentKind::kSe3},       {"sim3", AlignmentKind::kSim3}};
  CLI::Option* align =
      command
          .add_option_function<AlignmentKind>(
              "--align", [&rules](const AlignmentKind& kind) { rules.align = kind; },
              "how the estimate is brought to the truth: none; origin, by the first pose; se2 or se3, turned "
              "and shifted to fit best, in a plane or in space; sim2 or sim3, scaled too (default: se3, of "
              "planar files se2)")
          ->transform(CLI::CheckedTransformer(kinds).description(""))
          ->type_name("KIND");
  const std::map<std::string, Plane> planes = {{"xy", Plane::kXy}, {"xz", Plane::kXz}, {"yz", Plane::kYz}};
  CLI::Option* plane =
      command.add_option("--plane", rules.plane, "of se2 and sim2: xy, xz or yz (default: xy)")
          ->transform(CLI::CheckedTransformer(planes).description(""))
          ->type_name("PLANE");
  CLI::Option* span =
      command
          .add_option_function<std::string>(
              "--span",
              [&rules](const std::string& text) {
                const bool every = rules.span.from_every_pose;
                rules.span = parse_span(text);
                rules.span.from_every_pose = every;
              },
              "of the relative error: poses, metres or seconds, e.g. 1, 10m, 0.5s (default: 1)")
          ->type_name("SPAN");
  CLI::Option* every = command.add_flag("--spans-from-every-pose", rules.span.from_every_pose,
                                        "start a span at every pose, not where the last one ended");
  CLI::Option* segments = command
                              .add_option("--segments-m", rules.segments_m,
                                          "lengths of KITTI's errors by length, m (default: 100,200,...,800)")
                              ->delimiter(',')
                              ->check(CLI::Range(1e-6, 1e9))
                              ->type_name("A,B,...");
  CLI::Option* most_dt = command
                             .add_option("--most-dt-s", rules.pairing.most_dt_s,
                                         "between the times of two poses that belong together")
                             ->check(CLI::Range(0.0, 1e6))
                             ->capture_default_str();
  CLI::Option* offset =
      command.add_option("--offset-s", rules.pairing.offset_s, "is added to the times of the estimate")
          ->check(CLI::Range(-9e9, 9e9))
          ->capture_default_str();
  evaluate->group(kGroup);
  for (CLI::Option* option : {truth, align, plane, span, every, segments, most_dt, offset})
    option->needs(evaluate)->group(kGroup);
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
  const std::string estimate = arguments.estimate.filename().string();
  const std::string truth = arguments.truth.filename().string();
  const Evaluation evaluation =
      evaluate(read_trajectory(arguments.estimate), read_trajectory(arguments.truth), arguments.rules);
  const nlohmann::ordered_json json = evaluation_json(evaluation, estimate, truth);
  check_metrics(gates, json);
  if (out.empty()) out = std::filesystem::path("out") / arguments.estimate.stem();
  if (dry_run) {
    fmt::print("{}: would score {} pairs of poses; results: {}\n", estimate, evaluation.pairs.truth.size(),
               (out / "").string());
    return kPassed;
  }
  prepare_output_folder(out);
  remove_leftovers_in(out);
  write_file_atomically(out / "errors.csv", errors_csv(evaluation));
  write_file_atomically(out / "error.png", error_picture_of(evaluation, estimate));
  write_file_atomically(out / "path.png", path_picture_of(evaluation, estimate));
  write_file_atomically(out / "evaluation.json", json.dump(2) + "\n");
  print_summary(evaluation, estimate, truth);
  const auto broken = broken_gates(json, gates);
  say_gates(gate_report(broken, gates.size()), !broken.empty());
  fmt::print("results: {}\n", (out / "").string());
  return broken.empty() ? kPassed : kGateBroken;
}

}  // namespace stereobench::harness
