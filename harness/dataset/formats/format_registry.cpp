#include "harness/dataset/formats/format_registry.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/dataset/formats/container/recording_format.h"
#include "harness/dataset/formats/container/webdataset_format.h"
#include "harness/dataset/formats/odometry/euroc_format.h"
#include "harness/dataset/formats/odometry/kitti_odometry_format.h"
#include "harness/dataset/formats/odometry/mrclam_format.h"
#include "harness/dataset/formats/odometry/tum_format.h"
#include "harness/dataset/formats/odometry/vslamlab_format.h"
#include "harness/dataset/formats/plain_format.h"
#include "harness/dataset/formats/scene/bop_format.h"
#include "harness/dataset/formats/scene/coco_format.h"
#include "harness/dataset/formats/scene/colmap_format.h"
#include "harness/dataset/formats/scene/nerfstudio_format.h"
#include "harness/dataset/formats/stereo/eth3d_format.h"
#include "harness/dataset/formats/stereo/kitti_stereo_format.h"
#include "harness/dataset/formats/stereo/middlebury_format.h"
#include "harness/dataset/formats/stereo/sceneflow_format.h"
#include "worlds/yaml/advice.h"

namespace stereobench::harness {
namespace {

/// One row a format: name, what it holds, the truth that it needs, what it refuses, how it starts, which
/// kinds of picture its readers take, and whether it says what the detector found.
constexpr auto kFormats = std::to_array<DatasetFormat>({
    {"plain", "ids, depth, calibration and truth", "", check_plain_format, plain_writer,
     "colour, grey, bayer-rggb, linear16", true},
    {"kitti-odometry", "poses, as in KITTI odometry", "", check_kitti_odometry_format, kitti_odometry_writer},
    {"kitti-stereo", "disparity, as in KITTI stereo 2015", "disparity,flow", check_kitti_stereo_format,
     kitti_stereo_writer},
    {"kitti-stereo-2012", "disparity, as in KITTI stereo 2012", "disparity", check_kitti_stereo_2012_format,
     kitti_stereo_2012_writer},
    {"kitti-scene-flow", "disparity and flow, as in KITTI scene flow 2015", "disparity,flow",
     check_kitti_scene_flow_format, kitti_scene_flow_writer},
    {"euroc", "poses, as in EuRoC MAV", "", check_euroc_format, euroc_writer, "colour, grey"},
    {"tum", "depth and poses of the left camera, as in TUM RGB-D", "", check_tum_format, tum_writer},
    {"middlebury", "disparity, as in Middlebury 2014", "disparity", check_middlebury_format,
     middlebury_writer},
    {"eth3d", "disparity, as in ETH3D's two-view benchmark", "disparity", check_eth3d_format, eth3d_writer,
     "colour, grey"},
    {"sceneflow", "disparity, flow and poses, as in Scene Flow's Monkaa", "disparity,flow",
     check_sceneflow_format, sceneflow_writer},
    {"vslamlab", "poses, as VSLAM-LAB has them", "", check_vslamlab_format, vslamlab_writer},
    {"colmap", "poses and ball centres, as a model of COLMAP", "", check_colmap_format, colmap_writer,
     "colour, grey"},
    {"coco", "boxes and masks of balls, as in COCO", "balls", check_coco_format, coco_writer, "colour, grey"},
    {"bop", "6-D poses, masks and depth, as in BOP", "balls", check_bop_format, bop_writer},
    {"nerfstudio", "poses and depth, as Nerfstudio reads them", "", check_nerfstudio_format,
     nerfstudio_writer},
    {"rosbag", "odometry, detections and poses, as a bag of ROS 1", "", check_rosbag_format, rosbag_writer,
     "colour", true},
    {"mcap", "odometry, detections and poses, as a recording of ROS 2", "", check_mcap_format, mcap_writer,
     "colour", true},
    {"webdataset", "rigs, poses and balls, as shards of WebDataset", "", check_webdataset_format,
     webdataset_writer},
    {"mrclam", "odometry, sightings and poses in place of pictures, as in UTIAS MRCLAM", "",
     check_mrclam_format, mrclam_writer, "colour", true},
});

}  // namespace

void check_format(const DatasetFormat& format, const DatasetDrive& drive) {
  format.check(drive);
  const std::string_view kind = name_of(drive.picture_kind);
  if (format.pictures.find(kind) == std::string_view::npos)
    throw std::runtime_error(
        fmt::format("the format {} has no place for pictures of the kind {}; it holds {}", format.name, kind,
                    format.pictures));
}

bool is_plain(const DatasetFormat& format) {
  return format.name == kFormats.front().name;
}

std::vector<TruthKind> needed_truth(const DatasetFormat& format) {
  return format.needs.empty() ? std::vector<TruthKind>() : parse_truth(std::string(format.needs));
}

std::span<const DatasetFormat> dataset_formats() {
  return kFormats;
}

const DatasetFormat& dataset_format(std::string_view name, std::string_view option) {
  const auto* const found = std::ranges::find(kFormats, name, &DatasetFormat::name);
  if (found != kFormats.end()) return *found;
  std::vector<std::string_view> names;
  for (const DatasetFormat& format : kFormats) names.push_back(format.name);
  const auto meant = worlds::nearest_word(name, names);
  throw std::runtime_error(fmt::format("{}: no format is called '{}'{}; there are {}", option, name,
                                       meant ? fmt::format(", did you mean {}?", *meant) : "",
                                       fmt::join(names, ", ")));
}

std::vector<const DatasetFormat*> parse_formats(const std::string& text, std::string_view option) {
  std::vector<const DatasetFormat*> formats;
  std::istringstream names(text + ",");
  for (std::string name; std::getline(names, name, ',');) {
    formats.push_back(&dataset_format(name, option));
    if (std::ranges::count(formats, formats.back()) > 1)
      throw std::runtime_error(fmt::format("{}: '{}' stands there twice", option, name));
  }
  return formats;
}

}  // namespace stereobench::harness
