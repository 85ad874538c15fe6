/// What tests ask of a picture: where its ink is.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "harness/report/canvas.h"

namespace stereobench::harness {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

inline cv::Mat decoded(const std::string& png) {
  return cv::imdecode(cv::Mat(1, static_cast<int>(png.size()), CV_8UC1, const_cast<char*>(png.data())),
                      cv::IMREAD_COLOR);
}

/// The pixels of a colour, as canvas coordinates of their centres.
inline std::vector<Point> pixels_of(const cv::Mat& image, const Colour& colour, double tolerance = 12.0) {
  std::vector<Point> found;
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      const cv::Vec3b& pixel = image.at<cv::Vec3b>(row, column);
      const double off = std::abs(pixel[0] - 255.0 * colour.blue) +
                         std::abs(pixel[1] - 255.0 * colour.green) + std::abs(pixel[2] - 255.0 * colour.red);
      if (off <= tolerance) found.push_back({column + 0.5, row + 0.5});
    }
  }
  return found;
}

/// How much of a white sheet is covered by black, in pixels.
inline double black_area(const cv::Mat& image) {
  double area = 0.0;
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column)
      area += 1.0 - image.at<cv::Vec3b>(row, column)[1] / 255.0;
  }
  return area;
}

inline Point mean_of(const std::vector<Point>& points) {
  Point sum;
  for (const Point& point : points) {
    sum.x_px += point.x_px / static_cast<double>(points.size());
    sum.y_px += point.y_px / static_cast<double>(points.size());
  }
  return sum;
}

}  // namespace stereobench::harness
