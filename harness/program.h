/// The program `stereobench`, for those who link detectors of their own into it.
#pragma once

namespace stereobench::harness {

/// All that `main` does: reads the command line, runs the command, complains in one line.
/// @return the exit code: 0 passed, 1 a gate is broken, 2 bad input, 4 a run or a detector crashed
int run_program(int argc, char** argv);

}  // namespace stereobench::harness
