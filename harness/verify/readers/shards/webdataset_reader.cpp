#include "harness/verify/readers/shards/webdataset_reader.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/dataset/rendered_dataset.h"
#include "harness/io/file_list.h"
#include "harness/io/json_file.h"
#include "harness/io/picture_reader.h"
#include "harness/verify/readers/reader_tools.h"
#include "harness/verify/readers/shards/sample_checks.h"
#include "harness/verify/readers/shards/shard_files.h"
#include "renderer/pictures/picture_reader.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using vision::Side;

constexpr const char* kSampleJson = "json";

std::optional<ShardSample> said_of(DatasetView& view, const ShardFiles& files) {
  const auto json = files.members.find(kSampleJson);
  if (json == files.members.end()) return std::nullopt;
  try {
    const std::string text = read_member(view.folder / files.shard, json->second);
    if (is_stereo_sample(text)) return shard_sample(text);
  } catch (const std::runtime_error& error) {
    view.faults.push_back({files.place(kSampleJson), files.key, error.what()});
  }
  return std::nullopt;
}

cv::Mat decoded_member(const fs::path& archive, const TarMember& member) {
  const std::string bytes = read_member(archive, member);
  const std::vector<std::uint8_t> copy(bytes.begin(), bytes.end());
  return renderer::decode_picture(copy);
}

void add_pictures(const DatasetView& view, const ShardFiles& files, ViewFrame& frame) {
  for (const auto& [kind, member] : files.members) {
    if (!is_picture_name("picture." + kind)) continue;
    const Side side = kind.starts_with("right") ? Side::kRight : Side::kLeft;
    const bool is_named = kind.starts_with("left") || side == Side::kRight;
    if (!is_named && kind.find('.') != std::string::npos) continue;  // "mask.png" is no camera's picture
    const fs::path archive = view.folder / files.shard;
    frame.channels[index_of(side)][Channel::kPicture] = {
        files.place(kind), 0.0, [archive, file = member] { return decoded_member(archive, file); },
        [archive, file = member] { return read_member(archive, file); }};
  }
}

/// What a camera says of balls, as places in the list of all balls.
BallsFile balls_of(const ShardSample& sample, const std::string& file, const ViewCamera& camera,
                   std::size_t side, const BallPlaces& places) {
  BallsFile balls = {.file = file, .balls = {}};
  for (const SampleBall& ball : sample.balls) {
    const auto centre_px = pixel_of(camera, ball.centre_in_camera_m[side]);
    if (!centre_px) continue;
    balls.balls.push_back({.ball = places.at({sample.drive, sample.seed, ball.ball}),
                           .centre_px = *centre_px,
                           .centre_in_camera_m = ball.centre_in_camera_m[side],
                           .bbox_visib = ball.bbox_visib[side],
                           .px_count_visib = ball.px_count_visib[side],
                           .visib_fract = {},
                           .visible_mask = {},
                           .whole_mask = {}});
  }
  return balls;
}

void add_geometry(DatasetView& view, const SampleOfFiles& sample, const BallPlaces& places,
                  ViewFrame& frame) {
  const ShardSample& said = *sample.said;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const std::size_t i = index_of(side);
    ViewCamera& camera = frame.cameras[i];
    camera = {said.rig.intrinsics, said.rig.distortion, Eigen::Isometry3d::Identity()};
    frame.world_from_body[i] = said.world_from_camera[i];
    frame.balls[i] = balls_of(said, sample.files.place(kSampleJson), camera, i, places);
  }
  frame.stamp_ns = {said.stamp_ns, said.stamp_ns};
  frame.drive = fmt::format("{}_{}", said.drive, said.seed);
  frame.robot = {said.believed_rig, said.world_from_robot};
  view.poses.push_back({.file = sample.files.shard,
                        .stamp_ns = said.stamp_ns,
                        .matrix = said.world_from_camera[0].matrix(),
                        .name = sample.files.key});
}

bool is_same_drive(const SampleOfFiles& one, const SampleOfFiles& other) {
  return one.said && other.said && one.said->drive == other.said->drive && one.said->seed == other.said->seed;
}

void add_samples(DatasetView& view, const std::vector<SampleOfFiles>& samples, const BallPlaces& places) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    ViewFrame frame = {.name = samples[i].files.key, .cameras = {}};
    add_pictures(view, samples[i].files, frame);
    for (ViewCamera& camera : frame.cameras) camera.pinhole.width_px = 0;  // nothing says it
    if (samples[i].said) add_geometry(view, samples[i], places, frame);
    frame.drive_goes_on = i + 1 < samples.size() && is_same_drive(samples[i], samples[i + 1]);
    view.frames.push_back(std::move(frame));
  }
}

/// Steps that dataset.json lists, and no sample is of.
void find_missing_samples(DatasetView& view, const std::vector<SampleOfFiles>& samples) {
  if (!fs::exists(view.folder / kDatasetJson)) return;
  std::set<std::int64_t> there;
  for (const SampleOfFiles& sample : samples)
    if (sample.said) there.insert(sample.said->step);
  read_json_file(view.folder / kDatasetJson, [&](const JsonValue& json) {
    constexpr std::size_t kMostFrames = 1 << 24;
    const auto frames = json.find(kFrames);
    if (frames)
      for (const JsonValue& frame : frames->list(0, kMostFrames))
        if (const std::int64_t step = frame.integer(0, kMostFrames); !there.contains(step))
          view.faults.push_back({kDatasetJson, fmt::format("{:06}", step),
                                 "missing frame: it lists this step, and no shard has a sample of it"});
    return true;
  });
}

}  // namespace

bool looks_like_webdataset(const fs::path& folder) {
  return !stems_in(folder, ".tar").empty();
}

DatasetView read_webdataset_view(const fs::path& folder) {
  DatasetView view = {.format = "webdataset", .folder = folder};
  std::vector<SampleOfFiles> samples;
  for (ShardFiles& files : shard_files(view)) {
    std::optional<ShardSample> said = said_of(view, files);
    samples.push_back({std::move(files), std::move(said)});
  }
  view.has_calibration =
      std::ranges::any_of(samples, [](const auto& sample) { return sample.said.has_value(); });
  const std::string jsons = samples.empty() ? "" : samples.front().files.shard + "/*.json";
  view.calibration_file = view.poses_file = jsons;
  view.pictures_file = samples.empty() ? "" : samples.front().files.shard + "/*.png";
  view.poses_of = PosesOf::kEachCamera;
  double right_delay_s = 0.0;
  read_or_blame(view, kDatasetJson, [&] {
    right_delay_s = said_of_shutter(folder, "right_delay_s");
    find_missing_samples(view, samples);
  });
  const BallPlaces places = balls_of_drives(view, samples);
  add_samples(view, samples, places);
  check_samples(view, samples, right_delay_s != 0.0);
  view.cannot.push_back(view.has_calibration
                            ? "depth and identities of pixels, which the layout has not: cameras, poses and "
                              "balls were held against each other and corners of the pictures"
                            : "cameras and poses: no sample has a .json with a `rig`");
  return view;
}

}  // namespace stereobench::harness
