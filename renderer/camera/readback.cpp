#include "renderer/camera/readback.h"

#include <algorithm>
#include <bit>

#include <opencv2/core/hal/intrin.hpp>

#include "renderer/camera/camera_view.h"

namespace stereobench::renderer {
namespace {

constexpr int kBandRows = 32;  // what is read at once stays in the processor's cache

void store_identities(std::uint8_t* id, const cv::v_uint8x16& identities) {
  cv::v_store(id, identities);
}

/// In numbers of 16 bits an identity is 257 times itself.
void store_identities(std::uint8_t* id, const cv::v_uint16x8& identities) {
  cv::v_pack_store(id, identities >> 8);
}

/// @tparam Lanes numbers of the pixels that are looked at together
template <class Lanes>
void split_row(const cv::Mat& pixels, RenderedImage& frame, int row) {
  using Number = typename Lanes::lane_type;
  const auto* from = pixels.ptr<Number>(row);
  auto* colour = frame.colour.ptr<Number>(row);
  std::uint8_t* id = frame.ball_id.ptr(row);
  int i = 0;
  for (; i + Lanes::nlanes <= pixels.cols; i += Lanes::nlanes) {
    Lanes blue, green, red, identities;
    cv::v_load_deinterleave(from + 4 * i, blue, green, red, identities);
    cv::v_store_interleave(colour + 3 * i, blue, green, red);
    store_identities(id + i, identities);
  }
  for (; i < pixels.cols; ++i) {
    std::copy_n(from + 4 * i, 3, colour + 3 * i);
    id[i] = static_cast<std::uint8_t>(from[4 * i + 3] >> (8 * sizeof(Number) - 8));
  }
}

void row_to_metres(float* depth, int count, float near_m) {
  const cv::v_float32x4 near = cv::v_setall_f32(near_m);
  int i = 0;
  for (; i + cv::v_float32x4::nlanes <= count; i += cv::v_float32x4::nlanes) {
    cv::v_store(depth + i, near / cv::v_load(depth + i));
  }
  for (; i < count; ++i) depth[i] = near_m / depth[i];
}

}  // namespace

void split_colour_and_id(const cv::Mat& pixels, RenderedImage& frame) {
  const bool is_fine = pixels.depth() == CV_16U;
  frame.colour.create(pixels.size(), is_fine ? CV_16UC3 : CV_8UC3);
  frame.ball_id.create(pixels.size(), CV_8UC1);
  for (int row = 0; row < pixels.rows; ++row) {
    if (is_fine)
      split_row<cv::v_uint16x8>(pixels, frame, row);
    else
      split_row<cv::v_uint8x16>(pixels, frame, row);
  }
}

void depth_to_metres(cv::Mat& depth, float near_m) {
  for (int row = 0; row < depth.rows; ++row) row_to_metres(depth.ptr<float>(row), depth.cols, near_m);
}

cv::Mat read_primitives(const Gl& gl, const cv::Range& columns, const cv::Range& rows) {
  static_assert(std::endian::native == std::endian::little, "the lowest byte is written first");
  cv::Mat primitives(rows.size(), columns.size(), CV_32SC1);
  gl.ReadPixels(columns.start, rows.start, primitives.cols, primitives.rows, GL_RGBA, GL_UNSIGNED_BYTE,
                primitives.data);
  return primitives;
}

void read_part(const Gl& gl, const cv::Point& origin, const cv::Rect& part, RenderedImage& frame) {
  if (part.empty()) return;
  const bool is_fine = frame.colour.depth() == CV_16U;
  cv::Mat pixels(std::min(kBandRows, part.height), part.width, is_fine ? CV_16UC4 : CV_8UC4);
  for (int row = part.y; row < part.br().y; row += kBandRows) {
    const cv::Rect band_px(part.x, row, part.width, std::min(kBandRows, part.br().y - row));
    const cv::Point first = origin + band_px.tl();
    RenderedImage band{frame.colour(band_px), frame.ball_id(band_px), frame.depth_m(band_px)};
    const cv::Mat read = pixels.rowRange(0, band_px.height);
    gl.ReadPixels(first.x, first.y, band_px.width, band_px.height, GL_RGBA,
                  is_fine ? GL_UNSIGNED_SHORT : GL_UNSIGNED_BYTE, read.data);
    split_colour_and_id(read, band);
    gl.PixelStorei(GL_PACK_ROW_LENGTH, frame.depth_m.cols);
    gl.ReadPixels(first.x, first.y, band_px.width, band_px.height, GL_DEPTH_COMPONENT, GL_FLOAT,
                  band.depth_m.data);
    gl.PixelStorei(GL_PACK_ROW_LENGTH, 0);
    depth_to_metres(band.depth_m, static_cast<float>(kNear_m));
  }
}

RenderedImage blank_frame(const cv::Size& size_px, LightDepth depth, PicturePool& pool) {
  return {pool.take(size_px, depth == LightDepth::kEightBits ? CV_8UC3 : CV_16UC3),
          pool.take(size_px, CV_8UC1), pool.take(size_px, CV_32FC1)};
}

}  // namespace stereobench::renderer
