/// OpenCV's picture files, loaded when a test first opens one.
///
/// libopencv_imgcodecs brings GDAL and a hundred more libraries, which take 0.13 s to load, and each test is
/// a process of its own. Tests link `picture_codecs`, which has the functions of <opencv2/imgcodecs.hpp>
/// named here and loads `picture_codecs_module` behind them.
#pragma once

#include <opencv2/imgcodecs.hpp>

namespace stereobench::test {

/// What the module gives: OpenCV's own functions.
struct PictureCodecs {
  cv::Mat (*read)(const cv::String&, int);
  bool (*write)(const cv::String&, cv::InputArray, const std::vector<int>&);
  bool (*encode)(const cv::String&, cv::InputArray, std::vector<uchar>&, const std::vector<int>&);
  cv::Mat (*decode)(cv::InputArray, int);
};

}  // namespace stereobench::test
