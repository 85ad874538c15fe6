#include "tests/studies/ablation/views.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>

#include <Eigen/LU>

#include "harness/commands/scenario_arguments.h"
#include "harness/detector/detector.h"
#include "harness/vision_scoring/vision_score.h"
#include "tests/vision/hidden_scenes.h"
#include "vision/observe.h"
#include "worlds/scenario/scenario.h"

namespace stereobench::ablation {
namespace {

namespace painter = vision::painter;

constexpr double kPerMilli = 1e3;
constexpr std::uint64_t kMarkedSeed = 900'000;  // of the photographs that are marked; no others are near

double cpu_s() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

template <typename Work>
auto timed(double& sum_s, const Work& work) {
  const double begin_s = cpu_s();
  auto result = work();
  sum_s += cpu_s() - begin_s;
  return result;
}

double root_mean_square(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double value : values) squares += value * value;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// Each value by another weight, so that no two orders or errors have the same sum.
double digest_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
    sum += values[i] * (1.0 + 0.37 * static_cast<double>(i % 101));
  return sum + static_cast<double>(values.size());
}

}  // namespace

DrivenFrames drive(const std::string& scenario, std::vector<std::string> overrides, std::size_t stride,
                   std::uint64_t seed) {
  harness::ScenarioArguments arguments;
  arguments.scenario = STEREOBENCH_SOURCE_DIR "/assets/scenarios/" + scenario + ".yaml";
  arguments.overrides = std::move(overrides);
  arguments.overrides.emplace_back("gates=[]");
  DrivenFrames frames;
  const harness::Experiment experiment = harness::read_experiment(arguments);
  frames.scenario = experiment.scenario;
  frames.world = worlds::world_for_seed(frames.scenario, seed);
  harness::Listeners listeners;
  listeners.is_wanted = [stride](std::size_t step) { return step % stride == 0; };
  listeners.on_frame = [&frames](const harness::FrameEvent& event) {
    frames.steps.push_back(event.step);
    frames.poses.push_back(event.world_from_robot);
    frames.pairs.push_back({event.pair.left.clone(), event.pair.right.clone()});
    frames.truth.push_back({{{}, event.frame.left.ball_id.clone(), event.frame.left.depth_m.clone()},
                            {{}, event.frame.right.ball_id.clone(), event.frame.right.depth_m.clone()}});
  };
  const harness::Detector nobody = [](const harness::DetectorInput&) {
    return std::vector<vision::BallObservation>();
  };
  harness::record(experiment, seed, listeners, renderer::Backend::kSoftware, nobody);
  return frames;
}

HiddenBalls hidden_balls(std::uint64_t seeds) {
  HiddenBalls balls{painter::rig_of_hidden_balls(), {}, {}};
  for (const painter::Hider hider : {painter::Hider::kEdge, painter::Hider::kBall, painter::Hider::kBorder}) {
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      const painter::Scene scene = painter::hidden_scene(hider, balls.rig, seed);
      if (!painter::is_partly_hidden(painter::visible_share(scene, balls.rig, 0))) continue;
      balls.scenes.push_back(scene);
      balls.pairs.push_back(painter::paint(scene, balls.rig));
    }
  }
  return balls;
}

std::vector<photograph::Photograph> photographs(std::uint64_t count) {
  std::vector<photograph::Photograph> taken;
  for (std::uint64_t seed = 0; seed < count; ++seed) taken.push_back(photograph::take(seed));
  return taken;
}

Outcome outcome_of(const DrivenFrames& frames) {
  Outcome outcome;
  harness::VisionScore score;
  const harness::Detector detector = harness::our_detector(harness::detector_setup(frames.scenario));
  for (std::size_t i = 0; i < frames.pairs.size(); ++i) {
    const auto seen = timed(outcome.cpu_s, [&] {
      return detector({frames.steps[i], 0, frames.pairs[i], frames.scenario.believed_rig});
    });
    score += harness::score_match(harness::match_observations(
        {frames.world, frames.scenario.rig, frames.poses[i], frames.truth[i]}, seen));
  }
  outcome.wanted = score.visible;
  outcome.found = score.found;
  outcome.trusted = score.observations;
  outcome.wrong = score.misidentified + score.spurious + score.repeated;
  outcome.rms = kPerMilli * score.range_rms_m();
  outcome.nis = score.mean_normalised_error();
  outcome.digest = digest_of(score.range_errors_m) + digest_of(score.normalised_errors) +
                   static_cast<double>(score.flagged);
  return outcome;
}

Outcome outcome_of(const HiddenBalls& balls) {
  Outcome outcome;
  std::vector<double> errors_mm, normalised;
  vision::ObserverSettings settings;
  settings.noise_sd_levels = painter::kHiddenNoise_levels;
  for (std::size_t i = 0; i < balls.pairs.size(); ++i) {
    const auto seen =
        timed(outcome.cpu_s, [&] { return vision::observe(balls.pairs[i], balls.rig, settings); });
    const painter::PaintedBall& ball = balls.scenes[i].balls[0];
    ++outcome.wanted;
    bool is_found = false;
    for (const vision::BallObservation& observation : seen) {
      if (observation.colour != ball.colour) continue;
      is_found = true;
      if (!observation.trusted()) continue;
      ++outcome.trusted;
      const Eigen::Vector2d error = painter::range_bearing_error(observation, ball, balls.rig);
      const double distance2 = error.dot(observation.range_bearing.covariance.inverse() * error);
      if (std::abs(error.x()) > painter::allowed_range_error_m(ball.in_camera.z())) ++outcome.wrong;
      errors_mm.push_back(kPerMilli * error.x());
      normalised.push_back(0.5 * distance2);
    }
    outcome.found += is_found ? 1 : 0;
  }
  outcome.rms = root_mean_square(errors_mm);
  outcome.nis = mean(normalised);
  outcome.digest = digest_of(errors_mm) + digest_of(normalised) + static_cast<double>(outcome.found);
  return outcome;
}

Outcome outcome_of(const std::vector<photograph::Photograph>& photographs) {
  Outcome outcome;
  const auto palette = palette_of_four_photographs(kMarkedSeed);
  const vision::ColourTable table = vision::table_of(palette, vision::Levels::kSrgb);
  PhotographScore score;
  for (const photograph::Photograph& photograph : photographs) {
    const auto found = timed(outcome.cpu_s, [&] { return look_at(photograph.levels, table); });
    score.add(score_of(photograph, found));
  }
  outcome.wanted = score.whole;
  outcome.found = score.found;
  outcome.trusted = score.trusted;
  outcome.wrong = score.nothings_trusted;
  outcome.rms = root_mean_square(score.errors_px);
  outcome.nis = std::nan("");
  outcome.digest =
      digest_of(score.errors_px) + static_cast<double>(score.nothings + 1000 * score.hidden_trusted);
  return outcome;
}

}  // namespace stereobench::ablation
