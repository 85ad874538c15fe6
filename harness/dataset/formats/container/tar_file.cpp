#include "harness/dataset/formats/container/tar_file.h"

#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace stereobench::harness {
namespace {

constexpr std::size_t kTarBlock = 512;

/// A field of the header.
struct TarField {
  std::size_t at = 0;
  std::size_t size = 0;
};
constexpr TarField kTarName = {0, 100}, kTarMode = {100, 8}, kTarUser = {108, 8}, kTarGroup = {116, 8},
                   kTarSize = {124, 12}, kTarTime = {136, 12}, kTarSum = {148, 8}, kTarType = {156, 1},
                   kTarMagic = {257, 8}, kTarMajor = {329, 8}, kTarMinor = {337, 8};

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
  set(kTarName, name);
  set(kTarMode, octal(kReadable, kTarMode));
  for (const TarField& field : {kTarUser, kTarGroup, kTarTime, kTarMajor, kTarMinor})
    set(field, octal(0, field));
  set(kTarSize, octal(bytes, kTarSize));
  set(kTarType, "0");
  set(kTarMagic, std::string_view("ustar\00000", kTarMagic.size));
  set(kTarSum, std::string(kTarSum.size, ' '));  // the sum is taken over blanks in its own place
  std::size_t sum = 0;
  for (const char byte : header) sum += static_cast<unsigned char>(byte);
  set(kTarSum, fmt::format("{:06o}{} ", sum, '\0'));
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
