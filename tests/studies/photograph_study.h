/// How many balls of photographs are found and trusted, with colours learned from four of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "tests/studies/photograph_score.h"
#include "tests/studies/verdict.h"

namespace stereobench {

/// Takes pictures and looks at them, in processes of their own.
/// @param pictures folder for what was found, drawn; empty: nothing is drawn
PhotographScore study_photographs(std::span<const std::uint64_t> seeds, int jobs,
                                  const std::filesystem::path& pictures = {});

/// The score against what is asked for.
Section section_of(const PhotographScore& score);

}  // namespace stereobench
