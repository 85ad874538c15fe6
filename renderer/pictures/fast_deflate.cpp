#include "renderer/pictures/fast_deflate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include <zlib.h>

namespace stereobench::renderer {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kEndOfBlock = 256, kSymbols = 286;
constexpr int kLongestCode = 12;  // bits of a symbol
constexpr std::size_t kShortestRun = 4, kLongestRun = 258;

/// How a run's length is written (RFC 1951, 3.2.5).
struct RunLength {
  std::uint16_t symbol = 0;
  std::uint8_t extra_bits = 0;
  std::uint8_t extra = 0;
};

constexpr std::array<RunLength, kLongestRun + 1> run_lengths() {
  std::array<RunLength, kLongestRun + 1> table{};
  std::size_t length = 3;
  for (std::uint16_t symbol = 257; symbol < 285; ++symbol) {
    const int bits = symbol < 265 ? 0 : (symbol - 261) / 4;
    for (int extra = 0; extra < 1 << bits && length < kLongestRun; ++extra, ++length)
      table[length] = {symbol, static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(extra)};
  }
  table[kLongestRun] = {285, 0, 0};
  return table;
}

constexpr std::array<RunLength, kLongestRun + 1> kRunLengths = run_lengths();

using Counts = std::array<std::uint32_t, kSymbols>;

constexpr std::uint64_t kOnes = 0x0101010101010101U;

std::uint64_t eight_at(const std::uint8_t* at) {
  std::uint64_t eight = 0;
  std::memcpy(&eight, at, sizeof eight);
  return eight;
}

/// The highest bit of each byte that is 0.
std::uint64_t zero_bytes(std::uint64_t eight) {
  constexpr std::uint64_t kLow = 0x7F * kOnes;
  return ~(((eight & kLow) + kLow) | eight | kLow);
}

std::ptrdiff_t first_byte(std::uint64_t marks) {
  return std::countr_zero(marks) / 8;
}

/// Some bytes as they are, and behind them a run of the byte before.
struct Stretch {
  std::size_t literals = 0;
  std::size_t run = 0;  ///< its length; 0 for the last stretch
};

/// Where the next run begins, of the shortest length at least, or the end.
/// @param at behind the first byte
const std::uint8_t* next_run(const std::uint8_t* at, const std::uint8_t* end) {
  constexpr std::ptrdiff_t kWord = 8, kPlaces = 5;  // of four bytes in eight
  for (; end - at >= kWord; at += kPlaces) {
    const std::uint64_t equal = zero_bytes(eight_at(at) ^ eight_at(at - 1));
    const std::uint64_t four = equal & equal >> 8U & equal >> 16U & equal >> 24U;
    if (four != 0) return at + first_byte(four);
  }
  constexpr auto kLeast = static_cast<std::ptrdiff_t>(kShortestRun);
  for (; end - at >= kLeast; ++at)
    if (std::all_of(at, at + kLeast, [&](std::uint8_t byte) { return byte == at[-1]; })) return at;
  return end;
}

/// Where a run ends that begins there.
const std::uint8_t* end_of_run(const std::uint8_t* at, const std::uint8_t* end) {
  const std::uint8_t before = at[-1];
  const std::uint8_t* const most = at + std::min<std::ptrdiff_t>(end - at, kLongestRun);
  for (; most - at >= 8; at += 8)
    if (const std::uint64_t other = eight_at(at) ^ kOnes * before; other != 0) return at + first_byte(other);
  while (at != most && *at == before) ++at;
  return at;
}

/// Four tables, since a count that was just written is slow to read again.
void count_literals(Bytes bytes, std::array<Counts, 4>& counts) {
  std::size_t i = 0;
  for (; i + 4 <= bytes.size(); i += 4)
    for (std::size_t k = 0; k < 4; ++k) ++counts[k][bytes[i + k]];
  for (; i < bytes.size(); ++i) ++counts[0][bytes[i]];
}

struct Stretches {
  std::vector<Stretch> all;
  Counts counts{};  ///< of symbols
};

Stretches stretches_of(Bytes bytes) {
  Stretches found;
  std::array<Counts, 4> counts{};
  const std::uint8_t* const end = bytes.data() + bytes.size();
  const std::uint8_t* at = bytes.data();
  do {
    const std::uint8_t* const run = next_run(at == bytes.data() && at != end ? at + 1 : at, end);
    const std::uint8_t* const behind = run == end ? end : end_of_run(run, end);
    const Stretch stretch = {static_cast<std::size_t>(run - at), static_cast<std::size_t>(behind - run)};
    count_literals({at, stretch.literals}, counts);
    if (stretch.run > 0) ++counts[0][kRunLengths[stretch.run].symbol];
    found.all.push_back(stretch);
    at = behind;
  } while (at != end);
  for (const Counts& some : counts)
    for (std::size_t i = 0; i < kSymbols; ++i) found.counts[i] += some[i];
  found.counts[kEndOfBlock] = 1;
  return found;
}

/// Lengths of Huffman codes, none above kLongestCode; 0 for what does not occur.
std::array<std::uint8_t, kSymbols> code_lengths(const Counts& counts) {
  struct Node {
    std::uint64_t count = 0;
    int parent = -1;
  };
  std::vector<std::size_t> symbols;  // by how often they occur, the rarest first
  for (std::size_t i = 0; i < kSymbols; ++i)
    if (counts[i] > 0) symbols.push_back(i);
  std::stable_sort(symbols.begin(), symbols.end(),
                   [&](std::size_t a, std::size_t b) { return counts[a] < counts[b]; });
  const std::size_t leaves = symbols.size();
  std::vector<Node> nodes;
  for (const std::size_t symbol : symbols) nodes.push_back({counts[symbol]});
  std::size_t leaf = 0, inner = leaves;
  const auto rarest = [&] {
    return leaf < leaves && (inner == nodes.size() || nodes[leaf].count <= nodes[inner].count) ? leaf++
                                                                                               : inner++;
  };
  while (nodes.size() < 2 * leaves - 1) {
    const std::size_t one = rarest(), other = rarest();
    nodes[one].parent = nodes[other].parent = static_cast<int>(nodes.size());
    nodes.push_back({nodes[one].count + nodes[other].count});
  }
  std::vector<int> depths(nodes.size(), 0);
  for (std::size_t i = nodes.size() - 1; i-- > 0;)
    depths[i] = depths[static_cast<std::size_t>(nodes[i].parent)] + 1;
  // Codes that are cut to the longest one take more room than there is: the rarest of the others make way.
  // What is then left over is given to the most frequent ones that can use it, since readers want all of it
  // taken.
  constexpr int kRoom = 1 << kLongestCode;
  int taken = 0;
  for (std::size_t i = 0; i < leaves; ++i) {
    depths[i] = std::clamp(depths[i], 1, kLongestCode);
    taken += kRoom >> depths[i];
  }
  for (std::size_t i = 0; taken > kRoom; i = (i + 1) % leaves)
    if (depths[i] < kLongestCode) taken -= kRoom >> ++depths[i];
  for (std::size_t i = leaves; leaves > 1 && i-- > 0;)
    while (depths[i] > 1 && taken + (kRoom >> depths[i]) <= kRoom) taken += kRoom >> depths[i]--;
  std::array<std::uint8_t, kSymbols> lengths{};
  for (std::size_t i = 0; i < leaves; ++i) lengths[symbols[i]] = static_cast<std::uint8_t>(depths[i]);
  return lengths;
}

struct Code {
  std::uint32_t bits = 0;  ///< as they are written: the first one is the lowest
  std::uint8_t length = 0;
};

/// Codes of one length count upwards in the order of their symbols (RFC 1951, 3.2.2).
std::array<Code, kSymbols> codes_of(const std::array<std::uint8_t, kSymbols>& lengths) {
  std::array<std::uint32_t, kLongestCode + 2> next{};
  for (int length = 1; length <= kLongestCode; ++length)
    next[static_cast<std::size_t>(length) + 1] =
        (next[static_cast<std::size_t>(length)] +
         static_cast<std::uint32_t>(std::ranges::count(lengths, length)))
        << 1U;
  std::array<Code, kSymbols> codes{};
  for (std::size_t i = 0; i < kSymbols; ++i) {
    if (lengths[i] == 0) continue;
    const std::uint32_t value = next[lengths[i]]++;
    for (unsigned bit = 0; bit < lengths[i]; ++bit)
      codes[i].bits |= (value >> bit & 1U) << (lengths[i] - 1U - bit);
    codes[i].length = lengths[i];
  }
  return codes;
}

/// Bits, the lowest first, into room that is large enough.
class BitWriter {
 public:
  explicit BitWriter(std::uint8_t* to) : to_(to) {}
  void put(std::uint32_t bits, unsigned count) {
    word_ |= std::uint64_t{bits} << filled_;
    filled_ += count;
  }
  /// To be called after 56 bits at the latest.
  void flush() {
    std::memcpy(to_, &word_, sizeof word_);
    to_ += filled_ / 8;
    word_ >>= filled_ & ~7U;
    filled_ &= 7U;
  }
  /// @return behind the last byte
  std::uint8_t* finish() {
    flush();
    if (filled_ > 0) ++to_;
    return to_;
  }

 private:
  std::uint8_t* to_;
  std::uint64_t word_ = 0;
  unsigned filled_ = 0;
};

/// The block's own codes: all code lengths have four bits.
void put_codes(const std::array<std::uint8_t, kSymbols>& lengths, BitWriter& writer) {
  constexpr std::array<std::uint8_t, 19> kOrder = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                   11, 4,  12, 3, 13, 2, 14, 1, 15};
  constexpr std::array<std::uint8_t, 16> kReversed = {0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15};
  writer.put(1, 1);               // the last block
  writer.put(2, 2);               // with codes of its own
  writer.put(kSymbols - 257, 5);  // literals and lengths
  writer.put(0, 5);               // one distance
  writer.put(kOrder.size() - 4, 4);
  writer.flush();
  for (const std::uint8_t length : kOrder) {
    writer.put(length < 16 ? 4 : 0, 3);
    writer.flush();
  }
  for (const std::uint8_t length : lengths) {
    writer.put(kReversed[length], 4);
    writer.flush();
  }
  writer.put(kReversed[1], 4);  // the distance: one bit
  writer.flush();
}

/// @param writer copied, since what is kept in memory would be read again after each byte that is written
BitWriter put_literals(Bytes bytes, const std::array<Code, kSymbols>& codes, BitWriter writer) {
  const auto put = [&](std::uint8_t byte) { writer.put(codes[byte].bits, codes[byte].length); };
  std::size_t i = 0;
  for (; i + 4 <= bytes.size(); i += 4) {  // at most 12 bits each
    for (std::size_t k = 0; k < 4; ++k) put(bytes[i + k]);
    writer.flush();
  }
  for (; i < bytes.size(); ++i) put(bytes[i]);
  writer.flush();
  return writer;
}

void put_stretches(const std::vector<Stretch>& stretches, Bytes bytes,
                   const std::array<Code, kSymbols>& codes, BitWriter& writer) {
  for (const Stretch& stretch : stretches) {
    writer = put_literals(bytes.first(stretch.literals), codes, writer);
    bytes = bytes.subspan(stretch.literals + stretch.run);
    if (stretch.run == 0) continue;
    const RunLength& run = kRunLengths[stretch.run];
    writer.put(codes[run.symbol].bits, codes[run.symbol].length);
    writer.put(run.extra, run.extra_bits + 1U);  // and the distance, whose bit is 0
    writer.flush();
  }
  writer.put(codes[kEndOfBlock].bits, codes[kEndOfBlock].length);
}

}  // namespace

std::vector<std::uint8_t> deflate_fast(Bytes bytes) {
  const Stretches stretches = stretches_of(bytes);
  const auto lengths = code_lengths(stretches.counts);
  constexpr std::size_t kHeaders = 1024;
  std::size_t bits = 0;
  for (std::size_t i = 0; i < kSymbols; ++i)
    bits += stretches.counts[i] * (lengths[i] + (i < kEndOfBlock ? 0U : 6U));
  std::vector<std::uint8_t> packed(kHeaders + bits / 8);
  packed[0] = 0x78;  // zlib, a window of 32 KiB
  packed[1] = 0x01;  // packed fast
  BitWriter writer(packed.data() + 2);
  put_codes(lengths, writer);
  put_stretches(stretches.all, bytes, codes_of(lengths), writer);
  std::uint8_t* const end = writer.finish();
  const auto sum = static_cast<std::uint32_t>(::adler32(1, bytes.data(), static_cast<uInt>(bytes.size())));
  for (unsigned i = 0; i < 4; ++i) end[i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
  packed.resize(static_cast<std::size_t>(end - packed.data()) + 4);
  return packed;
}

}  // namespace stereobench::renderer
