/// Renders in a process of its own, so that tests can set its environment: the number of rasteriser threads,
/// the width of vectors and what the CPU is said to have are read once a process.
///
/// usage: frame_writer BACKEND ROOMS
/// Writes the frames of random rooms 0 to ROOMS - 1 to its output, as frames.h reads them.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "renderer/backend.h"
#include "tests/renderer/frames.h"

int main(int argc, char** argv) {
  using namespace stereobench::renderer;
  if (argc != 3) return 2;
  try {
    for (unsigned long room = 0; room < std::strtoul(argv[2], nullptr, 10); ++room) {
      test::write(test::room_frame(room, backend_named(argv[1])), stdout);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "frame_writer: %s\n", error.what());
    return 1;
  }
}
