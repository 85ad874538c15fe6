#include "harness/detector/detector_registry.h"

#include <algorithm>
#include <deque>
#include <stdexcept>

#include <fmt/format.h>

namespace stereobench::harness {
namespace {

std::deque<DetectorKind>& kinds() {  // a deque: what was found stays where it is
  static std::deque<DetectorKind> all = {{"stereobench", our_detector}};
  return all;
}

}  // namespace

void register_detector(DetectorKind kind) {
  if (kind.name.empty() || find_detector(kind.name))
    throw std::invalid_argument(
        fmt::format("register_detector: '{}' is {}", kind.name, kind.name.empty() ? "no name" : "taken"));
  kinds().push_back(std::move(kind));
}

const DetectorKind* find_detector(std::string_view name) {
  const auto found = std::ranges::find(kinds(), name, &DetectorKind::name);
  return found == kinds().end() ? nullptr : &*found;
}

}  // namespace stereobench::harness
