/// What a data-set format is: which files there are of a stereo pair and of a drive, and what is in them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "harness/dataset/dataset_drive.h"
#include "harness/dataset/dataset_pair.h"
#include "harness/io/atomic_file.h"
#include "harness/types.h"

namespace stereobench::harness {

/// A file of a data set.
struct DatasetFile {
  std::string name;                    ///< its place in the folder: "left/000012.png"
  std::function<std::string()> bytes;  ///< all of it; called only where the file is to be written
};

/// A file that is a picture. Its name says the format, as of `encoded` (harness/io/picture_file.h).
/// @param picture is worked out only where the file is to be written
DatasetFile picture_file(std::string name, std::function<cv::Mat()> picture);
DatasetFile picture_file(std::string name, const cv::Mat& picture);

/// A file that is what a camera stored. @param name ends with ".png"
DatasetFile camera_file(std::string name, DatasetPair& pair, vision::Side side);

/// A file that is a text.
DatasetFile text_file(std::string name, std::string text);

/// Parts of containers: files of a stereo pair whose place begins with this folder. They are in no list, and
/// are removed when the data set is finished.
inline constexpr std::string_view kPartsFolder = "dataset.parts";

/// A file that holds the whole drive, as a recording or an archive does. It is put together of parts when all
/// of them are there: a rendering that is interrupted goes on part by part.
struct DatasetContainer {
  std::string name;  ///< its place in the folder
  /// Appends all of it, with a few pairs in memory at a time.
  /// @param folder of the data set, where the parts lie at the places that frame_files gave them
  std::function<void(AtomicFile& file, const std::filesystem::path& folder)> write;
};

/// A data-set format at work on one drive. It names files and says what is in them. The data set that it is
/// a format of (rendered_dataset.h) makes folders, writes files whole or not at all, leaves those alone that
/// are there, and lists all files in the manifest.
class DatasetWriter {
 public:
  virtual ~DatasetWriter() = default;

  /// The files of one stereo pair; each pair of the drive is asked for once, in order, also where a rendering
  /// that was interrupted goes on.
  /// @param pair its values may be asked for until the next pair comes
  virtual std::vector<DatasetFile> frame_files(DatasetPair& pair) const = 0;

  /// The files of the whole drive, asked for after its last pair. They are always written anew.
  /// @param log the odometry, what was observed, and the true path: every step of the drive
  virtual std::vector<DatasetFile> drive_files(const MeasurementLog& log) const = 0;

  /// The containers of the whole drive, asked for after its last pair. They are always written anew.
  /// @param log as of drive_files; it outlives the containers
  virtual std::vector<DatasetContainer> containers(const MeasurementLog& log) const;
};

}  // namespace stereobench::harness
