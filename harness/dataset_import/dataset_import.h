/// Data sets of any layout, whoever made them, as folders that `detect` and `slam` read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "harness/dataset_import/imported_log.h"
#include "harness/dataset_import/posed_pairs.h"
#include "harness/io/calibration_file.h"
#include "harness/verify/readers/reader_registry.h"

namespace stereobench::harness {

struct ImportRequest {
  std::filesystem::path folder;
  const DatasetReader* reader = nullptr;
  std::string only;  ///< a sequence, a scene or a frame; empty: all
  std::optional<double> pitch_down_rad;
  bool odometry_from_truth = false;
  std::int64_t epoch_s = 0;  ///< the time of the layout that is 0 in what is written
  std::filesystem::path out;
};

/// What was imported.
struct ImportedDataset {
  std::string format;
  std::size_t frames = 0, left_out = 0;
  bool are_pairs = false;
  bool are_grey = false;
  std::optional<RigCalibration> calibration;
  std::optional<PairSpread> spread;         ///< where the rig is by poses of pairs
  std::optional<ImportedLog> log;           ///< where the layout has times
  std::optional<RecordedStreams> recorded;  ///< where it has odometry that a log has a place for
  std::string without_odometry;             ///< why it is left out, where the layout has some
};

/// Writes a folder with
///
///     left/000000.png, right/    the pictures: hard links to those of the data set, or copies; those of a
///                                container as PNG
///     pictures.csv               frame,t_s,left,right: of each frame its time, and where its pictures are from
///     calibration.yaml           the rig (calibration_file.h), where the layout has one; it comes last
///     instants.csv, groundtruth.csv    times and true poses, where the layout has them
///     odometry.csv, observations.csv, landmarks.csv    as recorded, or with odometry_from_truth; the latter
///                                two may be empty
///
/// @throws std::runtime_error, one line, for what cannot be read or has no place in such a folder, before
///   anything is written, and for a folder that is not empty
ImportedDataset import_dataset(const ImportRequest& request, const std::function<void(double)>& on_progress);

}  // namespace stereobench::harness
