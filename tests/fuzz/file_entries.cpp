/// The ways in of files that describe worlds, drives and marks.
#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>

#include "harness/dataset/colour_marks.h"
#include "harness/experiment/experiment.h"
#include "harness/logs/measurement_log_reader.h"
#include "harness/regression/result_folder.h"
#include "harness/suite/baseline.h"
#include "harness/suite/suite.h"
#include "harness/trajectories/trajectory_file.h"
#include "renderer/meshes/mesh_file.h"
#include "tests/fuzz/promises.h"
#include "worlds/drive/smooth_path.h"

namespace stereobench::fuzz {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// A file of this process's own, for as long as it is read.
class OwnFile {
 public:
  OwnFile(const std::string& name, const std::string& text) : path_(own_file(name)) { write(path_, text); }
  ~OwnFile() { fs::remove(path_); }
  OwnFile(const OwnFile&) = delete;
  OwnFile& operator=(const OwnFile&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

const std::set<std::string> kLogFiles = {
    "odometry.csv",           "observations.csv",      "groundtruth.csv",          "landmarks.csv",
    "instants.csv",           "Barcodes.dat",          "Landmark_Groundtruth.dat", "Robot3_Odometry.dat",
    "Robot3_Measurement.dat", "Robot3_Groundtruth.dat"};

/// Writes the files that a text holds into a folder.
void write_log(const fs::path& folder, const std::string& text) {
  fs::remove_all(folder);
  fs::create_directories(folder);
  constexpr std::string_view kBegin = "=== ";
  std::istringstream lines(text);
  std::ofstream file;
  for (std::string line; std::getline(lines, line);) {
    const bool begins = line.starts_with(kBegin) && kLogFiles.contains(line.substr(kBegin.size()));
    if (begins) {
      file.close();
      file.open(folder / line.substr(kBegin.size()), std::ios::binary);
    } else if (file.is_open()) {
      file << line << '\n';
    }
  }
}

constexpr std::array<const char*, 6> kMeshFormats = {"obj", "dae", "gltf", "glb", "stl", "fbx"};

}  // namespace

void check_scenario(Bytes bytes) {
  const OwnFile file("scenario.yaml", text_of(bytes));
  try {
    read_or_complain([&] {
      const worlds::Scenario scenario = harness::read_experiment(file.path()).scenario;
      expect(!scenario.path.empty() && !scenario.world.balls.empty(), "a scenario has a drive and balls");
      for (const worlds::Ball& ball : scenario.world.balls)
        expect(ball.centre_m.allFinite() && ball.radius_m > 0.0, "a ball is somewhere, and has a size");
    });
  } catch (const std::invalid_argument&) {  // it needs a reader of meshes, which is a caller's to give
  }
}

std::vector<std::string> scenario_seeds() {
  return {R"(name: tiny
seeds: 0..1
particles: 5
sensor: oracle
identity: known
oracle: {range_sd_m: 0.1, bearing_sd_deg: 1, max_range_m: 10, field_of_view_deg: 180}
odometry_noise: {v_per_v: 0.1, w_per_w: 0.1}
path: {kind: circle, radius_m: 1, speed_mps: 0.5, laps: 0.1, step_s: 0.1}
world:
  balls:
    - {colour: 0, at_m: [2, 0, 0.1]}
    - {colour: 1, at_m: [0, 2, 0.1]}
)",
          R"(name: rooms
sensor: stereo
identity: colour_class
rig: {width_px: 64, height_px: 48, focal_px: 50, baseline_m: 0.1, height_m: 0.3, pitch_down_deg: 5}
camera: {noise_sd_levels: 2}
odometry_noise: {v_per_v: 0.1, w_per_w: 0.1}
path: {kind: polyline, points_m: [[0, 0], [2, 0], [2, 2]], corner_radius_m: 0.3, speed_mps: 0.5, step_s: 0.5}
gates: [{metric: vision.recall, at_least: 0.5}]
randomise: {light: {}, walls: {}}
world:
  ball_radius_m: 0.06
  walls:
    - &wall {corners_m: [[0, 1], [4, 1]], height_m: 1, material: bricks}
    - {corners_m: [[0, -1], [4, -1]], height_m: 1, material: wood}
  balls:
    - {colour: 0, at_m: [2, 0.5, 0.06]}
)"};
}

void check_log(Bytes bytes) {
  const fs::path folder = own_file("log");
  write_log(folder, text_of(bytes));
  read_or_complain([&] {
    const harness::RecordedLog recorded = harness::read_log(folder, {});
    expect(!recorded.log.steps.empty(), "a log has a step");
    for (std::size_t k = 1; k < recorded.log.steps.size(); ++k)
      expect(recorded.log.steps[k].stamp_ns > recorded.log.steps[k - 1].stamp_ns,
             "steps are in order of time");
    expect(std::isfinite(recorded.facts.odometry_delay_s), "a delay is finite");
  });
  fs::remove_all(folder);
}

void check_result(Bytes bytes) {
  const OwnFile file("run.json", text_of(bytes));
  read_or_complain([&] {
    const harness::StoredResult result = harness::read_result(file.path());
    expect(!result.seeds.seeds.empty(), "a result has a seed");
    for (const auto& [name, values] : result.seeds.metrics)
      expect(values.size() == result.seeds.seeds.size(), "a metric has one value a seed");
    harness::compare_results(result.seeds, result.seeds, {});
  });
}

std::vector<std::string> result_seeds() {
  return {R"({"schema": 1, "scenario": "office", "seeds": [0, 7], "per_seed": {
  "filters.ekf.ate_rms_m": [0.125, 1e-3], "filters.ekf.failures": [0, 1], "vision.recall": [null, 0.75]}})"};
}

void check_suite(Bytes bytes) {
  const OwnFile file("suite.yaml", text_of(bytes));
  read_or_complain([&] {
    const harness::Suite suite = harness::read_suite(file.path());
    expect(!suite.cases.empty() && suite.alpha > 0.0, "a suite has a case, and a chance of false alarms");
    std::set<std::string> names;
    for (const harness::SuiteCase& one : suite.cases)
      expect(names.insert(one.name).second, "cases have names of their own");
  });
}

std::vector<std::string> suite_seeds() {
  return {R"(suite: vision
alpha: 0.02
presets:
  - name: short
    seeds: 0..19
    set: [path.laps=0.2, "gates=[]"]
    filters: [smoother]
    detector: python3 detector.py
    gates: [{metric: vision.recall, at_least: 0.5}]
cases:
  - {name: plain, like: short, scenario: ball_circle.yaml, margins: [{metric: vision.recall, change: 0.01}]}
  - name: noisy
    like: short
    scenario: ball_circle.yaml
    golden: {frames: [0, 3], limits: edges}
)"};
}

void check_baseline(Bytes bytes) {
  const OwnFile file("case.json", text_of(bytes));
  read_or_complain([&] {
    const harness::Baseline baseline = harness::read_baseline(file.path()).value();
    const OwnFile again("again.json", harness::baseline_text(baseline));
    expect(harness::baseline_text(harness::read_baseline(again.path()).value()) ==
               harness::baseline_text(baseline),
           "a baseline is read as it is written");
  });
}

std::vector<std::string> baseline_seeds() {
  return {R"({"schema": 1, "scenario": "office", "blessed": {"reason": "r", "stereobench": "0.1.0",
  "instead_of": null}, "inputs": {"sha256": "a1", "pixels": null, "detector": "none"}, "seeds": [0, 7],
  "per_seed": {"filters.ekf.ate_rms_m": [0.125, 1e-3], "vision.recall": [null, 0.75]}})"};
}

std::vector<std::string> log_seeds() {
  return {
      "=== odometry.csv\nt_s,v_mps,w_radps\n0,1,0\n1,1,0.5\n2,0,0\n"
      "=== observations.csv\nt_s,landmark_id,range_m,bearing_rad\n0.5,7,2,0.1\n1.5,7,1.5,0.2\n"
      "=== groundtruth.csv\nt_s,x_m,y_m,theta_rad\n0,0,0,0\n1,1,0,0\n2,2,0,0.5\n"
      "=== landmarks.csv\nlandmark_id,x_m,y_m\n7,3,0\n",
      "=== Barcodes.dat\n# Subject Barcode\n 1 5\n 7 63\n"
      "=== Landmark_Groundtruth.dat\n# x y sx sy\n 7 3.0 0.0 0.001 0.001\n"
      "=== Robot3_Odometry.dat\n# t v w\n100.0 \t 1.0 \t 0.0 \n101.0 1.0 0.5\n102.0 0 0\n"
      "=== Robot3_Measurement.dat\n# t barcode r b\n100.5 63 2.0 0.1\n100.6 5 1.0 0.0\n101.5 63 1.5 0.2\n"
      "=== Robot3_Groundtruth.dat\n100 0 0 0\n101 1 0 0\n102 2 0 0.5\n"};
}

void check_trajectory(Bytes bytes) {
  const OwnFile file("trajectory.txt", text_of(bytes));
  read_or_complain([&] {
    const auto poses = worlds::read_trajectory(file.path());
    expect(poses.size() >= 2, "a trajectory has two poses");
    worlds::GroundTruth path;
    try {
      path = worlds::drive_recorded(poses, 0.5, 0.0);
    } catch (const std::invalid_argument& error) {  // the reader of scenarios adds the line
      throw std::runtime_error(error.what());
    }
    for (const auto& step : path)
      expect(std::isfinite(step.pose.x_m) && std::isfinite(step.pose.heading_rad), "a drive is finite");
  });
}

std::vector<std::string> trajectory_seeds() {
  return {
      "# timestamp tx ty tz qx qy qz qw\n0 0 0 0 0 0 0 1\n1 0.5 0 0 0 0 0.0998334 0.9950042\n2 1 0.2 0 0 0 "
      "0.1986693 0.9800666\n",
      "t_s,x_m,y_m,theta_rad\n0,0,0,0\n1,0.5,0,0.1\n2,1,0.2,0.2\n",
      "t_s,x_m,y_m,theta_rad\n0,0,0,0\n1,0.5,0,0.1\n242009200,1,0.2,0.2\n"};  // longer than any drive may be
}

void check_poses(Bytes bytes) {
  const OwnFile file("poses.txt", text_of(bytes));
  read_or_complain([&] {
    const harness::Trajectory path = harness::read_trajectory(file.path());
    expect(path.stamps_ns.empty() || path.stamps_ns.size() == path.poses.size(),
           "all poses have a time, or none");
    for (const harness::PoseInSpace& pose : path.poses)
      expect(pose.position_m.allFinite() && pose.rotation.determinant() > 0.8,
             "a pose is somewhere, and turned");
  });
}

std::vector<std::string> pose_seeds() {
  return {"# timestamp tx ty tz qx qy qz qw\n1.5 0 0 0 0 0 0 1\n2 0.5 0 0 0 0 0.0998334 0.9950042\n",
          "#timestamp [ns],x,y,z,w,x,y,z,v\n1403636579758555392,4.6,-1.7,0.7,0.5,-0.5,0.5,-0.5,9\n",
          "1 0 0 0.5 0 1 0 1 0 0 1 2\n0 -1 0 1 1 0 0 1 0 0 1 2\n",
          "t_s,x_m,y_m,theta_rad\n0,0,0,0\n1,0.5,0,0.1\n"};
}

void check_marks(Bytes bytes) {
  static const fs::path folder = own_file("marks");
  if (!fs::exists(folder / "a.png")) {
    fs::create_directories(folder);
    cv::imwrite((folder / "a.png").string(), cv::Mat(32, 48, CV_8UC3, cv::Scalar(20, 90, 200)));
  }
  write(folder / "marks.json", text_of(bytes));
  read_or_complain([&] {
    const auto marked = harness::read_marked_pixels(folder / "marks.json", "linear");
    expect(!marked.colours.empty(), "marks have a colour");
    for (const auto& [name, pixels] : marked.pixels) expect(!pixels.empty(), "a mark holds a pixel");
  });
}

std::vector<std::string> mark_seeds() {
  return {R"({"marks": [{"picture": "a.png", "colour": "red", "circle_px": [14, 12, 5]},
 {"picture": "a.png", "colour": "green", "box_px": [5, 10, 30, 15]}]})"};
}

void check_mesh(Bytes bytes) {
  if (bytes.empty()) return;
  const OwnFile file(std::string("mesh.") + kMeshFormats[bytes[0] % kMeshFormats.size()],
                     text_of(bytes.subspan(1)));
  read_or_complain([&] {
    const auto triangles =
        renderer::read_mesh(file.path(), {.triangles = 10'000, .seconds = 2.0, .memory_mib = 256});
    expect(!triangles.empty(), "a mesh has a triangle");
    for (const auto& triangle : triangles)
      for (const auto& corner : triangle.corners)
        expect(corner.allFinite() && corner.cwiseAbs().maxCoeff() <= 1e6, "a corner is somewhere near");
  });
}

std::vector<std::string> mesh_seeds() {
  const auto of = [](char format, const std::string& text) { return format + text; };
  return {
      of(0, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n"),
      of(4,
         "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
         "endfacet\nendsolid s\n"),
      of(2, R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"buffers": [{"byteLength": 36,
 "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})")};
}

}  // namespace stereobench::fuzz
