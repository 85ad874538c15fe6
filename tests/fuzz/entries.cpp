#include "tests/fuzz/entries.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "harness/dataset/palette_file.h"
#include "harness/detector/detection_lines.h"
#include "harness/io/calibration_file.h"
#include "harness/io/picture_reader.h"
#include "tests/fuzz/promises.h"
#include "vision/camera/rig.h"
#include "vision/observe.h"
#include "vision/palette.h"

namespace stereobench::fuzz {
namespace {

vision::StereoRig small_rig() {
  vision::StereoRig rig;
  rig.intrinsics = {96, 64, 80.0, 47.5, 31.5};
  return rig;
}

cv::Scalar colour_of(std::uint8_t byte) {
  const vision::PaletteColour& c = vision::kPalette[byte % vision::kPalette.size()];
  const double shade = 0.4 + 0.6 * (byte / 18) / 14.0;
  return {shade * c.b, shade * c.g, shade * c.r};
}

void expect_sound(const vision::MeasuredOutline& outline) {
  expect(outline.centre_px.allFinite() && outline.covariance_px2.allFinite(), "an outline is finite");
  expect(outline.radius_px > 0.0 && outline.radius_px < 1e6, "a radius is positive");
  expect(outline.hidden_fraction >= 0.0 && outline.outside_fraction >= 0.0, "shares are not negative");
}

/// Discs and strips of palette colours: five bytes each.
cv::Mat drawn(Bytes bytes, int shift_px) {
  cv::Mat picture(64, 96, CV_8UC3, cv::Scalar::all(140));
  for (std::size_t i = 0; i + 5 <= bytes.size() && i < 200; i += 5) {
    const int x = bytes[i] % 128 - 16 - (bytes[i + 3] % 32) * shift_px;
    const int y = bytes[i + 1] % 96 - 16;
    const int size = bytes[i + 2] % 48 + 1;
    if (bytes[i + 3] < 192)
      cv::circle(picture, {x, y}, size, colour_of(bytes[i + 4]), cv::FILLED, cv::LINE_AA);
    else
      cv::rectangle(picture, {x, y, size, bytes[i + 3] % 64 + 1}, colour_of(bytes[i + 4]), cv::FILLED);
  }
  return picture;
}

std::vector<std::string> scene_seeds() {
  return {std::string("\x30\x20\x0C\x08\x20", 5),
          std::string("\x20\x20\x0C\x08\x40\x50\x28\x0A\x05\x81\x60\x10\x14\xC8\x02", 15)};
}

/// A TGA file of 4 x 2 pixels, which OpenCV does not write.
std::string tga(char kind, char bits, char palette_colours, const std::string& pixels) {
  std::string file(18, '\0');
  file[1] = palette_colours > 0 ? 1 : 0;
  file[2] = kind;
  file[5] = palette_colours;
  file[7] = 24;
  file[12] = 4;
  file[14] = 2;
  file[16] = bits;
  return file += pixels;
}

/// Colours as they are, packed runs of them, and two of a palette.
std::vector<std::string> tga_seeds() {
  return {tga(2, 24, 0, "abcdefghijklmnopqrstuvwx"), tga(10, 24, 0, "\203abc\203def"),
          tga(1, 8, 2, std::string("abcdef\0\1\1\0\1\0\0\1", 14))};
}

std::vector<std::string> picture_seeds() {
  std::vector<std::string> seeds = tga_seeds();
  const cv::Mat picture = drawn(Bytes(reinterpret_cast<const std::uint8_t*>("\x30\x20\x0C\x08\x20"), 5), 0);
  cv::Mat small, grey;
  cv::resize(picture, small, {24, 16});
  cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
  for (const cv::Mat& shown : {picture, small, grey}) {
    for (const char* extension : {".png", ".jpg", ".bmp", ".pnm", ".tiff"}) {
      std::vector<std::uint8_t> bytes;
      cv::imencode(extension, shown, bytes);
      seeds.emplace_back(bytes.begin(), bytes.end());
    }
  }
  return seeds;
}

std::vector<std::string> calibration_seeds() {
  vision::StereoRig rig = small_rig();
  rig.distortion.k1 = -0.1;
  rig.right_turn_rad = {0.01, 0.02, -0.01};
  vision::CameraPair cameras = vision::cameras_of(rig);
  return {harness::calibration_yaml(rig), harness::calibration_yaml(small_rig(), cameras)};
}

std::vector<std::string> detection_seeds() {
  vision::BallObservation ball;
  ball.colour = 3;
  ball.left_px = {50.0, 30.0};
  ball.right_px = {40.0, 30.0};
  ball.range_bearing.range_m = 1.0;
  ball.range_bearing.covariance << 1e-4, 1e-6, 1e-6, 1e-4;
  return {harness::detections_line(0, std::array{ball, ball}),
          R"({"frame":0,"balls":[{"colour":null,"range_m":2.1,"bearing_rad":-0.2,"truncated":true}]})"};
}

std::vector<std::string> palette_seeds() {
  vision::LearnedColour red{"red", {0.9, 0.05}, 4e-4 * Eigen::Matrix2d::Identity(), 60.0, {10, 5, 220}};
  vision::LearnedColour blue = red;
  blue.name = "blue";
  blue.chromaticity = {0.1, 0.2};
  return {harness::palette_json({{red, blue}, worlds::Encoding::kSrgb})};
}

}  // namespace

void check_scene(Bytes bytes) {
  const vision::StereoRig rig = small_rig();
  const vision::StereoPair pair = {drawn(bytes, 0), drawn(bytes, 1)};
  const vision::ObserverSettings settings{.noise_sd_levels = bytes.empty() ? 0.0 : bytes[0] / 64.0};
  for (const vision::BallObservation& ball : vision::observe(pair, rig, settings)) {
    expect(ball.ball_in_camera.allFinite() && ball.ball_in_camera.z() > 0.0, "a ball is before the camera");
    expect(ball.range_bearing.covariance.allFinite(), "a covariance is finite");
  }
  std::vector<vision::LearnedColour> colours(1);
  colours[0] = {"any", {0.6, 0.3}, 4e-3 * Eigen::Matrix2d::Identity(), 40.0, {20, 90, 200}};
  static const vision::ColourTable table = vision::table_of(colours);
  for (const auto& outline : vision::find_outlines(pair.left, rig.intrinsics, {.learned = &table}))
    expect_sound(outline);
}

void check_picture(Bytes bytes) {
  const std::filesystem::path file = own_file("picture.png");
  std::ofstream(file, std::ios::binary) << text_of(bytes);
  read_or_complain([&] {
    const cv::Mat picture = harness::read_levels(file);
    const bool colour = picture.type() == CV_8UC3;
    expect((colour || picture.type() == CV_8UC1) && !picture.empty(), "a picture has shades or colours");
    if (!colour || picture.total() > 1U << 18) return;  // looked at for long, and nothing new
    const vision::Intrinsics camera{picture.cols, picture.rows, 80.0, 0.0, 0.0};
    for (const auto& outline : vision::find_outlines(picture, camera, {})) expect_sound(outline);
  });
  std::filesystem::remove(file);
}

void check_calibration(Bytes bytes) {
  read_or_complain([&] {
    const harness::RigCalibration read = harness::parse_calibration(text_of(bytes), "rig.yaml");
    expect(vision::is_usable(read.rig), "a rig can be computed with");
    const auto again = harness::parse_calibration(harness::calibration_yaml(read.rig, read.cameras), "again");
    expect(
        again.rig.baseline_m == read.rig.baseline_m && again.cameras.has_value() == read.cameras.has_value(),
        "a calibration is read as it is written");
    const vision::Intrinsics& camera = read.rig.intrinsics;
    if (camera.width_px <= 256 && camera.height_px <= 256)
      vision::Rectification(read.rig, read.cameras ? *read.cameras : vision::cameras_of(read.rig));
  });
}

void check_detections(Bytes bytes) {
  read_or_complain([&] {
    for (const auto& ball : harness::read_detections(text_of(bytes), 0, {.rig = small_rig()})) {
      expect(ball.range_bearing.covariance.allFinite(), "a covariance is finite");
      expect(std::isfinite(ball.range_bearing.range_m), "a range is finite");
    }
  });
}

void check_palette(Bytes bytes) {
  read_or_complain([&] {
    const harness::PaletteFile palette = harness::parse_palette(text_of(bytes), "palette.json");
    const std::string json = harness::palette_json(palette);
    expect(harness::palette_json(harness::parse_palette(json, "again")) == json, "read as it is written");
    for (const vision::LearnedColour& colour : palette.colours)
      expect(vision::deviations_from(colour, {0.5, 0.3}) >= 0.0, "deviations are numbers");
  });
}

std::span<const Entry> entries() {
  static constexpr std::array<Entry, 21> kEntries = {{{"scene", check_scene, scene_seeds},
                                                      {"picture", check_picture, picture_seeds},
                                                      {"calibration", check_calibration, calibration_seeds},
                                                      {"detections", check_detections, detection_seeds},
                                                      {"palette", check_palette, palette_seeds},
                                                      {"scenario", check_scenario, scenario_seeds},
                                                      {"log", check_log, log_seeds},
                                                      {"trajectory", check_trajectory, trajectory_seeds},
                                                      {"poses", check_poses, pose_seeds},
                                                      {"marks", check_marks, mark_seeds},
                                                      {"mesh", check_mesh, mesh_seeds},
                                                      {"result", check_result, result_seeds},
                                                      {"suite", check_suite, suite_seeds},
                                                      {"baseline", check_baseline, baseline_seeds},
                                                      {"bag", check_bag, bag_seeds},
                                                      {"mcap", check_mcap, mcap_seeds},
                                                      {"shards", check_shards, shard_seeds},
                                                      {"tiff", check_float_picture, float_picture_seeds},
                                                      {"drive", check_drive, drive_seeds},
                                                      {"manifest", check_manifest, manifest_seeds},
                                                      {"collection", check_collection, collection_seeds}}};
  return kEntries;
}

}  // namespace stereobench::fuzz
