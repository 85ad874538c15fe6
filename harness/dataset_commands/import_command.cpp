#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/talk.h"
#include "harness/dataset_import/dataset_import.h"
#include "harness/process/progress.h"
#include "slam/math/angles.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

struct ImportArguments {
  fs::path folder;
  std::string format;
  ImportRequest request;
  std::optional<double> pitch_down_deg;
};

const DatasetReader& foreign_reader(const ImportArguments& arguments) {
  const DatasetReader& reader =
      arguments.format.empty() ? reader_of(arguments.folder) : dataset_reader(arguments.format);
  if (!reader.not_imported.empty())
    throw std::runtime_error(
        fmt::format("{}: the format {} {}", arguments.folder.string(), reader.format, reader.not_imported));
  return reader;
}

std::string rig_line(const ImportedDataset& done) {
  if (!done.calibration) return "no calibration of two cameras: `detect` needs --rig for pairs";
  const vision::StereoRig& rig = done.calibration->rig;
  const std::string spread =
      done.spread ? fmt::format("; pairs are off it by up to {:.3f} px and {:.3f} % of the baseline",
                                done.spread->px, 100.0 * done.spread->share)
                  : "";
  return fmt::format(
      "rig: {} x {} px, focal length {:.2f} px, baseline {:.4f} m, looking {:.2f} deg down{}{}",
      rig.intrinsics.width_px, rig.intrinsics.height_px, rig.intrinsics.focal_px, rig.baseline_m,
      rig.pitch_down_rad * slam::kDegreesPerRad,
      done.calibration->cameras ? "; two different cameras, which `detect` rectifies" : "", spread);
}

std::string odometry_text(const ImportedDataset& done, bool is_from_truth) {
  if (is_from_truth)
    return fmt::format("exact odometry from them, but for up to {:.3f} m sideways in a step",
                       done.log->most_sideways_m);
  if (done.recorded)
    return fmt::format("{} recorded odometry readings, {} sightings", done.recorded->odometry.size(),
                       done.recorded->sightings.size());
  if (!done.without_odometry.empty())
    return fmt::format("the recorded odometry is left out, {}: `slam` needs --odometry-from-truth",
                       done.without_odometry);
  return "no odometry, which the layout has not: `slam` needs --odometry-from-truth";
}

std::string log_line(const ImportedDataset& done, bool odometry_from_truth) {
  if (!done.log) return "no times, so that there is no log";
  long poses = 0;
  for (const LogStep& step : done.log->log.steps) poses += step.truth ? 1 : 0;
  const std::string truth =
      poses == 0 ? "no true poses"
                 : fmt::format("{} true poses{}, put on the floor from up to {:.3f} m and {:.2f} deg off it",
                               poses, done.log->world_is_kept ? "" : " from the first one on",
                               done.log->most_height_m, done.log->most_tilt_rad * slam::kDegreesPerRad);
  return fmt::format("{}; {}", truth, odometry_text(done, odometry_from_truth));
}

int import_folder(ImportArguments arguments) {
  ImportRequest& request = arguments.request;
  request.folder = arguments.folder;
  request.reader = &foreign_reader(arguments);
  if (arguments.pitch_down_deg) request.pitch_down_rad = *arguments.pitch_down_deg * slam::kRadPerDegree;
  const std::string name = fs::absolute(arguments.folder / "").parent_path().filename().string();
  ImportedDataset done;
  {
    Progress progress("import " + name, 1.0);
    done = import_dataset(request, [&](double share) { progress.show(share); });
  }
  say(fmt::format("{}: {}, {} {}{} in {}\n", name, done.format, done.frames,
                  done.are_pairs ? "pairs" : "left pictures",
                  done.left_out > 0 ? fmt::format(" ({} frames left out)", done.left_out) : "",
                  (request.out / "").string()));
  say(fmt::format("{}\n{}\n", rig_line(done), log_line(done, request.odometry_from_truth)));
  if (done.are_grey) say("warning: the pictures have no colour, by which `detect` finds balls\n");
  return kPassed;
}

}  // namespace

void add_import_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("import", "turn a data set of any layout into what `detect` and `slam` read");
  auto arguments = std::make_shared<ImportArguments>();
  command
      ->add_option("dataset", arguments->folder,
                   "folder of a data set of KITTI, EuRoC, TUM, ROS, COLMAP, ...")
      ->required();
  command->add_option("-o,--out", arguments->request.out, "folder for the result; a new one")->required();
  command->add_option("--as", arguments->format, "its format, where the folder does not tell")
      ->type_name("NAME");
  command->add_option("--only", arguments->request.only, "import this sequence, scene or frame alone")
      ->type_name("NAME");
  command
      ->add_option("--pitch-down-deg", arguments->pitch_down_deg,
                   "how far the cameras look down (default: as the layout says, or level)")
      ->check(real_between(-89.0, 89.0));
  command->add_flag("--odometry-from-truth", arguments->request.odometry_from_truth,
                    "make odometry of the true poses; it is exact");
  command
      ->add_option("--epoch-s", arguments->request.epoch_s,
                   "the time of the data set that becomes 0; 1500000000 for those of `render`")
      ->type_name("SECONDS")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{4'000'000'000}));
  add_quiet_option(*command);
  command->footer(
      "Pictures are linked, or copied where the file system has no links, and never decoded; those of bags\n"
      "and MCAP become PNG. Frames without a partner are left out. Of COLMAP, BOP and Nerfstudio the rig is\n"
      "where the poses of both pictures have it; folders called left and right tell which are a pair. True\n"
      "poses are put on the floor. Balls' sizes and colours, which no layout has, are options of\n"
      "`detect`.\n\n"
      "Example: stereobench import MH_01_easy --out out/mh_01");
  command->callback([arguments, &action] { action = [arguments] { return import_folder(*arguments); }; });
}

}  // namespace stereobench::harness
