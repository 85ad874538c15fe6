#include "harness/verify/readers/shards/tar_listing.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "harness/dataset/formats/container/tar_header.h"
#include "worlds/yaml/excerpt.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

using Block = std::array<char, kTarBlock>;

std::string_view field_of(const Block& block, const TarField& field) {
  const std::string_view whole(block.data() + field.at, field.size);
  return whole.substr(0, whole.find('\0'));
}

/// Octal digits between blanks.
std::optional<std::uint64_t> octal_in(const Block& block, const TarField& field) {
  constexpr int kOctal = 8;
  std::string_view digits = field_of(block, field);
  while (digits.starts_with(' ')) digits.remove_prefix(1);
  while (digits.ends_with(' ')) digits.remove_suffix(1);
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, kOctal);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

/// The sum of a header's bytes; its own field counts as blanks.
std::uint64_t sum_of(const Block& block) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < kTarBlock; ++i) {
    const bool is_own = i >= tar_field::kSum.at && i < tar_field::kSum.at + tar_field::kSum.size;
    sum += is_own ? static_cast<unsigned char>(' ') : static_cast<unsigned char>(block[i]);
  }
  return sum;
}

/// The value of `path` in an extended header of pax: lines "LENGTH KEY=VALUE".
std::string path_in(std::string_view records) {
  constexpr std::string_view kKey = "path=";
  while (!records.empty()) {
    std::size_t length = 0;
    const auto [end, error] = std::from_chars(records.data(), records.data() + records.size(), length);
    const auto digits = static_cast<std::size_t>(end - records.data());
    if (error != std::errc() || length <= digits + 1 || length > records.size()) return {};
    std::string_view record = records.substr(digits + 1, length - digits - 2);
    if (record.starts_with(kKey)) return std::string(record.substr(kKey.size()));
    records.remove_prefix(length);
  }
  return {};
}

std::string name_in(const Block& block) {
  const std::string_view name = field_of(block, tar_field::kName),
                         prefix = field_of(block, tar_field::kPrefix);
  return prefix.empty() ? std::string(name) : fmt::format("{}/{}", prefix, name);
}

std::ifstream opened(const fs::path& archive) {
  std::ifstream stream(archive, std::ios::binary);
  if (!stream) throw std::runtime_error(fmt::format("{}: cannot be read", archive.string()));
  return stream;
}

/// Reads headers one after the other. @return what is wrong; empty at the archive's proper end
std::string walk_tar(std::ifstream& stream, std::uint64_t bytes, const fs::path& archive,
                     std::vector<TarMember>& members) {
  constexpr std::uint64_t kLongestName = 1 << 16;
  std::string long_name;
  for (std::uint64_t at = 0;;) {
    Block block;
    if (!stream.seekg(static_cast<std::streamoff>(at)).read(block.data(), kTarBlock))
      return fmt::format("the archive is cut short: expected its end, two blocks of zeros, at byte {}", at);
    at += kTarBlock;
    if (std::ranges::all_of(block, [](char byte) { return byte == '\0'; })) return {};
    const auto size = octal_in(block, tar_field::kSize), sum = octal_in(block, tar_field::kSum);
    if (!size || !sum || *sum != sum_of(block))
      return fmt::format("byte {}: expected the header of a member, or its sum is wrong (a flipped bit?)",
                         at - kTarBlock);
    TarMember member = {long_name.empty() ? name_in(block) : long_name, at, *size};
    if (*size > bytes - std::min(bytes, at))
      return fmt::format("the archive is cut short: {} has {} bytes from byte {} on, and the archive {}",
                         member.name, *size, at, bytes);
    at += (*size + kTarBlock - 1) / kTarBlock * kTarBlock;
    const char type = block[tar_field::kType.at];
    const bool is_note = type == 'x' || type == 'L';
    if (is_note && *size <= kLongestName) {
      const std::string text = read_member(archive, member);
      long_name = type == 'x' ? path_in(text) : text.substr(0, text.find('\0'));
    }
    if (is_note || type == 'g') continue;
    long_name.clear();
    if (type == '0' || type == '\0') members.push_back(std::move(member));
  }
}

}  // namespace

TarListing list_tar(const fs::path& archive) {
  std::ifstream stream = opened(archive);
  TarListing listing;
  listing.broken = walk_tar(stream, fs::file_size(archive), archive, listing.members);
  return listing;
}

std::string read_member(const fs::path& archive, const TarMember& member) {
  std::ifstream stream = opened(archive);
  std::string bytes(member.size, '\0');
  if (!stream.seekg(static_cast<std::streamoff>(member.at))
           .read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    throw std::runtime_error(
        fmt::format("{}: {} is cut short", archive.string(), worlds::excerpt(member.name)));
  return bytes;
}

}  // namespace stereobench::harness
