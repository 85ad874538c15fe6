#include "harness/rig_calibration/model_choice.h"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <utility>

#include <boost/math/distributions/fisher_f.hpp>
#include <fmt/format.h>

#include "harness/rig_calibration/rectified_rig.h"

namespace stereobench::harness {
namespace {

constexpr std::size_t kThird = 4;  // k3 among FreeCoefficients

std::string name_of(const RigFitSettings& settings) {
  constexpr std::array<const char*, 5> kCoefficients = {"k1", "k2", "p1", "p2", "k3"};
  std::string name = settings.square_pixels ? "fx = fy" : "fx, fy";
  const char* before = ", ";
  for (std::size_t i = 0; i < kCoefficients.size(); ++i)
    if (settings.lens[i]) name += std::exchange(before, " ") + std::string(kCoefficients[i]);
  return name;
}

/// Nested in the last, the simplest first.
std::vector<RigFitSettings> models_of(const RigFitSettings& simplest, const Compared& compared) {
  std::vector<RigFitSettings> models = {simplest};
  if (compared.k3) {
    models.push_back(simplest);
    models.back().lens[kThird] = true;
  }
  if (!compared.aspect) return models;
  const std::size_t square = models.size();
  for (std::size_t i = 0; i < square; ++i) {
    models.push_back(models[i]);
    models.back().square_pixels = false;
  }
  return models;
}

/// A model's fit, if it can be had.
struct Tried {
  ModelTrial trial;
  std::optional<RigFit> fit;
};

Tried try_model(const std::vector<BoardView>& views, const RigFitSettings& settings) {
  Tried tried{.trial = {.name = name_of(settings)}};
  try {
    const RigFit fit = fit_rig(views, settings);
    rectified_rig(fit, settings.model, settings.width_px, settings.height_px);
    tried.fit = fit;
    tried.trial.rms_px = fit.rms_px;
    tried.trial.aspect_sd = std::max(fit.cameras_sd[0][kAspect], fit.cameras_sd[1][kAspect]);
  } catch (const std::runtime_error& error) {
    tried.trial.refused = error.what();
  }
  return tried;
}

/// Holds a model against one that it is part of.
void test(Tried& tried, const RigFit& full) {
  const long left_out = tried.fit->degrees_of_freedom - full.degrees_of_freedom;
  if (left_out <= 0) return;
  const double spread = full.clustering * full.squares_px2 / static_cast<double>(full.degrees_of_freedom);
  const double lost = std::max(tried.fit->squares_px2 - full.squares_px2, 0.0);
  tried.trial.f = lost / static_cast<double>(left_out) / spread;
  const boost::math::fisher_f law(static_cast<double>(left_out),
                                  static_cast<double>(full.degrees_of_freedom));
  tried.trial.p = boost::math::cdf(boost::math::complement(law, tried.trial.f));
}

bool is_simpler(const Tried* a, const Tried* b) {
  return a->fit->degrees_of_freedom != b->fit->degrees_of_freedom
             ? a->fit->degrees_of_freedom > b->fit->degrees_of_freedom
             : a->fit->squares_px2 < b->fit->squares_px2;
}

}  // namespace

RigFitSettings fullest(RigFitSettings settings, const Compared& compared) {
  if (compared.aspect) settings.square_pixels = false;
  if (compared.k3) settings.lens[kThird] = true;
  return settings;
}

ModelChoice choose_model(const std::vector<BoardView>& views, const RigFitSettings& settings,
                         const Compared& compared) {
  std::vector<Tried> all;
  for (const RigFitSettings& model : models_of(settings, compared)) all.push_back(try_model(views, model));
  std::vector<Tried*> had;
  for (Tried& tried : all)
    if (tried.fit) had.push_back(&tried);
  if (had.empty()) throw std::runtime_error(all.front().trial.refused);
  std::sort(had.begin(), had.end(), is_simpler);
  const RigFit& full = *had.back()->fit;
  for (Tried* tried : had) test(*tried, full);
  Tried& taken =
      **std::find_if(had.begin(), had.end(), [](const Tried* t) { return !(t->trial.p < kRejected); });
  taken.trial.taken = true;
  ModelChoice choice{.fit = *taken.fit};
  for (Tried& tried : all) choice.trials.push_back(tried.trial);
  return choice;
}

}  // namespace stereobench::harness
