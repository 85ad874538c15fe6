#include "harness/experiment/key_kind.h"

#include "harness/experiment/experiment.h"
#include "worlds/yaml/yaml_document.h"

namespace stereobench::harness {

bool takes_whole_numbers(std::string_view path) {
  const worlds::Key* const key = worlds::declared_key(experiment_keys(), path);
  return key != nullptr && key->kind == worlds::ValueKind::kWhole;
}

}  // namespace stereobench::harness
