#include "renderer/pictures/fast_deflate.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

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

std::uint32_t four_at(const std::uint8_t* at) {
  std::uint32_t four = 0;
  std::memcpy(&four, at, sizeof four);
  return four;
}

/// Literals as they are, and runs of the byte before them as 256 + their length.
struct Tokens {
  std::unique_ptr<std::uint16_t[]> values;
  std::size_t size = 0;
  std::array<std::uint32_t, kSymbols> counts{};  ///< of symbols
};

Tokens tokens_of(Bytes bytes) {
  Tokens tokens;
  tokens.values = std::make_unique_for_overwrite<std::uint16_t[]>(bytes.size());
  std::uint16_t* token = tokens.values.get();
  const std::uint8_t* const end = bytes.data() + bytes.size();
  const std::uint8_t* at = bytes.data();
  const auto literal = [&] {
    ++tokens.counts[*at];
    *token++ = *at++;
  };
  if (at != end) literal();
  while (end - at >= static_cast<std::ptrdiff_t>(kShortestRun)) {
    const std::uint8_t before = at[-1];
    if (four_at(at) != 0x01010101U * before) {
      literal();
      continue;
    }
    const std::uint8_t* const most = at + std::min<std::ptrdiff_t>(end - at, kLongestRun);
    const std::uint8_t* run = at + kShortestRun;
    while (run != most && *run == before) ++run;
    const auto length = static_cast<std::size_t>(run - at);
    ++tokens.counts[kRunLengths[length].symbol];
    *token++ = static_cast<std::uint16_t>(256 + length);
    at = run;
  }
  while (at != end) literal();
  tokens.counts[kEndOfBlock] = 1;
  tokens.size = static_cast<std::size_t>(token - tokens.values.get());
  return tokens;
}

/// Lengths of Huffman codes, none above kLongestCode; 0 for what does not occur.
std::array<std::uint8_t, kSymbols> code_lengths(const std::array<std::uint32_t, kSymbols>& counts) {
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

void put_tokens(std::span<const std::uint16_t> tokens, const std::array<Code, kSymbols>& codes,
                BitWriter& writer) {
  const auto put = [&](std::uint16_t token) {
    if (token < 256) {
      writer.put(codes[token].bits, codes[token].length);
      return;
    }
    const RunLength& run = kRunLengths[token - 256U];
    writer.put(codes[run.symbol].bits, codes[run.symbol].length);
    writer.put(run.extra, run.extra_bits + 1U);  // and the distance, whose bit is 0
  };
  std::size_t i = 0;
  for (; i + 3 <= tokens.size(); i += 3) {  // at most 18 bits each
    put(tokens[i]);
    put(tokens[i + 1]);
    put(tokens[i + 2]);
    writer.flush();
  }
  for (; i < tokens.size(); ++i) put(tokens[i]);
  writer.flush();
  writer.put(codes[kEndOfBlock].bits, codes[kEndOfBlock].length);
}

}  // namespace

std::vector<std::uint8_t> deflate_fast(Bytes bytes) {
  const Tokens tokens = tokens_of(bytes);
  const auto lengths = code_lengths(tokens.counts);
  constexpr std::size_t kHeaders = 1024;
  std::size_t bits = 0;
  for (std::size_t i = 0; i < kSymbols; ++i)
    bits += tokens.counts[i] * (lengths[i] + (i < kEndOfBlock ? 0U : 6U));
  std::vector<std::uint8_t> packed(kHeaders + bits / 8);
  packed[0] = 0x78;  // zlib, a window of 32 KiB
  packed[1] = 0x01;  // packed fast
  BitWriter writer(packed.data() + 2);
  put_codes(lengths, writer);
  put_tokens({tokens.values.get(), tokens.size}, codes_of(lengths), writer);
  std::uint8_t* const end = writer.finish();
  const auto sum = static_cast<std::uint32_t>(::adler32(1, bytes.data(), static_cast<uInt>(bytes.size())));
  for (unsigned i = 0; i < 4; ++i) end[i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
  packed.resize(static_cast<std::size_t>(end - packed.data()) + 4);
  return packed;
}

}  // namespace stereobench::renderer
