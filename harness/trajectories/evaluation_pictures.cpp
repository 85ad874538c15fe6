#include "harness/trajectories/evaluation_pictures.h"

#include <fmt/format.h>

#include "harness/report/error_picture.h"
#include "harness/report/map_picture.h"
#include "harness/trajectories/path_view.h"

namespace stereobench::harness {
namespace {

std::string title_of(const Evaluation& evaluation, const std::string& estimate) {
  constexpr std::size_t kMost = 60;
  const std::string name =
      estimate.size() > kMost ? "..." + estimate.substr(estimate.size() - kMost) : estimate;
  return fmt::format("{}, aligned: {}", name, text_of(evaluation.align));
}

}  // namespace

std::string error_picture_of(const Evaluation& evaluation, const std::string& estimate) {
  ErrorCurves curve("estimate");
  curve.add(evaluation.absolute.translation_m);
  return draw_error_picture({.title = title_of(evaluation, estimate),
                             .time_s = times_of(evaluation.pairs),
                             .filters = {curve},
                             .time_axis = evaluation.pairs.stamps_ns.empty() ? "pose" : "time [s]"});
}

std::string path_picture_of(const Evaluation& evaluation, const std::string& estimate) {
  const PathView view = path_view(evaluation);
  return draw_map_picture({.title = title_of(evaluation, estimate),
                           .true_path = view.truth,
                           .estimates = {{"estimate", view.estimate, {}}},
                           .to_the_right = view.to_the_right,
                           .upwards = view.upwards});
}

}  // namespace stereobench::harness
