#include "tests/renderer/frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

#include "renderer/backend.h"
#include "renderer/renderer.h"
#include "tests/renderer/folder.h"
#include "tests/renderer/random_scene.h"

namespace stereobench::renderer::test {
namespace {

template <typename Frame>
auto pictures_of(Frame& frame) {
  return std::array{&frame.left.colour,  &frame.left.ball_id,  &frame.left.depth_m,
                    &frame.right.colour, &frame.right.ball_id, &frame.right.depth_m};
}

bool is_other_colour(const cv::Vec3b& a, const cv::Vec3b& b) {
  return cv::norm(cv::Vec3i(a) - cv::Vec3i(b), cv::NORM_INF) > 1.0;
}

bool is_other_depth(float a, float b, double share) {
  return a != b && !(std::abs(double{a} - double{b}) <= share * std::min(double{a}, double{b}));
}

Difference difference(const RenderedImage& a, const RenderedImage& b, double depth_share) {
  Difference result{.ids = cv::countNonZero(a.ball_id != b.ball_id)};
  for (int row = 0; row < a.colour.rows; ++row) {
    for (int column = 0; column < a.colour.cols; ++column) {
      const cv::Point at(column, row);
      result.colours += is_other_colour(a.colour.at<cv::Vec3b>(at), b.colour.at<cv::Vec3b>(at)) ? 1 : 0;
      result.depths += is_other_depth(a.depth_m.at<float>(at), b.depth_m.at<float>(at), depth_share) ? 1 : 0;
    }
  }
  return result;
}

/// A mesh with a texture, in files of this process alone: a large upright triangle across the room, sprinkled
/// with texels of all sizes.
class PictureOnAWall {
 public:
  explicit PictureOnAWall(std::uint64_t seed) {
    cv::Mat grain(256, 192, CV_8UC3);
    slam::RandomStream random(seed, slam::Stream::kWorld, 2);
    for (cv::Vec3b& texel : cv::Mat_<cv::Vec3b>(grain))
      for (int i = 0; i < 3; ++i) texel[i] = static_cast<std::uint8_t>(random.bits() >> 24U);
    folder_.write("grain.png", grain);
    folder_.write("wall.mtl", "newmtl grain\nKd 1 1 1\nmap_Kd grain.png\n");
    file_ = folder_.write("wall.obj",
                          "mtllib wall.mtl\nusemtl grain\nv -4 -4 0\nv 4 -3 0\nv 0 4 2.4\n"
                          "vt 0 0\nvt 5 0\nvt 0 5\nf 1/1 2/2 3/3\n");
  }

  worlds::MeshInstance mesh() const { return {.file = file_, .material = worlds::Material::kFile}; }

 private:
  Folder folder_;
  std::string file_;
};

StereoFrame blank_frame() {
  const vision::Intrinsics camera = small_rig().intrinsics;
  const cv::Size size(camera.width_px, camera.height_px);
  const auto image = [&] { return RenderedImage{{size, CV_8UC3}, {size, CV_8UC1}, {size, CV_32FC1}}; };
  return {image(), image()};
}

bool read(StereoFrame& frame, std::FILE* file) {
  bool whole = true;
  for (cv::Mat* picture : pictures_of(frame)) {
    whole =
        whole && std::fread(picture->data, picture->elemSize(), picture->total(), file) == picture->total();
  }
  return whole;
}

}  // namespace

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && a.isContinuous() && b.isContinuous() &&
         std::equal(a.datastart, a.dataend, b.datastart);
}

bool same(const StereoFrame& a, const StereoFrame& b) {
  const auto of_a = pictures_of(a);
  const auto of_b = pictures_of(b);
  return std::equal(of_a.begin(), of_a.end(), of_b.begin(),
                    [](const cv::Mat* x, const cv::Mat* y) { return same(*x, *y); });
}

Difference difference(const StereoFrame& a, const StereoFrame& b, double depth_share) {
  const Difference left = difference(a.left, b.left, depth_share);
  const Difference right = difference(a.right, b.right, depth_share);
  return {left.ids + right.ids, left.colours + right.colours, left.depths + right.depths};
}

std::uint64_t hash_of(const StereoFrame& frame) {
  std::uint64_t hash = 14695981039346656037U;
  for (const RenderedImage* image : {&frame.left, &frame.right})
    for (const cv::Mat& picture : {image->colour, image->ball_id, image->depth_m})
      for (int row = 0; row < picture.rows; ++row)
        for (std::size_t i = 0; i < picture.elemSize() * static_cast<std::size_t>(picture.cols); ++i)
          hash = (hash ^ picture.ptr(row)[i]) * 1099511628211U;
  return hash;
}

StereoFrame room_frame(std::uint64_t room, Backend backend) {
  worlds::World world = random_room(room);
  const PictureOnAWall picture(room);
  world.meshes.push_back(picture.mesh());
  return Renderer(world, small_rig(), backend).render(random_pose(room));
}

std::vector<StereoFrame> frames_of_process(const std::string& environment, Backend backend, int rooms) {
  const std::string command =
      fmt::format("env {} '{}' {} {}", environment, STEREOBENCH_FRAME_WRITER, name_of(backend), rooms);
  std::FILE* const output = ::popen(command.c_str(), "r");
  if (output == nullptr) throw std::runtime_error("cannot run: " + command);
  std::vector<StereoFrame> frames;
  for (StereoFrame frame = blank_frame(); read(frame, output); frame = blank_frame()) frames.push_back(frame);
  if (::pclose(output) != 0 || std::ssize(frames) != rooms) throw std::runtime_error("failed: " + command);
  return frames;
}

void write(const StereoFrame& frame, std::FILE* file) {
  for (const cv::Mat* picture : pictures_of(frame)) {
    std::fwrite(picture->data, picture->elemSize(), picture->total(), file);
  }
}

}  // namespace stereobench::renderer::test
