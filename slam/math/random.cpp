#include "slam/math/random.h"

#include <cmath>

#include <Eigen/Core>
#include <Random123/philox.h>

#include "slam/math/elementary.h"

namespace stereobench::slam {
namespace {

using Coefficients = std::array<double, 8>;

/// Wichura's rational approximations: central part, tails, far tails.
constexpr Coefficients kCentreUp = {
    3.3871328727963666080,    1.3314166789178437745e+2, 1.9715909503065514427e+3, 1.3731693765509461125e+4,
    4.5921953931549871457e+4, 6.7265770927008700853e+4, 3.3430575583588128105e+4, 2.5090809287301226727e+3};
constexpr Coefficients kCentreDown = {1.0,
                                      4.2313330701600911252e+1,
                                      6.8718700749205790830e+2,
                                      5.3941960214247511077e+3,
                                      2.1213794301586595867e+4,
                                      3.9307895800092710610e+4,
                                      2.8729085735721942674e+4,
                                      5.2264952788528545610e+3};
constexpr Coefficients kTailUp = {
    1.42343711074968357734, 4.63033784615654529590,    5.76949722146069140550,    3.64784832476320460504,
    1.27045825245236838258, 2.41780725177450611770e-1, 2.27238449892691845833e-2, 7.74545014278341407640e-4};
constexpr Coefficients kTailDown = {1.0,
                                    2.05319162663775882187,
                                    1.67638483018380384940,
                                    6.89767334985100004550e-1,
                                    1.48103976427480074590e-1,
                                    1.51986665636164571966e-2,
                                    5.47593808499534494600e-4,
                                    1.05075007164441684324e-9};
constexpr Coefficients kFarUp = {6.65790464350110377720,    5.46378491116411436990,
                                 1.78482653991729133580,    2.96560571828504891230e-1,
                                 2.65321895265761230930e-2, 1.24266094738807843860e-3,
                                 2.71155556874348757815e-5, 2.01033439929228813265e-7};
constexpr Coefficients kFarDown = {1.0,
                                   5.99832206555887937690e-1,
                                   1.36929880922735805310e-1,
                                   1.48753612908506148525e-2,
                                   7.86869131145613259100e-4,
                                   1.84631831751005468180e-5,
                                   1.42151175831644588870e-7,
                                   2.04426310338993978564e-15};

/// Both polynomials side by side.
double ratio(const Coefficients& up, const Coefficients& down, double x) {
  Eigen::Array2d sums(up[7], down[7]);
  for (std::size_t i = 7; i-- > 0;) sums = sums * x + Eigen::Array2d(up[i], down[i]);
  return sums[0] / sums[1];
}

}  // namespace

double normal_quantile(double probability) {
  const double offset = probability - 0.5;
  if (std::abs(offset) <= 0.425) return offset * ratio(kCentreUp, kCentreDown, 0.180625 - offset * offset);
  const double tail = std::sqrt(-logarithm(offset < 0.0 ? probability : 1.0 - probability));
  const double size =
      tail <= 5.0 ? ratio(kTailUp, kTailDown, tail - 1.6) : ratio(kFarUp, kFarDown, tail - 5.0);
  return offset < 0.0 ? -size : size;
}

RandomStream::RandomStream(std::uint64_t seed, Stream stream, std::uint64_t index)
    : seed_(seed), index_(index), stream_(static_cast<std::uint32_t>(stream)) {}

void RandomStream::refill() {
  const auto low = [](std::uint64_t value) { return static_cast<std::uint32_t>(value); };
  const auto high = [](std::uint64_t value) { return static_cast<std::uint32_t>(value >> 32); };
  // 24 bits of carry above the 32-bit block number: 2^58 numbers before a sequence meets another stream.
  const r123::Philox4x32::ctr_type counter = {
      {low(block_), (stream_ << 24) | high(block_), low(index_), high(index_)}};
  const r123::Philox4x32::key_type key = {{low(seed_), high(seed_)}};
  const r123::Philox4x32::ctr_type out = r123::Philox4x32{}(counter, key);
  words_ = {out[0], out[1], out[2], out[3]};
  ++block_;
  used_ = 0;
}

std::uint32_t RandomStream::bits() {
  if (used_ == words_.size()) refill();
  return words_[used_++];
}

std::uint64_t RandomStream::wide_bits() {
  const std::uint64_t first = bits();
  return (first << 32) | bits();
}

double RandomStream::uniform() {
  return static_cast<double>(wide_bits() >> 11) * 0x1p-53;
}

double RandomStream::normal() {
  return normal_quantile((static_cast<double>(wide_bits() >> 12) + 0.5) * 0x1p-52);  // never 0, never 1
}

}  // namespace stereobench::slam
