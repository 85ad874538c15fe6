/// The data card of a data set: what a person has to know who finds the folder without this project.
#pragma once

#include <string>

#include "harness/dataset/card/dataset_facts.h"

namespace stereobench::harness {

/// @return Markdown, which has no path, time or host of the machine
std::string data_card(const DatasetFacts& facts);

/// The paragraphs that hold for every picture and table: units, frames, pixels, depth, disparity, what is
/// masked.
std::string conventions_text();

/// What holds of the licence of rendered pictures, where nobody has said more.
inline constexpr const char* kLicenceText =
    "The licence of the program (Apache 2.0) is that of its code, and of the scenarios and meshes that come "
    "with it. The program claims no rights in pictures that it renders. Meshes and textures of a scenario's "
    "own keep their licences, also in pictures.";

}  // namespace stereobench::harness
