#include "renderer/camera/philox_blocks.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace stereobench::renderer {
namespace {

#if defined(__x86_64__)
#define STEREOBENCH_AVX2 __attribute__((target("avx2")))
#define STEREOBENCH_AVX512 __attribute__((target("avx512f")))

// A 32-bit word of a block lies in the low half of a 64-bit lane. What the high halves hold does not matter:
// products are those of the low halves.
constexpr int kRounds = 10;
constexpr __mmask8 kAllLanes = 0xff;  // GCC 12 warns of a variable of its own in functions without a mask

STEREOBENCH_AVX2 __m256i high_xor(__m256i product, __m256i word, __m256i key) {
  return _mm256_xor_si256(_mm256_srli_epi64(product, 32), _mm256_xor_si256(word, key));
}

STEREOBENCH_AVX512 __m512i high_xor(__m512i product, __m512i word, __m512i key) {
  constexpr int kXorOfThree = 0x96;
  return _mm512_ternarylogic_epi64(_mm512_maskz_srli_epi64(kAllLanes, product, 32), word, key, kXorOfThree);
}

/// Low halves of one, then of the other, in each lane.
STEREOBENCH_AVX2 __m256i side_by_side(__m256i low, __m256i high) {
  return _mm256_blend_epi32(low, _mm256_slli_epi64(high, 32), 0xaa);
}

STEREOBENCH_AVX512 __m512i side_by_side(__m512i low, __m512i high) {
  return _mm512_mask_blend_epi32(0xaaaa, low, _mm512_maskz_slli_epi64(kAllLanes, high, 32));
}

/// Four blocks at a time: one in each lane.
STEREOBENCH_AVX2 std::size_t write_fours(const PhiloxBlocks& blocks, std::uint16_t* numbers) {
  const __m256i first_factor = _mm256_set1_epi64x(PHILOX_M4x32_0),
                second_factor = _mm256_set1_epi64x(PHILOX_M4x32_1);
  __m256i first_keys[kRounds], second_keys[kRounds];
  for (std::uint32_t i = 0; i < kRounds; ++i) {
    first_keys[i] = _mm256_set1_epi64x(blocks.key[0] + i * PHILOX_W32_0);
    second_keys[i] = _mm256_set1_epi64x(blocks.key[1] + i * PHILOX_W32_1);
  }
  __m256i counter = _mm256_add_epi64(_mm256_set1_epi64x(blocks.first[0]), _mm256_set_epi64x(3, 2, 1, 0));
  const std::size_t count = blocks.count / 4 * 4;
  for (std::size_t done = 0; done < count; done += 4, numbers += 4 * kNumbersPerBlock) {
    __m256i a = counter, b = _mm256_set1_epi64x(blocks.first[1]), c = _mm256_set1_epi64x(blocks.first[2]),
            d = _mm256_set1_epi64x(blocks.first[3]);
#pragma GCC unroll 10
    for (int i = 0; i < kRounds; ++i) {
      const __m256i of_a = _mm256_mul_epu32(a, first_factor), of_c = _mm256_mul_epu32(c, second_factor);
      a = high_xor(of_c, b, first_keys[i]);
      c = high_xor(of_a, d, second_keys[i]);
      b = of_c;
      d = of_a;
    }
    const __m256i front = side_by_side(a, b), back = side_by_side(c, d);
    const __m256i even = _mm256_unpacklo_epi64(front, back), odd = _mm256_unpackhi_epi64(front, back);
    auto* const words = reinterpret_cast<__m256i*>(numbers);
    _mm256_storeu_si256(words, _mm256_permute2x128_si256(even, odd, 0x20));
    _mm256_storeu_si256(words + 1, _mm256_permute2x128_si256(even, odd, 0x31));
    counter = _mm256_add_epi64(counter, _mm256_set1_epi64x(4));
  }
  return count;
}

/// Eight blocks at a time: one in each lane.
STEREOBENCH_AVX512 std::size_t write_eights(const PhiloxBlocks& blocks, std::uint16_t* numbers) {
  const __m512i first_factor = _mm512_set1_epi64(PHILOX_M4x32_0),
                second_factor = _mm512_set1_epi64(PHILOX_M4x32_1);
  const __m512i front_order = _mm512_set_epi64(11, 3, 10, 2, 9, 1, 8, 0);
  const __m512i back_order = _mm512_set_epi64(15, 7, 14, 6, 13, 5, 12, 4);
  __m512i first_keys[kRounds], second_keys[kRounds];
  for (std::uint32_t i = 0; i < kRounds; ++i) {
    first_keys[i] = _mm512_set1_epi64(blocks.key[0] + i * PHILOX_W32_0);
    second_keys[i] = _mm512_set1_epi64(blocks.key[1] + i * PHILOX_W32_1);
  }
  __m512i counter =
      _mm512_add_epi64(_mm512_set1_epi64(blocks.first[0]), _mm512_set_epi64(7, 6, 5, 4, 3, 2, 1, 0));
  const std::size_t count = blocks.count / 8 * 8;
  for (std::size_t done = 0; done < count; done += 8, numbers += 8 * kNumbersPerBlock) {
    __m512i a = counter, b = _mm512_set1_epi64(blocks.first[1]), c = _mm512_set1_epi64(blocks.first[2]),
            d = _mm512_set1_epi64(blocks.first[3]);
#pragma GCC unroll 10
    for (int i = 0; i < kRounds; ++i) {
      const __m512i of_a = _mm512_maskz_mul_epu32(kAllLanes, a, first_factor),
                    of_c = _mm512_maskz_mul_epu32(kAllLanes, c, second_factor);
      a = high_xor(of_c, b, first_keys[i]);
      c = high_xor(of_a, d, second_keys[i]);
      b = of_c;
      d = of_a;
    }
    const __m512i front = side_by_side(a, b), back = side_by_side(c, d);
    _mm512_storeu_si512(numbers, _mm512_permutex2var_epi64(front, front_order, back));
    _mm512_storeu_si512(numbers + 32, _mm512_permutex2var_epi64(front, back_order, back));
    counter = _mm512_add_epi64(counter, _mm512_set1_epi64(8));
  }
  return count;
}

std::vector<WriteManyBlocks> make_writers() {
  std::vector<WriteManyBlocks> writers;
  if (__builtin_cpu_supports("avx512f") > 0) writers.push_back(write_eights);
  if (__builtin_cpu_supports("avx2") > 0) writers.push_back(write_fours);
  return writers;
}
#else
std::vector<WriteManyBlocks> make_writers() {
  return {};
}
#endif

}  // namespace

const std::vector<WriteManyBlocks>& wide_writers() {
  static const std::vector<WriteManyBlocks> writers = make_writers();
  return writers;
}

void write_blocks(const PhiloxBlocks& blocks, std::uint16_t* numbers) {
  PhiloxBlocks rest = blocks;
  const std::size_t done = wide_writers().empty() ? 0 : wide_writers().front()(blocks, numbers);
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
