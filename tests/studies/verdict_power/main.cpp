/// How often `compare` sees planted faults of a detector, and how often it raises false alarms.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/drive/sightings.h"
#include "harness/experiment/experiment.h"
#include "harness/experiment/filter_config.h"
#include "harness/io/atomic_file.h"
#include "harness/io/text_file.h"
#include "harness/io/text_table.h"
#include "harness/process/process_pool.h"
#include "harness/process/progress.h"
#include "harness/regression/detection_changes.h"
#include "harness/regression/verdict_report.h"
#include "harness/run/seed_drive.h"
#include "harness/statistics/statistics.h"
#include "harness/vision_scoring/detection_table.h"
#include "tests/studies/verdict_power/detector_variants.h"

namespace stereobench::harness {
namespace {

constexpr std::uint64_t kSeedsOfRepetition = 20;
constexpr std::size_t kNoisyVariants = 4;  ///< of each repetition; each is compared with the next one
constexpr double kNoise_px = 0.05;
constexpr std::uint64_t kCalibrationSeeds = 40;  ///< those behind the seeds of all repetitions

/// A variant's result so far: what its folder would hold.
struct VariantResult {
  SeedTable table;
  SeedMetricsTally metrics;
  std::string detections = detections_csv_header();
};

std::vector<Variant> all_variants(double nis_per_degree, double coarser_belief) {
  std::vector<Variant> variants = faulty_variants(nis_per_degree, coarser_belief);
  for (std::size_t i = 0; i < kNoisyVariants; ++i) variants.push_back(noisy_variant(kNoise_px));
  return variants;
}

/// What a variant makes of a drive that the detector looks at.
class VariantDrive {
 public:
  VariantDrive(const Variant& variant, std::size_t number, std::uint64_t seed)
      : variant_(variant), seed_(seed), chance_(seed, slam::Stream::kOracle, number) {
    score_.emplace();
  }

  void look(const FrameEvent& event, const Observations& before, const worlds::Scenario& scenario) {
    const Found found{event.observations, before, scenario.believed_rig, event.world.ball_radius_m()};
    const Observations observations = variant_.detect(found, chance_);
    const FrameMatch match =
        match_observations({event.world, event.rig, event.world_from_robot, event.frame}, observations);
    *score_ += score_match(match);
    rows_ += detection_rows({seed_, event.step, event.world, event.rig}, match);
    sightings_[event.step] =
        sightings_of(observations, balls_observed(match), event.world.balls, scenario.identity);
  }

  void finish(const Experiment& experiment, MeasurementLog log, VariantResult& result) {
    for (std::size_t step = 0; step < log.steps.size(); ++step) {
      log.steps[step].measurements = sightings_[step].measurements;
      log.steps[step].true_landmarks = sightings_[step].balls;
    }
    slam::FilterConfig config = filter_config(experiment);
    variant_.believe(config);
    SeedDrive drive{.seed = seed_, .recording = {.log = std::move(log), .vision = std::move(score_)}};
    drive.references.batch.failed = true;
    Timing timing;
    drive.runs = replay_filters(drive.recording.log, {"iekf"}, config, seed_, timing);
    result.metrics.add(score_seed(drive, {}));
    result.table.seeds.push_back(seed_);
    result.detections += rows_;
  }

 private:
  const Variant& variant_;
  std::uint64_t seed_;
  slam::RandomStream chance_;
  std::optional<VisionScore> score_;
  std::map<std::size_t, Sightings> sightings_;
  std::string rows_;
};

void drive_variants(const Experiment& experiment, std::uint64_t seed, const std::vector<Variant>& variants,
                    std::vector<VariantResult>& results) {
  std::vector<VariantDrive> drives;
  for (std::size_t i = 0; i < variants.size(); ++i) drives.emplace_back(variants[i], i, seed);
  Observations before;
  Listeners listeners;
  listeners.on_frame = [&](const FrameEvent& event) {
    for (VariantDrive& drive : drives) drive.look(event, before, experiment.scenario);
    before = event.observations;
  };
  const Recording recording = record(experiment, seed, listeners);
  for (std::size_t i = 0; i < drives.size(); ++i) drives[i].finish(experiment, recording.log, results[i]);
}

/// NIS / 2 of the detector as it is in one drive.
double nis_per_degree_of(const Experiment& experiment, std::uint64_t seed) {
  std::vector<VariantResult> result(1);
  drive_variants(experiment, seed, {faulty_variants(1.0, 1.0).front()}, result);
  return summarise(result[0].metrics.metrics().at("vision.normalised_error")).mean;
}

/// The mean over seeds from `first` on, each driven by a process of its own.
double mean_nis_per_degree(const Experiment& experiment, std::uint64_t first, int jobs) {
  double sum = 0.0;
  run_in_order(
      kCalibrationSeeds, jobs,
      [&](std::size_t index, const std::function<void(double)>&) {
        return fmt::format("{}", nis_per_degree_of(experiment, first + index));
      },
      [&](std::size_t, const std::string& answer) { sum += std::stod(answer); }, [](double) {});
  return sum / static_cast<double>(kCalibrationSeeds);
}

constexpr const char* kAte = "filters.iekf.ate_rms_m";

double mean_ate_m(const VariantResult& result) {
  return summarise(result.table.metrics.at(kAte)).mean;
}

/// What `compare` says of two results.
nlohmann::json comparison_of(VariantResult& first, VariantResult& second, const std::filesystem::path& file) {
  const auto balls_of = [&file](const VariantResult& result) {
    write_file_atomically(file, result.detections);
    return read_detected_balls(file);
  };
  const auto changes = detection_changes(pair_balls(balls_of(first), balls_of(second)));
  for (VariantResult* result : {&first, &second}) result->table.metrics = result->metrics.metrics();
  const ResultComparison comparison = compare_results(first.table, second.table, {}, counts_of(changes));
  nlohmann::json said = {{"text", changes_text(changes, true)},
                         {"ate_ratio", mean_ate_m(second) / mean_ate_m(first)},
                         {"compared", comparison.metrics.size()},
                         {"regressed", nlohmann::json::array()},
                         {"improved", nlohmann::json::array()}};
  for (const MetricVerdict& metric : comparison.metrics) {
    said["rows"][metric.metric] = fmt::format("{} {:.4g} -> {:.4g}, {}, margin {}, p {:.2g}",
                                              text_of(metric.verdict), metric.first_mean, metric.second_mean,
                                              change_text(metric), margin_text(metric), metric.p_holm);
    if (metric.verdict == Verdict::kRegressed) said["regressed"].push_back(metric.metric);
    if (metric.verdict == Verdict::kImproved) said["improved"].push_back(metric.metric);
  }
  return said;
}

/// Position of the variant that one is compared with.
std::size_t position_of(const std::string& name, const std::vector<Variant>& variants) {
  const auto found = std::ranges::find(variants, name, &Variant::name);
  return static_cast<std::size_t>(found - variants.begin());
}

/// One repetition: each fault beside the detector without it, and each noisy variant beside the next one.
std::string repetition(const Experiment& experiment, const std::vector<Variant>& variants,
                       std::uint64_t number, const std::filesystem::path& folder,
                       const std::function<void(double)>& report) {
  std::vector<VariantResult> results(variants.size());
  for (std::uint64_t i = 0; i < kSeedsOfRepetition; ++i) {
    drive_variants(experiment, kSeedsOfRepetition * number + i, variants, results);
    report(static_cast<double>(i + 1) / static_cast<double>(kSeedsOfRepetition));
  }
  const std::filesystem::path file = folder / fmt::format("detections_{}.csv", number);
  const std::size_t faults = variants.size() - kNoisyVariants;
  nlohmann::json said = nlohmann::json::array();
  for (std::size_t i = 0; i < faults; ++i)
    said.push_back(comparison_of(results[position_of(variants[i].beside, variants)], results[i], file));
  for (std::size_t i = faults; i + 1 < variants.size(); ++i)
    said.push_back(comparison_of(results[i], results[i + 1], file));
  std::filesystem::remove(file);
  return said.dump();
}

/// The same, kept in a folder for a study that is stopped and goes on: the folder is one study's.
std::string kept_repetition(const Experiment& experiment, const std::vector<Variant>& variants,
                            std::uint64_t number, const std::filesystem::path& keep,
                            const std::function<void(double)>& report) {
  if (keep.empty())
    return repetition(experiment, variants, number, std::filesystem::temp_directory_path(), report);
  const std::filesystem::path file = keep / fmt::format("repetition_{}.json", number);
  if (std::filesystem::exists(file)) return read_text(file);
  std::string said = repetition(experiment, variants, number, keep, report);
  write_file_atomically(file, said);
  return said;
}

/// What came out of one variant over all repetitions.
struct Tally {
  long repetitions = 0;
  long regressed = 0;      ///< any metric
  long improved = 0;       ///< any metric
  long right_metric = 0;   ///< one of those that are to be
  long right_report = 0;   ///< all that the report is to say is said
  double ate_ratio = 0.0;  ///< summed over the repetitions
  std::map<std::string, long> by_metric;
};

void add(const Variant& variant, const nlohmann::json& said, Tally& tally) {
  const auto regressed = said.at("regressed").get<std::vector<std::string>>();
  ++tally.repetitions;
  tally.regressed += regressed.empty() ? 0 : 1;
  tally.improved += said.at("improved").empty() ? 0 : 1;
  tally.right_metric += std::ranges::any_of(variant.metrics, [&](const std::string& metric) {
    return std::ranges::find(regressed, metric) != regressed.end();
  });
  const auto text = said.at("text").get<std::string>();
  tally.right_report += std::ranges::all_of(
      variant.says, [&](const std::string& line) { return text.find(line) != std::string::npos; });
  tally.ate_ratio += said.at("ate_ratio").get<double>();
  for (const std::string& metric : regressed) ++tally.by_metric[metric];
}

/// Says why a fault was not seen as it should be.
void explain(const Variant& variant, std::size_t repetition, const nlohmann::json& said, const Tally& before,
             const Tally& after) {
  if (!variant.metrics.empty() && after.right_metric == before.right_metric)
    for (const std::string& metric : variant.metrics)
      fmt::print(stderr, "{}, repetition {}: {} is {}\n", variant.name, repetition, metric,
                 said.at("rows").at(metric).get<std::string>());
  if (after.right_report == before.right_report)
    fmt::print(stderr, "{}, repetition {}: the report says\n{}", variant.name, repetition,
               said.at("text").get<std::string>());
}

std::string most_frequent(const Tally& tally) {
  std::string name = "-";
  long most = 0;
  for (const auto& [metric, count] : tally.by_metric)
    if (count > most) {
      most = count;
      name = fmt::format("{} ({})", metric, count);
    }
  return name;
}

/// How often each of the right metrics is REGRESSED; of a fault without any, the one that is most often.
std::string metrics_seen(const Variant& variant, const Tally& tally) {
  std::string text;
  for (const std::string& metric : variant.metrics) {
    const auto seen = tally.by_metric.find(metric);
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", metric,
                        seen == tally.by_metric.end() ? 0 : seen->second);
  }
  return text.empty() ? most_frequent(tally) : text;
}

void print(const std::vector<Variant>& variants, const std::vector<Tally>& tallies) {
  AlignedTable table{.header = {"variant", "comparisons", "REGRESSED", "IMPROVED", "right metric",
                                "right report", "ATE, B / A", "how often each"}};
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    const Tally& tally = tallies[i];
    const auto unless = [](bool nothing, long count) { return nothing ? "-" : fmt::format("{}", count); };
    table.rows.push_back({variants[i].name, fmt::format("{}", tally.repetitions),
                          fmt::format("{}", tally.regressed), fmt::format("{}", tally.improved),
                          unless(variants[i].metrics.empty(), tally.right_metric),
                          unless(variants[i].says.empty(), tally.right_report),
                          fmt::format("{:.3g}", tally.ate_ratio / static_cast<double>(tally.repetitions)),
                          metrics_seen(variants[i], tally)});
  }
  fmt::print("{}", markdown(table));
}

struct StudyArguments {
  std::filesystem::path scenario = STEREOBENCH_SOURCE_DIR "/assets/scenarios/ball_circle.yaml";
  std::vector<std::string> set;
  std::string detector;
  double coarser_belief = 11.0;  ///< makes the absolute trajectory error of our detector a fifth larger
  std::size_t repetitions = 100;
  int jobs = 2;
  std::filesystem::path keep;
};

int run_study(const StudyArguments& arguments) {
  const std::size_t repetitions = arguments.repetitions;
  if (!arguments.keep.empty()) prepare_output_folder(arguments.keep);
  std::vector<std::string> lines = {"path.laps=0.29", "gates=[]"};
  lines.insert(lines.end(), arguments.set.begin(), arguments.set.end());
  Experiment experiment = read_experiment(arguments.scenario, lines);
  experiment.detector.command = arguments.detector;
  const double nis_per_degree =
      mean_nis_per_degree(experiment, kSeedsOfRepetition * repetitions, arguments.jobs);
  const std::vector<Variant> variants = all_variants(nis_per_degree, arguments.coarser_belief);
  const std::size_t faults = variants.size() - kNoisyVariants;
  std::vector<Tally> tallies(faults + 1);
  Progress progress("verdicts", static_cast<double>(repetitions));
  run_in_order(
      repetitions, arguments.jobs,
      [&](std::size_t index, const std::function<void(double)>& report) {
        return kept_repetition(experiment, variants, index, arguments.keep, report);
      },
      [&](std::size_t index, const std::string& answer) {
        const auto said = nlohmann::json::parse(answer);
        for (std::size_t i = 0; i < said.size(); ++i) {
          const std::size_t at = std::min(i, faults);
          const Tally before = tallies[at];
          add(variants[at], said[i], tallies[at]);
          explain(variants[at], index, said[i], before, tallies[at]);
        }
      },
      [&](double done) { progress.show(done); });
  fmt::print("{} seeds a comparison, {} steps a seed; NIS / 2 as it is, on {} other seeds: {:.3f}\n\n",
             kSeedsOfRepetition, experiment.scenario.path.size(), kCalibrationSeeds, nis_per_degree);
  print(variants, tallies);
  return 0;
}

}  // namespace
}  // namespace stereobench::harness

int main(int argc, char** argv) {
  CLI::App program("How often compare sees planted faults, and how often it raises false alarms.");
  stereobench::harness::StudyArguments arguments;
  program.add_option("--scenario", arguments.scenario, "with pictures")->capture_default_str();
  program.add_option("--set", arguments.set, "KEY=VALUE of the scenario, as in stereobench run");
  program.add_option("--detector", arguments.detector, "command of a program in place of our detector");
  program
      .add_option("--coarser-belief", arguments.coarser_belief,
                  "by what the odometry noise is multiplied that the filter of the last fault believes")
      ->capture_default_str();
  program.add_option("--repetitions", arguments.repetitions, "how often each fault is planted")
      ->capture_default_str();
  program.add_option("--jobs", arguments.jobs, "processes at a time")->capture_default_str();
  program.add_option("--keep", arguments.keep,
                     "folder that keeps what is finished, for a study that is stopped and goes on");
  CLI11_PARSE(program, argc, argv);
  return stereobench::harness::run_study(arguments);
}
