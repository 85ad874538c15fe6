/// What a data-set format is: which files there are of a stereo pair and of a drive, and what is in them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "harness/dataset/frame_truth.h"
#include "harness/dataset/truth_request.h"
#include "harness/drive/frame_choice.h"
#include "harness/drive/recording.h"
#include "worlds/types.h"

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

/// A file that is a text.
DatasetFile text_file(std::string name, std::string text);

/// The drive that a data set is of: one seed's.
struct DatasetDrive {
  const worlds::Scenario& scenario;
  const worlds::World& world;  ///< of the seed
  std::uint64_t seed = 0;
  FrameChoice frames;  ///< that are asked for; the shutter may drop some
  TruthRequest truth;  ///< what was asked for beside them
};

/// A data-set format at work on one drive. It names files and says what is in them. The data set that it is
/// a format of (rendered_dataset.h) makes folders, writes files whole or not at all, leaves those alone that
/// are there, and keeps the list of all files in dataset.json.
class DatasetWriter {
 public:
  virtual ~DatasetWriter() = default;

  /// The files of one stereo pair; each pair of the drive is asked for once, in order, also where a rendering
  /// that was interrupted goes on.
  /// @param event, truth of this pair; their values may be asked for until the next pair comes
  virtual std::vector<DatasetFile> frame_files(const FrameEvent& event, FrameTruth& truth) const = 0;

  /// The files of the whole drive, asked for after its last pair. They are always written anew.
  /// @param log the odometry, what was observed, and the true path: every step of the drive. Which of them
  /// have
  ///        pictures, and from where these are taken, says pictures_of (frames_file.h)
  virtual std::vector<DatasetFile> drive_files(const MeasurementLog& log) const = 0;
};

}  // namespace stereobench::harness
