#include "renderer/surfaces/edge_smoother.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

namespace stereobench::renderer {
namespace {

constexpr double kSameDepth = 1e-4;  ///< relative; the rasteriser's depths are good to 4e-6 in a room
constexpr double kRounding = 1e-6;   ///< of inverse depths, relative to the largest one of the face
constexpr double kSnap_px = 0.01;    ///< the rasteriser snaps corners: so near a centre may be on either side
constexpr std::size_t kUsualMixes = 16384;

/// The integral of clamp(t, 0, 1) from 0 to t.
double clamp_integral(double t) {
  return t <= 0.0 ? 0.0 : t >= 1.0 ? t - 0.5 : 0.5 * t * t;
}

/// A face as the picture has it: the inverse of planar depth is linear in the pixel's place.
struct Face {
  double at_zero = 0.0, per_column = 0.0, per_row = 0.0;  // 1/m, 1/(m px)
  double rounding = 0.0;  // of the inverse depths that are read, 1/m: a street's far end is as coarse as its
                          // near one
  bool is_low = false;    // lies towards smaller coordinates of the edge's minor axis

  double inverse_depth(const cv::Point& pixel) const {
    return at_zero + per_column * pixel.x + per_row * pixel.y;
  }
};

/// The plane with this normal (of any length) through a point of the camera's frame.
Face face_of(const vision::Intrinsics& camera, const Eigen::Vector3d& normal, const Eigen::Vector3d& point) {
  const Eigen::Vector3d scaled = normal / normal.dot(point);  // 1 / Z = scaled . ray
  Face face;
  face.per_column = scaled.x() / camera.focal_px;
  face.per_row = scaled.y() / camera.focal_px;
  face.at_zero = scaled.z() - face.per_column * camera.cx_px - face.per_row * camera.cy_px;
  double largest = 0.0;
  for (const int column : {0, camera.width_px})
    for (const int row : {0, camera.height_px})
      largest = std::max(largest, face.inverse_depth({column, row}));
  face.rounding = kRounding * std::min(largest, 1.0 / kNear_m);
  return face;
}

/// An edge as a line in the picture, followed along the axis (0: columns, 1: rows) that it is nearer to.
struct EdgeLine {
  int major = 0;
  int first = 0, last = -1;           // of the major coordinate, within the picture
  double at_zero = 0.0, slope = 0.0;  // minor coordinate, px
  std::array<Face, 2> faces;          // where there is one, nobody sees the other

  double minor_at(int k) const { return at_zero + slope * k; }
  cv::Point pixel(int k, int j) const { return major == 0 ? cv::Point(k, j) : cv::Point(j, k); }
};

/// Cuts off what is behind the near plane. @return whether something is left
bool cut_near(Eigen::Vector3d& from, Eigen::Vector3d& to) {
  if (from.z() < kNear_m && to.z() < kNear_m) return false;
  const auto cut = [](Eigen::Vector3d& end, const Eigen::Vector3d& other) {
    if (end.z() < kNear_m) end += (kNear_m - end.z()) / (other.z() - end.z()) * (other - end);
  };
  cut(from, to);
  cut(to, from);
  return true;
}

/// The line of an edge, without its faces. @return with an empty range where it is out of the picture
EdgeLine bare_line(const vision::Intrinsics& camera, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector2d p = vision::project(camera, from), q = vision::project(camera, to);
  const Eigen::Vector2d run = q - p;
  EdgeLine line;
  line.major = std::abs(run.x()) >= std::abs(run.y()) ? 0 : 1;
  const int minor = 1 - line.major;
  const Eigen::Vector2d size(camera.width_px, camera.height_px);
  if (run[line.major] == 0.0 || std::max(p[minor], q[minor]) < 0.0 ||
      std::min(p[minor], q[minor]) > size[minor])
    return line;
  line.slope = run[minor] / run[line.major];
  line.at_zero = p[minor] - line.slope * p[line.major];
  line.first = static_cast<int>(std::ceil(std::max(0.0, std::min(p[line.major], q[line.major]))));
  line.last = static_cast<int>(
      std::floor(std::clamp(std::max(p[line.major], q[line.major]), -1.0, size[line.major] - 1.0)));
  return line;
}

/// @return with an empty range where the edge is out of the picture, or no edge from there
EdgeLine line_of(const SurfaceEdge& edge, const CameraView& view) {
  Eigen::Vector3d from = view.camera_from_world * edge.from_m;
  Eigen::Vector3d to = view.camera_from_world * edge.to_m;
  const Eigen::Vector3d along = to - from;
  const Eigen::Vector3d across = from.cross(to);  // of the plane through the camera and the edge
  if (!cut_near(from, to)) return {};
  EdgeLine line = bare_line(view.intrinsics, from, to);
  if (line.first > line.last) return line;
  for (std::size_t i = 0; i < static_cast<std::size_t>(edge.faces); ++i) {
    const Eigen::Vector3d inner = view.camera_from_world * edge.inner_m[i];
    line.faces[i] = face_of(view.intrinsics, along.cross(inner - from), from);
    line.faces[i].is_low = (across.dot(inner) > 0.0) != (across[1 - line.major] > 0.0);
  }
  const bool goes_on = edge.is_smooth && line.faces[0].is_low != line.faces[1].is_low;
  return goes_on ? EdgeLine{} : line;
}

/// The pairs of pixels that edges divide, of a picture of surfaces alone.
class DividedPairs {
 public:
  explicit DividedPairs(const RenderedImage& frame)
      : frame_(frame), picture_({0, 0}, frame.colour.size()), done_(2 * frame.colour.total()) {
    mixes_.reserve(kUsualMixes);
  }

  void follow(const EdgeLine& line) {
    for (int k = line.first; k <= line.last; ++k) {
      const double at = line.minor_at(k);
      if (!(at > -1.0 && at < std::max(picture_.width, picture_.height))) continue;
      const int low = static_cast<int>(std::floor(at));
      add(line, k, low);
      if (at - low < kSnap_px) add(line, k, low - 1);
      if (low + 1 - at < kSnap_px) add(line, k, low + 1);
    }
  }

  std::vector<EdgeMix> take() { return std::move(mixes_); }

 private:
  /// Adds the pixels `low` and `low` + 1 of the minor axis, if the edge is what divides them.
  void add(const EdgeLine& line, int k, int low) {
    const Pair pair = {line.pixel(k, low), line.pixel(k, low + 1)};
    if (!picture_.contains(pair.lower) || !picture_.contains(pair.higher)) return;
    const double at = line.minor_at(k);
    const auto inverse_depth = divided_at(line, pair, at - low);
    if (!inverse_depth) return;
    const auto done =
        done_.begin() + 2 * (std::ptrdiff_t{picture_.width} * pair.lower.y + pair.lower.x) + line.major;
    if (*done) return;  // edges that lie on each other are one
    *done = true;
    mixes_.push_back({.lower = pair.lower,
                      .higher = pair.higher,
                      .higher_in_lower = static_cast<float>(1.0 - share_low(at, line.slope, low)),
                      .lower_in_higher = static_cast<float>(share_low(at, line.slope, low + 1)),
                      .inverse_depth = *inverse_depth,
                      .step = level(pair.higher) - level(pair.lower)});
  }

  struct Pair {
    cv::Point lower, higher;
  };

  cv::Vec3f level(const cv::Point& pixel) const {
    if (frame_.colour.depth() == CV_16U) return frame_.colour.at<cv::Vec3w>(pixel);
    return frame_.colour.at<cv::Vec3b>(pixel);
  }

  /// The edge divides the pixels if one sees a face that ends here. What the other one sees may be as near as
  /// it likes: the floor at a wall's foot comes nearer by any amount within a pixel.
  /// @param way from the lower pixel's centre to the edge, px
  /// @return the inverse of the edge's depth
  std::optional<double> divided_at(const EdgeLine& line, const Pair& pair, double way) const {
    for (const Face& face : line.faces) {
      const cv::Point& own = face.is_low ? pair.lower : pair.higher;
      const double seen_m = double{frame_.depth_m.at<float>(own)};
      const double expected = face.inverse_depth(own);
      const double off = std::abs(1.0 / seen_m - expected);
      if (!(std::isfinite(seen_m) && off <= kSameDepth * expected + face.rounding)) continue;
      const double at_lower = face.inverse_depth(pair.lower);
      return at_lower + way * (face.inverse_depth(pair.higher) - at_lower);
    }
    return std::nullopt;
  }

  const RenderedImage& frame_;
  cv::Rect picture_;
  std::vector<bool> done_;  // pairs that are mixed already, by their lower pixel and their axis
  std::vector<EdgeMix> mixes_;
};

}  // namespace

double share_low(double at, double slope, int j) {
  const double begin = at - 0.5 * slope - (j - 0.5);
  const double end = at + 0.5 * slope - (j - 0.5);
  if (std::abs(end - begin) < 1e-6) return std::clamp(0.5 * (begin + end), 0.0, 1.0);
  return (clamp_integral(end) - clamp_integral(begin)) / (end - begin);
}

std::vector<EdgeMix> EdgeSmoother::mixes(const CameraView& view, const RenderedImage& surfaces) const {
  DividedPairs pairing(surfaces);
  const auto follow = [&](const SurfaceEdge& edge) { pairing.follow(line_of(edge, view)); };
  for (const EdgeGroup& group : groups_) {
    if (group.run && !can_see(view, *group.run)) continue;
    std::for_each(group.edges.begin(), group.edges.end(), follow);
  }
  if (has_floor_)
    for (const SurfaceEdge& edge : floor_edges(view.centre_in_world())) follow(edge);
  return pairing.take();
}

}  // namespace stereobench::renderer
