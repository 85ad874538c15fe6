/// One seed's data set, rendered: the unit of work that `render` spreads over processes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/dataset/dataset_output.h"
#include "harness/dataset/pictures/picture_change.h"
#include "harness/dataset/truth/truth_request.h"
#include "harness/drive/frame_choice.h"
#include "harness/drive/recording.h"
#include "harness/experiment/types.h"
#include "renderer/types.h"

namespace stereobench::harness {

/// A drive that is to be rendered.
struct RenderTask {
  const Experiment* experiment = nullptr;
  std::uint64_t seed = 0;
  FrameChoice frames;  ///< as of frames_of_drive
  TruthRequest truth;
  renderer::Backend backend = renderer::Backend::kSoftware;
  std::vector<WantedDataset> datasets;  ///< of the same pictures; at least one
  PictureChange change = {};            ///< of all data sets
};

/// What became of a drive.
struct RenderedSeed {
  std::vector<WrittenDataset> datasets;  ///< in the order of the task's
  CoarseBlur blur;
};

/// Renders drives in `jobs` processes at a time, with a progress line for people. A data set that is
/// complete is left as it is, one that was interrupted is gone on with. The files' bytes do not depend on
/// `jobs`.
/// @param what is shown on the progress line
/// @return one for each task, in their order
/// @throws std::runtime_error as record and RenderedDataset; RunCrash when a detector or a process fails.
///   What is finished stays.
std::vector<RenderedSeed> render_seeds(const std::vector<RenderTask>& tasks, int jobs,
                                       const std::string& what);

}  // namespace stereobench::harness
