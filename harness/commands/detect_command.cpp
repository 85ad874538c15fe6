#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <iostream>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/dataset/dataset_truth.h"
#include "harness/dataset/palette_file.h"
#include "harness/detector/detection_lines.h"
#include "harness/detector/detector.h"
#include "harness/detector/serve.h"
#include "harness/io/atomic_file.h"
#include "harness/io/calibration_file.h"
#include "harness/io/file_list.h"
#include "harness/io/picture_reader.h"
#include "harness/process/standard_streams.h"
#include "harness/report/detection_picture.h"
#include "renderer/camera/sensor_model.h"
#include "vision/observe.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

constexpr int kDrawnWidth_px = 1600;

struct DetectArguments {
  std::vector<fs::path> pictures;  ///< LEFT, LEFT RIGHT, or a folder
  fs::path rig;
  fs::path palette;  ///< of learned colours; empty: our own
  std::optional<double> ball_radius_m;
  std::optional<double> ball_radius_sd_m;
  std::optional<double> rows_within_px;
  double noise_sd_levels = 2.0;
  std::string encoding = "auto";
  fs::path out;   ///< empty: stdout
  fs::path draw;  ///< empty: nothing is drawn
  bool serve = false;
};

/// What is looked at together: a pair, or a picture alone.
struct DetectTask {
  std::size_t frame = 0;
  fs::path left;
  fs::path right;  ///< empty for a picture alone
};

std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> pictures;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && is_picture_name(entry.path())) pictures.push_back(entry.path());
  if (pictures.empty()) throw std::runtime_error(fmt::format("{}: holds no picture", folder.string()));
  std::sort(pictures.begin(), pictures.end());
  return pictures;
}

/// The number that a picture is named by, e.g. 12 of 000012.png; else its place in the folder.
std::size_t frame_of(const fs::path& picture, std::size_t place) {
  const std::string stem = picture.stem().string();
  std::size_t frame = 0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), frame);
  return error == std::errc() && end == stem.data() + stem.size() ? frame : place;
}

std::vector<DetectTask> tasks_of(const std::vector<fs::path>& given) {
  if (given.size() == 2) return {{0, given[0], given[1]}};
  if (!fs::is_directory(given[0])) return {{0, given[0], {}}};
  const bool pairs = fs::is_directory(given[0] / "left");
  std::vector<DetectTask> tasks;
  for (const fs::path& left : pictures_in(pairs ? given[0] / "left" : given[0]))
    tasks.push_back(
        {frame_of(left, tasks.size()), left, pairs ? given[0] / "right" / left.filename() : fs::path()});
  return tasks;
}

/// A camera for pictures that come without one: its focal length, of which only the slight eccentricity of
/// outlines depends, is the picture's width.
vision::Intrinsics camera_for(const cv::Mat& picture) {
  return {picture.cols, picture.rows, static_cast<double>(picture.cols), 0.5 * (picture.cols - 1),
          0.5 * (picture.rows - 1)};
}

void check_size(const fs::path& file, const cv::Mat& picture, const vision::Intrinsics& camera) {
  if (picture.cols != camera.width_px || picture.rows != camera.height_px)
    throw std::runtime_error(fmt::format("{}: {} x {} pixels, the rig's have {} x {}", file.string(),
                                         picture.cols, picture.rows, camera.width_px, camera.height_px));
}

/// Looks at pictures as the command line says.
class Looker {
 public:
  Looker(const DetectArguments& arguments, const fs::path& first_picture) : arguments_(arguments) {
    const fs::path& given = arguments.pictures[0];
    const fs::path beside = given / "calibration.yaml";
    const fs::path file = arguments.rig.empty() && fs::exists(beside) ? beside : arguments.rig;
    if (!file.empty()) {
      const RigCalibration calibration = read_rig_calibration(file);
      rig_ = calibration.rig;
      setup_.cameras = calibration.cameras;
    }
    read_ball_size(given);
    if (const auto told = read_rows_within_px(given)) setup_.rows_within_px = *told;
    setup_.noise_sd_levels = arguments.noise_sd_levels;
    if (arguments.palette.empty())
      setup_.encoding = encoding_of(arguments.encoding, std::array{first_picture});
    else
      learn(read_palette(arguments.palette));
    if (!rig_) return;
    take_rows_within();
    setup_.rig = *rig_;
    detector_ = our_detector(setup_);
  }

  worlds::Encoding encoding() const { return setup_.encoding; }

  /// @param task of the frame after that of the last call: what pairs tell of the rig is kept for the next
  /// @return the task's line; its picture is drawn where that is asked for
  std::string look(const DetectTask& task) const {
    return task.right.empty() ? look_at_one(task) : look_at_pair(task);
  }

 private:
  /// As the command line says, or the folder; of balls that nothing is known of, a tenth more or less.
  void read_ball_size(const fs::path& given) {
    constexpr double kUnknownTolerance = 0.1;
    if (!arguments_.ball_radius_m && fs::exists(given / "balls.csv")) {
      const worlds::World world = read_balls(given);
      setup_.ball_radius_m = world.ball_radius_m();
      setup_.ball_radius_sd_m = world.ball_radius_sd_m;
    } else {
      setup_.ball_radius_m = arguments_.ball_radius_m.value_or(setup_.ball_radius_m);
      setup_.ball_radius_sd_m = kUnknownTolerance * setup_.ball_radius_m;
    }
    if (!arguments_.ball_radius_sd_m) return;
    setup_.ball_radius_sd_m = *arguments_.ball_radius_sd_m;
    if (setup_.ball_radius_sd_m > setup_.ball_radius_m)
      throw std::runtime_error(fmt::format("--ball-radius-sd-m: expected at most the radius, {:g} (got {:g})",
                                           setup_.ball_radius_m, setup_.ball_radius_sd_m));
  }

  void take_rows_within() {
    if (!arguments_.rows_within_px) return;
    const double half_a_picture_px = 0.5 * rig_->intrinsics.height_px;
    setup_.rows_within_px = *arguments_.rows_within_px;
    if (setup_.rows_within_px > half_a_picture_px)
      throw std::runtime_error(
          fmt::format("--rows-within-px: expected at most half a picture, {:g} (got {:g})", half_a_picture_px,
                      setup_.rows_within_px));
  }

  void learn(const PaletteFile& palette) {
    setup_.palette = palette.colours;
    setup_.encoding = palette.encoding;
    table_ = vision::table_of(palette.colours, levels_of(palette.encoding));
    for (const vision::LearnedColour& colour : palette.colours) names_.push_back(colour.name);
  }

  std::string look_at_pair(const DetectTask& task) const {
    if (!rig_) throw std::runtime_error("--rig: two cameras need the calibration of their rig");
    const vision::StereoPair pair = {read_picture(task.left), read_picture(task.right)};
    check_size(task.left, pair.left, rig_->intrinsics);
    check_size(task.right, pair.right, rig_->intrinsics);
    const auto balls = detector_({task.frame, 0, pair, *rig_});
    if (balls.empty()) check_not_swapped(task, pair);
    if (!arguments_.draw.empty()) write_drawing(task, draw_detection_picture(pair, balls));
    const std::array<std::string, 2> names = {task.left.filename().string(), task.right.filename().string()};
    return detections_line(task.frame, balls, names, names_);
  }

  /// No ball that both cameras see is no error, unless the other way round there are some.
  void check_not_swapped(const DetectTask& task, const vision::StereoPair& pair) const {
    constexpr std::size_t kEnough = 2;  // one may match by chance
    const vision::StereoPair swapped = {pair.right, pair.left};
    const std::size_t balls = our_detector(setup_)({task.frame, 0, swapped, *rig_}).size();
    if (balls >= kEnough)
      throw std::runtime_error(
          fmt::format("{}: left and right are swapped: both cameras see no ball, and {} the other way round",
                      task.left.string(), balls));
  }

  std::string look_at_one(const DetectTask& task) const {
    const cv::Mat picture = read_picture(task.left);
    if (rig_) check_size(task.left, picture, rig_->intrinsics);
    const cv::Mat light = table_ ? picture : renderer::decode(picture, {.encoding = setup_.encoding});
    const auto outlines = vision::find_outlines(light, rig_ ? rig_->intrinsics : camera_for(picture),
                                                {.ball_radius_m = setup_.ball_radius_m,
                                                 .noise_sd_levels = setup_.noise_sd_levels,
                                                 .learned = table_ ? &*table_ : nullptr});
    if (!arguments_.draw.empty())
      write_drawing(task, draw_outline_picture(picture, outlines, kDrawnWidth_px, names_));
    return outlines_line(task.frame, outlines, task.left.filename().string(), names_);
  }

  void write_drawing(const DetectTask& task, const std::string& png) const {
    write_file_atomically(arguments_.draw / (task.left.stem().string() + ".png"), png);
  }

  const DetectArguments& arguments_;
  std::optional<vision::StereoRig> rig_;
  std::optional<vision::ColourTable> table_;  ///< of learned colours
  std::vector<std::string> names_;            ///< theirs
  DetectorSetup setup_;
  Detector detector_;  ///< where there is a rig
};

int serve() {
  std::ios::sync_with_stdio(false);
  serve_detections(std::cin, std::cout);
  return kPassed;
}

/// Where it is left to the pictures, and matters, how they are read.
void say_encoding(const DetectArguments& arguments, const Looker& looker, const fs::path& first_picture) {
  if (arguments.palette.empty() && arguments.encoding == "auto" &&
      looker.encoding() == worlds::Encoding::kSrgb)
    note(fmt::format("pictures are read as sRGB, as {} says it is (--encoding linear: as light)",
                     first_picture.string()));
}

int detect(const DetectArguments& arguments) {
  if (arguments.serve) return serve();
  if (arguments.pictures.empty())
    throw std::runtime_error("detect: expected LEFT, LEFT RIGHT or a folder; see --help");
  require_as_rendered(arguments.pictures.front());
  const std::vector<DetectTask> tasks = tasks_of(arguments.pictures);
  const fs::path& first_picture = tasks.front().left;
  const Looker looker(arguments, first_picture);
  if (!arguments.draw.empty()) prepare_output_folder(arguments.draw);
  std::string lines;
  for (const DetectTask& task : tasks) {
    const std::string line = looker.look(task) + "\n";
    if (&task == &tasks.front()) say_encoding(arguments, looker, first_picture);
    if (arguments.out.empty()) fmt::print("{}", line);
    lines += line;
  }
  if (!arguments.out.empty()) write_file_atomically(arguments.out, lines);
  return kPassed;
}

/// Options that say what is known of the rig and of the balls.
void add_what_is_known(CLI::App& command, DetectArguments& arguments) {
  command.add_option(
      "--rig", arguments.rig,
      "calibration.yaml as `render` and `calibrate-rig` write it (default: the folder's own, if it has one)");
  command
      .add_option("--ball-radius-m", arguments.ball_radius_m,
                  "that balls are made to (default: as the folder's data set says, or 0.05)")
      ->check(real_between(1e-6, 1e6));
  command
      .add_option("--ball-radius-sd-m", arguments.ball_radius_sd_m,
                  "how exactly they are (default: as the folder's data set says, or a tenth of the radius)")
      ->check(real_between(0.0, 1e6));
  command
      .add_option(
          "--rows-within-px", arguments.rows_within_px,
          "that the rig may be off by: balls are matched within so many rows, at most half a picture\n"
          "(default: as the folder's data set says, or 10)")
      ->check(real_between(0.1, 1e4));
}

}  // namespace

void add_detect_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("detect", "find balls in pictures from anywhere");
  auto arguments = std::make_shared<DetectArguments>();
  command
      ->add_option("pictures", arguments->pictures,
                   "LEFT and RIGHT, one picture alone, or a folder: of pictures, or with left/ and right/")
      ->expected(0, 2);
  add_what_is_known(*command, *arguments);
  command->add_option("--noise-sd-levels", arguments->noise_sd_levels, "of the pictures, in levels of 255")
      ->check(real_between(0.0, 255.0))
      ->capture_default_str();
  CLI::Option* encoding = command
                              ->add_option("--encoding", arguments->encoding,
                                           "how levels stand for light; auto: sRGB of JPEGs and of "
                                           "PNGs that say so, else linear")
                              ->check(CLI::IsMember({"auto", "linear", "srgb"}))
                              ->capture_default_str();
  command
      ->add_option("--palette", arguments->palette,
                   "colours to look for, as `learn-palette` writes them (default: those of our own balls)")
      ->excludes(encoding);
  command->add_option("--out,-o", arguments->out, "file for the lines (default: stdout)");
  command->add_option("--draw", arguments->draw, "folder for pictures with the detections drawn on them");
  command->add_flag("--serve", arguments->serve,
                    "be a detector's program: read the protocol's lines from stdin, answer on stdout");
  command->footer(
      "Writes a line of JSON a pair or picture (docs/guide/detectors.md): of pairs range and bearing with\n"
      "covariance, of single pictures centres, radii and colours.\n\n"
      "Example: stereobench detect left.png right.png --rig calibration.yaml --draw out/drawn");
  command->callback([arguments, &action] { action = [arguments] { return detect(*arguments); }; });
}

}  // namespace stereobench::harness
