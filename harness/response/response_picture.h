/// A response as a picture.
#pragma once

#include <string>

#include "harness/response/response_fit.h"

namespace stereobench::harness {

/// Draws the errors and their laws on logarithmic axes, with knees; below, the errors over the bound; below
/// that, the sentences. Level 0 stands before a break of the axis.
/// @return the bytes of a PNG file; the same for an equal fit
std::string draw_response_picture(const ResponseFit& fit, const std::string& title);

}  // namespace stereobench::harness
