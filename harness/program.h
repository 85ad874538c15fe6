/// The program `stereobench`, for those who link detectors of their own into it.
#pragma once

#include <string>
#include <vector>

namespace stereobench::harness {

/// All that `main` does: reads the command line, runs the command, complains in one line.
/// @return the exit code: 0 passed, 1 a gate is broken, 2 bad input, 4 a run or a detector crashed
int run_program(int argc, char** argv);

/// A command in this process, with its errors thrown.
/// @param words of its command line, the first of which is the program's name
/// @return the exit code of what ended without an error: 0 passed, 1 a gate is broken
/// @throws std::runtime_error with one line for bad input; RunCrash where a run or a detector crashed
int run_words(const std::vector<std::string>& words);

}  // namespace stereobench::harness
