#include "base/deflate.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <string>

#include "input/inflate.hpp"

using namespace sillon;

namespace {

// Bytes of `kinds` values, the k-th 2^-k of them where they are `skewed`.
std::string noise(std::size_t size, int kinds, bool skewed) {
  std::uint64_t state = size + static_cast<std::uint64_t>(kinds);
  std::string bytes;
  while (bytes.size() < size) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    const auto drawn = static_cast<std::uint32_t>(state >> 33);
    int kind = static_cast<int>(drawn % static_cast<std::uint32_t>(kinds));
    if (skewed) {
      for (kind = 0; kind + 1 < kinds && (drawn >> kind & 1) != 0;) ++kind;
    }
    bytes += static_cast<char>(kind);
  }
  return bytes;
}

// The reader looks 4 bytes beyond the end.
bool comesBack(const std::string& bytes) {
  return inflated(deflated(bytes) + std::string(4, '\0'), bytes.size()) == bytes;
}

}  // namespace

TEST_CASE("what is packed comes back, whatever it is and however long") {
  for (std::size_t size = 0; size < 300; ++size) {
    CAPTURE(size);
    CHECK(comesBack(noise(size, 256, false)));
    CHECK(comesBack(std::string(size, 'a')));
  }
  // Codes of more than 15 bits would be needed for the rarest; several blocks, the last of them full or not.
  for (const std::size_t size : {65535U, 65536U, 65537U, 131072U, 3000000U}) {
    CAPTURE(size);
    CHECK(comesBack(noise(size, 256, false)));
    CHECK(comesBack(noise(size, 28, true)));
    CHECK(comesBack(noise(size, 2, false)));
    CHECK(comesBack(std::string(size, '\xff')));
  }
}

TEST_CASE("what repeats is packed once, from as far as can be told") {
  const std::string kept = noise(32768, 256, false);
  CHECK(deflated(kept).size() < 33100);  // and noise hardly grows
  CHECK(deflated(kept + kept).size() < 34000);
  CHECK(comesBack(kept + kept));
  const std::string far = kept + 'x' + kept;  // one byte too far
  CHECK(deflated(far).size() > 60000);
  CHECK(comesBack(far));
  // Matches of each length, and such as reach over themselves.
  std::string ends;
  for (std::size_t length = 1; length < 600; ++length) ends += noise(length, 3, false) + std::string(length, 'z');
  CHECK(comesBack(ends));
}

TEST_CASE("noise of few values takes hardly more than its entropy") {
  for (const int kinds : {16, 64}) {
    const double bits = kinds == 16 ? 4 : 6;
    CHECK(static_cast<double>(deflated(noise(1000000, kinds, false)).size()) < 1000000 / 8.0 * bits * 1.1);
  }
}
