/// A data set of any format as values that can be compared: what readers (readers/) make of a folder, and
/// checks (checks/) look at.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "harness/verify/margins.h"
#include "vision/types.h"

namespace stereobench::harness {

/// Something of a data set that is not as it has to be. One line a fault.
struct Fault {
  std::string file;   ///< its place in the folder; a folder where a whole kind of file is at fault
  std::string frame;  ///< its name; empty where it is of no frame or of all
  std::string what;   ///< what was found, and what was expected
};

/// Whether a fault is that a frame has not all of its files: the others are as good as without it.
inline bool is_missing_frame(const Fault& fault) {
  return fault.what.starts_with("missing frame") || fault.what.starts_with("missing member");
}

/// A kind of picture that a frame may have of each camera, and the form in which it is read.
enum class Channel {
  kPicture,        ///< what the camera stored: CV_8UC1 or CV_8UC3
  kDisparity,      ///< CV_32FC1, px, u in the left picture minus u in the right one; +inf = none
  kDepth,          ///< CV_32FC1, planar Z in metres; +inf = none
  kRange,          ///< CV_32FC1, metres along the ray; +inf = none
  kFlow,           ///< CV_32FC2, px to the next frame's picture; +inf = none
  kNextDisparity,  ///< CV_32FC1, px that a pixel's point has at the next frame; +inf = none
  kNextPicture,    ///< as kPicture: what the camera stored at the next instant
  kBallId,         ///< CV_8UC1, 0 = no ball, k = ball k - 1
};

/// A picture of a frame that is read when it is asked for.
struct ChannelFile {
  std::string file;                         ///< its place in the folder
  double step = 0.0;                        ///< of the stored levels, px or m; 0 for 32-bit floats
  std::function<cv::Mat()> read;            ///< @throws std::runtime_error, one line, for what cannot be read
  std::function<std::string()> bytes = {};  ///< where the file is in an archive, else null. @throws alike
};

/// A camera on a body. Its frame is x right, y down, z forward.
struct ViewCamera {
  vision::Intrinsics pinhole;
  vision::Distortion lens;
  Eigen::Isometry3d body_from_camera = Eigen::Isometry3d::Identity();
};

/// A picture whose pixels are 0 or not: those that belong to a ball.
struct ViewMask {
  std::string file;               ///< that messages name
  std::function<cv::Mat()> read;  ///< CV_8UC1; @throws std::runtime_error, one line, for what cannot be read
};

/// What a file of balls says of one ball in one picture; boxes are [left, top, width, height]. In formats of
/// objects and points a ball is one of those.
struct ViewBallTruth {
  int ball = 0;
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  Eigen::Vector3d centre_in_camera_m = Eigen::Vector3d::Zero();
  cv::Rect bbox_visib;  ///< empty where it is hidden
  std::int64_t px_count_visib = 0;
  std::int64_t px_count_all = 0;
  std::optional<double> visib_fract;
  cv::Rect bbox_obj;                                 ///< empty where the file does not say
  std::optional<ViewMask> visible_mask, whole_mask;  ///< where a format has them of each ball
  int box_slack_px = 0;                              ///< other tools count the last row and column, or not
};

struct BallsFile {
  std::string file;
  std::vector<ViewBallTruth> balls;
};

/// A robot, where a layout says all of it: the rig that vision is told, and where the robot is in the world.
struct ViewRobot {
  vision::StereoRig rig;
  Eigen::Isometry3d world_from_robot = Eigen::Isometry3d::Identity();
};

/// One instant. Arrays are by vision::Side.
struct ViewFrame {
  std::string name;
  std::string drive = {};  ///< its name, where drives are told apart by more than folders
  std::array<std::optional<std::int64_t>, 2> stamp_ns;
  std::array<std::optional<Eigen::Isometry3d>, 2> world_from_body;  ///< when each camera looked
  std::array<ViewCamera, 2> cameras;
  std::optional<ViewRobot> robot = {};
  std::array<std::map<Channel, ChannelFile>, 2> channels;
  std::array<std::optional<BallsFile>, 2> balls;
  /// Pictures, and those of which they are a part: the same values, or none.
  std::vector<std::pair<ChannelFile, ChannelFile>> parts;
  bool drive_goes_on = true;  ///< the frame that is listed next is of the same drive
  bool next_follows = true;  ///< flow and disparities of the next frame lead to the frame that is listed next
};

/// A pose as a file of poses has it.
struct ViewPose {
  std::string file;
  long line = 0;
  std::optional<std::int64_t> stamp_ns;
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  double quaternion_norm = 1.0;  ///< where it was given by one
  std::string name = {};         ///< of its picture, where the file has no lines
};

struct ViewBall {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0.0;         ///< 0 for what is no sphere
  double reprojection_px = 0.0;  ///< by how much pictures are off it: a point that was found in pictures
};

/// Whose poses a data set has.
enum class PosesOf {
  kBody,        ///< which carries both cameras
  kLeftCamera,  ///< to which the right one is fixed
  kEachCamera,  ///< of each picture: ViewCamera::body_from_camera says nothing
};

struct DatasetView {
  std::string format;
  std::filesystem::path folder;
  std::vector<ViewFrame> frames;
  std::vector<ViewPose> poses;  ///< all of the files of poses
  std::vector<ViewBall> balls;
  bool has_calibration = true;  ///< without it nothing is said of geometry
  PosesOf poses_of = PosesOf::kLeftCamera;
  bool poses_are_a_way = true;     ///< from frame to frame; photographs may be taken anywhere
  bool balls_have_places = true;   ///< in the world; without them only each camera says where a ball is
  double place_precision_m = 0.0;  ///< of the poses, by the decimals of their numbers
  double turn_precision = 0.0;     ///< likewise, rad
  bool rows_look_apart = false;    ///< a rolling shutter: poses hold for the middle row alone
  std::string calibration_file;    ///< that messages name; likewise below
  std::string poses_file;
  std::string depth_file;            ///< or of disparities: a folder
  std::string pictures_file;         ///< a folder
  std::vector<Fault> faults;         ///< that were found while reading
  std::vector<std::string> checked;  ///< what readers have compared, for the summary
  std::vector<std::string> cannot;   ///< what nothing in the folder can be held against, and why
  Margins margins;                   ///< of what readers have compared
};

inline std::size_t index_of(vision::Side side) {
  return static_cast<std::size_t>(side);
}

/// A frame's file of a kind. @return null where the format has none
const ChannelFile* find_channel(const ViewFrame& frame, vision::Side side, Channel channel);

/// The ray of a pixel. @return the point with Z = 1 in the camera's frame; empty where the lens folds
std::optional<Eigen::Vector3d> ray_of(const ViewCamera& camera, const Eigen::Vector2d& pixel_px);

/// By what a pixel's depth may be off behind a lens, as a share of it: pictures are remapped from a
/// pinhole's, whose nearest pixel is taken (decision 020), half a pixel beside each way at most.
/// @return 0 for a camera without a lens
double depth_beside(const ViewCamera& camera, const cv::Mat& depth_m, const cv::Point& pixel);

/// Where a camera shows a point of its frame. @return empty for what is behind it
std::optional<Eigen::Vector2d> pixel_of(const ViewCamera& camera, const Eigen::Vector3d& point_m);

}  // namespace stereobench::harness
