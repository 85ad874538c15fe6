/// Weights of particles, and which of them live on.
#pragma once

#include <vector>

namespace stereobench::slam {

/// Scales log weights so that the weights sum to 1. Weights that have all vanished become equal.
///
/// @param log_weights at least one; minus infinity and NaN are weights of zero
/// @param weights as many; receives the weights themselves
/// @return false when every weight had vanished
bool normalise(std::vector<double>& log_weights, std::vector<double>& weights);

/// Makes all weights one over their number.
void make_equal(std::vector<double>& log_weights, std::vector<double>& weights);

/// @param weights normalised
/// @return 1 / sum of squared weights (eq. 36), in [1, M]
double effective_particles(const std::vector<double>& weights);

/// Systematic resampling: M equally spaced positions behind one uniform number.
///
/// Particle i gets floor(M w_i) or ceil(M w_i) descendants. Positions are counted in integers, so there are
/// always exactly M descendants, whatever rounding does to the sum of the weights.
///
/// @param weights normalised
/// @param uniform in [0, 1)
/// @return the number of descendants of each particle; they sum to M
std::vector<int> systematic_descendants(const std::vector<double>& weights, double uniform);

/// Gives each descendant a place: a particle that lives on keeps its own, copies move into vacant ones.
///
/// @param descendants from systematic_descendants
/// @return for each place the index of the particle that fills it; survivors have ancestor[i] == i
std::vector<int> ancestors_in_place(const std::vector<int>& descendants);

}  // namespace stereobench::slam
