/// From the framebuffer's bytes to pictures, identities and metres.
#pragma once

#include "renderer/camera/picture_pool.h"
#include "renderer/gl/gl.h"
#include "renderer/types.h"

namespace stereobench::renderer {

/// Splits the shader's four numbers of each pixel into colour and identity.
/// @param pixels CV_8UC4: blue, green, red, identity; or CV_16UC4, all in steps of 1/257
void split_colour_and_id(const cv::Mat& pixels, RenderedImage& frame);

/// Turns GL's depth n / Z into Z, in place; 0, where nothing was drawn, becomes +inf.
/// @param depth CV_32FC1
void depth_to_metres(cv::Mat& depth, float near_m);

/// Reads some rows of one camera's part of the framebuffer that is bound, drawn as primitives.
/// @param columns of the camera's part
/// @return CV_32SC1, numbers of primitives.h
cv::Mat read_primitives(const Gl& gl, const cv::Range& columns, const cv::Range& rows);

/// Reads a part of one camera's picture out of the framebuffer that is bound, over what the frame has there.
/// @param origin of the frame in the framebuffer
void read_part(const Gl& gl, const cv::Point& origin, const cv::Rect& part, RenderedImage& frame);

/// A picture with anything in it.
/// @param pool that the pictures' memory is of
RenderedImage blank_frame(const cv::Size& size_px, LightDepth depth, PicturePool& pool);

}  // namespace stereobench::renderer
