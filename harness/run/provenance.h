/// What a result was made from: as much as can be told, so that it can be made again.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/frame_replay/invocation.h"

namespace stereobench::harness {

struct Provenance {
  std::string scenario;                      ///< its lines, with what the command line changed put in place
  std::vector<std::string> set;              ///< what --set and --vary changed: "key=value"
  std::map<std::string, std::string> files;  ///< SHA-256 of each file that the scenario names, by that name
  std::string pixels;                        ///< the renderer's fingerprint; empty without pictures
  std::optional<Invocation> invocation;      ///< with paths of this machine: never compared
};

/// The block `made_from` of run.json: version, hashes, what was changed. No path, host or time that the user
/// did not write.
nlohmann::ordered_json provenance_json(const Provenance& provenance);

/// SHA-256 of the files among a command's words, e.g. of my_detector.py in "python3 my_detector.py"; with a
/// Python script those of all Python files beside it and below, which it may import.
std::map<std::string, std::string> files_of_command(std::string command);

/// What a drive's outcome depends on besides its seed, in one text: the provenance, the program itself, and
/// files that a detector's command names.
/// @param detector the command of a detector's program; empty for ours
std::string basis_of(const Provenance& provenance, const std::string& backend, const std::string& detector);

}  // namespace stereobench::harness
