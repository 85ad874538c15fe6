/// What commands say to people at their end, and what they keep to themselves.
#pragma once

#include <string_view>

#include <CLI/CLI.hpp>

namespace stereobench::harness {

/// Adds --quiet: from then on standard output goes nowhere and no progress is shown. Errors and warnings
/// remain.
void add_quiet_option(CLI::App& command);

/// Prints a text for people. With --quiet only its lines that begin with "warning: " are shown, on standard
/// error.
void say(std::string_view text);

/// Prints a verdict: what gate_report says, or what `compare` found. When the command is quiet, one that is
/// not good is said on standard error.
void say_gates(std::string_view report, bool broken);

}  // namespace stereobench::harness
