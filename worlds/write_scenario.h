/// Scenarios written out, so that what a generator made can be edited.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stereobench::worlds {

/// The lines of a scenario with its overrides put in place, mesh files by their absolute paths and, where
/// there is a generator, its balls, walls and tour in its stead. Comments are lost. Read again it is the same
/// world and the same drive, bit for bit.
/// @throws std::runtime_error as read_scenario
std::string written_out(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

}  // namespace stereobench::worlds
