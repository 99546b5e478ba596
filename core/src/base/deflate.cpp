// Deflate (RFC 1951), tuned for speed. Noise, such as lit beads, hardly repeats strings, so that few places are
// searched; Huffman codes made for each block save most of the space.
#include "base/deflate.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace sillon {
namespace {

constexpr int kDistances = 30;  // number of distance symbols
constexpr int kLiterals = 286;  // number of literal symbols, with the end and the lengths of copies
constexpr int kSymbols = kLiterals + kDistances;
constexpr std::uint32_t kEnd = 256;         // symbol that ends a block
constexpr int kLongestCode = 15;            // longest code [bits]
constexpr std::uint32_t kShortestCopy = 3;  // shortest length that can be encoded [bytes]
constexpr int kShortest = 4;   // shortest copy that is searched [bytes]: copies of three cost more than they save
constexpr int kLongest = 257;  // longest copy [bytes]; one more could be encoded, but would need a symbol out of order
constexpr std::uint32_t kCopy = 32768;  // farthest distance [bytes]; also marks copies in tokens, see writeBlock()
constexpr int kHashBits = 15;
constexpr std::size_t kBlock = 1U << 16;  // literals and copies per block, which share codes

struct BitWriter {
  std::string out;
  std::uint64_t held = 0;
  int count = 0;

  void add(std::uint32_t value, int bits) {
    held |= std::uint64_t{value} << count;
    for (count += bits; count >= 8; count -= 8, held >>= 8) out += static_cast<char>(held);
  }
};

// Reverses a code, because codes are written from their highest bit on, but all other numbers from their lowest.
std::uint32_t turned(std::uint32_t code, int bits) {
  std::uint32_t turned = 0;
  for (; bits > 0; --bits, code >>= 1) turned = turned << 1 | (code & 1);
  return turned;
}

struct Code {
  std::uint32_t bits;
  int length;
};

// Makes Huffman codes, numbered as in RFC 1951. Counts are halved until no code is too long.
// \param counts  counts of the symbols; at least two must be above 0.
void makeCodes(const std::uint32_t* counts, int size, Code* codes) {
  int parent[2 * kLiterals];
  int depth[2 * kLiterals];
  int longest = kLongestCode + 1;
  for (int halved = 0; longest > kLongestCode; ++halved) {
    std::uint32_t weight[2 * kLiterals];
    for (int k = 0; k < size; ++k) weight[k] = counts[k] == 0 ? 0 : std::max(counts[k] >> halved, 1U);
    int root = size;
    for (;; ++root) {  // each node takes the two lightest ones that remain
      weight[root] = 0;
      int taken = 0;
      for (; taken < 2; ++taken) {
        int least = -1;
        for (int k = 0; k < root; ++k) {
          if (weight[k] != 0 && (least < 0 || weight[k] < weight[least])) least = k;
        }
        if (least < 0) break;
        parent[least] = root;
        weight[root] += weight[least];
        weight[least] = 0;
      }
      if (taken < 2) break;
    }
    depth[root] = -1;  // a surplus node above the root of the tree
    longest = 0;
    for (int k = root - 1; k >= 0; --k) {
      depth[k] = k < size && counts[k] == 0 ? 0 : depth[parent[k]] + 1;
      longest = std::max(longest, depth[k]);
    }
  }
  std::uint32_t next = 0;
  for (int length = 1; length <= kLongestCode; ++length, next <<= 1) {
    for (int k = 0; k < size; ++k) {
      if (depth[k] == length) codes[k] = {turned(next++, length), length};
    }
  }
}

// Writes one block.
// \param tokens  literals as they are; copies as kCopy times the length, plus the distance less one.
void writeBlock(const std::vector<std::uint32_t>& tokens, bool last, BitWriter& to) {
  std::uint32_t counts[kSymbols] = {1};
  counts[kLiterals] = counts[kLiterals + 1] = 1;  // some readers reject a code of fewer than two symbols
  Code codes[kSymbols] = {};
  bool known = false;
  // Lengths and distances have symbols for ranges whose size doubles after every 2^bits of them, and extra bits for the
  // place within the range.
  const auto put = [&](std::uint32_t first, std::uint32_t value, int bits) {
    const int extra = std::max(static_cast<int>(std::bit_width(value)) - 1 - bits, 0);
    const std::uint32_t symbol = first + (static_cast<std::uint32_t>(extra) << bits) + (value >> extra);
    ++counts[symbol];
    if (!known) return;
    to.add(codes[symbol].bits, codes[symbol].length);
    to.add(value & ((1U << extra) - 1), extra);
  };
  const auto putAll = [&] {
    for (const std::uint32_t token : tokens) {
      if (token < kCopy) {
        put(0, token, 8);
      } else {
        put(kEnd + 1, token / kCopy - kShortestCopy, 2);
        put(kLiterals, token % kCopy, 1);
      }
    }
    put(0, kEnd, 9);
  };
  putAll();
  makeCodes(counts, kLiterals, codes);
  makeCodes(counts + kLiterals, kDistances, codes + kLiterals);
  to.add(last ? 5 : 4, 3);
  // Code lengths take four bits each, without repetition symbols: blocks are so long that it does not matter.
  to.add(15 << 10 | (kDistances - 1) << 5 | (kLiterals - 257), 14);
  for (int k = 0; k < 19; ++k) to.add(k < 3 ? 0 : 4, 3);
  for (const Code& code : codes) to.add(turned(static_cast<std::uint32_t>(code.length), 4), 4);
  known = true;
  putAll();
}

}  // namespace

std::string deflated(std::string_view data) {
  BitWriter to;
  std::vector<std::uint32_t> tokens;
  const int size = static_cast<int>(data.size());
  const int farthest = static_cast<int>(kCopy);
  std::vector<int> newest(std::size_t{1} << kHashBits, -farthest - 1);  // latest position of bytes with each hash
  // Returns the latest earlier position with the same hash, and records `at` in its place.
  const auto lastLike = [&](int at) {
    if (at + kShortest > size) return -farthest - 1;
    std::uint32_t bytes = 0;
    for (int k = 0; k < kShortest; ++k) bytes = bytes << 8 | static_cast<std::uint8_t>(data[at + k]);
    return std::exchange(newest[bytes * 2654435761U >> (32 - kHashBits)], at);
  };
  for (int at = 0; at < size;) {
    const int from = lastLike(at);
    const int most = at - from > farthest ? 0 : std::min(kLongest, size - at);
    int length = 0;
    while (length < most && data[from + length] == data[at + length]) ++length;
    if (length < kShortest) {
      tokens.push_back(static_cast<std::uint8_t>(data[at++]));
    } else {
      tokens.push_back(static_cast<std::uint32_t>(length) * kCopy + static_cast<std::uint32_t>(at - from - 1));
      for (const int end = at++ + length; at < end; ++at) lastLike(at);
    }
    if (tokens.size() == kBlock) {
      writeBlock(tokens, at == size, to);
      tokens.clear();
    }
  }
  if (!tokens.empty() || size == 0) writeBlock(tokens, true, to);
  to.add(0, 7);  // fills the last byte
  return std::move(to.out);
}

}  // namespace sillon
