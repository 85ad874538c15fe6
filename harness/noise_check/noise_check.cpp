#include "harness/noise_check/noise_check.h"

#include <cmath>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/json/cbor.h"
#include "harness/json/json_numbers.h"
#include "harness/process/process_pool.h"
#include "slam/math/elementary.h"

namespace stereobench::slam {
STEREOBENCH_ALL_FIELDS(NoiseEvidence, slope, information, refused)
}  // namespace stereobench::slam

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kQuantile = 3.2905;  ///< of the normal distribution, for 99.9 % on both sides
constexpr double kTolerated = 1.25;   ///< factor on a standard deviation

/// Standard deviation of a factor's logarithm beyond which logs cannot tell: the interval would span a
/// hundredfold.
constexpr double kVague = 0.7;

struct Named {
  const char* key;
  const char* title;
  const char* are;
};
constexpr std::array<Named, slam::kNoiseFactors> kNames = {
    {{"forward_speed", "forward speed", "forward speed is"},
     {"turn_rate", "turn rate", "turn rate is"},
     {"range", "ranges", "ranges are"},
     {"bearing", "bearings", "bearings are"}}};

bool is_off(const NoiseFactor& factor) {
  return factor.low > kTolerated || factor.high < 1.0 / kTolerated;
}

std::string warning_of(const NoiseFactor& factor, const char* are) {
  const bool noisier = factor.factor > 1.0;
  const auto times = [&](double value) { return format_number(noisier ? value : 1.0 / value, 2); };
  return fmt::format("warning: {} {} times as {} as filters are told ({} to {}, 99.9 %)\n", are,
                     times(factor.factor), noisier ? "noisy" : "precise",
                     times(noisier ? factor.low : factor.high), times(noisier ? factor.high : factor.low));
}

}  // namespace

NoiseCheck check_noise(const std::vector<SensorLog>& logs, const slam::FilterConfig& config, int jobs) {
  const auto evidence_at = [&](const slam::LogFactors& factors) {
    slam::NoiseEvidence sum;
    const auto answer = [&](std::size_t k, const std::function<void(double)>&) {
      return bytes_of(slam::noise_evidence(config, logs[k].start, logs[k].steps, factors));
    };
    const auto add = [&](std::size_t, const std::string& bytes) {
      sum += json_of(bytes).get<slam::NoiseEvidence>();
    };
    run_in_order(logs.size(), jobs, answer, add, [](double) {});
    return sum;
  };
  const slam::NoiseFit fit = slam::fit_noise(evidence_at);
  NoiseCheck check{.factors = {}, .logs = logs.size(), .refused = fit.evidence.refused};
  check.converged = fit.converged;
  if (!fit.converged) return check;
  for (int k = 0; k < slam::kNoiseFactors; ++k) {
    const double sd = fit.deviations[k];
    if (!(sd < kVague)) continue;
    const double log = fit.factors[k];
    check.factors[static_cast<std::size_t>(k)] = {slam::exponential(log),
                                                  slam::exponential(log - kQuantile * sd),
                                                  slam::exponential(log + kQuantile * sd)};
  }
  return check;
}

nlohmann::ordered_json noise_json(const NoiseCheck& check) {
  Json json = {{"logs", check.logs}, {"converged", check.converged}, {"refused", check.refused}};
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    const NoiseFactor& factor = check.factors[k];
    json[kNames[k].key] = {
        {"factor", number(factor.factor)}, {"low", number(factor.low)}, {"high", number(factor.high)}};
  }
  return json;
}

std::string noise_table(const NoiseCheck& check) {
  AlignedTable table{
      .header = {fmt::format("noise, by the sightings of {} log{}", check.logs, check.logs == 1 ? "" : "s"),
                 "times what filters are told", "99.9 % interval"}};
  std::string warnings;
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    const NoiseFactor& factor = check.factors[k];
    if (!std::isfinite(factor.factor)) continue;
    table.rows.push_back({kNames[k].title, format_number(factor.factor),
                          fmt::format("{} to {}", format_number(factor.low), format_number(factor.high))});
    if (is_off(factor)) warnings += warning_of(factor, kNames[k].are);
  }
  if (check.logs > 0 && !check.converged)
    return "warning: no noise was found that makes the sightings likely (the search did not converge)\n";
  if (table.rows.empty()) return "";
  return plain_text(table) + warnings;
}

}  // namespace stereobench::harness
