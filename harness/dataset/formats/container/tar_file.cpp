#include "harness/dataset/formats/container/tar_file.h"

#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "harness/dataset/formats/container/tar_header.h"

namespace stereobench::harness {
namespace {

/// Octal digits that fill a field but for the zero byte at its end.
std::string octal(std::size_t value, const TarField& field) {
  return fmt::format("{:0{}o}", value, field.size - 1);
}

std::string tar_header(std::string_view name, std::size_t bytes) {
  constexpr std::size_t kReadable = 0644;
  std::string header(kTarBlock, '\0');
  const auto set = [&](const TarField& field, std::string_view text) {
    if (text.size() > field.size)
      throw std::invalid_argument(fmt::format("{}: has no place in the header of an archive", text));
    header.replace(field.at, text.size(), text);
  };
  set(tar_field::kName, name);
  set(tar_field::kMode, octal(kReadable, tar_field::kMode));
  for (const TarField& field :
       {tar_field::kUser, tar_field::kGroup, tar_field::kTime, tar_field::kMajor, tar_field::kMinor})
    set(field, octal(0, field));
  set(tar_field::kSize, octal(bytes, tar_field::kSize));
  set(tar_field::kType, "0");
  set(tar_field::kMagic, std::string_view("ustar\00000", tar_field::kMagic.size));
  set(tar_field::kSum,
      std::string(tar_field::kSum.size, ' '));  // the sum is taken over blanks in its own place
  std::size_t sum = 0;
  for (const char byte : header) sum += static_cast<unsigned char>(byte);
  set(tar_field::kSum, fmt::format("{:06o}{} ", sum, '\0'));
  return header;
}

}  // namespace

void TarFile::add(std::string_view name, std::string_view content) {
  file_.append(tar_header(name, content.size()));
  file_.append(content);
  file_.append(std::string((kTarBlock - content.size() % kTarBlock) % kTarBlock, '\0'));
}

void TarFile::finish() {
  file_.append(std::string(2 * kTarBlock, '\0'));
}

}  // namespace stereobench::harness
