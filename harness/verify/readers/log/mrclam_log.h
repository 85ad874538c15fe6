/// The files of UTIAS MRCLAM (Leung et al., IJRR 2011) as values that can be held against each other.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "harness/verify/dataset_view.h"
#include "slam/types.h"

namespace stereobench::harness {

inline constexpr const char* kMrclamBarcodes = "Barcodes.dat";
inline constexpr const char* kMrclamLandmarks = "Landmark_Groundtruth.dat";

/// A line of Robot1_Measurement.dat.
struct MrclamSighting {
  long line = 0;
  std::string time;  ///< as the file has it
  std::int64_t stamp_ns = 0;
  int barcode = 0;  ///< 0: nobody's, of what was not recognised
  double range_m = 0.0;
  double bearing_rad = 0.0;
};

/// A line of Robot1_Odometry.dat.
struct MrclamReading {
  long line = 0;
  std::int64_t stamp_ns = 0;
  double v_mps = 0.0;
  double w_radps = 0.0;
};

/// A line of Robot1_Groundtruth.dat.
struct MrclamPose {
  long line = 0;
  std::string time;
  std::int64_t stamp_ns = 0;
  slam::Pose pose;
};

struct MrclamRobot {
  int subject = 0;
  std::string odometry_file, sightings_file, truth_file;  ///< empty where it is not there
  std::vector<MrclamReading> odometry;
  std::vector<MrclamSighting> sightings;
  std::vector<MrclamPose> truth;
};

struct MrclamLog {
  std::map<int, int> subjects;                 ///< by barcode
  std::map<int, Eigen::Vector2d> landmarks_m;  ///< by subject
  std::vector<MrclamRobot> robots;
};

/// Reads the files of all robots. Lines that cannot be read are faults, and left out.
MrclamLog read_mrclam_log(DatasetView& view);

/// Where a robot was: between two true poses that are at most a second apart.
/// @param late the poses are taken for those of so many lines later
std::optional<slam::Pose> true_pose(const std::vector<MrclamPose>& truth, std::int64_t stamp_ns,
                                    std::ptrdiff_t late = 0);

/// Barcodes and subjects against each other and those of sightings.
void check_identities(DatasetView& view, const MrclamLog& log);

/// Ranges and bearings against true poses and landmarks: a cause that holds for all, landmarks that are
/// elsewhere, and lines that noise does not explain.
/// @param may_be_late pictures are late by what the folder itself says: that they are is no fault
void check_sightings(DatasetView& view, const MrclamLog& log, const MrclamRobot& robot, bool may_be_late);

/// Velocities against true poses: their sign and unit.
void check_odometry(DatasetView& view, const MrclamRobot& robot);

}  // namespace stereobench::harness
