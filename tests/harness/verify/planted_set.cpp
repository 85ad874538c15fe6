#include "tests/harness/verify/planted_set.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <regex>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/io/float_picture.h"
#include "harness/io/picture_file.h"
#include "harness/io/picture_reader.h"
#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using Eigen::Matrix4d;
using Numbers = std::vector<double>;

Numbers numbers_of(std::string text) {
  for (char& letter : text)
    if (std::string(",;[]\n").find(letter) != std::string::npos) letter = ' ';
  std::istringstream words(text);
  return {std::istream_iterator<double>(words), std::istream_iterator<double>()};
}

/// Changes the numbers of a pattern's first group wherever it matches.
std::string with_numbers(const std::string& text, const std::string& pattern, const char* separator,
                         const std::function<void(Numbers&, std::size_t match)>& change) {
  const std::regex regex(pattern);
  std::string result;
  std::size_t at = 0, match = 0;
  for (std::sregex_iterator found(text.begin(), text.end(), regex), none; found != none; ++found, ++match) {
    Numbers numbers = numbers_of((*found)[1]);
    change(numbers, match);
    const auto begin = static_cast<std::size_t>(found->position(1));
    result += text.substr(at, begin - at) + fmt::format("{}", fmt::join(numbers, separator));
    at = begin + static_cast<std::size_t>(found->length(1));
  }
  return result + text.substr(at);
}

Matrix4d as_matrix(const Numbers& numbers) {
  Matrix4d matrix = Matrix4d::Identity();
  for (std::size_t i = 0; i < numbers.size(); ++i)
    matrix(static_cast<int>(i / 4), static_cast<int>(i % 4)) = numbers[i];
  return matrix;
}

void put(const Matrix4d& matrix, Numbers& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = matrix(static_cast<int>(i / 4), static_cast<int>(i % 4));
}

/// Where a format has its poses, and how a line of numbers is one.
struct PoseLines {
  std::string file;
  std::string pattern;  ///< of a line, whose first group are the pose's numbers
  const char* separator;
  enum Form { kRows, kQuaternionLast, kQuaternionFirst, kPlane } form;
};

std::vector<PoseLines> pose_lines(const std::string& format) {
  const std::string rest = "([^\\n]+)";
  if (format == "plain")  // the left camera's, then the right one's
    return {{"frames.csv", "\\n\\d+,[^,]*,1,[^,]*,([^,\\n]*,[^,]*,[^,]*),", ",", PoseLines::kPlane},
            {"frames.csv", "\\n\\d+,[^,]*,1,[^,]*,[^,\\n]*,[^,]*,[^,]*,([^\\n]*)", ",", PoseLines::kPlane}};
  if (format == "tum")
    return {{"groundtruth.txt", "\\n\\d+\\.\\d+ " + rest, " ", PoseLines::kQuaternionLast}};
  if (format == "vslamlab") return {{"groundtruth.csv", "\\n\\d+," + rest, ",", PoseLines::kQuaternionLast}};
  if (format == "euroc")
    return {{"mav0/state_groundtruth_estimate0/data.csv", "\\n\\d+,((?:[^,]*,){6}[^,]*)", ",",
             PoseLines::kQuaternionFirst}};
  if (format == "kitti-odometry") return {{"poses/00.txt", rest, " ", PoseLines::kRows}};
  return {{"camera_data/bend_0/camera_data.txt", "\\nL " + rest, " ", PoseLines::kRows},
          {"camera_data/bend_0/camera_data.txt", "\\nR " + rest, " ", PoseLines::kRows}};
}

Matrix4d pose_of_line(const Numbers& numbers, PoseLines::Form form) {
  if (form == PoseLines::kRows) return as_matrix(numbers);
  Matrix4d pose = Matrix4d::Identity();
  pose.topRightCorner<3, 1>() << numbers[0], numbers[1], form == PoseLines::kPlane ? 0.0 : numbers[2];
  Eigen::Quaterniond turn(Eigen::AngleAxisd(numbers[2], Eigen::Vector3d::UnitZ()));
  if (form == PoseLines::kQuaternionLast) turn = {numbers[6], numbers[3], numbers[4], numbers[5]};
  if (form == PoseLines::kQuaternionFirst) turn = {numbers[3], numbers[4], numbers[5], numbers[6]};
  pose.topLeftCorner<3, 3>() = turn.toRotationMatrix();
  return pose;
}

void put_pose(const Matrix4d& pose, PoseLines::Form form, Numbers& numbers) {
  if (form == PoseLines::kRows) return put(pose, numbers);
  const Eigen::Quaterniond q(Eigen::Matrix3d(pose.topLeftCorner<3, 3>()));
  numbers = {pose(0, 3), pose(1, 3)};
  const Numbers more = form == PoseLines::kPlane            ? Numbers{std::atan2(pose(1, 0), pose(0, 0))}
                       : form == PoseLines::kQuaternionLast ? Numbers{pose(2, 3), q.x(), q.y(), q.z(), q.w()}
                                                            : Numbers{pose(2, 3), q.w(), q.x(), q.y(), q.z()};
  numbers.insert(numbers.end(), more.begin(), more.end());
}

const Eigen::Vector4d kAxesOfOpenGl = {1.0, -1.0, -1.0, 1.0};

/// K [R | t], of three or four columns.
void change_projection(const PlantedSet::Calibration& by, std::size_t columns, Numbers& p) {
  p[0] *= by.focal;
  p[2] += by.right_px;
  p[columns + 1] *= by.focal;
  p[columns + 2] += by.down_px;
  if (columns == 4) p[3] *= by.focal * by.baseline;
}

/// The places of both cameras, the left one's first.
std::function<void(Numbers&, std::size_t)> moved(const PlantedSet::Calibration& by) {
  const auto left = std::make_shared<Matrix4d>();
  return [by, left](Numbers& numbers, std::size_t side) {
    Matrix4d place = as_matrix(numbers);
    if (side == 0) *left = place;
    place.topRightCorner<3, 1>() =
        left->topRightCorner<3, 1>() + by.baseline * (place - *left).topRightCorner<3, 1>();
    if (by.has_axes_of_gl) place = place * kAxesOfOpenGl.asDiagonal();
    put(place, numbers);
  };
}

/// calibration.yaml of `render`.
std::string changed_rig(std::string text, const PlantedSet::Calibration& by) {
  const auto data = [](const char* key) {
    return fmt::format("\n{}: !!opencv-matrix[^\\[]*\\[([^\\]]*)\\]", key);
  };
  text = with_numbers(text, data("K"), ", ", [&](Numbers& k, std::size_t) { change_projection(by, 3, k); });
  text =
      with_numbers(text, data("P[12]"), ", ", [&](Numbers& p, std::size_t) { change_projection(by, 4, p); });
  text = with_numbers(text, data("robot_from_(?:left|right)_camera"), ", ", moved(by));
  return with_numbers(text, "\nbaseline_m: ([^\\n]*)", "",
                      [&](Numbers& b, std::size_t) { b[0] *= by.baseline; });
}

std::string changed_euroc(std::string text, const PlantedSet::Calibration& by,
                          const std::function<void(Numbers&, std::size_t)>& move, std::size_t side) {
  text = with_numbers(text, "intrinsics: \\[([^\\]]*)\\]", ", ", [&](Numbers& k, std::size_t) {
    k = {by.focal * k[0], by.focal * k[1], k[2] + by.right_px, k[3] + by.down_px};
  });
  return with_numbers(text, "data: \\[([^\\]]*)\\]", ", ",
                      [&](Numbers& place, std::size_t) { move(place, side); });
}

std::string changed_vslamlab(std::string text, const PlantedSet::Calibration& by) {
  text = with_numbers(text, "focal_length: \\[([^\\]]*)\\]", ", ", [&](Numbers& f, std::size_t) {
    f = {by.focal * f[0], by.focal * f[1]};
  });
  text = with_numbers(text, "principal_point: \\[([^\\]]*)\\]", ", ", [&](Numbers& c, std::size_t) {
    c = {c[0] + by.right_px, c[1] + by.down_px};
  });
  return with_numbers(text, "T_BS: \\[([^\\]]*)\\]", ", ", moved(by));
}

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

}  // namespace

fs::path rendered(const std::string& scenario, const std::string& formats,
                  const std::vector<std::string>& arguments) {
  static const TestFolder folder;
  static std::map<std::string, fs::path> known;
  const std::string key = fmt::format("{} {} {}", scenario, formats, fmt::join(arguments, " "));
  if (known.contains(key)) return known.at(key);
  const fs::path out = folder.path() / fmt::format("{}", known.size());
  const std::vector<std::string> common = {"render", scenario, "--format", formats, "--out", out.string()};
  const Outcome outcome = run_stereobench(with(common, arguments));
  if (outcome.exit_code != 0) ADD_FAILURE() << outcome.err;
  return known[key] = out;
}

std::string faults_of(const fs::path& folder, const std::string& format) {
  std::string lines;
  for (const Fault& fault : verify_dataset(folder, dataset_reader(format), [](double) {}).faults)
    lines += line_of(fault) + "\n";
  return lines;
}

fs::path whole_set(const std::string& format) {
  if (format == "mrclam") return rendered(kBend, format, kLogFrames);
  if (format == "webdataset") return rendered(kBend, format, kSceneFrames);
  const bool is_scene = kSceneFormats.find(format) != std::string::npos;
  return rendered(kBend, is_scene ? kSceneFormats : kAllFormats, is_scene ? kSceneFrames : kBendFrames) /
         format;
}

PlantedSet::PlantedSet(const std::string& format) : format_(format) {
  const fs::path from = whole_set(format);
  fs::copy(from, folder_.path() / format, fs::copy_options::recursive);
  for (const char* name : {"dataset.json", "manifest-sha256.txt"}) fs::remove(path(name));
}

void PlantedSet::change_poses(const std::function<void(Path&)>& change) const {
  for (const PoseLines& lines : pose_lines(format_)) {
    Path path;
    const std::string before = text(lines.file);
    with_numbers(before, lines.pattern, lines.separator,
                 [&](Numbers& pose, std::size_t) { path.push_back(pose_of_line(pose, lines.form)); });
    ASSERT_GT(path.size(), 3U) << format_;
    change(path);
    write(lines.file, with_numbers(before, lines.pattern, lines.separator, [&](Numbers& pose, std::size_t i) {
            put_pose(path[i], lines.form, pose);
          }));
  }
}

void PlantedSet::change_calibration(const Calibration& by) const {
  const auto change = [this](const std::string& name, const auto& changed) {
    write(name, changed(text(name)));
  };
  const auto rig = [&](const std::string& text) { return changed_rig(text, by); };
  if (format_ == "plain") return change("true_calibration.yaml", rig);
  if (format_ == "tum") return change("calibration.yaml", rig);
  if (format_ == "sceneflow") return change("camera_data/bend_0/calibration.yaml", rig);
  if (format_ == "vslamlab")
    return change("calibration.yaml", [&](const std::string& text) { return changed_vslamlab(text, by); });
  if (format_ == "euroc") {
    const auto move = moved(by);
    for (std::size_t side = 0; side < 2; ++side)
      change(fmt::format("mav0/cam{}/sensor.yaml", side),
             [&](const std::string& text) { return changed_euroc(text, by, move, side); });
    return;
  }
  for (const fs::path& file : files_below(folder_.path() / format_)) {
    const std::string name = fs::relative(file, folder_.path() / format_).string();
    if (name.ends_with("calib.txt") || name.starts_with("calib/"))
      change(name, [&](const std::string& text) {
        return with_numbers(with_numbers(text, "P\\d: ([^\\n]*)", " ",
                                         [&](Numbers& p, std::size_t) { change_projection(by, 4, p); }),
                            "cam1=\\[([^\\]]*)\\]", " ",
                            [&](Numbers& k, std::size_t) { change_projection(by, 3, k); });
      });
  }
}

std::vector<std::string> PlantedSet::pictures(std::size_t side) const {
  const std::vector<std::array<const char*, 2>> places = {{"left/", "right/"},
                                                          {"image_0/", "image_1/"},
                                                          {"image_2/", "image_3/"},
                                                          {"colored_0/", "colored_1/"},
                                                          {"cam0/data/", "cam1/data/"},
                                                          {"rgb_0/", "rgb_1/"},
                                                          {"rgb/", "none/"},
                                                          {"im0.png", "im1.png"}};
  std::vector<std::string> names;
  for (const fs::path& file : files_below(folder_.path() / format_)) {
    const std::string name = fs::relative(file, folder_.path() / format_).string();
    if (name.ends_with(".png") && std::ranges::any_of(places, [&](const auto& place) {
          const std::size_t at = name.find(place[side]);
          return at != std::string::npos && (at == 0 || name[at - 1] == '/');
        }))
      names.push_back(name);
  }
  return names;
}

void PlantedSet::swap_pictures() const {
  const std::vector<std::string> left = pictures(0), right = pictures(1);
  ASSERT_EQ(left.size(), right.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    const std::string kept = text(left[i]);
    write(left[i], text(right[i]));
    write(right[i], kept);
  }
}

void PlantedSet::delay_pictures() const {
  for (std::size_t side = 0; side < 2; ++side) {
    const std::vector<std::string> names = pictures(side);
    for (std::size_t i = names.size(); i-- > 1;) write(names[i], text(names[i - 1]));
  }
}

void PlantedSet::change_depth(const std::function<double(double ray)>& factor) const {
  constexpr double kFocal_px = 280.0, kMiddle_u = 159.5, kMiddle_v = 119.5, kMostLevel = 65535.0;
  for (const fs::path& file : files_below(folder_.path() / format_)) {
    const std::string name = fs::relative(file, folder_.path() / format_).string();
    if (name.find("depth/") == std::string::npos) continue;
    const bool is_float = name.ends_with(".pfm");
    cv::Mat depth;
    (is_float ? read_float_picture(file) : read_exact_png(file)).convertTo(depth, CV_64F);
    for (int v = 0; v < depth.rows; ++v)
      for (int u = 0; u < depth.cols; ++u) {
        const Eigen::Vector3d ray((u - kMiddle_u) / kFocal_px, (v - kMiddle_v) / kFocal_px, 1.0);
        depth.at<double>(v, u) *= factor(ray.norm());
      }
    if (!is_float) depth.setTo(0.0, depth > kMostLevel);
    depth.convertTo(depth, is_float ? CV_32F : CV_16U);
    write(name, encoded(is_float ? ".pfm" : ".png", depth));
  }
}

}  // namespace stereobench::harness
