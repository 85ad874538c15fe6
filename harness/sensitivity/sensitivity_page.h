/// A study of sensitivity on a page of results.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/page/page.h"
#include "harness/sensitivity/sensitivity.h"

namespace stereobench::harness {

/// The indices as a table and as a chart, and what is to be known about them.
/// @param words of the command line; empty: none is shown
std::vector<Block> sensitivity_blocks(const Sensitivity& study, std::span<const std::string> words);

/// The blocks as a page.
Page sensitivity_page(const Sensitivity& study, std::span<const std::string> words);

}  // namespace stereobench::harness
