/// One drive of which there is a data set: what holds for all its stereo pairs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/dataset/pictures/picture_kind.h"
#include "harness/dataset/truth/truth_request.h"
#include "harness/drive/frame_choice.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// When the pictures of a step were taken, and from where.
struct TakenPictures {
  double late_s = 0.0;                ///< by how much later than the step's time the cameras looked
  slam::Pose world_from_robot;        ///< when the left one did: its middle row, halfway through the exposure
  slam::Pose world_from_robot_right;  ///< when the right one did
};

struct DriveStep {
  std::int64_t stamp_ns = 0;
  slam::Pose world_from_robot;            ///< at that time
  std::optional<TakenPictures> pictures;  ///< none where the shutter dropped the frame, or nobody wanted it
};

struct DatasetDrive {
  std::string name;  ///< of the scenario
  std::uint64_t seed = 0;
  worlds::World world;             ///< of the seed
  vision::StereoRig rig;           ///< as it is
  vision::StereoRig believed_rig;  ///< as vision takes it to be
  worlds::Shutter shutter;
  worlds::Encoding encoding = worlds::Encoding::kLinear;  ///< of the pictures' levels
  std::vector<DriveStep> steps;                           ///< all of the path
  TruthRequest truth;                                     ///< what was asked for beside the pictures
  std::string draws;                                      ///< what the seed drew (draws_file.h)
  PictureKind picture_kind = PictureKind::kColour;
};

/// The drive of a seed through a scenario.
/// @param world of the seed
/// @param frames of which there are to be pictures; the shutter may drop some
DatasetDrive drive_of(const worlds::Scenario& scenario, const worlds::World& world, std::uint64_t seed,
                      const FrameChoice& frames = {}, const TruthRequest& truth = {});

/// When layouts whose stamps are dates let a drive begin: their names then have equally many digits, so that
/// they sort by time, and their readers take 0 for no stamp.
inline constexpr std::int64_t kEpoch_ns = 1'500'000'000 * std::int64_t{1'000'000'000};  ///< July 2017

/// The steps that have pictures, in order.
std::vector<std::size_t> steps_with_pictures(const DatasetDrive& drive);

/// How many pairs there are a second, on average; 0 for fewer than two.
double pairs_per_second(const DatasetDrive& drive);

/// A line for each step of a drive: its number and time; whether there are pictures of it; by how much later
/// than that time the cameras looked; and the robot's true pose when the left one did (its middle row,
/// halfway through the exposure), and when the right one did. Of a step without pictures, the last seven are
/// empty.
/// @return CSV with a header
std::string frames_csv(const DatasetDrive& drive);

inline constexpr const char* kFramesFile = "frames.csv";
inline constexpr const char* kFramesHeader =
    "step,t_s,has_pictures,late_s,x_m,y_m,theta_rad,right_x_m,right_y_m,right_theta_rad";

}  // namespace stereobench::harness
