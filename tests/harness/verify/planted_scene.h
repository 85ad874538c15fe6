// Faults that are planted in data sets of COLMAP, COCO, BOP and Nerfstudio.
#pragma once

#include <functional>
#include <ostream>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/harness/verify/planted_set.h"

namespace stereobench::harness {

inline void change_json(const PlantedSet& set, const std::string& file,
                        const std::function<void(nlohmann::ordered_json&)>& change) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(set.text(file));
  change(json);
  set.write(file, json.dump());
}

/// A fault in a format, and what the message says of it.
struct SceneCase {
  const char* name;
  const char* format;
  void (*plant)(const PlantedSet&);
  const char* cause;
};

inline void PrintTo(const SceneCase& planted, std::ostream* out) {
  *out << planted.name << " in " << planted.format;
}

}  // namespace stereobench::harness
