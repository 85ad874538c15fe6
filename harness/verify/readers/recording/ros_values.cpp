#include "harness/verify/readers/recording/ros_values.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "harness/types.h"
#include "harness/verify/readers/recording/file_pieces.h"
#include "harness/verify/readers/scene/scene_json.h"
#include "worlds/yaml/excerpt.h"

namespace stereobench::harness {
namespace {

constexpr std::uint32_t kLongest_px = 1 << 20;

/// Takes values one after the other.
class RosDecoder {
 public:
  RosDecoder(RosVersion version, std::string_view bytes) : version_(version), values_(bytes) {
    if (version_ == RosVersion::kOne) return;
    constexpr std::string_view kPlainCdr("\0\1", 2);
    constexpr std::size_t kRepresentation = 2;
    if (values_.bytes(kRepresentation) != kPlainCdr)
      throw std::runtime_error("expected plain CDR, little endian");
    values_.bytes(kRepresentation);  // options
    start_ = values_.at();
  }

  template <class Number>
  Number number() {
    if (version_ == RosVersion::kTwo) {
      const std::size_t beyond = (values_.at() - start_) % sizeof(Number);
      if (beyond != 0) values_.bytes(sizeof(Number) - beyond);
    }
    return values_.number<Number>();
  }
  template <std::size_t Count>
  std::array<double, Count> doubles() {
    std::array<double, Count> numbers;
    for (double& value : numbers) value = number<double>();
    return numbers;
  }
  /// A length, an angle or a share.
  double bounded() {
    const double value = number<double>();
    if (!(std::abs(value) <= kMostNumber))
      throw std::runtime_error(fmt::format("expected numbers up to {:g} (got {:g})", kMostNumber, value));
    return value;
  }
  template <std::size_t Count>
  std::array<double, Count> all_bounded() {
    std::array<double, Count> numbers;
    for (double& value : numbers) value = bounded();
    return numbers;
  }
  int pixels() {
    const std::uint32_t value = count();
    if (value > kLongest_px)
      throw std::runtime_error(
          fmt::format("expected sides of at most {} pixels (got {})", kLongest_px, value));
    return static_cast<int>(value);
  }
  std::uint32_t count() { return number<std::uint32_t>(); }
  std::string_view block() {
    const std::uint32_t size = count();
    return values_.bytes(size);
  }
  std::string text() {
    std::string_view text = block();
    if (version_ == RosVersion::kTwo) {
      if (!text.ends_with('\0')) throw std::runtime_error("expected a text that ends with a zero");
      text.remove_suffix(1);
    }
    return std::string(text);
  }
  ReadHeader header() {
    ReadHeader header;
    if (version_ == RosVersion::kOne) header.sequence = count();
    const std::int64_t seconds =
        version_ == RosVersion::kOne ? std::int64_t{count()} : number<std::int32_t>();
    header.stamp_ns = seconds * kSecond_ns + count();
    header.frame = text();
    return header;
  }
  ReadPose pose() {
    const auto at = all_bounded<7>();
    return {{at[0], at[1], at[2]}, {at[6], at[3], at[4], at[5]}};
  }

 private:
  RosVersion version_;
  LittleValues values_;
  std::size_t start_ = 0;
};

/// How a picture's levels lie in its bytes.
struct RosEncoding {
  std::string_view name;
  int type = CV_8UC1;
  int to_bgr = -1;  ///< a conversion of OpenCV's, where it needs one
};

constexpr std::array kRosEncodings = {RosEncoding{"mono8", CV_8UC1},
                                      RosEncoding{"8UC1", CV_8UC1},
                                      RosEncoding{"bgr8", CV_8UC3},
                                      RosEncoding{"8UC3", CV_8UC3},
                                      RosEncoding{"rgb8", CV_8UC3, cv::COLOR_RGB2BGR},
                                      RosEncoding{"bgra8", CV_8UC4, cv::COLOR_BGRA2BGR},
                                      RosEncoding{"rgba8", CV_8UC4, cv::COLOR_RGBA2BGR}};

const RosEncoding& ros_encoding(std::string_view name) {
  const auto* const found = std::ranges::find(kRosEncodings, name, &RosEncoding::name);
  if (found == kRosEncodings.end())
    throw std::runtime_error(fmt::format("expected pictures of mono8, bgr8, rgb8, bgra8 or rgba8 (got {})",
                                         worlds::excerpt(name)));
  return *found;
}

}  // namespace

Eigen::Isometry3d ReadPose::rigid() const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (turn.norm() > 0.0) pose.linear() = turn.normalized().toRotationMatrix();
  pose.translation() = place_m;
  return pose;
}

ReadHeader read_ros_header(RosVersion version, std::string_view bytes) {
  return RosDecoder(version, bytes).header();
}

cv::Mat read_ros_image(RosVersion version, std::string_view bytes) {
  RosDecoder in(version, bytes);
  in.header();
  const std::uint32_t rows = in.count(), columns = in.count();
  const std::string name = in.text();
  const RosEncoding& encoding = ros_encoding(name);
  in.number<std::uint8_t>();  // is_bigendian says nothing of levels of 8 bits
  const std::uint64_t step = in.count();
  const std::string_view data = in.block();
  const auto pixel = static_cast<std::uint64_t>(CV_ELEM_SIZE(encoding.type));
  if (rows == 0 || columns == 0 || rows > kLongest_px || columns > kLongest_px || step < columns * pixel ||
      data.size() < rows * step)
    throw std::runtime_error(fmt::format("expected {} x {} pixels of {} in rows of {} bytes (got {} bytes)",
                                         columns, rows, encoding.name, step, data.size()));
  // OpenCV takes no memory that may not be written to; nothing is written there.
  auto* const levels = const_cast<char*>(data.data());
  const cv::Mat lent(static_cast<int>(rows), static_cast<int>(columns), encoding.type, levels, step);
  cv::Mat picture;
  if (encoding.to_bgr >= 0)
    cv::cvtColor(lent, picture, encoding.to_bgr);
  else
    picture = lent.clone();
  return picture;
}

ReadCameraInfo read_ros_camera_info(RosVersion version, std::string_view bytes) {
  RosDecoder in(version, bytes);
  ReadCameraInfo info;
  info.header = in.header();
  info.height_px = in.pixels();
  info.width_px = in.pixels();
  info.model = in.text();
  const std::uint32_t coefficients = in.count();
  constexpr std::uint32_t kMostCoefficients = 14;  // of the models that ROS knows
  if (coefficients > kMostCoefficients)
    throw std::runtime_error(
        fmt::format("expected at most {} coefficients of a lens (got {})", kMostCoefficients, coefficients));
  for (std::uint32_t i = 0; i < coefficients; ++i) info.d.push_back(in.bounded());
  info.k = in.all_bounded<9>();
  info.r = in.all_bounded<9>();
  info.p = in.all_bounded<12>();
  const std::array binning = {in.count(), in.count()};
  const std::array region = {in.count(), in.count(), in.count(), in.count()};  // x, y, height, width; 0: all
  const std::array none = {0U, 0U, 0U, 0U};
  const std::array all = {0U, 0U, static_cast<std::uint32_t>(info.height_px),
                          static_cast<std::uint32_t>(info.width_px)};
  info.is_of_whole_picture = binning[0] <= 1 && binning[1] <= 1 && (region == none || region == all);
  return info;
}

ReadStampedPose read_ros_pose(RosVersion version, std::string_view bytes) {
  RosDecoder in(version, bytes);
  ReadStampedPose stamped;
  stamped.header = in.header();
  stamped.pose = in.pose();
  return stamped;
}

std::vector<ReadTransform> read_ros_transforms(RosVersion version, std::string_view bytes) {
  RosDecoder in(version, bytes);
  std::vector<ReadTransform> transforms;
  for (std::uint32_t left = in.count(); left > 0; --left) {
    ReadTransform& transform = transforms.emplace_back();
    transform.header = in.header();
    transform.child_frame = in.text();
    transform.parent_from_child = in.pose();
  }
  return transforms;
}

ReadOdometry read_ros_odometry(RosVersion version, std::string_view bytes) {
  constexpr std::size_t kCovariance = 36;
  RosDecoder in(version, bytes);
  ReadOdometry odometry;
  odometry.header = in.header();
  odometry.child_frame = in.text();
  in.doubles<7>();  // where it is by itself, which nothing is held against
  in.doubles<kCovariance>();
  const auto twist = in.doubles<6>();
  odometry.v_mps = twist[0], odometry.lateral_mps = twist[1], odometry.w_radps = twist[5];
  return odometry;
}

slam::Pose read_ros_planar_pose(RosVersion version, std::string_view bytes) {
  const auto at = RosDecoder(version, bytes).all_bounded<3>();
  return {at[0], at[1], at[2]};
}

std::vector<std::vector<double>> read_ros_table(RosVersion version, std::string_view bytes,
                                                std::span<const std::string_view> columns) {
  RosDecoder in(version, bytes);
  in.header();
  const std::uint64_t points = std::uint64_t{in.count()} * in.count();
  std::vector<std::optional<std::size_t>> places(columns.size());
  for (std::uint32_t left = in.count(); left > 0; --left) {
    const std::string name = in.text();
    const std::uint32_t offset = in.count();
    const bool is_number = in.number<std::uint8_t>() == kRosFloat64;
    in.count();  // of its values
    const auto column = std::ranges::find(columns, name);
    if (is_number && column != columns.end())
      places[static_cast<std::size_t>(column - columns.begin())] = offset;
  }
  const bool is_big_endian = in.number<std::uint8_t>() != 0;
  const std::uint64_t point_bytes = in.count();
  in.count();  // of a row
  const std::string_view data = in.block();
  if (is_big_endian) throw std::runtime_error("expected numbers with their least byte first");
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (!places[i] || *places[i] + sizeof(double) > point_bytes)
      throw std::runtime_error(fmt::format("expected a field {} of 64 bits", columns[i]));
  if (point_bytes == 0 || data.size() / point_bytes < points)
    throw std::runtime_error(
        fmt::format("expected {} points of {} bytes (got {} bytes)", points, point_bytes, data.size()));
  std::vector<std::vector<double>> rows;
  for (std::uint64_t point = 0; point < points; ++point)
    for (std::vector<double>& row = rows.emplace_back(); row.size() < columns.size();)
      row.push_back(LittleValues(data.substr(point * point_bytes + *places[row.size()])).number<double>());
  return rows;
}

}  // namespace stereobench::harness
