/// Philox4x32-10 (Salmon et al. 2011) over many counters at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Random123/philox.h>

namespace stereobench::renderer {

inline constexpr std::size_t kNumbersPerBlock = 8;  ///< of 16 bits each

/// Which blocks: the counters that begin with one word, and those after it by one each in that word.
struct PhiloxBlocks {
  r123::Philox4x32::key_type key;
  r123::Philox4x32::ctr_type first;
  std::size_t count = 0;  ///< first[0] + count is at most 2^32
};

/// Writes blocks one after another, each as its four words.
/// @param numbers room for 8 numbers a block, the low half of each word first
void write_blocks(const PhiloxBlocks& blocks, std::uint16_t* numbers);

/// Writes the first blocks, a multiple of 8 or of 4. @return how many
using WriteManyBlocks = std::size_t (*)(const PhiloxBlocks& blocks, std::uint16_t* numbers);

/// What this processor has registers for, the widest first. write_blocks() takes the first.
const std::vector<WriteManyBlocks>& wide_writers();

/// The same as write_blocks() without wide registers: the reference.
void write_blocks_one_by_one(const PhiloxBlocks& blocks, std::uint16_t* numbers);

}  // namespace stereobench::renderer
