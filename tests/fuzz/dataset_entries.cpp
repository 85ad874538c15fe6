/// The ways in of data sets that others wrote: containers, truth, and lists of what a set has.
#include <cmath>
#include <fstream>
#include <sstream>

#include "harness/collection/collection_record.h"
#include "harness/dataset/drive_json.h"
#include "harness/dataset/formats/container/pair_parts.h"
#include "harness/dataset/formats/format_registry.h"
#include "harness/io/file_list.h"
#include "harness/io/float_picture.h"
#include "harness/io/json_file.h"
#include "harness/io/picture_file.h"
#include "harness/io/text_file.h"
#include "harness/verify/verify_dataset.h"
#include "tests/fuzz/promises.h"
#include "worlds/scenario/scenario.h"

namespace stereobench::fuzz {
namespace {

namespace fs = std::filesystem;
using vision::Side;

constexpr std::ptrdiff_t kOneLine = 1;

/// A folder of this process's own that holds one file, for as long as that is read.
class OwnFolder {
 public:
  OwnFolder(const std::string& name, const std::string& file, const std::string& text)
      : path_(own_file(name)) {
    fs::create_directories(path_);
    std::ofstream(path_ / file, std::ios::binary) << text;
  }
  ~OwnFolder() { fs::remove_all(path_); }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void expect_line(const std::string& text) {
  constexpr std::size_t kMost = 4096;
  expect(!text.empty() && text.find('\n') == std::string::npos, "what is said is a line");
  expect(text.size() < kMost, "what is said is not long");
}

void expect_sound(const harness::ViewFrame& frame, bool has_calibration) {
  for (std::size_t side = 0; side < 2; ++side) {
    const harness::ViewCamera& camera = frame.cameras[side];
    expect(!has_calibration || (std::isfinite(camera.pinhole.focal_px) && camera.pinhole.focal_px > 0.0),
           "a focal length is positive");
    expect(camera.body_from_camera.matrix().allFinite(), "a camera is somewhere");
    expect(!frame.world_from_body[side] || frame.world_from_body[side]->matrix().allFinite(),
           "a body is somewhere");
    for (const auto& channel : frame.channels[side])
      read_or_complain(
          [&] {
            const cv::Mat picture = channel.second.read();
            expect(!picture.empty() && (picture.type() == CV_8UC1 || picture.type() == CV_8UC3),
                   "a picture has shades or colours");
          },
          kOneLine);
  }
}

/// What is read of a data set, its pictures among it.
void expect_sound(const harness::DatasetView& view) {
  for (const harness::Fault& fault : view.faults) expect_line(harness::line_of(fault));
  for (const auto& lines : {view.checked, view.cannot})
    for (const std::string& line : lines) expect_line(line);
  for (const harness::ViewPose& pose : view.poses)
    expect(pose.matrix.allFinite() && pose.quaternion_norm >= 0.0, "a pose is finite");
  for (const harness::ViewBall& ball : view.balls)
    expect(ball.centre_m.allFinite() && ball.radius_m >= 0.0, "a ball is somewhere, and has a size");
  for (const harness::ViewFrame& frame : view.frames) expect_sound(frame, view.has_calibration);
}

void expect_sound(const harness::RecordedStreams& streams) {
  for (std::size_t i = 0; i < streams.odometry.size(); ++i) {
    const harness::OdometryReading& reading = streams.odometry[i];
    expect(std::isfinite(reading.v_mps) && std::isfinite(reading.w_radps), "odometry is finite");
    expect(i == 0 || reading.stamp_ns > streams.odometry[i - 1].stamp_ns, "odometry is in order of time");
  }
  for (const harness::LoggedSighting& sighting : streams.sightings)
    expect(std::isfinite(sighting.measurement.range_m) && sighting.measurement.covariance.allFinite(),
           "a sighting is finite");
  for (const harness::StampedPose& pose : streams.truth)
    expect(std::isfinite(pose.pose.x_m) && std::isfinite(pose.pose.heading_rad), "a true pose is finite");
  for (const harness::LandmarkTruth& landmark : streams.landmarks)
    expect(landmark.position_m.allFinite(), "a landmark is somewhere");
}

/// Reads a folder that has the bytes as its only file.
void check_dataset(const char* format, const char* file, Bytes bytes) {
  const OwnFolder folder(format, file, text_of(bytes));
  const harness::DatasetReader& reader = harness::dataset_reader(format);
  read_or_complain([&] { expect_sound(reader.read(folder.path())); }, kOneLine);
  if (reader.read_log != nullptr)
    read_or_complain([&] { expect_sound(reader.read_log(folder.path())); }, kOneLine);
}

/// Two pairs of 8 x 6 pixels, in which the only ball is seen.
worlds::Scenario tiny_scenario() {
  worlds::Scenario scenario;
  scenario.name = "tiny";
  scenario.rig.intrinsics = {8, 6, 7.0, 3.5, 2.5};
  scenario.believed_rig = scenario.rig;
  scenario.world.balls = {{{2.0, 0.1, 0.3}, 0.1, 3}};
  scenario.path = {{0, {0.0, 0.0, 0.0}, {}}, {100'000'000, {0.1, 0.0, 0.05}, {{1.0, 0.5, 0.1}}}};
  return scenario;
}

harness::MeasurementLog tiny_log(const worlds::Scenario& scenario) {
  harness::MeasurementLog log = {.start = {}, .steps = {}, .landmarks = {{0, 3, {2.0, 0.1}}}};
  for (const worlds::PathStep& step : scenario.path) {
    slam::RangeBearing seen = {.range_m = 2.0, .bearing_rad = 0.05};
    seen.covariance << 1e-4, 1e-6, 1e-6, 1e-4;
    seen.landmark_id = 0, seen.colour_class = 3;
    log.steps.push_back({.stamp_ns = step.stamp_ns, .odometry = step.controls, .truth = step.pose});
    log.steps.back().measurements = {seen};
  }
  return log;
}

/// What the program writes of the tiny drive: the first container of a format.
std::string tiny_container(const char* format) {
  const OwnFolder folder("seed", "empty", "");
  const worlds::Scenario scenario = tiny_scenario();
  const harness::MeasurementLog log = tiny_log(scenario);
  const harness::DatasetDrive drive = harness::drive_of(scenario, scenario.world, 0);
  for (std::size_t step = 0; step < drive.steps.size(); ++step) {
    for (const Side side : harness::kBothSides) {
      const cv::Mat picture(6, 8, CV_8UC3, cv::Scalar(20.0 * static_cast<double>(step), 90, 200));
      const fs::path file = harness::picture_part(folder.path(), step, side);
      fs::create_directories(file.parent_path());
      std::ofstream(file, std::ios::binary) << harness::encoded(".png", picture);
    }
    const fs::path balls = folder.path() / harness::kPartsFolder / "balls" / fmt::format("{:06}.json", step);
    fs::create_directories(balls.parent_path());
    std::ofstream(balls)
        << R"([{"ball_id": 0, "left": {"px_count_visib": 2, "bbox_visib": [3, 2, 1, 0]}, "right": null}])";
  }
  const auto writer = harness::dataset_format(format).make(drive);
  const harness::DatasetContainer container = writer->containers(log).at(0);
  harness::AtomicFile file(folder.path() / container.name);
  container.write(file, folder.path());
  file.move_into_place();
  return harness::read_text(folder.path() / container.name);
}

}  // namespace

void check_bag(Bytes bytes) {
  check_dataset("rosbag", "drive.bag", bytes);
}

std::vector<std::string> bag_seeds() {
  return {tiny_container("rosbag")};
}

void check_mcap(Bytes bytes) {
  check_dataset("mcap", "drive.mcap", bytes);
}

std::vector<std::string> mcap_seeds() {
  return {tiny_container("mcap")};
}

void check_shards(Bytes bytes) {
  check_dataset("webdataset", "drive-000000.tar", bytes);
}

std::vector<std::string> shard_seeds() {
  return {tiny_container("webdataset")};
}

void check_float_picture(Bytes bytes) {
  const OwnFolder folder("truth", "depth.tiff", text_of(bytes));
  read_or_complain([&] {
    const cv::Mat picture = harness::read_float_picture(folder.path() / "depth.tiff");
    expect(!picture.empty() && (picture.type() == CV_32FC1 || picture.type() == CV_32FC3),
           "truth has floats of one or three channels");
  });
}

std::vector<std::string> float_picture_seeds() {
  cv::Mat depth(6, 8, CV_32FC1), flow(6, 8, CV_32FC3);
  cv::randu(depth, 0.0, 4.0);
  cv::randu(flow, -2.0, 2.0);
  return {harness::encoded(".tiff", depth), harness::encoded(".tiff", flow), harness::encoded(".pfm", depth),
          harness::encoded(".pfm", flow)};
}

void check_drive(Bytes bytes) {
  const OwnFolder folder("drive", harness::kDatasetJson, text_of(bytes));
  const auto read = [](const fs::path& file) {
    return harness::read_json_file(file, [](const harness::JsonValue& json) {
      harness::DatasetDrive drive;
      harness::read_drive(json, drive);
      return harness::drive_json(drive).dump();
    });
  };
  read_or_complain([&] {
    const std::string written = read(folder.path() / harness::kDatasetJson);
    const OwnFolder again("again", harness::kDatasetJson, written);
    expect(read(again.path() / harness::kDatasetJson) == written, "a drive is read as it is written");
  });
}

std::vector<std::string> drive_seeds() {
  const worlds::Scenario scenario = tiny_scenario();
  return {harness::drive_json(harness::drive_of(scenario, scenario.world, 0)).dump()};
}

void check_manifest(Bytes bytes) {
  const OwnFolder folder("manifest", harness::kManifest, text_of(bytes));
  read_or_complain([&] {
    const harness::FileHashes files = harness::read_manifest(folder.path());
    for (const std::string& name : harness::changed_files(folder.path(), files))
      expect(files.contains(name), "a file that changed is in the list");
    for (const auto& [name, hash] : files)
      expect(fs::path(name).is_relative() && *fs::path(name).begin() != "..", "a name leads nowhere else");
  });
}

std::vector<std::string> manifest_seeds() {
  const std::string hash(64, 'a');
  return {harness::manifest_text({{"left/000000.png", hash}, {harness::kDatasetJson, hash}}),
          hash + " *a%0Ab.png\n" + std::string(64, 'F') + "\tright/100%25.png\n"};
}

void check_collection(Bytes bytes) {
  const OwnFolder folder("collection", harness::kCollectionFile, text_of(bytes));
  read_or_complain([&] {
    const std::string written = harness::collection_json(harness::read_collection_record(folder.path()));
    const OwnFolder again("again", harness::kCollectionFile, written);
    expect(harness::collection_json(harness::read_collection_record(again.path())) == written,
           "a collection is read as it is written");
  });
}

std::vector<std::string> collection_seeds() {
  const harness::CollectionEntry entry = {.folder = "train/tiny/seed_3",
                                          .split = "train",
                                          .name = "tiny",
                                          .variation = "",
                                          .format = "plain",
                                          .scenario = "tiny",
                                          .seed = 3,
                                          .identity_sha256 = std::string(64, 'a')};
  return {harness::collection_json({.name = "balls",
                                    .version = "1.0.0",
                                    .about = {"balls of a room", "CC0", "somebody", "none", "2026-01-31"},
                                    .datasets = {entry}})};
}

}  // namespace stereobench::fuzz
