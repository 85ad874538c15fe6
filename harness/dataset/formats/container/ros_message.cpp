#include "harness/dataset/formats/container/ros_message.h"

#include <array>
#include <bit>
#include <concepts>

#include "harness/dataset/camera_pose.h"
#include "harness/types.h"

namespace stereobench::harness {
namespace {

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

/// Writes values one after the other.
class RosEncoder {
 public:
  explicit RosEncoder(RosVersion version) : version_(version) {
    if (version_ == RosVersion::kTwo) bytes_.assign({0, 1, 0, 0});  // plain CDR, little endian
    start_ = bytes_.size();
  }

  template <class Number>
  requires std::integral<Number> || std::floating_point<Number>
  void number(Number value) {
    while (version_ == RosVersion::kTwo && (bytes_.size() - start_) % sizeof(Number) != 0)
      bytes_.push_back('\0');
    const auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(value);
    bytes_.append(raw.data(), raw.size());
  }
  template <class Number, class Values>
  void numbers(const Values& values) {
    for (const auto value : values) number(static_cast<Number>(value));
  }
  void count(std::size_t many) { number(static_cast<std::uint32_t>(many)); }
  void text(std::string_view text) {
    const bool ends_with_zero = version_ == RosVersion::kTwo;
    count(text.size() + (ends_with_zero ? 1 : 0));
    bytes_.append(text);
    if (ends_with_zero) bytes_.push_back('\0');
  }
  void flag(bool value) { number(static_cast<std::uint8_t>(value ? 1 : 0)); }
  void block(const char* data, std::size_t size) { bytes_.append(data, size); }

  void time(std::int64_t ns) {
    number(static_cast<std::uint32_t>(ns / kSecond_ns));
    number(static_cast<std::uint32_t>(ns % kSecond_ns));
  }
  void header(const RosHeader& header) {
    if (version_ == RosVersion::kOne) number(header.sequence);
    time(header.stamp_ns);
    text(header.frame);
  }
  void vector(const Eigen::Vector3d& vector) {
    numbers<double>(std::array{vector.x(), vector.y(), vector.z()});
  }
  void turn(const Eigen::Matrix3d& rotation) {
    const Eigen::Quaterniond turn = unit_quaternion(rotation);
    numbers<double>(std::array{turn.x(), turn.y(), turn.z(), turn.w()});
  }
  void pose(const Eigen::Isometry3d& pose) {
    vector(pose.translation());
    turn(pose.linear());
  }

  RosVersion version() const { return version_; }
  std::string take() { return std::move(bytes_); }
  void expect(std::size_t more) { bytes_.reserve(bytes_.size() + more); }

 private:
  RosVersion version_;
  std::size_t start_ = 0;
  std::string bytes_;
};

void add_sphere(RosEncoder& out, const RosHeader& header, const RosSphere& sphere, std::int64_t lifetime_ns) {
  constexpr std::int32_t kSphere = 2, kAdd = 0;
  out.header(header);
  out.text(sphere.name);
  out.numbers<std::int32_t>(std::array{sphere.id, kSphere, kAdd});
  out.vector(sphere.centre_m);
  out.turn(Eigen::Matrix3d::Identity());
  out.vector(Eigen::Vector3d::Constant(2.0 * sphere.radius_m));
  out.numbers<float>(std::array{sphere.rgb.x(), sphere.rgb.y(), sphere.rgb.z(), 1.0});
  out.time(lifetime_ns);
  out.flag(false);  // frame_locked
  out.count(0);     // points
  out.count(0);     // colors
  if (out.version() == RosVersion::kTwo) {
    out.text("");  // texture_resource
    out.header({});
    out.text("");  // the format of texture
    out.count(0);  // its data
    out.count(0);  // uv_coordinates
  }
  out.text("");  // text
  out.text("");  // mesh_resource
  if (out.version() == RosVersion::kTwo) {
    out.text("");  // the file name of mesh_file
    out.count(0);  // its data
  }
  out.flag(false);  // mesh_use_embedded_materials
}

}  // namespace

std::string ros_image(RosVersion version, const RosHeader& header, const cv::Mat& picture) {
  const cv::Mat whole = picture.isContinuous() ? picture : picture.clone();
  const std::size_t bytes = whole.total() * whole.elemSize();
  RosEncoder out(version);
  constexpr std::size_t kRest = 256;
  out.expect(bytes + kRest);
  out.header(header);
  out.numbers<std::uint32_t>(std::array{whole.rows, whole.cols});
  out.text("bgr8");
  out.flag(false);  // is_bigendian
  out.count(static_cast<std::size_t>(whole.cols) * whole.elemSize());
  out.count(bytes);
  out.block(whole.ptr<char>(), bytes);
  return out.take();
}

std::string ros_camera_info(RosVersion version, const RosHeader& header, const vision::StereoRig& rig,
                            vision::Side side) {
  const vision::Intrinsics& camera = rig.intrinsics;
  const vision::Distortion& lens = rig.distortion;
  const double fx = camera.focal_px, fy = fx * lens.pixel_aspect;
  const double shift = side == vision::Side::kRight ? -fx * rig.baseline_m : 0.0;
  RosEncoder out(version);
  out.header(header);
  out.numbers<std::uint32_t>(std::array{camera.height_px, camera.width_px});
  out.text("plumb_bob");
  const std::array d = {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3};
  out.count(d.size());
  out.numbers<double>(d);
  out.numbers<double>(std::array{fx, 0.0, camera.cx_px, 0.0, fy, camera.cy_px, 0.0, 0.0, 1.0});
  out.numbers<double>(std::array{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0});
  out.numbers<double>(
      std::array{fx, 0.0, camera.cx_px, shift, 0.0, fy, camera.cy_px, 0.0, 0.0, 0.0, 1.0, 0.0});
  out.numbers<std::uint32_t>(std::array{0, 0});        // binning: none
  out.numbers<std::uint32_t>(std::array{0, 0, 0, 0});  // region of interest: all of it
  out.flag(false);
  return out.take();
}

std::string ros_odometry(RosVersion version, const RosTransform& pose, double v_mps, double w_radps) {
  constexpr std::array<double, 36> kNone = {};
  RosEncoder out(version);
  out.header(pose.header);
  out.text(pose.child_frame);
  out.pose(pose.parent_from_child);
  out.numbers<double>(kNone);
  out.numbers<double>(std::array{v_mps, 0.0, 0.0, 0.0, 0.0, w_radps});
  out.numbers<double>(kNone);
  return out.take();
}

std::string ros_pose(RosVersion version, const RosHeader& header, const Eigen::Isometry3d& pose) {
  RosEncoder out(version);
  out.header(header);
  out.pose(pose);
  return out.take();
}

std::string ros_planar_pose(RosVersion version, const slam::Pose& pose) {
  RosEncoder out(version);
  out.numbers<double>(std::array{pose.x_m, pose.y_m, pose.heading_rad});
  return out.take();
}

std::string ros_transforms(RosVersion version, std::span<const RosTransform> transforms) {
  RosEncoder out(version);
  out.count(transforms.size());
  for (const RosTransform& transform : transforms) {
    out.header(transform.header);
    out.text(transform.child_frame);
    out.pose(transform.parent_from_child);
  }
  return out.take();
}

std::string ros_spheres(RosVersion version, const RosHeader& header, std::span<const RosSphere> spheres,
                        std::int64_t lifetime_ns) {
  RosEncoder out(version);
  out.count(spheres.size());
  for (const RosSphere& sphere : spheres) add_sphere(out, header, sphere, lifetime_ns);
  return out.take();
}

std::string ros_points(RosVersion version, const RosHeader& header, std::span<const std::string_view> columns,
                       std::span<const RosPoint> points) {
  constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
  constexpr std::size_t kPlaceBytes = 16;  // three of four bytes, and as many to where numbers of eight begin
  const std::size_t point_bytes = kPlaceBytes + columns.size() * sizeof(double);
  RosEncoder out(version);
  const auto field = [&out](std::string_view name, std::size_t offset, std::uint8_t type) {
    out.text(name);
    out.count(offset);
    out.number(type);
    out.count(1);
  };
  out.header(header);
  out.count(1);  // height
  out.count(points.size());
  out.count(kAxes.size() + columns.size());
  for (std::size_t i = 0; i < kAxes.size(); ++i) field(kAxes[i], i * sizeof(float), kRosFloat32);
  for (std::size_t i = 0; i < columns.size(); ++i)
    field(columns[i], kPlaceBytes + i * sizeof(double), kRosFloat64);
  out.flag(false);  // is_bigendian
  out.count(point_bytes);
  out.count(point_bytes * points.size());
  out.count(point_bytes * points.size());  // of data
  for (const RosPoint& point : points) {
    const std::array place = {static_cast<float>(point.place_m.x()), static_cast<float>(point.place_m.y()),
                              0.0F, 0.0F};
    static_assert(sizeof(place) == kPlaceBytes);
    out.block(reinterpret_cast<const char*>(place.data()), kPlaceBytes);
    out.block(reinterpret_cast<const char*>(point.numbers.data()), point.numbers.size() * sizeof(double));
  }
  out.flag(true);  // is_dense
  return out.take();
}

}  // namespace stereobench::harness
