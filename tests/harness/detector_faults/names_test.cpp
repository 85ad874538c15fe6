/// Names that are wrong as often as was asked, measured from the detections alone. Bounds are 99 % intervals
/// of the sample size; seeds are pinned.
#include "harness/detector_faults/names.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "tests/harness/detector_faults/made_up_drive.h"

namespace stereobench::harness {
namespace {

using worlds::SensorKind;

// Mutations: one of a pair renamed; the odd one paired with itself; numbers of the oracle forgotten.
TEST(WrongNames, AreSwappedInPairs) {
  for (const SensorKind sensor : {SensorKind::kStereo, SensorKind::kOracle}) {
    MadeUpDrive drive = made_up_drive(5000, 5, sensor);
    if (sensor == SensorKind::kOracle)
      for (TracedDetection& detection : drive.perfect) {
        detection.seen.colour = detection.seen.range_bearing.colour_class = slam::kUnknown;
        detection.seen.range_bearing.landmark_id = detection.ball;
      }
    DetectorFaults faults;
    faults.identity_swap_probability = 0.1;
    const FaultyDrive faulty = drive_with(faults, drive);
    long renamed = 0;
    for (const auto& detections : faulty.frames) {
      const auto name = [&](int ball) {
        const slam::RangeBearing& seen = detections[static_cast<std::size_t>(ball)].seen.range_bearing;
        return sensor == SensorKind::kOracle ? seen.landmark_id : seen.colour_class;
      };
      for (int ball = 0; ball < 5; ++ball) {
        EXPECT_EQ(name(name(ball)), ball);
        renamed += name(ball) != ball ? 1 : 0;
      }
    }
    EXPECT_TRUE(is_share(renamed / 2, 2 * 5000, 0.1)) << renamed;  // two pairs a frame, one is left over
    EXPECT_EQ(faulty.counts, (FaultCounts{.renamed = renamed}));
  }
}

// Mutations: the matrix transposed; colours beyond it confused.
TEST(WrongNames, AreConfusedAsTheMatrixSays) {
  const MadeUpDrive drive = made_up_drive(10000);
  DetectorFaults faults;
  faults.confusion = {{0.7, 0.1, 0.2}, {0.0, 0.95, 0.05}, {0.25, 0.25, 0.5}};
  const FaultyDrive faulty = drive_with(faults, drive);
  long taken[4][4] = {};
  for (const auto& detections : faulty.frames)
    for (const TracedDetection& detection : detections) {
      EXPECT_EQ(detection.seen.colour, detection.seen.range_bearing.colour_class);
      ++taken[detection.ball][detection.seen.colour];
    }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_TRUE(is_share(taken[i][j], 10000, faults.confusion[i][j])) << i << j << ": " << taken[i][j];
  EXPECT_EQ(taken[3][3], 10000);
  EXPECT_EQ(faulty.counts.renamed, 30000 - taken[0][0] - taken[1][1] - taken[2][2]);
}

// A colour that is confused at one level is confused at a higher one, also with another colour. Mutation:
// draws compared with the columns in their order.
TEST(WrongNames, ContainThoseOfALowerLevel) {
  const MadeUpDrive drive = made_up_drive(500, 3);
  const auto confused_by = [&](const std::vector<std::vector<double>>& confusion) {
    DetectorFaults faults;
    faults.confusion = confusion;
    const Arrived frames = drive_with(faults, drive).frames;
    std::set<std::pair<std::size_t, int>> confused;
    for (std::size_t i = 0; i < frames.size(); ++i)
      for (const TracedDetection& detection : frames[i])
        if (detection.seen.colour != detection.ball) confused.emplace(i, detection.ball);
    return confused;
  };
  const auto low = confused_by({{1, 0, 0}, {0.1, 0.9, 0}, {0.1, 0, 0.9}});
  const auto high = confused_by({{1, 0, 0}, {0, 0.8, 0.2}, {0, 0.2, 0.8}});
  EXPECT_GT(low.size(), 50U);
  EXPECT_GT(high.size(), low.size());
  EXPECT_TRUE(std::includes(high.begin(), high.end(), low.begin(), low.end()));
}

}  // namespace
}  // namespace stereobench::harness
