/// stereobench: an offscreen-rendered stereo simulation testbench. See README.md.
#include "harness/program.h"

int main(int argc, char** argv) {
  return stereobench::harness::run_program(argc, argv);
}
