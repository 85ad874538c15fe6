/// Where the header of an archive's member has what (IEEE Std 1003.1, pax, "ustar interchange format"), for
/// those that write and that read it.
#pragma once

#include <cstddef>

namespace stereobench::harness {

/// Headers and contents fill blocks of so many bytes.
inline constexpr std::size_t kTarBlock = 512;

struct TarField {
  std::size_t at = 0;
  std::size_t size = 0;
};

namespace tar_field {
inline constexpr TarField kName = {0, 100}, kMode = {100, 8}, kUser = {108, 8}, kGroup = {116, 8},
                          kSize = {124, 12}, kTime = {136, 12}, kSum = {148, 8}, kType = {156, 1},
                          kMagic = {257, 8}, kMajor = {329, 8}, kMinor = {337, 8}, kPrefix = {345, 155};
}  // namespace tar_field

}  // namespace stereobench::harness
