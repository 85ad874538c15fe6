#include "harness/logs/log_facts.h"

#include <array>

#include <fmt/format.h>

#include "slam/math/angles.h"

namespace stereobench::harness {
namespace {

std::string sightings(long count) {
  return fmt::format("{} sighting{}", count, count == 1 ? "" : "s");
}

void add_truth(const LogFacts& facts, std::vector<std::string>& lines) {
  if (!facts.has_truth) {
    lines.emplace_back(
        "there is no true path: filters start at the origin of a frame of their own, and a map is compared "
        "with "
        "landmarks.csv after its best rotation and shift, where sightings name landmarks; add "
        "groundtruth.csv "
        "for errors of the path");
  } else if (facts.truth_starts_s > 0.0) {
    lines.push_back(
        fmt::format("the truth starts {:.2f} s after the log: filters start at the origin of a frame of "
                    "their own, and errors "
                    "are those after the best rotation and shift; cut the log where the truth starts to see "
                    "them as they are",
                    facts.truth_starts_s));
  } else if (facts.steps_without_truth > 0) {
    lines.push_back(fmt::format("{} of {} steps have no truth, and are not scored", facts.steps_without_truth,
                                facts.steps));
  }
}

void add_delay(const LogFacts& facts, std::vector<std::string>& lines) {
  const std::string taken = "the odometry's delay is taken to be 0; state --odometry-delay-s if it is known";
  if (facts.delay_source == DelaySource::kNoIdentities)
    lines.push_back("sightings do not say of which landmark they are: " + taken);
  if (facts.delay_source == DelaySource::kFewPairs)
    lines.push_back("too few landmarks are seen twice within a second: " + taken);
}

/// Those that were found; what the caller stated has no correlation.
void add_lasting_errors(const slam::LastingErrors& lasting, std::vector<std::string>& lines) {
  constexpr std::array kParts = {"ranges", "bearings"};
  for (int part = 0; part < 2; ++part) {
    if (!(lasting.correlation[part] > 0.0)) continue;
    lines.push_back(
        fmt::format("errors of {} last {:.2g} s (correlation {:.2f} over {:.2g} s): {:.2g} sightings of a "
                    "landmark in a row count for "
                    "about one; state --sighting-correlation-s 0,0 to take each for independent",
                    kParts[static_cast<std::size_t>(part)], lasting.time_s[part], lasting.correlation[part],
                    lasting.gap_s, 1.0 / (1.0 - lasting.correlation[part])));
  }
}

void add_sector(const slam::FoundSector& found, std::vector<std::string>& lines) {
  const auto& [range_m, half_angle_rad, missed, false_per_look] = found.sector;
  if (!(range_m > 0.0)) {
    lines.emplace_back(
        "too few sightings without identities are seen again to tell how far the sensor sees: every landmark "
        "is taken for real, and none for another's double; state --sector");
    return;
  }
  lines.push_back(fmt::format(
      "sightings without identities are of a sensor that sees {:.1f} m far and {:.0f} deg to each side, "
      "misses {:.0f} % of what is there, and sees {:.2f} things a look that are not, as {} sightings say "
      "that "
      "had to be seen again; state --sector if you know",
      range_m, half_angle_rad / slam::kRadPerDegree, 100.0 * missed, false_per_look, found.looks.triples));
}

}  // namespace

std::vector<std::string> assumptions_of(const LogFacts& facts, const StatedNoise& stated) {
  std::vector<std::string> lines;
  if (facts.repeated_sightings > 0)
    lines.push_back(fmt::format(
        "{} stood in the log already (the same instant, landmark, range and bearing) and left out: none is "
        "evidence twice; remove them from the log if that is right",
        sightings(facts.repeated_sightings)));
  if (facts.concurrent_sightings > 0)
    lines.push_back(
        fmt::format("{} of a landmark that is seen once more at the same instant: taken to have errors of "
                    "their own; remove "
                    "them if one was made of the other",
                    sightings(facts.concurrent_sightings)));
  if (facts.unknown_barcodes > 0)
    lines.push_back(fmt::format("{} of barcodes that Barcodes.dat does not name left out: add them to it",
                                sightings(facts.unknown_barcodes)));
  add_truth(facts, lines);
  add_delay(facts, lines);
  if (facts.sector_is_found) add_sector(facts.sector, lines);
  add_lasting_errors(facts.lasting_errors, lines);
  if (facts.noise_is_assumed && !stated.sensor)
    lines.emplace_back(
        "sightings state no covariances: that of MRCLAM's cameras is assumed; state --range-sd-m and "
        "--bearing-sd-rad, or --noise-law");
  if (!stated.odometry && !facts.odometry_states_noise)
    lines.emplace_back(
        "the odometry's noise is assumed to be that of MRCLAM's robots; state --v-constant-mps and its like "
        "(slam --help)");
  return lines;
}

}  // namespace stereobench::harness
