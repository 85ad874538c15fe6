#include "harness/drive/frame_choice.h"

#include <charconv>
#include <stdexcept>

#include <fmt/format.h>

#include "worlds/yaml/excerpt.h"

namespace stereobench::harness {
namespace {

std::optional<std::size_t> whole_number(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// What stands before a separator and what after it; nothing after it where there is none.
std::pair<std::string_view, std::optional<std::string_view>> split(std::string_view text,
                                                                   std::string_view separator) {
  const std::size_t place = text.find(separator);
  if (place == std::string_view::npos) return {text, std::nullopt};
  return {text.substr(0, place), text.substr(place + separator.size())};
}

}  // namespace

FrameChoice parse_frames(std::string_view text) {
  const auto [range, stride_text] = split(text, ":");
  const auto [first_text, last_text] = split(range, "..");
  const auto first = whole_number(first_text);
  const auto last = last_text ? whole_number(*last_text) : first;
  const auto stride = stride_text ? whole_number(*stride_text) : std::optional<std::size_t>(1);
  const bool is_range = first && last && *first <= *last && stride && *stride > 0;
  if (!is_range || (stride_text && !last_text))
    throw std::runtime_error(
        fmt::format("--frames: expected frames such as 7, 0..90 or 0..90:10, every tenth of them (got '{}')",
                    worlds::excerpt(text)));
  return {*first, last, *stride};
}

FrameChoice frames_of_drive(const FrameChoice& choice, std::size_t steps) {
  FrameChoice frames = choice;
  const std::size_t last = choice.last.value_or(steps - 1);
  if (choice.first >= steps || last >= steps)
    throw std::runtime_error(fmt::format("--frames: the drive has the frames 0 to {} (got {}..{})", steps - 1,
                                         choice.first, last));
  frames.last = last - (last - choice.first) % choice.stride;
  if (frames.last == frames.first) frames.stride = 1;
  return frames;
}

std::string text_of(const FrameChoice& choice) {
  const std::string range = fmt::format("{}..{}", choice.first, *choice.last);
  return choice.stride == 1 ? range : fmt::format("{}:{}", range, choice.stride);
}

}  // namespace stereobench::harness
