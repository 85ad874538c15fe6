#include "harness/verify/channel_files.h"

#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/float_picture.h"
#include "harness/io/picture_reader.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

[[noreturn]] void refuse(const fs::path& file, const char* expected) {
  throw std::runtime_error(fmt::format("{}: expected {}", file.string(), expected));
}

/// Levels of 16 bits in units; 0 is none.
cv::Mat in_units(const fs::path& file, double step) {
  const cv::Mat levels = read_exact_png(file);
  if (levels.type() != CV_16UC1) refuse(file, "a PNG of 16 bits and one channel");
  cv::Mat values;
  levels.convertTo(values, CV_32F, step);
  values.setTo(cv::Scalar(kInfinity), levels == 0);
  return values;
}

cv::Mat single_floats(const fs::path& file, bool zero_is_none) {
  cv::Mat values = read_float_picture(file);
  if (values.type() != CV_32FC1) refuse(file, "floats of one channel");
  if (zero_is_none) values.setTo(cv::Scalar(kInfinity), values == 0.0);
  return values;
}

/// KITTI's: (level - 2^15) / 64 px in red and green, blue is 0 for none.
cv::Mat kitti_flow(const fs::path& file, double step) {
  constexpr double kZero = 32768.0;
  const cv::Mat levels = read_exact_png(file);
  if (levels.type() != CV_16UC3) refuse(file, "a PNG of 16 bits and three channels");
  std::vector<cv::Mat> bgr;
  cv::split(levels, bgr);
  std::vector<cv::Mat> shift(2);
  bgr[2].convertTo(shift[0], CV_32F, step, -kZero * step);
  bgr[1].convertTo(shift[1], CV_32F, step, -kZero * step);
  cv::Mat flow;
  cv::merge(shift, flow);
  flow.setTo(cv::Scalar::all(kInfinity), bgr[0] == 0);
  return flow;
}

cv::Mat float_flow(const fs::path& file) {
  const cv::Mat values = read_float_picture(file);
  if (values.type() != CV_32FC3) refuse(file, "floats of three channels");
  std::vector<cv::Mat> bgr;
  cv::split(values, bgr);
  cv::Mat flow;
  cv::merge(std::vector<cv::Mat>{bgr[2], bgr[1]}, flow);
  return flow;
}

}  // namespace

cv::Mat read_channel(const fs::path& file, Channel channel, double step) {
  switch (channel) {
    case Channel::kPicture:
    case Channel::kNextPicture:
      return read_levels(file);
    case Channel::kBallId: {
      cv::Mat ids = read_exact_png(file);
      if (ids.type() != CV_8UC1) refuse(file, "a PNG of 8 bits and one channel");
      return ids;
    }
    case Channel::kFlow:
      return step > 0.0 ? kitti_flow(file, step) : float_flow(file);
    case Channel::kDisparity:
    case Channel::kNextDisparity:
    case Channel::kDepth:
    case Channel::kRange:
      return step > 0.0 ? in_units(file, step) : single_floats(file, channel != Channel::kRange);
  }
  refuse(file, "a known kind of picture");
}

}  // namespace stereobench::harness
