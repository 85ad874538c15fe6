#include "renderer/camera/philox_blocks.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace stereobench::renderer {
namespace {

#if defined(__x86_64__)
#define STEREOBENCH_AVX2 __attribute__((target("avx2")))

constexpr std::size_t kBlocksAtOnce = 4;

/// A 32-bit word in the low half of each 64-bit lane. What the high halves hold does not matter: products are
/// those of the low halves.
STEREOBENCH_AVX2 __m256i in_all_lanes(std::uint32_t word) {
  return _mm256_set1_epi64x(word);
}

STEREOBENCH_AVX2 __m256i high_half(__m256i lanes) {
  return _mm256_srli_epi64(lanes, 32);
}

STEREOBENCH_AVX2 __m256i combine(__m256i high_of, __m256i word, __m256i key) {
  return _mm256_xor_si256(_mm256_xor_si256(high_half(high_of), word), key);
}

/// Low halves of one, then of the other, in each lane.
STEREOBENCH_AVX2 __m256i side_by_side(__m256i low, __m256i high) {
  constexpr int kOddWords = 0xaa;
  return _mm256_blend_epi32(low, _mm256_slli_epi64(high, 32), kOddWords);
}

/// Four blocks: one in each lane.
STEREOBENCH_AVX2 void write_four(const PhiloxBlocks& blocks, std::uint32_t counter, std::uint16_t* numbers) {
  const __m256i first_factor = in_all_lanes(PHILOX_M4x32_0), second_factor = in_all_lanes(PHILOX_M4x32_1);
  std::uint32_t first_key = blocks.key[0], second_key = blocks.key[1];
  __m256i a = _mm256_add_epi64(in_all_lanes(counter), _mm256_set_epi64x(3, 2, 1, 0));
  __m256i b = in_all_lanes(blocks.first[1]), c = in_all_lanes(blocks.first[2]),
          d = in_all_lanes(blocks.first[3]);
  for (int round = 0; round < 10; ++round) {
    const __m256i of_a = _mm256_mul_epu32(a, first_factor), of_c = _mm256_mul_epu32(c, second_factor);
    a = combine(of_c, b, in_all_lanes(first_key));
    c = combine(of_a, d, in_all_lanes(second_key));
    b = of_c;
    d = of_a;
    first_key += PHILOX_W32_0;
    second_key += PHILOX_W32_1;
  }
  const __m256i front = side_by_side(a, b), back = side_by_side(c, d);
  const __m256i even = _mm256_unpacklo_epi64(front, back), odd = _mm256_unpackhi_epi64(front, back);
  auto* const words = reinterpret_cast<__m256i*>(numbers);
  _mm256_storeu_si256(words, _mm256_permute2x128_si256(even, odd, 0x20));
  _mm256_storeu_si256(words + 1, _mm256_permute2x128_si256(even, odd, 0x31));
}

STEREOBENCH_AVX2 std::size_t write_fours(const PhiloxBlocks& blocks, std::uint16_t* numbers) {
  std::size_t done = 0;
  for (; done + kBlocksAtOnce <= blocks.count; done += kBlocksAtOnce)
    write_four(blocks, blocks.first[0] + static_cast<std::uint32_t>(done), numbers + done * kNumbersPerBlock);
  return done;
}

bool has_wide_registers() {
  static const bool has = __builtin_cpu_supports("avx2") > 0;
  return has;
}
#else
std::size_t write_fours(const PhiloxBlocks&, std::uint16_t*) {
  return 0;
}

bool has_wide_registers() {
  return false;
}
#endif

}  // namespace

void write_blocks(const PhiloxBlocks& blocks, std::uint16_t* numbers) {
  PhiloxBlocks rest = blocks;
  const std::size_t done = has_wide_registers() ? write_fours(blocks, numbers) : 0;
  rest.first[0] += static_cast<std::uint32_t>(done);
  rest.count -= done;
  write_blocks_one_by_one(rest, numbers + done * kNumbersPerBlock);
}

void write_blocks_one_by_one(const PhiloxBlocks& blocks, std::uint16_t* numbers) {
  r123::Philox4x32::ctr_type counter = blocks.first;
  for (std::size_t i = 0; i < blocks.count; ++i, ++counter[0]) {
    const r123::Philox4x32::ctr_type words = r123::Philox4x32{}(counter, blocks.key);
    for (std::size_t j = 0; j < words.size(); ++j) {
      *numbers++ = static_cast<std::uint16_t>(words[j] & 0xffffU);
      *numbers++ = static_cast<std::uint16_t>(words[j] >> 16);
    }
  }
}

}  // namespace stereobench::renderer
