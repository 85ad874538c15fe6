/// Our own detector as a program of the protocol.
#pragma once

#include <iosfwd>

namespace stereobench::harness {

/// Reads the setup and then frames, and answers each with the balls that the vision stage finds.
/// @throws BadLine when a line is not of protocol.h; std::runtime_error when a picture cannot be read
void serve_detections(std::istream& requests, std::ostream& answers);

}  // namespace stereobench::harness
