/// One seed's data set, rendered: the unit of work that `render` spreads over processes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/dataset/formats/format_registry.h"
#include "harness/dataset/truth_request.h"
#include "harness/drive/frame_choice.h"
#include "harness/drive/recording.h"
#include "harness/experiment/types.h"
#include "renderer/types.h"

namespace stereobench::harness {

/// A data set that is wanted.
struct RenderTask {
  const Experiment* experiment = nullptr;
  std::uint64_t seed = 0;
  const DatasetFormat* format = nullptr;
  FrameChoice frames;  ///< as of frames_of_drive
  TruthRequest truth;
  renderer::Backend backend = renderer::Backend::kOsmesa;
  std::filesystem::path folder;
  nlohmann::ordered_json identity;  ///< of RenderedDataset
};

/// What became of it.
struct RenderedSeed {
  long pairs = 0;                   ///< stereo pairs of the data set; 0 where it was complete
  bool was_complete = false;        ///< there was nothing to do
  std::vector<std::string> spoilt;  ///< files that were not as they had been written, and are again
  CoarseBlur blur;
};

/// Renders data sets in `jobs` processes at a time, with a progress line for people. One that is complete is
/// left as it is, one that was interrupted is gone on with. The files' bytes do not depend on `jobs`.
/// @param what is shown on the progress line
/// @return one for each task, in their order
/// @throws std::runtime_error as record and RenderedDataset; RunCrash when a detector or a process fails.
///   What is finished stays.
std::vector<RenderedSeed> render_seeds(const std::vector<RenderTask>& tasks, int jobs,
                                       const std::string& what);

}  // namespace stereobench::harness
