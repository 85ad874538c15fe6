// A small data-set format, as docs/guide/contributing.md shows it: pictures by their time, and the robot's
// poses as in TUM's files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "harness/dataset/formats/format_registry.h"
#include "harness/logs/measurement_log_writer.h"
#include "slam/math/elementary.h"

namespace stereobench::harness {

// left/TIME.png and right/TIME.png, named by their time in seconds, and groundtruth.txt.
class ExampleWriter final : public DatasetWriter {
 public:
  explicit ExampleWriter(const DatasetDrive& drive) : drive_(drive) {}

  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override {
    const std::string time = seconds_of(drive_.steps[pair.step()].stamp_ns);
    return {camera_file("left/" + time + ".png", pair, vision::Side::kLeft),
            camera_file("right/" + time + ".png", pair, vision::Side::kRight)};
  }

  std::vector<DatasetFile> drive_files(const MeasurementLog& log) const override {
    std::string text = "# timestamp tx ty tz qx qy qz qw\n";
    for (const LogStep& step : log.steps) {
      const slam::SineCosine half =
          slam::sine_cosine(0.5 * step.truth->heading_rad);  // all rendered steps have it
      text += fmt::format("{} {} {} 0 0 0 {} {}\n", seconds_of(step.stamp_ns), step.truth->x_m,
                          step.truth->y_m, half.sine, half.cosine);
    }
    return {text_file("groundtruth.txt", text)};
  }

 private:
  const DatasetDrive& drive_;
};

inline constexpr DatasetFormat kExampleFormat = {
    "example", "a trajectory", "", [](const DatasetDrive&) {},
    [](const DatasetDrive& drive) -> std::unique_ptr<DatasetWriter> {
      return std::make_unique<ExampleWriter>(drive);
    }};

}  // namespace stereobench::harness
