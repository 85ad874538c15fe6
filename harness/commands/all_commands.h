/// All subcommands together.
#pragma once

#include "harness/commands/commands.h"

namespace stereobench::harness {

/// Adds every subcommand, in the order of the program's help (harness/program.cpp).
void add_commands(CLI::App& program, Action& action);

}  // namespace stereobench::harness
