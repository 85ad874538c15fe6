/// What things have in common that came out differently.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace stereobench::harness {

/// A property of things.
struct Property {
  std::string name;            ///< e.g. "range"
  std::string unit;            ///< behind its numbers
  std::vector<double> values;  ///< one a thing
  bool is_category = false;    ///< values are names: neighbours have nothing in common
};

/// A part of some things: those whose properties lie within limits.
struct Slice {
  std::vector<std::string> conditions;  ///< e.g. "range 4.1 to 6 m"; none: all of them
  std::vector<std::string> rivals;      ///< conditions that say as much as the first of these
  std::size_t things = 0;               ///< that lie within
  std::size_t marked = 0;               ///< of these, the marked ones
  std::size_t all_things = 0;
  std::size_t all_marked = 0;
};

/// Finds the part that marked things prefer most, of those that hold nine tenths of them.
///
/// Greedily: of all intervals of a property's octiles, or sets of up to four of its categories, the one with
/// the largest likelihood ratio of marks inside and outside is taken, then the next one within it, of up to
/// three properties. One is only taken that leaves at most two thirds of the things, and that chance would
/// hardly find: the hypergeometric probability of so many marked ones among so few, times the number of
/// properties, times the number of intervals or sets that one could have taken, is below 1 %. Rivals are the
/// best ones of other properties with at least a hundredth of the first one's likelihood.
/// @param marked one a thing
/// @throws std::invalid_argument when a property has not one value a thing
Slice find_slice(std::span<const Property> properties, const std::vector<bool>& marked);

}  // namespace stereobench::harness
