#include "harness/dataset/dataset_export.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/dataset/drive_json.h"
#include "harness/dataset/pictures/changed_pair.h"
#include "harness/dataset/plain_dataset.h"
#include "harness/io/file_list.h"
#include "harness/io/text_file.h"
#include "harness/json/json_line.h"

namespace stereobench::harness {
namespace {

/// What dataset.json says of the whole set.
struct Marker {
  nlohmann::ordered_json identity;  ///< of all formats
  CoarseBlur blur;
};

CoarseBlur blur_of(const JsonValue& json) {
  constexpr double kMost = 1e9;
  return {static_cast<long>(json.at("coarse_pairs").integer(0, std::int64_t{1} << 40)),
          json.at("most_step_px").number(0.0, kMost)};
}

/// @throws std::runtime_error where a file is not as it was rendered
Marker read_marker_of(const std::filesystem::path& folder) {
  const std::vector<std::string> changed = changed_files(folder, read_manifest(folder));
  if (!changed.empty())
    throw std::runtime_error(
        fmt::format("{}: {} files are missing or not as they were rendered (the first: {}); "
                    "render it again",
                    folder.string(), changed.size(), changed.front()));
  const std::filesystem::path file = folder / kDatasetJson;
  const std::string text = read_text(file);
  try {
    const nlohmann::json json = parse_line(text);
    const JsonValue whole(json, "");
    Marker marker = {.identity = nlohmann::ordered_json::parse(text), .blur = blur_of(whole.at(kBlur))};
    for (const char* outcome : {kFrames, kBlur}) marker.identity.erase(outcome);
    if (whole.at("stereobench").text() != STEREOBENCH_VERSION)
      marker.identity["exported_by"] = STEREOBENCH_VERSION;
    return marker;
  } catch (const BadLine& bad) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), bad.what()));
  }
}

/// Truth that is written in the format plain, and not read from it.
void require_readable_truth(const PlainDataset& plain) {
  for (const TruthKind kind : plain.drive.truth.kinds) {
    const bool is_read =
        kind == TruthKind::kBalls || kind == TruthKind::kDisparity || kind == TruthKind::kFlow;
    if (!is_read)
      throw std::runtime_error(
          fmt::format("{}: has {}, which is not read from data sets; render it so instead",
                      plain.folder.string(), name_of(kind)));
    require_exact_truth(plain, kind);
  }
}

/// A file of disparities has no rows: of a rig whose points are not in the same row of both pictures, it does
/// not tell which ones a cut leaves in the other picture.
void require_rows(const PlainDataset& plain) {
  const vision::StereoRig& rig = plain.drive.rig;
  const bool are_same = rig.distortion == vision::Distortion{} && rig.right_turn_rad.isZero(0.0) &&
                        plain.drive.shutter.right_delay_s == 0.0;
  if (!are_same && std::ranges::count(plain.drive.truth.kinds, TruthKind::kDisparity) > 0)
    throw std::runtime_error(
        fmt::format("--crop: {} has disparity of a rig that is not rectified, which does not say in which "
                    "rows points are "
                    "in the other picture; render it with --crop instead",
                    plain.folder.string()));
}

/// @throws std::runtime_error, one line, where a set cannot be changed so
void check_change(const PlainDataset& plain, const nlohmann::ordered_json& identity,
                  const PictureChange& change) {
  if (!change.changes_anything()) return;
  if (identity.contains(kPictures))
    throw std::runtime_error(fmt::format(
        "{}: its pictures were changed when they were written ({}); export them from the set with "
        "all of them as the camera took them, or leave the options out",
        plain.folder.string(), identity[kPictures].dump()));
  if (change.kind == PictureKind::kLinear16)
    throw std::runtime_error(
        fmt::format("{}: has levels of 8 bits, and linear16 needs more; render it with --picture linear16",
                    plain.folder.string()));
  if (change.crop) require_rows(plain);
}

/// What is known of a set of one format.
nlohmann::ordered_json identity_in(const DatasetFormat& format, nlohmann::ordered_json whole,
                                   const PictureChange& change) {
  const nlohmann::ordered_json plain = whole;
  for (const char* of_plain : {"truth", "truth_format"}) whole.erase(of_plain);
  if (change.changes_anything()) whole[kPictures] = change_json(change);
  if (!is_plain(format)) {
    whole["format"] = format.name;
    return whole;
  }
  for (const char* of_plain : {"truth", "truth_format"})
    if (plain.contains(of_plain)) whole[of_plain] = plain[of_plain];
  return whole;
}

void check_formats(const std::vector<const DatasetFormat*>& formats, const PlainDataset& plain,
                   const DatasetDrive& drive) {
  for (const DatasetFormat* format : formats) {
    check_format(*format, drive);
    for (const TruthKind kind : needed_truth(*format)) require_exact_truth(plain, kind);
    if (is_plain(*format)) require_readable_truth(plain);
  }
}

/// The log of the pairs that are left: at the others, nobody looked.
MeasurementLog log_of(const DatasetDrive& drive, MeasurementLog log) {
  for (std::size_t step = 0; step < drive.steps.size(); ++step)
    if (!drive.steps[step].pictures) log.steps[step].measurements.clear();
  return log;
}

}  // namespace

std::vector<WrittenDataset> export_dataset(const std::filesystem::path& dataset,
                                           const std::vector<const DatasetFormat*>& formats,
                                           const std::filesystem::path& out, const PictureChange& change,
                                           const std::function<void(double)>& on_progress) {
  const PlainDataset plain = read_plain_dataset(dataset);
  const Marker marker = read_marker_of(dataset);
  check_change(plain, marker.identity, change);
  const DatasetDrive drive = changed(plain.drive, change);
  check_formats(formats, plain, drive);
  nlohmann::ordered_json identity = marker.identity;
  identity[kDrive] = drive_json(drive);
  std::vector<WantedDataset> wanted;
  for (const DatasetFormat* format : formats)
    wanted.push_back({format, folder_of(out, *format, formats), identity_in(*format, identity, change)});
  require_room(wanted, out);
  std::vector<DatasetOutput> outputs;
  for (const WantedDataset& one : wanted) outputs.emplace_back(one, drive);
  for (std::size_t step = 0; step < drive.steps.size(); ++step) {
    on_progress(static_cast<double>(step) / static_cast<double>(drive.steps.size()));
    if (!drive.steps[step].pictures) continue;
    PlainPair whole(plain, step);
    ChangedPair pair(whole, drive, change);
    for (DatasetOutput& output : outputs) output.write(pair);
  }
  const MeasurementLog log = log_of(drive, plain.log);
  std::vector<WrittenDataset> written;
  for (DatasetOutput& output : outputs) {
    output.finish(log, marker.blur);
    written.push_back(output.written());
  }
  return written;
}

}  // namespace stereobench::harness
