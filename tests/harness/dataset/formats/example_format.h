// A small data-set format, as docs/guide/developing.md shows it: TUM's layout of pictures and a trajectory.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "harness/dataset/formats/format_registry.h"
#include "harness/logs/measurement_log_writer.h"

namespace stereobench::harness {

// left/TIME.png and right/TIME.png, named by their time in seconds, and groundtruth.txt.
class ExampleWriter final : public DatasetWriter {
 public:
  std::vector<DatasetFile> frame_files(const FrameEvent& event, FrameTruth&) const override {
    const std::string time = seconds_of(event.stamp_ns);
    return {picture_file("left/" + time + ".png", event.pair.left),
            picture_file("right/" + time + ".png", event.pair.right)};
  }

  std::vector<DatasetFile> drive_files(const MeasurementLog& log) const override {
    std::string text = "# timestamp tx ty tz qx qy qz qw\n";
    for (const LogStep& step : log.steps) {
      const double half = 0.5 * step.truth->heading_rad;
      text += fmt::format("{} {} {} 0 0 0 {} {}\n", seconds_of(step.stamp_ns), step.truth->x_m,
                          step.truth->y_m, std::sin(half), std::cos(half));
    }
    return {text_file("groundtruth.txt", text)};
  }
};

inline constexpr DatasetFormat kExampleFormat = {
    "example", "a trajectory", [](const worlds::Scenario&, const TruthRequest&) {},
    [](const DatasetDrive&) -> std::unique_ptr<DatasetWriter> { return std::make_unique<ExampleWriter>(); }};

}  // namespace stereobench::harness
