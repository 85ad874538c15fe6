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
};

/// A part of some things: those whose properties lie within limits.
struct Slice {
  std::vector<std::string> conditions;  ///< e.g. "range 4.1 to 6 m"; none: all of them
  std::size_t things = 0;               ///< that lie within
  std::size_t marked = 0;               ///< of these, the marked ones
  std::size_t all_things = 0;
  std::size_t all_marked = 0;
};

/// Finds the smallest part that holds nine tenths of the marked things.
///
/// Greedily: of all intervals of a property's octiles the one that leaves the fewest things is taken, then
/// the next one within it, of up to three properties. One is only taken that leaves at most two thirds of the
/// things, and that chance would hardly find: the hypergeometric probability of so many marked ones among so
/// few, times the number of intervals that were looked at, is below 1 %.
/// @param marked one a thing
/// @throws std::invalid_argument when a property has not one value a thing
Slice find_slice(std::span<const Property> properties, const std::vector<bool>& marked);

}  // namespace stereobench::harness
