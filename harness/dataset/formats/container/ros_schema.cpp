#include "harness/dataset/formats/container/ros_schema.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace stereobench::harness {
namespace {

struct RosPart {
  std::string_view name;
  std::string_view fields;   ///< of ROS 1
  std::string_view fields2;  ///< of ROS 2, where they differ
};

constexpr std::string_view kMarkerConstants =
    "ARROW=0 CUBE=1 SPHERE=2 CYLINDER=3 LINE_STRIP=4 LINE_LIST=5 CUBE_LIST=6 SPHERE_LIST=7 POINTS=8 "
    "TEXT_VIEW_FACING=9 MESH_RESOURCE=10 TRIANGLE_LIST=11 ADD=0 MODIFY=0 DELETE=2 DELETEALL=3";

constexpr auto kParts = std::to_array<RosPart>({
    {"std_msgs/Header", "uint32 seq\ntime stamp\nstring frame_id\n",
     "builtin_interfaces/Time stamp\nstring frame_id\n"},
    {"builtin_interfaces/Time", "", "int32 sec\nuint32 nanosec\n"},
    {"builtin_interfaces/Duration", "", "int32 sec\nuint32 nanosec\n"},
    {"std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n", ""},
    {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n", ""},
    {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n", ""},
    {"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n", ""},
    {"geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n", ""},
    {"geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose pose\nfloat64[36] covariance\n", ""},
    {"geometry_msgs/Twist", "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n", ""},
    {"geometry_msgs/TwistWithCovariance", "geometry_msgs/Twist twist\nfloat64[36] covariance\n", ""},
    {"geometry_msgs/Transform", "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n", ""},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n", ""},
    {"geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n", ""},
    {"sensor_msgs/RegionOfInterest",
     "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n", ""},
    {"sensor_msgs/Image",
     "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\n"
     "uint8[] data\n",
     ""},
    {"sensor_msgs/CompressedImage", "", "std_msgs/Header header\nstring format\nuint8[] data\n"},
    {"sensor_msgs/CameraInfo",
     "std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] D\n"
     "float64[9] K\nfloat64[9] R\nfloat64[12] P\nuint32 binning_x\nuint32 binning_y\n"
     "sensor_msgs/RegionOfInterest roi\n",
     "std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] d\n"
     "float64[9] k\nfloat64[9] r\nfloat64[12] p\nuint32 binning_x\nuint32 binning_y\n"
     "sensor_msgs/RegionOfInterest roi\n"},
    {"nav_msgs/Odometry",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
     "geometry_msgs/TwistWithCovariance twist\n",
     ""},
    {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n", ""},
    {"visualization_msgs/UVCoordinate", "", "float32 u\nfloat32 v\n"},
    {"visualization_msgs/MeshFile", "", "string filename\nuint8[] data\n"},
    {"visualization_msgs/Marker",
     "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\ngeometry_msgs/Pose pose\n"
     "geometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\nduration lifetime\nbool frame_locked\n"
     "geometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\nstring text\nstring mesh_resource\n"
     "bool mesh_use_embedded_materials\n",
     "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\ngeometry_msgs/Pose pose\n"
     "geometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\nbuiltin_interfaces/Duration lifetime\n"
     "bool frame_locked\ngeometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\n"
     "string texture_resource\nsensor_msgs/CompressedImage texture\n"
     "visualization_msgs/UVCoordinate[] uv_coordinates\nstring text\nstring mesh_resource\n"
     "visualization_msgs/MeshFile mesh_file\nbool mesh_use_embedded_materials\n"},
    {"visualization_msgs/MarkerArray", "visualization_msgs/Marker[] markers\n", ""},
    {"geometry_msgs/Pose2D", "float64 x\nfloat64 y\nfloat64 theta\n", ""},
    {"sensor_msgs/PointField",
     "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\nuint8 UINT32=6\n"
     "uint8 FLOAT32=7\nuint8 FLOAT64=8\nstring name\nuint32 offset\nuint8 datatype\nuint32 count\n",
     ""},
    {"sensor_msgs/PointCloud2",
     "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\n"
     "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n",
     ""},
});

const RosPart* find_part(std::string_view name) {
  for (const RosPart& part : kParts)
    if (part.name == name) return &part;
  return nullptr;
}

/// The lines of a type: constants, then fields.
std::string lines_of(const RosPart& part, RosVersion version) {
  std::string lines;
  if (part.name == "visualization_msgs/Marker") {
    const char* type = version == RosVersion::kOne ? "uint8" : "int32";
    std::string_view rest = kMarkerConstants;
    while (!rest.empty()) {
      const std::string_view constant = rest.substr(0, rest.find(' '));
      lines += fmt::format("{} {}\n", type, constant);
      rest.remove_prefix(std::min(rest.size(), constant.size() + 1));
    }
  }
  const bool has_own = version == RosVersion::kTwo && !part.fields2.empty();
  return lines.append(has_own ? part.fields2 : part.fields);
}

/// The types that a type's fields are of, in their order, each once, and theirs after them.
void add_needed(const RosPart& part, RosVersion version, std::vector<const RosPart*>& needed) {
  const std::string lines = lines_of(part, version);
  for (std::size_t at = 0; at < lines.size(); at = lines.find('\n', at) + 1) {
    const std::string_view type = std::string_view(lines).substr(at, lines.find_first_of(" [", at) - at);
    const RosPart* const found = find_part(type);
    if (found == nullptr || std::ranges::find(needed, found) != needed.end()) continue;
    needed.push_back(found);
    add_needed(*found, version, needed);
  }
}

struct RosName {
  RosType type;
  std::string_view name;
  std::string_view md5;
};

constexpr auto kNames = std::to_array<RosName>({
    {RosType::kImage, "sensor_msgs/Image", "060021388200f6f0f447d0fcd9c64743"},
    {RosType::kCameraInfo, "sensor_msgs/CameraInfo", "c9a58c1b0b154e0e6da7578cb991d214"},
    {RosType::kOdometry, "nav_msgs/Odometry", "cd5e73d190d741a2f92e81eda573aca7"},
    {RosType::kPose, "geometry_msgs/PoseStamped", "d3812c3cbc69362b77dc0b19b345f8f5"},
    {RosType::kPlanarPose, "geometry_msgs/Pose2D", "938fa65709584ad8e77d238529be13b8"},
    {RosType::kTransforms, "tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec"},
    {RosType::kSpheres, "visualization_msgs/MarkerArray", "d155b9ce5188fbaf89745847fd5882d7"},
    {RosType::kTable, "sensor_msgs/PointCloud2", "1158d486dd51d683ce2f1be655c3c181"},
});

}  // namespace

RosSchema ros_schema(RosType type, RosVersion version) {
  const RosName& row = *std::ranges::find(kNames, type, &RosName::type);
  const RosPart& whole = *find_part(row.name);
  std::vector<const RosPart*> needed;
  add_needed(whole, version, needed);
  std::string definition = lines_of(whole, version);
  for (const RosPart* part : needed)
    definition += fmt::format("{}\nMSG: {}\n{}", std::string(80, '='), part->name, lines_of(*part, version));
  std::string name(row.name);
  if (version == RosVersion::kTwo) name.insert(name.find('/'), "/msg");
  return {name, definition, version == RosVersion::kOne ? std::string(row.md5) : ""};
}

}  // namespace stereobench::harness
