#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/talk.h"
#include "harness/frame_replay/frame_replay.h"
#include "harness/frame_replay/frame_table.h"
#include "harness/frame_replay/replay_picture.h"
#include "harness/io/atomic_file.h"
#include "harness/io/picture_file.h"
#include "harness/vision_scoring/detection_table.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

struct ReplayArguments {
  fs::path result;
  std::vector<std::string> frames;  ///< "SEED:STEP"
  fs::path scenario;                ///< empty: where it was
  std::string detector;             ///< empty: that of the run
  bool with_before = false;
  fs::path out = "out/replay";
};

/// Whether the run's detector gave the same, in one line; empty where the run kept no detections.
std::string verdict_on(const ReplayedFrame& frame, const ReplayArguments& arguments) {
  const fs::path folder =
      fs::is_directory(arguments.result) ? arguments.result : arguments.result.parent_path();
  if (!fs::exists(folder / kDetections)) return "";
  if (rows_in_table(folder / kDetections, frame.name) == frame.rows) return "as in the run\n";
  const bool may_remember = arguments.detector.empty() && !arguments.with_before;
  return fmt::format("not as in the run{}\n",
                     may_remember ? ": the detector has changed, or has a memory (--with-before shows it all "
                                    "frames before)"
                                  : "");
}

void write_pictures(const ReplayedFrame& frame, const fs::path& out) {
  const std::string stem = file_stem(frame.name);
  write_file_atomically(out / (stem + ".png"), draw_replay_picture(frame));
  write_file_atomically(out / (stem + "_left.png"), encoded(".png", frame.pair.left));
  write_file_atomically(out / (stem + "_right.png"), encoded(".png", frame.pair.right));
}

int replay_command(const ReplayArguments& arguments) {
  std::vector<FrameName> names;
  for (const std::string& frame : arguments.frames) names.push_back(parse_frame_name(frame));
  const Invocation invocation = read_invocation(arguments.result, arguments.scenario);
  renderer::MeshCache meshes;
  Experiment experiment = experiment_of(invocation, meshes);
  if (!arguments.detector.empty()) experiment.detector.command = arguments.detector;
  const auto frames = replay_frames(experiment, names, invocation.backend, meshes, arguments.with_before);
  prepare_output_folder(arguments.out);
  for (const ReplayedFrame& frame : frames) {
    fmt::print("seed {} frame {}\n{}", frame.name.seed, frame.name.step, frame_table(frame));
    say(verdict_on(frame, arguments));
    write_pictures(frame, arguments.out);
    fmt::print("\n");
  }
  fmt::print("pictures: {}\n", (arguments.out / "").string());
  return kPassed;
}

}  // namespace

void add_replay_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand(
      "replay", "render frames of a finished run again, and show what the detector makes of them");
  auto arguments = std::make_shared<ReplayArguments>();
  command->add_option("result", arguments->result, "a folder that `run` wrote")->required();
  repeatable(command->add_option("--frame", arguments->frames, "which frame: seed and step; may be repeated"))
      ->required()
      ->type_name("SEED:STEP");
  command->add_option("--scenario", arguments->scenario,
                      "where the scenario lies now (default: where the run read it)");
  command
      ->add_option("--detector", arguments->detector,
                   "another detector than that of the run: a name, or a program's command")
      ->type_name("NAME|COMMAND");
  command->add_flag("--with-before", arguments->with_before,
                    "show the detector all frames before, too, for one that has a memory");
  command->add_option("--out,-o", arguments->out, "folder for the pictures")->capture_default_str();
  add_quiet_option(*command);
  command->footer(
      "Prints a line for each detection and for each ball that was missed, with its errors, and writes\n"
      "seed0_step0012.png, the pair with truth and detections drawn on it, and the pair as the camera "
      "stored\n"
      "it. The scenario must be the one that the run read; the detector may have changed since.\n\n"
      "Example: stereobench replay out/ball_circle --frame 0:12");
  command->callback([arguments, &action] { action = [arguments] { return replay_command(*arguments); }; });
}

}  // namespace stereobench::harness
