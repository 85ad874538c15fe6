#include "harness/dataset/card/format_layout.h"

#include <algorithm>
#include <array>
#include <string>

#include <fnmatch.h>

namespace stereobench::harness {
namespace {

constexpr std::string_view kLeft = "picture of the left camera";
constexpr std::string_view kRight = "picture of the right camera";
constexpr std::string_view kIds = "8-bit: 0 no ball, k the ball with ball_id k - 1 in balls.csv";
constexpr std::string_view kDepth = "planar Z in the camera frame, m; inf: nothing";
constexpr std::string_view kSurface = "16-bit: number of the surface in surfaces.csv; 0: nothing";
constexpr std::string_view kRange = "distance along the ray from the optical centre, m; inf: nothing";
constexpr std::string_view kNormal = "unit normal in the camera frame, towards the camera; 0: nothing";
constexpr std::string_view kDisparity = "u in the left picture minus u in the right one, px; inf: nothing";
constexpr std::string_view kMatch =
    "shift (x, y) to the other camera's picture, px; third channel: 1 where the point is seen there";
constexpr std::string_view kFlow =
    "shift (x, y) to the next step's picture of the same camera, px; third channel: 1 where the point is "
    "seen "
    "there";
constexpr std::string_view kMask =
    "where the point is in the other picture. 0: no point, 85: outside, 170: occluded, 255: visible";
constexpr std::string_view kKittiDisparity = "level / 256: disparity, px; 0: invalid";
constexpr std::string_view kKittiShift =
    "(level - 32768) / 64 in red and green: shift (x, y), px; blue: 1 where it is valid";
constexpr std::string_view kBallLines = "JSON, a line for each ball: outline, counts of pixels, boxes";
constexpr std::string_view kRig = "the rig, as OpenCV's FileStorage";
constexpr std::string_view kKittiOcc = "16-bit, level / 256: disparity of the left picture, px; 0: nothing";
constexpr std::string_view kKittiNoc = "the same of pixels that both cameras see";
constexpr std::string_view kKittiCalib = "3 x 4 projections of the cameras, row by row";
constexpr std::string_view kCamToCam = "size, lens, place and projection of the cameras";
constexpr std::string_view kPosesTum =
    "true pose of the left camera in the world: time, place, turn (x y z w)";
constexpr std::string_view kDepthMm = "planar Z: 16-bit, mm; 0: nothing, or beyond 65.5 m";
constexpr std::string_view kBothSee = "255: both cameras see it, 128: this one alone, 0: nothing";

constexpr auto kLayout = std::to_array<LayoutEntry>({
    {"plain", "left/*.png", kLeft},
    {"plain", "right/*.png", kRight},
    {"plain", "left_id/*.png", kIds},
    {"plain", "right_id/*.png", kIds},
    {"plain", "left_depth/*.pfm", kDepth},
    {"plain", "right_depth/*.pfm", kDepth},
    {"plain", "left_depth/*.tiff", kDepth},
    {"plain", "right_depth/*.tiff", kDepth},
    {"plain", "left_balls/*.jsonl", kBallLines},
    {"plain", "right_balls/*.jsonl", kBallLines},
    {"plain", "left_surface/*.png", kSurface},
    {"plain", "right_surface/*.png", kSurface},
    {"plain", "left_range/*.pfm", kRange},
    {"plain", "right_range/*.pfm", kRange},
    {"plain", "left_range/*.tiff", kRange},
    {"plain", "right_range/*.tiff", kRange},
    {"plain", "left_normal/*.pfm", kNormal},
    {"plain", "right_normal/*.pfm", kNormal},
    {"plain", "left_normal/*.tiff", kNormal},
    {"plain", "right_normal/*.tiff", kNormal},
    {"plain", "left_disparity/*.pfm", kDisparity},
    {"plain", "right_disparity/*.pfm", kDisparity},
    {"plain", "left_disparity/*.tiff", kDisparity},
    {"plain", "right_disparity/*.tiff", kDisparity},
    {"plain", "left_disparity/*.png", kKittiDisparity},
    {"plain", "right_disparity/*.png", kKittiDisparity},
    {"plain", "left_match/*.pfm", kMatch},
    {"plain", "right_match/*.pfm", kMatch},
    {"plain", "left_match/*.tiff", kMatch},
    {"plain", "right_match/*.tiff", kMatch},
    {"plain", "left_match/*.png", kKittiShift},
    {"plain", "right_match/*.png", kKittiShift},
    {"plain", "left_flow/*.pfm", kFlow},
    {"plain", "right_flow/*.pfm", kFlow},
    {"plain", "left_flow/*.tiff", kFlow},
    {"plain", "right_flow/*.tiff", kFlow},
    {"plain", "left_flow/*.png", kKittiShift},
    {"plain", "right_flow/*.png", kKittiShift},
    {"plain", "left_*_fate/*.png", kMask},
    {"plain", "right_*_fate/*.png", kMask},
    {"plain", "calibration.yaml", "the rig as vision is told it, as OpenCV's FileStorage"},
    {"plain", "true_calibration.yaml", "the rig as it is, as OpenCV's FileStorage"},
    {"plain", "balls.csv", "each ball: colour, centre in the world, radius"},
    {"plain", "surfaces.csv", "each surface of left_surface/ and right_surface/"},
    {"plain", "draws.jsonl", "what the seed drew"},
    {"plain", "frames.csv",
     "each step: its time, whether it has pictures, the true pose when they were taken"},
    {"plain", "odometry.csv", "measured speeds, with noise"},
    {"plain", "observations.csv", "what the detector saw: range, bearing, colour, covariance"},
    {"plain", "landmarks.csv", "true places of the balls in the world"},
    {"plain", "groundtruth.csv", "true pose of the robot in the world at each step"},
    {"plain", "instants.csv", "time of each step"},
    {"kitti-odometry", "sequences/*/image_0/*.png", "grey picture of the left camera"},
    {"kitti-odometry", "sequences/*/image_1/*.png", "grey picture of the right camera"},
    {"kitti-odometry", "sequences/*/image_2/*.png", kLeft},
    {"kitti-odometry", "sequences/*/image_3/*.png", kRight},
    {"kitti-odometry", "sequences/*/calib.txt", kKittiCalib},
    {"kitti-odometry", "sequences/*/times.txt", "seconds since the first frame"},
    {"kitti-odometry", "sequences/*/velodyne/none.txt", "a note that there is no laser scanner"},
    {"kitti-odometry", "poses/*.txt", "3 x 4, row by row: from the left camera to that of the first frame"},
    {"kitti-stereo", "image_2/*_10.png", kLeft},
    {"kitti-stereo", "image_3/*_10.png", kRight},
    {"kitti-stereo", "disp_occ_0/*.png", kKittiOcc},
    {"kitti-stereo", "disp_noc_0/*.png", kKittiNoc},
    {"kitti-stereo", "disp_occ_1/*.png",
     "16-bit, level / 256: disparity of the pixel's point a step later, px"},
    {"kitti-stereo", "disp_noc_1/*.png", "the same of points that the left camera then sees"},
    {"kitti-stereo", "calib/*.txt", kKittiCalib},
    {"kitti-stereo", "calib_cam_to_cam/*.txt", kCamToCam},
    {"kitti-stereo-2012", "colored_0/*.png", kLeft},
    {"kitti-stereo-2012", "colored_1/*.png", kRight},
    {"kitti-stereo-2012", "image_0/*.png", "grey picture of the left camera"},
    {"kitti-stereo-2012", "image_1/*.png", "grey picture of the right camera"},
    {"kitti-stereo-2012", "disp_occ/*.png", kKittiOcc},
    {"kitti-stereo-2012", "disp_noc/*.png", kKittiNoc},
    {"kitti-stereo-2012", "calib/*.txt", kKittiCalib},
    {"kitti-scene-flow", "image_2/*_10.png", kLeft},
    {"kitti-scene-flow", "image_3/*_10.png", kRight},
    {"kitti-scene-flow", "image_2/*_11.png", "the same a step later"},
    {"kitti-scene-flow", "image_3/*_11.png", "the same a step later"},
    {"kitti-scene-flow", "disp_occ_0/*.png", kKittiOcc},
    {"kitti-scene-flow", "disp_noc_0/*.png", kKittiNoc},
    {"kitti-scene-flow", "disp_occ_1/*.png",
     "16-bit, level / 256: disparity of the pixel's point a step later, px"},
    {"kitti-scene-flow", "disp_noc_1/*.png", "the same of points that the left camera then sees"},
    {"kitti-scene-flow", "flow_occ/*.png",
     "(level - 32768) / 64 in red and green: flow (x, y) of the left picture to the next step, px; blue: 1 "
     "where "
     "it is valid"},
    {"kitti-scene-flow", "flow_noc/*.png", "the same of points that the next picture shows"},
    {"kitti-scene-flow", "calib/*.txt", kKittiCalib},
    {"kitti-scene-flow", "calib_cam_to_cam/*.txt", kCamToCam},
    {"euroc", "mav0/cam0/data/*.png", kLeft},
    {"euroc", "mav0/cam1/data/*.png", kRight},
    {"euroc", "mav0/cam*/data.csv", "time (ns) and name of each picture"},
    {"euroc", "mav0/cam*/sensor.yaml", "T_BS (camera to body), rate, size, intrinsics, lens"},
    {"euroc", "mav0/state_groundtruth_estimate0/data.csv",
     "each step: time, place, turn (w x y z), speed in the world, biases (all 0: there is no IMU)"},
    {"euroc", "mav0/state_groundtruth_estimate0/sensor.yaml", "T_BS of the truth: the body itself"},
    {"euroc", "mav0/body.yaml", "scenario and seed"},
    {"tum", "rgb/*.png", kLeft},
    {"tum", "depth/*.png",
     "planar Z of the left picture: 16-bit, level / 5000 m; 0: nothing, or beyond 13.1 m"},
    {"tum", "rgb.txt", "time (s) and name of each picture"},
    {"tum", "depth.txt", "time (s) and name of each map of depths"},
    {"tum", "groundtruth.txt", kPosesTum},
    {"tum", "calibration.yaml", kRig},
    {"middlebury", "*/im0.png", kLeft},
    {"middlebury", "*/im1.png", kRight},
    {"middlebury", "*/disp0.pfm", "disparity of the left picture, px; inf: nothing"},
    {"middlebury", "*/disp1.pfm", "disparity of the right picture, px; inf: nothing"},
    {"middlebury", "*/mask0nocc.png", kBothSee},
    {"middlebury", "*/mask1nocc.png", kBothSee},
    {"middlebury", "*/calib.txt", "cameras, baseline (mm), size, range of the disparities"},
    {"eth3d", "two_view_training/*/im0.png", kLeft},
    {"eth3d", "two_view_training/*/im1.png", kRight},
    {"eth3d", "two_view_training/*/calib.txt", "cameras, baseline (mm), size, range of the disparities"},
    {"eth3d", "two_view_training_gt/*/disp0GT.pfm", "disparity of the left picture, px; inf: nothing"},
    {"eth3d", "two_view_training_gt/*/mask0nocc.png", kBothSee},
    {"sceneflow", "frames_cleanpass/*/left/*.png", kLeft},
    {"sceneflow", "frames_cleanpass/*/right/*.png", kRight},
    {"sceneflow", "disparity/*/left/*.pfm", "disparity of the left picture, px; 0: nothing"},
    {"sceneflow", "disparity/*/right/*.pfm", "disparity of the right picture, px; 0: nothing"},
    {"sceneflow", "optical_flow/*/into_future/left/*.pfm", "flow to the next step, px: x, y, 0"},
    {"sceneflow", "optical_flow/*/into_future/right/*.pfm", "flow to the next step, px: x, y, 0"},
    {"sceneflow", "camera_data/*/camera_data.txt", "4 x 4 from each camera to the world; y up, z backward"},
    {"sceneflow", "camera_data/*/calibration.yaml", kRig},
    {"vslamlab", "rgb_0/*.png", kLeft},
    {"vslamlab", "rgb_1/*.png", kRight},
    {"vslamlab", "rgb.csv", "time (ns) and path of both pictures of each pair"},
    {"vslamlab", "groundtruth.csv", kPosesTum},
    {"vslamlab", "calibration.yaml", "both cameras: intrinsics, lens (radtan5), size, rate, T_BS"},
    {"colmap", "images/left/*.png", kLeft},
    {"colmap", "images/right/*.png", kRight},
    {"colmap", "sparse/0/cameras.txt", "lens of each camera; the first pixel's centre is (0.5, 0.5)"},
    {"colmap", "sparse/0/images.txt",
     "camera_from_world of each picture, and the ball centres that it shows"},
    {"colmap", "sparse/0/points3D.txt", "ball centres in the world, m, and which pictures show them"},
    {"coco", "images/left/*.png", kLeft},
    {"coco", "images/right/*.png", kRight},
    {"coco", "annotations/*.json",
     "the balls that each picture shows: boxes, areas, masks (RLE), BOP's numbers"},
    {"bop", "test_left/*/rgb/*.png", kLeft},
    {"bop", "test_right/*/rgb/*.png", kRight},
    {"bop", "test_*/*/depth/*.png", "planar Z: 16-bit, level / 5 mm; 0: nothing, or beyond 13.1 m"},
    {"bop", "test_*/*/mask/*.png", "255: within the ball's outline, hidden or not"},
    {"bop", "test_*/*/mask_visib/*.png", "255: shows the ball"},
    {"bop", "test_*/*/scene_camera.json",
     "camera of each picture: K, place in the world (mm), scale of depth"},
    {"bop", "test_*/*/scene_gt.json", "pose of each ball in the camera, mm"},
    {"bop", "test_*/*/scene_gt_info.json", "boxes, counts of pixels and visibility of each ball"},
    {"bop", "camera.json", "the cameras, and the levels of depth"},
    {"bop", "models/*.ply", "a ball as a mesh, mm"},
    {"bop", "models/models_info.json", "diameter, box (mm) and symmetries of each object"},
    {"nerfstudio", "images/left/*.png", kLeft},
    {"nerfstudio", "images/right/*.png", kRight},
    {"nerfstudio", "depth/left/*.png", kDepthMm},
    {"nerfstudio", "depth/right/*.png", kDepthMm},
    {"nerfstudio", "transforms.json", "the camera, and world_from_camera of each picture; y up, z backward"},
    {"rosbag", "*.bag",
     "bag of ROS 1: pictures (bgr8), cameras, odometry as measured, detections; truth in /ground_truth/*, "
     "/tf "
     "and /tf_static; stamps from 1500000000 s"},
    {"mcap", "*.mcap", "MCAP of ROS 2: the same topics as in a bag of `rosbag`; stamps from 1500000000 s"},
    {"webdataset", "*.tar",
     "each pair's .left.png, .right.png and .json: rigs, 4 x 4 poses, the balls that a picture shows"},
    {"mrclam", "Robot1_Odometry.dat", "time (s), measured speeds: forward (m/s), counter-clockwise (rad/s)"},
    {"mrclam", "Robot1_Measurement.dat",
     "what the detector saw: time (s), barcode, range (m), bearing (rad)"},
    {"mrclam", "Robot1_Groundtruth.dat", "true pose of the robot at each step: time (s), x, y, heading"},
    {"mrclam", "Landmark_Groundtruth.dat",
     "true places of the balls: subject, x, y (m), and their deviations"},
    {"mrclam", "Barcodes.dat", "which subject has which barcode"},
});

}  // namespace

std::span<const LayoutEntry> layout_entries() {
  return kLayout;
}

bool has_pictures(std::string_view format) {
  return format != "mrclam";
}

const LayoutEntry* layout_entry_of(std::string_view format, std::string_view file) {
  const std::string name(file);
  const auto fits = [&](const LayoutEntry& entry) {
    return entry.format == format &&
           fnmatch(std::string(entry.glob).c_str(), name.c_str(), FNM_PATHNAME) == 0;
  };
  const auto* const found = std::ranges::find_if(kLayout, fits);
  return found == kLayout.end() ? nullptr : found;
}

}  // namespace stereobench::harness
