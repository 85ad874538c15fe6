/// How a result was asked for: what it takes to render one of its frames again.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/types.h"

namespace stereobench::harness {

/// Its name beside a result. It has paths of this machine and is not compared.
inline constexpr const char* kInvocation = "invocation.json";

/// A scenario and all that the command line said of it.
struct Invocation {
  std::filesystem::path scenario;  ///< absolute
  /// "key=value": --set, and what other options put in place of filters, seeds and the detector
  std::vector<std::string> overrides;
  std::filesystem::path folder;  ///< from which a detector's command is called
  renderer::Backend backend = renderer::Backend::kSoftware;
};

/// The content of invocation.json.
std::string invocation_text(const Invocation& invocation);

/// The folder of a result whose frames can be rendered again; empty for others, such as those of `slam`.
/// @param result the folder, or its run.json
std::string replayable_folder(const std::filesystem::path& result);

/// Reads how a result was asked for, and checks that the scenario and the files that it names are still those
/// that run.json has the hashes of.
/// @param result the folder that `run` wrote, or its run.json
/// @param scenario where the scenario lies now; empty: where it lay
/// @throws std::runtime_error, one line that says what is missing, what has changed, or what was expected
Invocation read_invocation(const std::filesystem::path& result, const std::filesystem::path& scenario = {});

}  // namespace stereobench::harness
