#include "renderer/pictures/tiff_memory.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace stereobench::renderer {
namespace {

constexpr tmsize_t kMostMemory = tmsize_t{1} << 30U;  // of one piece: a damaged file may claim anything

using TiffOptions = std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)>;

tmsize_t take(thandle_t handle, void* to, tmsize_t size) {
  auto& input = *static_cast<TiffInput*>(handle);
  const std::size_t left = input.bytes.size() - std::min(input.at, input.bytes.size());
  const std::size_t taken = std::min(static_cast<std::size_t>(size), left);
  if (taken > 0) std::copy_n(input.bytes.data() + input.at, taken, static_cast<std::uint8_t*>(to));
  input.at += taken;
  return static_cast<tmsize_t>(taken);
}

tmsize_t put_nothing(thandle_t, void*, tmsize_t) {
  return 0;
}

toff_t seek(thandle_t handle, toff_t offset, int from) {
  auto& input = *static_cast<TiffInput*>(handle);
  const std::size_t begin = from == SEEK_SET ? 0 : from == SEEK_CUR ? input.at : input.bytes.size();
  return input.at = begin + offset;
}

int close_nothing(thandle_t) {
  return 0;
}

toff_t size_of(thandle_t handle) {
  return static_cast<TiffInput*>(handle)->bytes.size();
}

/// libtiff reads back what it has written.
tmsize_t take_back(thandle_t handle, void* to, tmsize_t size) {
  auto& output = *static_cast<TiffOutput*>(handle);
  const std::size_t left = output.bytes.size() - std::min(output.at, output.bytes.size());
  const std::size_t taken = std::min(static_cast<std::size_t>(size), left);
  std::copy_n(output.bytes.data() + output.at, taken, static_cast<char*>(to));
  output.at += taken;
  return static_cast<tmsize_t>(taken);
}

tmsize_t put(thandle_t handle, void* from, tmsize_t size) {
  auto& output = *static_cast<TiffOutput*>(handle);
  const std::size_t end = output.at + static_cast<std::size_t>(size);
  output.bytes.resize(std::max(output.bytes.size(), end));
  std::copy_n(static_cast<const char*>(from), size, output.bytes.data() + output.at);
  output.at = end;
  return size;
}

toff_t seek_output(thandle_t handle, toff_t offset, int from) {
  auto& output = *static_cast<TiffOutput*>(handle);
  const std::size_t begin = from == SEEK_SET ? 0 : from == SEEK_CUR ? output.at : output.bytes.size();
  return output.at = begin + offset;
}

toff_t size_of_output(thandle_t handle) {
  return static_cast<TiffOutput*>(handle)->bytes.size();
}

int complain(TIFF*, void* input, const char*, const char* format, va_list values) {
  char text[200];
  std::vsnprintf(text, sizeof text, format, values);
  static_cast<TiffInput*>(input)->complaint = text;
  return 1;
}

int pass_over(TIFF*, void*, const char*, const char*, va_list) {
  return 1;
}

}  // namespace

OpenTiff open_tiff(TiffInput& input) {
  const TiffOptions options(TIFFOpenOptionsAlloc(), TIFFOpenOptionsFree);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kMostMemory);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), complain, &input);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), pass_over, nullptr);
  return {TIFFClientOpenExt("", "rm", &input, take, put_nothing, seek, close_nothing, size_of, nullptr,
                            nullptr, options.get()),
          TIFFClose};
}

OpenTiff open_tiff(TiffOutput& output) {
  return {TIFFClientOpen("", "wl", &output, take_back, put, seek_output, close_nothing, size_of_output,
                         nullptr, nullptr),
          TIFFClose};
}

}  // namespace stereobench::renderer
