/// How far the limits of `verify` are from what clean data sets reach, and from what planted faults reach.
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "tests/harness/commands/program.h"
#include "tests/harness/verify/planted_scene.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using Path = PlantedSet::Path;

/// A fault that a limit has to tell from clean sets, and no smaller one is promised.
struct LimitFault {
  const char* limit;
  const char* fault;
  const char* format;
  void (*plant)(const PlantedSet&);
};

void replace_all(const PlantedSet& set, const char* file, const std::string& from, const std::string& to) {
  std::string text = set.text(file);
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  set.write(file, text);
}

/// Changes the third sighting of a log. @param change of its four cells
void change_sighting(const PlantedSet& set, const std::function<void(std::vector<std::string>&)>& change) {
  std::string text = set.text("Robot1_Measurement.dat");
  std::size_t begin = 0;
  for (int line = 0; line < 3; ++line) begin = text.find('\n', begin) + 1;
  const std::size_t end = text.find('\n', begin);
  std::istringstream words(text.substr(begin, end - begin));
  std::vector<std::string> cells{std::istream_iterator<std::string>(words),
                                 std::istream_iterator<std::string>()};
  change(cells);
  text.replace(begin, end - begin, fmt::format("{} {} {} {}", cells[0], cells[1], cells[2], cells[3]));
  set.write("Robot1_Measurement.dat", text);
}

constexpr LimitFault kLimitFaults[] = {
    {"disparity against depth and baseline", "baseline 1 % too long", "plain",
     [](const PlantedSet& set) { set.change_calibration({.baseline = 1.01}); }},
    {"the right camera's disparity against its depth and the baseline", "baseline 1 % too long", "plain",
     [](const PlantedSet& set) { set.change_calibration({.baseline = 1.01}); }},
    {"flow against depth and poses", "focal length 1 % too long", "plain",
     [](const PlantedSet& set) { set.change_calibration({.focal = 1.01}); }},
    {"points of the world in pictures, against poses", "focal length 1 % too long", "plain",
     [](const PlantedSet& set) { set.change_calibration({.focal = 1.01}); }},
    {"depth of balls against world and poses", "depth 1 % too large", "plain",
     [](const PlantedSet& set) { set.change_depth([](double) { return 1.01; }); }},
    {"corners of the left picture in the right one", "swapped pictures", "plain",
     [](const PlantedSet& set) { set.swap_pictures(); }},
    {"rows of corners in both pictures", "swapped pictures", "euroc",
     [](const PlantedSet& set) { set.swap_pictures(); }},
    {"corners of a picture in the next one, against poses", "pictures a frame late", "euroc",
     [](const PlantedSet& set) { set.delay_pictures(); }},
    {"places of objects in both cameras and in the next frame, against poses", "places of poses in metres",
     "bop",
     [](const PlantedSet& set) {
       for (const char* scene : {"test_left/000000/", "test_right/000000/"})
         change_json(set, std::string(scene) + "scene_camera.json", [](nlohmann::ordered_json& json) {
           for (auto& camera : json)
             for (auto& number : camera["cam_t_w2c"]) number = 1e-3 * number.get<double>();
         });
     }},
    {"files of a single frame", "depth of another frame", "plain",
     [](const PlantedSet& set) { set.write("left_depth/000005.pfm", set.text("left_depth/000002.pfm")); }},
    {"corners of a single frame", "left picture of another frame", "euroc",
     [](const PlantedSet& set) {
       set.write("mav0/cam0/data/1500000000500000000.png",
                 set.text("mav0/cam1/data/1500000000500000000.png"));
     }},
    {"amount by corners", "focal length 1 % too long", "tum",
     [](const PlantedSet& set) { set.change_calibration({.focal = 1.01}); }},
    {"gain of an amount", "focal length 1 % too long", "tum",
     [](const PlantedSet& set) { set.change_calibration({.focal = 1.01}); }},
    {"box beyond an outline", "boxes of the other camera", "plain",
     [](const PlantedSet& set) {
       set.write("left_balls/000002.jsonl", set.text("right_balls/000002.jsonl"));
       replace_all(set, "left_balls/000002.jsonl", "\"centre_in_camera_m\":[-0.36",
                   "\"centre_in_camera_m\":[-0.24");
     }},
    {"range against depth", "depth in the place of range", "plain",
     [](const PlantedSet& set) { set.write("left_range/000003.pfm", set.text("left_depth/000003.pfm")); }},
    {"rigid motion of flow and disparities", "next disparity of another frame", "kitti-scene-flow",
     [](const PlantedSet& set) {
       for (const char* kind : {"disp_noc_1", "disp_occ_1"})
         set.write(fmt::format("{}/000005_10.png", kind), set.text(fmt::format("{}/000002_10.png", kind)));
     }},
    {"corners of the second pair", "second picture of another frame", "kitti-scene-flow",
     [](const PlantedSet& set) { set.write("image_2/000005_11.png", set.text("image_2/000002_11.png")); }},
    {"length of a quaternion", "0.1 % too long", "euroc",
     [](const PlantedSet& set) {
       replace_all(set, "mav0/state_groundtruth_estimate0/data.csv", ",1,0,0,0,", ",1.001,0,0,0,");
     }},
    {"rotation that is none", "an axis 0.1 % too long", "kitti-odometry",
     [](const PlantedSet& set) { set.change_poses([](Path& path) { path[2].col(1) *= 1.001; }); }},
    {"leap of poses", "a pose 10 m off", "tum",
     [](const PlantedSet& set) { set.change_poses([](Path& path) { path[3](0, 3) += 10.0; }); }},
    {"visib_fract", "1 % too much", "bop",
     [](const PlantedSet& set) {
       change_json(set, "test_left/000000/scene_gt_info.json", [](nlohmann::ordered_json& json) {
         for (auto& picture : json)
           for (auto& object : picture) object["visib_fract"] = 0.99 * object["visib_fract"].get<double>();
       });
     }},
    {"cause of sightings", "sightings a frame late", "mrclam",
     [](const PlantedSet& set) {
       std::istringstream lines(set.text("Robot1_Measurement.dat"));
       std::string late, line;
       std::getline(lines, late);
       late += "\n";
       while (std::getline(lines, line)) {
         std::istringstream words(line);
         std::string time, rest;
         words >> time;
         std::getline(words, rest);
         late += fmt::format("{:.9f}{}\n", std::stod(time) + 0.1, rest);
       }
       set.write("Robot1_Measurement.dat", late);
     }},
    {"single sighting", "another landmark's barcode", "mrclam",
     [](const PlantedSet& set) {
       change_sighting(set, [](auto& cells) { cells[1] = cells[1] == "6" ? "8" : "6"; });
     }},
    {"single sighting", "range 30 cm too long", "mrclam",
     [](const PlantedSet& set) {
       change_sighting(set, [](auto& cells) { cells[2] = fmt::format("{}", std::stod(cells[2]) + 0.3); });
     }},
    {"landmark", "a landmark 0.3 m off", "mrclam",
     [](const PlantedSet& set) { replace_all(set, "Landmark_Groundtruth.dat", "8 2.7 ", "8 2.4 "); }},
    {"gap of true poses", "a pose left out", "mrclam", [](const PlantedSet& set) {
       std::string text = set.text("Robot1_Groundtruth.dat");
       const std::size_t at = text.find("\n1.300000000 ");
       text.erase(at, text.find('\n', at + 1) - at);
       set.write("Robot1_Groundtruth.dat", text);
     }}};

/// Limits beyond which a cause is only looked for: corners of clean sets go beyond them, and no cause mends
/// that.
constexpr std::array<std::string_view, 2> kLooksForCauses = {
    "corners of the left picture in the right one", "corners of a picture in the next one, against poses"};

/// What some limits were nearest to, and in which set.
struct Reached {
  double share = 0.0;
  std::string where;
};

Verification verified(const fs::path& set, const std::string& format) {
  return verify_dataset(set, dataset_reader(format), [](double) {});
}

struct CleanSets {
  std::string scenario;
  std::string formats;
  std::vector<std::string> arguments;
};

std::vector<CleanSets> clean_sets() {
  const std::vector<std::string> small = {"--set", "rig.width_px=320", "--set", "rig.height_px=240",
                                          "--set", "rig.focal_px=280"};
  const auto frames = [&](const char* which, const std::vector<std::string>& more) {
    return with(with({"--frames", which}, small), more);
  };
  const std::vector<std::string> truth = {"--truth", "balls,disparity,flow,range"};
  const std::string pairs = "plain,euroc,tum,kitti-odometry,kitti-scene-flow",
                    scenes = "bop,colmap,nerfstudio";
  std::vector<CleanSets> all = {{kBend, pairs, with({"--frames", "2..7"}, truth)},
                                {kBend, scenes, {"--frames", "2..7"}},
                                {kBend, kShardsAndLogs, kLogFrames}};
  for (const char* name : {"corridor", "office"}) {
    all.push_back({scenario_path(name), pairs, frames("0..2", truth)});
    all.push_back({scenario_path(name), scenes, frames("0..2", {})});
    all.push_back({scenario_path(name), kShardsAndLogs, frames("0..19", {})});
  }
  return all;
}

/// @return how many faults clean sets have
std::size_t measure_clean(std::map<std::string, Reached>& reached) {
  std::size_t faults = 0;
  for (const CleanSets& sets : clean_sets()) {
    const fs::path folder = rendered(sets.scenario, sets.formats, sets.arguments);
    std::istringstream names(sets.formats);
    for (std::string format; std::getline(names, format, ',');) {
      const Verification found = verified(folder / format, format);
      for (const Fault& fault : found.faults)
        fmt::print("{} of {}: {}\n", format, sets.scenario, line_of(fault));
      faults += found.faults.size();
      for (const auto& [name, share] : found.margins.most())
        if (Reached& most = reached[name]; share >= most.share)
          most = {share, fmt::format("{}, {}", fs::path(sets.scenario).stem().string(), format)};
    }
  }
  return faults;
}

int measure() {
  std::map<std::string, Reached> clean;
  const std::size_t faults = measure_clean(clean);
  fmt::print("| limit | clean sets: at most | in | planted fault: at least | of |\n|---|---|---|---|---|\n");
  bool is_apart = faults == 0;
  std::set<std::string> planted;
  for (const LimitFault& fault : kLimitFaults) {
    const PlantedSet set(fault.format);
    fault.plant(set);
    const auto most = verified(set.path(""), fault.format).margins.most();
    const double share = most.contains(fault.limit) ? most.at(fault.limit) : 0.0;
    const Reached& without = clean[fault.limit];
    const bool is_for_causes = std::ranges::find(kLooksForCauses, fault.limit) != kLooksForCauses.end();
    is_apart &= (is_for_causes || without.share < 1.0) && share > 1.0;
    planted.insert(fault.limit);
    fmt::print("| {} | {:.2g} | {} | {:.3g} | {}, {} |\n", fault.limit, without.share, without.where, share,
               fault.fault, fault.format);
  }
  for (const auto& [name, reached] : clean)
    if (!planted.contains(name)) fmt::print("| {} | {:.2g} | {} | | |\n", name, reached.share, reached.where);
  return is_apart ? 0 : 1;
}

}  // namespace
}  // namespace stereobench::harness

int main() {
  try {
    return stereobench::harness::measure();
  } catch (const std::exception& error) {
    fmt::print(stderr, "stereobench_verify_limits: {}\n", error.what());
    return 2;
  }
}
