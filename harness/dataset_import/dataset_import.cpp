#include "harness/dataset_import/dataset_import.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "harness/dataset/formats/plain_format.h"
#include "harness/dataset_import/imported_frames.h"
#include "harness/dataset_import/imported_rig.h"
#include "harness/dataset_import/recorded_odometry.h"
#include "harness/frames/linked_files.h"
#include "harness/io/atomic_file.h"
#include "harness/io/file_list.h"
#include "harness/io/picture_file.h"
#include "harness/logs/measurement_log_writer.h"
#include "harness/verify/verify_dataset.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using vision::Side;

/// Frames that have not all of their files are left out; all else that is wrong ends the import.
void require_sound(const DatasetView& view) {
  for (const Fault& fault : view.faults)
    if (!is_missing_frame(fault))
      throw std::runtime_error(fmt::format("{}: {}", view.folder.string(), line_of(fault)));
}

void require_new(const fs::path& out) {
  if (fs::exists(out) && !(fs::is_directory(out) && fs::is_empty(out)))
    throw std::runtime_error(
        fmt::format("{}: is there already; `import` writes into a new folder", out.string()));
}

/// The sides whose pictures are imported.
std::vector<Side> sides_of(const ImportedFrames& imported) {
  return imported.are_pairs ? std::vector{Side::kLeft, Side::kRight} : std::vector{Side::kLeft};
}

/// Both cameras of the frames, with the size of their pictures, which some layouts state and others not.
/// @param are_grey is set where a picture has no colour
std::array<ViewCamera, 2> sized_cameras(const DatasetView& view, const ImportedFrames& imported,
                                        bool& are_grey) {
  const ViewFrame& first = imported.frames.front();
  std::array<ViewCamera, 2> cameras = first.cameras;
  cv::Size size;
  for (const Side side : sides_of(imported)) {
    const ChannelFile& file = *find_channel(first, side, Channel::kPicture);
    const cv::Mat picture = file.read();
    are_grey = are_grey || picture.channels() == 1;
    vision::Intrinsics& pinhole = cameras[index_of(side)].pinhole;
    const cv::Size stated(pinhole.width_px, pinhole.height_px);
    if (!view.has_calibration || stated == cv::Size(0, 0))
      pinhole.width_px = picture.cols, pinhole.height_px = picture.rows;
    else if (stated != picture.size())
      throw std::runtime_error(fmt::format("{}: {} x {} pixels, and {} x {} by {}",
                                           (view.folder / file.file).string(), picture.cols, picture.rows,
                                           stated.width, stated.height, view.calibration_file));
    if (size != cv::Size() && size != picture.size())
      throw std::runtime_error(fmt::format("{}: {} x {} pixels, the left picture has {} x {}",
                                           (view.folder / file.file).string(), picture.cols, picture.rows,
                                           size.width, size.height));
    size = picture.size();
  }
  if (!imported.are_pairs)
    cameras[1].pinhole.width_px = size.width, cameras[1].pinhole.height_px = size.height;
  return cameras;
}

/// The rig; empty where the data set has no calibration, or one camera alone and no place of another.
std::optional<RigCalibration> calibration_of(const DatasetView& view, const ImportedFrames& imported,
                                             const std::array<ViewCamera, 2>& cameras) {
  const bool is_one_place =
      cameras[0].body_from_camera.translation() == cameras[1].body_from_camera.translation();
  if (!view.has_calibration || (!imported.are_pairs && is_one_place)) return std::nullopt;
  if (const auto& robot = imported.frames.front().robot)
    return RigCalibration{.rig = robot->rig, .cameras = {}};
  try {
    return imported_rig(cameras);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(
        fmt::format("{}: {}: {}", view.folder.string(), view.calibration_file, error.what()));
  }
}

/// The times and poses of the frames, as seen from the robot that carries the rig.
std::optional<ImportedLog> log_of(const ImportRequest& request, const ImportedFrames& imported,
                                  const std::optional<RigCalibration>& calibration, const ViewCamera& left) {
  if (!imported.have_times) return std::nullopt;
  const RigCalibration one_camera = {.rig = {.baseline_m = 0.0, .height_m = 0.0}, .cameras = {}};
  const bool is_on_robot = imported.frames.front().robot.has_value();
  ImportedLog log =
      imported_log(imported.frames, is_on_robot ? Eigen::Isometry3d::Identity()
                                                : body_from_robot(calibration.value_or(one_camera), left));
  if (request.odometry_from_truth) add_odometry_from_truth(log);
  return log;
}

/// The recorded streams, where a log has a place for them. @param done is told why not
std::optional<RecordedStreams> recorded_of(const ImportRequest& request, const ImportedFrames& imported,
                                           ImportedDataset& done, const ViewCamera& left) {
  if (request.reader->read_log == nullptr || request.odometry_from_truth) return std::nullopt;
  RecordedStreams streams = request.reader->read_log(request.folder);
  if (streams.odometry.empty()) return std::nullopt;
  done.without_odometry = why_without(
      streams, done.calibration ? body_from_robot(*done.calibration, left) : Eigen::Isometry3d::Identity());
  if (!done.without_odometry.empty()) return std::nullopt;
  complete_streams(imported.frames, done.log->log, streams);
  return streams;
}

/// Pictures are numbered by the steps of the log that they are of.
void number_by_steps(const RecordedStreams& streams, ImportedFrames& imported) {
  const std::vector<std::int64_t>& instants_ns = streams.instants_ns.value();
  for (std::size_t i = 0; i < imported.frames.size(); ++i)
    imported.numbers[i] = static_cast<std::size_t>(
        std::ranges::lower_bound(instants_ns, *imported.frames[i].stamp_ns[0]) - instants_ns.begin());
}

/// Whether a picture has a file of its own, and is not in a container.
bool has_file(const DatasetView& view, const ChannelFile& picture) {
  return fs::is_regular_file(view.folder / picture.file);
}

/// Whether a picture is stored as a file's bytes; else as levels.
bool is_encoded(const DatasetView& view, const ChannelFile& picture) {
  return picture.bytes || has_file(view, picture);
}

std::string picture_name(const DatasetView& view, const ImportedFrames& imported, std::size_t i, Side side) {
  const ChannelFile& file = *find_channel(imported.frames[i], side, Channel::kPicture);
  return fmt::format("{:06}{}", imported.numbers[i],
                     is_encoded(view, file) ? fs::path(file.file).extension().string() : ".png");
}

std::string pictures_csv(const ImportedFrames& imported, std::int64_t epoch_ns) {
  std::string csv = "frame,t_s,left,right\n";
  for (std::size_t i = 0; i < imported.frames.size(); ++i) {
    const ViewFrame& frame = imported.frames[i];
    const auto file = [&](Side side) { return find_channel(frame, side, Channel::kPicture)->file; };
    csv += fmt::format("{},{},{},{}\n", imported.numbers[i],
                       frame.stamp_ns[0] ? seconds_of(*frame.stamp_ns[0] - epoch_ns) : "", file(Side::kLeft),
                       imported.are_pairs ? file(Side::kRight) : "");
  }
  return csv;
}

void write_pictures(const ImportRequest& request, const DatasetView& view, const ImportedFrames& imported,
                    const std::function<void(double)>& on_progress) {
  for (const Side side : sides_of(imported)) prepare_output_folder(request.out / picture_folder(side));
  LinkedFiles files;
  AtomicFiles unpacked;
  for (std::size_t i = 0; i < imported.frames.size(); ++i) {
    for (const Side side : sides_of(imported)) {
      const ChannelFile& file = *find_channel(imported.frames[i], side, Channel::kPicture);
      const fs::path to = request.out / picture_folder(side) / picture_name(view, imported, i, side);
      if (has_file(view, file))
        files.place(view.folder / file.file, to);
      else
        unpacked.write(to, file.bytes ? file.bytes() : encoded(".png", file.read()));
    }
    on_progress(static_cast<double>(i + 1) / static_cast<double>(imported.frames.size()));
  }
  files.move_into_place();
  unpacked.move_into_place();
}

/// The tables of the folder, the calibration last. Their times are since the epoch.
std::vector<LogFile> tables_of(const ImportRequest& request, const ImportedFrames& imported,
                               const ImportedDataset& done) {
  const std::int64_t epoch_ns = request.epoch_s * kSecond_ns;
  std::vector<LogFile> tables;
  if (done.recorded)
    tables = log_files(since(epoch_ns, *done.recorded));
  else if (done.log && request.odometry_from_truth)
    tables = log_files(since(epoch_ns, done.log->log));
  else if (done.log)
    tables = time_files(since(epoch_ns, done.log->log));
  tables.push_back({kPicturesFile, pictures_csv(imported, epoch_ns)});
  if (done.calibration)
    tables.push_back({kCalibrationFile, calibration_yaml(done.calibration->rig, done.calibration->cameras)});
  return tables;
}

}  // namespace

ImportedDataset import_dataset(const ImportRequest& request, const std::function<void(double)>& on_progress) {
  require_new(request.out);
  const DatasetView view = request.reader->read(request.folder);
  require_sound(view);
  ImportedFrames frames = frames_to_import(view, request.only);
  if (request.odometry_from_truth) keep_frames_with_poses(view, frames);
  const std::optional<PairSpread> spread = put_on_one_body(view, frames);
  ImportedDataset done = {.format = view.format, .frames = frames.frames.size(), .left_out = frames.left_out};
  done.are_pairs = frames.are_pairs;
  done.spread = spread;
  const std::array<ViewCamera, 2> cameras = sized_cameras(view, frames, done.are_grey);
  done.calibration = calibration_of(view, frames, cameras);
  if (request.pitch_down_rad) {
    if (!done.calibration)
      throw std::runtime_error(fmt::format("{}: --pitch-down-deg: there is no rig (format {})",
                                           view.folder.string(), view.format));
    done.calibration->rig.pitch_down_rad = *request.pitch_down_rad;
  }
  done.log = log_of(request, frames, done.calibration, cameras[0]);
  done.recorded = recorded_of(request, frames, done, cameras[0]);
  if (done.recorded) number_by_steps(*done.recorded, frames);
  const std::vector<LogFile> tables = tables_of(request, frames, done);
  write_pictures(request, view, frames, on_progress);
  for (const LogFile& table : tables) write_file_atomically(request.out / table.name, table.text);
  return done;
}

}  // namespace stereobench::harness
