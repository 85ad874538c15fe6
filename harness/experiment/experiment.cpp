#include "harness/experiment/experiment.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/experiment/experiment_parts.h"
#include "harness/experiment/fault_presets.h"
#include "harness/experiment/filter_config.h"
#include "harness/experiment/scenario_file.h"
#include "harness/experiment/seeds.h"
#include "worlds/scenario/scenario.h"
#include "worlds/scenario/scenario_parts.h"

namespace stereobench::harness {
namespace {

using worlds::choice;
using worlds::Field;
using worlds::Fields;
using worlds::flag;
using worlds::group;
using worlds::number;
using worlds::text;
using worlds::whole;
using worlds::YamlMap;
using worlds::YamlValue;

constexpr std::size_t kMostFilters = 16;

const std::vector<std::string>& filter_names() {
  static const std::vector<std::string> names = slam::filter_names();
  return names;
}

void read_filters(const YamlValue& list, Experiment& experiment) {
  const std::vector<std::string_view> names(filter_names().begin(), filter_names().end());
  experiment.filters.clear();
  for (const YamlValue& entry : list.list(1, kMostFilters)) {
    experiment.filters.push_back(filter_names()[entry.choice(names)]);
    if (std::ranges::count(experiment.filters, experiment.filters.back()) > 1)
      entry.fail("expected each filter once");
  }
}

void read_seeds(const YamlValue& value, Experiment& experiment) {
  const std::string text = value.text();
  try {
    experiment.seeds = parse_seeds(text);
  } catch (const std::invalid_argument& error) {
    value.fail(error.what());
  }
}

YAML::Node written_seeds(const Experiment& experiment) {
  return YAML::Node(fmt::format("{}", fmt::join(experiment.seeds, ",")));
}

void read_detector(const YamlValue& value, Experiment& experiment) {
  if (experiment.scenario.sensor != worlds::SensorKind::kStereo)
    value.refuse("the oracle has no pictures to look at");
  experiment.detector.command = value.text();
}

void read_detector_noise(const YamlValue& value, Experiment& experiment) {
  experiment.detector_noise = read_detector_faults(value, experiment.scenario);
}

const Fields<PerfectDetections>& perfect_detections_keys() {
  static const Fields<PerfectDetections> keys({
      flag("places", "Whether each ball that is seen is found, where it is.")
          .fills(&PerfectDetections::places),
      flag("names", "Whether each detection has its ball's name; filters are told it.")
          .fills(&PerfectDetections::names),
  });
  return keys;
}

std::vector<Field<Experiment>> run_fields() {
  return {
      choice("filters", {filter_names().begin(), filter_names().end()},
             "Filters that are run; dead reckoning always is.")
          .list(1, kMostFilters)
          .fills(&Experiment::filters)
          .reading(read_filters),
      whole("particles", 1, 100000, "Particles of each particle filter.").fills(&Experiment::particles),
      whole("draw_every", 1, 100000, "Frames of a block at most, of the filters that draw poses in blocks.")
          .fills(&Experiment::draw_every),
      text("seeds", "Which seeds are run: 0..9 (both included), 3, or 0,4,7.", kSeedsPattern)
          .by<Experiment>(read_seeds, written_seeds),
      group("gates", gate_keys(), "Limits on metrics of run.json; a broken one is exit code 1.")
          .list(0, 1000)
          .fills(&Experiment::gates),
  };
}

std::vector<Field<Experiment>> association_fields() {
  return {choice("association", {"individual", "joint"},
                 "Whether sightings that compete for landmarks are settled each for itself or as a set.")
              .fills(&Experiment::association)};
}

std::vector<Field<Experiment>> detector_fields() {
  return {
      text("detector", "What finds the balls: the name of a linked detector, or the command of a program.")
          .otherwise_says("our own detector")
          .by<Experiment>(read_detector),
      number("detector_timeout_s", {1e-3, 1e6}, "How long it may think about a frame, in seconds.")
          .fills(&Experiment::detector, &DetectorProgram::timeout_s),
      number("detector_start_s", {0.0, 1e6},
             "How much longer it may take for its first answer, in seconds, since it has to start.")
          .fills(&Experiment::detector, &DetectorProgram::start_s),
      group("detector_noise", detector_faults_keys(),
            "What is made worse of the detector's answers, whoever it is.")
          .otherwise_says("nothing")
          .fills(&Experiment::detector_noise)
          .reading(read_detector_noise),
      group("perfect_detections", perfect_detections_keys(),
            "What detections have of the truth, whatever the detector found.")
          .fills(&Experiment::perfect_detections),
      group("faults", fault_keys(), "Named faults by their severities, 0 to 5; they stand for other keys.")
          .otherwise_says("none"),
  };
}

/// What read_beliefs reads.
std::vector<Field<Experiment>> believed_oracle_fields() {
  return {group("believed_oracle", believed_oracle_keys(),
                "What filters are told of that sensor's sector and rates.")};
}

std::vector<Field<Experiment>> believed_odometry_fields() {
  return {group("believed_odometry_noise", worlds::odometry_noise_keys(),
                "Noise of the odometry that filters are told.")
              .otherwise_as("odometry_noise")
              .fills(&Experiment::believed, &FilterBeliefs::odometry_noise)};
}

std::vector<Field<Experiment>> believed_start_and_measurement_fields() {
  return {
      group("believed_start_noise", worlds::start_noise_keys(),
            "Noise of the start pose that filters are told.")
          .otherwise_as("start_noise")
          .fills(&Experiment::believed, &FilterBeliefs::start_noise),
      group("believed_measurement_noise", measurement_noise_keys(),
            "Noise of sightings that filters are told.")
          .otherwise_says("what each sighting states"),
  };
}

/// The keys of worlds, and between them those of a run: in the order in which they are listed, and read.
std::vector<Field<Experiment>> all_fields() {
  std::vector<Field<Experiment>> fields =
      worlds::lifted(&Experiment::scenario, worlds::scenario_keys().fields());
  insert_behind("description", run_fields(), fields);
  insert_behind("identity", association_fields(), fields);
  insert_behind("shutter", detector_fields(), fields);
  insert_behind("oracle", believed_oracle_fields(), fields);
  insert_behind("odometry_noise", believed_odometry_fields(), fields);
  insert_behind("start_noise", believed_start_and_measurement_fields(), fields);
  return fields;
}

const Fields<Experiment>& keys_of_experiment() {
  static const Fields<Experiment> keys(worlds::scenario_keys().kind_key, all_fields());
  return keys;
}

/// What depends on whether other groups are there.
void read_beliefs(const YamlMap& top, Experiment& experiment) {
  const worlds::Scenario& scenario = experiment.scenario;
  if (const auto believed = top.find("believed_oracle")) {
    if (!top.find("oracle")) believed->refuse("expected `oracle:` beside it, the sensor as it is");
    experiment.believed.sector = sector_of(scenario.oracle);
    believed_oracle_keys().read_into(*believed, *experiment.believed.sector);
  }
  if (const auto noise = top.find("believed_measurement_noise")) {
    const auto rig = top.find("rig") ? std::optional(scenario.believed_rig) : std::nullopt;
    const MeasurementNoise told = read_measurement_noise(*noise, rig);
    experiment.believed.measurement_noise = told.law;
    experiment.believed.stated_sd_scale = told.stated_sd_scale;
  }
}

}  // namespace

const worlds::KeyGroup& experiment_keys() {
  return keys_of_experiment();
}

Experiment read_experiment(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                           const worlds::OccluderReader& occluders) {
  const worlds::YamlDocument document = load_scenario(file, overrides);
  const YamlValue top(document, "", document.root, document.root.Mark());
  check_keys(top, experiment_keys());
  Experiment experiment;
  keys_of_experiment().read_into(top, experiment);
  const YamlMap map(top, experiment_keys());
  read_beliefs(map, experiment);
  worlds::read_world_and_path(map, occluders, experiment.scenario);
  return experiment;
}

}  // namespace stereobench::harness
