/// The filters that test suites run over, as values.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "slam/filter_registry.h"

namespace stereobench::slam {

// A filter by its name; one that draws in blocks also with blocks so short that brief drives have many.
struct TestedFilter {
  std::string name;
  int draw_every = 0;  // 0: as the settings say

  Filter make(FilterConfig config, const Pose& start = {}, std::uint64_t seed = 1) const {
    if (draw_every > 0) config.draw_every = draw_every;
    return make_filter(name, config, start, seed);
  }

  // Such a filter needs fewer particles, and more time for each.
  bool draws_in_blocks() const { return name.ends_with("_block"); }

  // The least standard deviation (m and rad) that it takes a motion for.
  double least_sd() const { return name == "smoother" ? 1e-6 : 0.0; }
};

inline void PrintTo(const TestedFilter& filter, std::ostream* out) {
  *out << filter.name;
  if (filter.draw_every > 0) *out << "_of_" << filter.draw_every;
}

inline std::vector<TestedFilter> tested_filters(const std::vector<std::string>& names) {
  std::vector<TestedFilter> filters;
  for (const std::string& name : names) {
    filters.push_back({name});
    if (filters.back().draws_in_blocks()) filters.push_back({name, 3});
  }
  return filters;
}

// Those of the registry that map landmarks.
inline std::vector<TestedFilter> mapping_filters() {
  std::vector<std::string> names;
  for (const FilterKind& kind : filter_kinds())
    if (kind.maps_landmarks) names.emplace_back(kind.name);
  return tested_filters(names);
}

}  // namespace stereobench::slam
