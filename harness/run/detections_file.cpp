#include "harness/run/detections_file.h"

#include <fstream>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "harness/dataset/dataset_truth.h"
#include "harness/dataset/formats/plain_format.h"
#include "harness/detector/detection_lines.h"
#include "harness/drive/sightings.h"
#include "harness/io/calibration_file.h"
#include "harness/io/file_list.h"
#include "harness/io/number_table.h"
#include "harness/json/json_line.h"
#include "harness/vision_scoring/detection_table.h"
#include "harness/vision_scoring/rig_check.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

worlds::Identity identity_by_colour(const std::vector<worlds::Ball>& balls) {
  std::set<int> colours;
  for (const worlds::Ball& ball : balls) colours.insert(ball.colour);
  return colours.size() == balls.size() ? worlds::Identity::kKnown : worlds::Identity::kColourClass;
}

[[noreturn]] void refuse(const fs::path& file, std::size_t line, const std::string& what) {
  throw std::runtime_error(fmt::format("{}:{}: {}", file.string(), line, what));
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || fs::is_directory(file))
    throw std::runtime_error(fmt::format("{}: no such file of detections", file.string()));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void forget_sightings(MeasurementLog& log) {
  for (LogStep& step : log.steps) {
    step.measurements.clear();
    step.true_landmarks.clear();
  }
}

/// @throws BadLine where a ball of a line has pixels alone
void require_ranges(const std::string& line) {
  constexpr std::size_t kMostBalls = 100'000;
  const nlohmann::json json = parse_line(line);
  for (const JsonValue& ball : JsonValue(json, "").at("balls").list(0, kMostBalls)) ball.at("range_m");
}

/// Landmarks as balls that are told apart by colour. They are numbered by their places from now on, as
/// sightings of them are.
std::vector<worlds::Ball> balls_of(std::vector<LandmarkTruth>& landmarks) {
  std::vector<worlds::Ball> balls;
  for (LandmarkTruth& landmark : landmarks) {
    landmark.landmark_id = static_cast<int>(balls.size());
    balls.push_back({.colour = landmark.colour_class});
  }
  return balls;
}

/// The numbers of an imported folder's pictures.
/// @param steps of the log; each picture is of one of them
std::vector<std::size_t> imported_frames(const fs::path& folder, std::size_t steps) {
  const NumberTable table = read_comma_separated_table(folder / kPicturesFile, {"frame"});
  std::vector<std::size_t> frames;
  for (const TableRow& row : table.rows) {
    frames.push_back(static_cast<std::size_t>(whole_number_in(table, row, 0, 0)));
    if (frames.back() >= steps)
      refuse(table, row, 0, fmt::format("expected the number of one of the log's {} steps", steps));
  }
  return frames;
}

}  // namespace

bool is_imported(const fs::path& folder) {
  return fs::exists(folder / kPicturesFile) && !fs::exists(folder / kDatasetJson);
}

void take_sightings(MeasurementLog& log, const fs::path& folder, const fs::path& detections,
                    std::optional<worlds::Identity> identity) {
  const BallGeometry geometry = {.rig = read_rig_calibration(folder / kCalibrationFile).rig};
  const std::vector<std::string> lines = lines_of(detections);
  const std::vector<std::size_t> frames = imported_frames(folder, log.steps.size());
  if (lines.size() != frames.size())
    refuse(detections, lines.size(),
           fmt::format("expected a line for each of {} frames (got {})", frames.size(), lines.size()));
  forget_sightings(log);
  const std::vector<worlds::Ball> balls = balls_of(log.landmarks);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t frame = frames[i];
    try {
      const auto observations = read_detections(lines[i], frame, geometry);
      require_ranges(lines[i]);
      const std::vector<int> of_no_known_ball(observations.size(), slam::kUnknown);
      log.steps[frame].measurements = sightings_of(observations, of_no_known_ball, balls,
                                                   identity.value_or(worlds::Identity::kColourClass))
                                          .measurements;
    } catch (const BadLine& bad) {
      refuse(detections, i + 1, bad.what());
    }
  }
}

ScoredDetections replace_sightings(MeasurementLog& log, const fs::path& folder, const fs::path& detections,
                                   std::optional<worlds::Identity> identity, std::uint64_t seed) {
  const DatasetTruth truth = read_dataset_truth(folder);
  const BallGeometry geometry = {truth.believed_rig, truth.world.ball_radius_m()};
  const vision::BallSize size = {truth.world.ball_radius_m(), truth.world.ball_radius_sd_m};
  const worlds::Identity told = identity.value_or(identity_by_colour(truth.world.balls));
  const std::vector<std::string> lines = lines_of(detections);
  forget_sightings(log);
  ScoredDetections scored;
  for (std::size_t i = 0; i < truth.frames.size(); ++i) {
    const std::size_t frame = truth.frames[i];
    if (i >= lines.size()) refuse(detections, i + 1, fmt::format("expected the line of frame {}", frame));
    if (frame >= log.steps.size() || !log.steps[frame].truth)
      throw std::runtime_error(
          fmt::format("{}: there is a picture of frame {}, but no truth", folder.string(), frame));
    LogStep& step = log.steps[frame];
    const renderer::StereoFrame ids = read_ball_ids(folder, frame, truth.rig);
    const VisionTruth seen = {truth.world, truth.rig, *step.truth, ids};
    try {
      const auto observations = read_detections(lines[i], frame, geometry);
      const FrameMatch match = match_observations(seen, observations);
      scored.score += score_match(match);
      scored.score.rig += check_rig(truth.believed_rig, size, observations);
      scored.rows += detection_rows({seed, frame, truth.world, truth.rig}, match);
      Sightings sightings = sightings_of(observations, balls_observed(match), truth.world.balls, told);
      step.measurements = std::move(sightings.measurements);
      step.true_landmarks = std::move(sightings.balls);
    } catch (const BadLine& bad) {
      refuse(detections, i + 1, bad.what());
    }
  }
  if (lines.size() > truth.frames.size())
    refuse(detections, truth.frames.size() + 1, "expected no more lines: the data set has no more frames");
  return scored;
}

}  // namespace stereobench::harness
