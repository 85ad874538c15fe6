#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "harness/commands/commands.h"
#include "harness/commands/talk.h"
#include "harness/io/atomic_file.h"
#include "harness/io/calibration_file.h"
#include "harness/io/picture_reader.h"
#include "harness/rig_calibration/calibration_report.h"
#include "harness/rig_calibration/calibration_warnings.h"
#include "harness/rig_calibration/rig_calibration.h"
#include "harness/rig_calibration/rig_picture.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

struct CalibrateRigArguments {
  fs::path folder;
  std::string corners = "9x6";
  BoardSettings settings;
  std::array<std::string, 2> patterns;
  std::string model = "two";
  std::vector<std::string> lens;
  std::string pixels = "compare";
  fs::path out = "out/rig";
};

Board read_board(const CalibrateRigArguments& arguments) {
  Board board = arguments.settings.board;
  int used = 0;
  const bool read =
      std::sscanf(arguments.corners.c_str(), "%3dx%3d%n", &board.columns, &board.rows, &used) == 2 &&
      static_cast<std::size_t>(used) == arguments.corners.size();
  if (!read || std::min(board.columns, board.rows) < 3)
    throw std::runtime_error(
        fmt::format("--corners: expected the inner corners across and down, from 3x3 on, e.g. 9x6 (got '{}')",
                    arguments.corners));
  return board;
}

FreeCoefficients read_lens(const std::vector<std::string>& names) {
  constexpr std::array<const char*, 5> kNames = {"k1", "k2", "p1", "p2", "k3"};
  FreeCoefficients free = {};
  for (const std::string& name : names) {
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    if (found == kNames.end() && name != "none")
      throw std::runtime_error(
          fmt::format("--lens: expected none, or some of k1,k2,p1,p2,k3 (got '{}')", name));
    if (found != kNames.end()) free[static_cast<std::size_t>(found - kNames.begin())] = true;
  }
  return free;
}

/// The view whose error is in the middle of all, as the one to look at.
const ViewOutcome& typical_view(const BoardCalibration& calibration) {
  std::vector<const ViewOutcome*> views;
  for (const ViewOutcome& view : calibration.outcomes)
    if (view.dropped.empty()) views.push_back(&view);
  const auto middle = views.begin() + static_cast<long>(views.size() / 2);
  std::nth_element(views.begin(), middle, views.end(),
                   [](const auto* a, const auto* b) { return a->row_rms_px < b->row_rms_px; });
  return **middle;
}

cv::Mat in_colour(const fs::path& file) {
  cv::Mat picture;
  cv::cvtColor(read_grey_picture(file), picture, cv::COLOR_GRAY2BGR);
  return picture;
}

std::string picture_of(const BoardCalibration& calibration, const std::vector<ViewFiles>& files) {
  const ViewOutcome& view = typical_view(calibration);
  const auto file =
      std::find_if(files.begin(), files.end(), [&](const ViewFiles& f) { return f.name == view.name; });
  return draw_rig_picture(calibration, view.index, {in_colour(file->left), in_colour(file->right)});
}

int calibrate(CalibrateRigArguments arguments) {
  BoardSettings& settings = arguments.settings;
  settings.board = read_board(arguments);
  settings.compared = {.aspect = arguments.pixels == "compare", .k3 = arguments.lens.empty()};
  settings.square_pixels = arguments.pixels != "free";
  if (!arguments.lens.empty()) settings.lens = read_lens(arguments.lens);
  settings.model = arguments.model == "one" ? RigModel::kOneCamera : RigModel::kTwoCameras;
  if (arguments.patterns[0].empty() != arguments.patterns[1].empty())
    throw std::runtime_error("--left, --right: expected both patterns, or none");
  const auto files = find_view_files(arguments.folder, arguments.patterns);
  const BoardCalibration calibration = calibrate_rig(files, settings);
  prepare_output_folder(arguments.out);
  write_file_atomically(arguments.out / "calibration.yaml",
                        calibration_yaml(calibration.rig.rig, calibration.rig.cameras));
  write_file_atomically(arguments.out / "calibration.json", calibration_json(calibration, settings));
  write_file_atomically(arguments.out / "rectified.png", picture_of(calibration, files));
  fmt::print("{}{}\n", calibration_text(calibration, settings),
             (arguments.out / "calibration.yaml").string());
  for (const std::string& warning : warnings_of(calibration, settings))
    fmt::print(stderr, "stereobench: warning: {}\n", warning);
  return kPassed;
}

}  // namespace

void add_calibrate_rig_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("calibrate-rig",
                                             "find a stereo rig's calibration from pictures of a chessboard");
  auto arguments = std::make_shared<CalibrateRigArguments>();
  command->add_option("folder", arguments->folder, "of pictures of the board, a pair a view")->required();
  command->add_option("--corners", arguments->corners, "inner corners across and down")
      ->capture_default_str();
  command->add_option("--square-m", arguments->settings.board.square_m, "side of a square, metres")
      ->required()
      ->check(real_between(1e-6, 1e3));
  command->add_option("--left", arguments->patterns[0],
                      "names of the left pictures, with a * for what a pair has in common, e.g. 'left*.jpg' "
                      "(default: left/* where there is such a folder, else left*)");
  command->add_option("--right", arguments->patterns[1], "the same of the right ones");
  command->add_option("--model", arguments->model, "two cameras, or one camera twice as a scenario's rig is")
      ->check(CLI::IsMember({"two", "one"}))
      ->capture_default_str();
  command
      ->add_option("--lens", arguments->lens,
                   "lens coefficients to estimate: of k1,k2,p1,p2,k3, or none (default: k1,k2,p1,p2, and k3 "
                   "where the views ask for it)")
      ->delimiter(',');
  command
      ->add_option(
          "--pixels", arguments->pixels,
          "square; free: two focal lengths a camera, across and down; or free where the views ask for it")
      ->check(CLI::IsMember({"compare", "square", "free"}))
      ->capture_default_str();
  command->add_option("--fewest-views", arguments->settings.fewest_views, "that are enough")
      ->check(CLI::Range(3, 10000))
      ->capture_default_str();
  command->add_option("--out,-o", arguments->out, "folder for the results")->capture_default_str();
  add_quiet_option(*command);
  command->footer(
      "Writes calibration.yaml (for detect --rig), calibration.json (every parameter with its standard\n"
      "deviation, every view with its errors) and rectified.png.\n\n"
      "Example: stereobench calibrate-rig pictures --corners 9x6 --square-m 0.025");
  command->callback([arguments, &action] { action = [arguments] { return calibrate(*arguments); }; });
}

}  // namespace stereobench::harness
