#include "harness/frame_replay/frame_name.h"

#include <charconv>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "worlds/yaml/excerpt.h"

namespace stereobench::harness {
namespace {

template <class Number>
std::optional<Number> whole_number_of(std::string_view text) {
  Number number = 0;
  const char* const end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && read == end ? std::optional(number) : std::nullopt;
}

}  // namespace

FrameName parse_frame_name(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon != std::string_view::npos) {
    const auto seed = whole_number_of<std::uint64_t>(text.substr(0, colon));
    const auto step = whole_number_of<std::size_t>(text.substr(colon + 1));
    if (seed && step) return {*seed, *step};
  }
  throw std::runtime_error(
      fmt::format("--frame: expected SEED:STEP, e.g. 0:12 (got '{}')", worlds::excerpt(text)));
}

std::string file_stem(const FrameName& frame) {
  return fmt::format("seed{}_step{:04}", frame.seed, frame.step);
}

}  // namespace stereobench::harness
