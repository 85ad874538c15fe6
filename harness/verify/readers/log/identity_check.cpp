#include <set>

#include <fmt/format.h>

#include "harness/logs/recorded_streams.h"
#include "harness/verify/readers/log/mrclam_log.h"

namespace stereobench::harness {
namespace {

/// Barcodes of sightings that nobody has: a line for each, however often it was seen.
void find_unknown_barcodes(DatasetView& view, const MrclamLog& log, const MrclamRobot& robot) {
  std::map<int, std::pair<const MrclamSighting*, std::size_t>> unknown;
  for (const MrclamSighting& sighting : robot.sightings) {
    if (sighting.barcode == 0 || log.subjects.contains(sighting.barcode)) continue;
    ++unknown.emplace(sighting.barcode, std::pair(&sighting, std::size_t{0})).first->second.second;
  }
  for (const auto& [barcode, seen] : unknown)
    view.faults.push_back({robot.sightings_file, seen.first->time,
                           fmt::format("line {}: barcode {}, which {} does not list (in {} lines)",
                                       seen.first->line, barcode, kMrclamBarcodes, seen.second)});
}

}  // namespace

void check_identities(DatasetView& view, const MrclamLog& log) {
  std::set<int> with_barcode;
  for (const auto& [barcode, subject] : log.subjects) {
    if (!with_barcode.insert(subject).second)
      view.faults.push_back({kMrclamBarcodes, "", fmt::format("subject {} has two barcodes", subject)});
    if (subject > kMrclamRobots && !log.landmarks_m.contains(subject))
      view.faults.push_back({kMrclamLandmarks, "",
                             fmt::format("missing landmark: {} lists subject {}", kMrclamBarcodes, subject)});
  }
  for (const auto& [subject, place_m] : log.landmarks_m) {
    if (subject <= kMrclamRobots)
      view.faults.push_back(
          {kMrclamLandmarks, "",
           fmt::format("subject {} is a robot's: landmarks are from {} on", subject, kMrclamRobots + 1)});
    if (!with_barcode.contains(subject))
      view.faults.push_back({kMrclamBarcodes, "",
                             fmt::format("missing landmark: {} has subject {}", kMrclamLandmarks, subject)});
  }
  for (const MrclamRobot& robot : log.robots) find_unknown_barcodes(view, log, robot);
}

}  // namespace stereobench::harness
