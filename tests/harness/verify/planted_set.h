// Data sets of all formats, rendered once for all tests, and copies of them in which a fault is planted as
// whoever writes such a format makes it: in the text or the pictures, not in values of ours.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "harness/verify/verify_dataset.h"
#include "tests/test_folder.h"

namespace stereobench::harness {

/// The scenario of most tests, and what is rendered of it.
inline const std::string kBend = STEREOBENCH_SOURCE_DIR "/tests/harness/verify/bend.yaml";
inline const std::vector<std::string> kBendFrames = {"--frames", "2..7", "--truth", "balls,disparity,flow"};

inline const std::vector<std::string> kSceneFrames = {"--frames", "2..7"};

/// The folder that has a data set in each of some formats.
/// @param scenario its file
/// @param arguments of `render` behind the scenario
std::filesystem::path rendered(const std::string& scenario, const std::string& formats,
                               const std::vector<std::string>& arguments = {});

/// All that `render --format` knows.
inline const std::string kAllFormats =
    "plain,kitti-odometry,kitti-stereo,kitti-stereo-2012,kitti-scene-flow,euroc,tum,middlebury,eth3d,"
    "sceneflow,"
    "vslamlab";

/// The formats of scenes; rendered apart, since they take other drives than the others.
inline const std::string kSceneFormats = "colmap,coco,bop,nerfstudio";

/// Archives and logs: rendered apart, and each by itself, since they take any drive.
inline const std::string kShardsAndLogs = "webdataset,mrclam";
inline const std::vector<std::string> kLogFrames = {"--set", "identity=known"};

/// The data set that copies of a format are made from.
std::filesystem::path whole_set(const std::string& format);

/// All faults of a folder, a line each.
std::string faults_of(const std::filesystem::path& folder, const std::string& format);

/// A copy of a data set of the bend, without dataset.json and manifest: as if somebody else had written it.
class PlantedSet {
 public:
  explicit PlantedSet(const std::string& format);

  const std::string& format() const { return format_; }
  std::string faults() const { return faults_of(folder_.path() / format_, format_); }
  std::filesystem::path path(const std::string& name) const { return folder_.path() / format_ / name; }
  std::string text(const std::string& name) const { return folder_.read(format_ + "/" + name); }
  void write(const std::string& name, const std::string& text) const {
    folder_.write(format_ + "/" + name, text);
  }

  using Path = std::vector<Eigen::Matrix4d>;
  /// Changes the poses of the format's file. @param change of all poses of one camera, in the file's axes
  void change_poses(const std::function<void(Path&)>& change) const;

  /// Changes what the format says of its cameras, wherever it says so.
  struct Calibration {
    double focal = 1.0, baseline = 1.0;    ///< factors
    double right_px = 0.0, down_px = 0.0;  ///< added to the principal point
    bool has_axes_of_gl = false;           ///< in the cameras' places on the body
  };
  void change_calibration(const Calibration& by) const;

  /// Left pictures get the names of right ones.
  void swap_pictures() const;
  /// Each picture gets the name of the next one; the first one stays.
  void delay_pictures() const;
  /// Depth is multiplied by a function of the ray's length.
  void change_depth(const std::function<double(double ray)>& factor) const;

 private:
  std::vector<std::string> pictures(std::size_t side) const;
  TestFolder folder_;
  std::string format_;
};

}  // namespace stereobench::harness
