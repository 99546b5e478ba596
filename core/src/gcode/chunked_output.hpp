// Output that collects text and hands it to a sink in pieces of at most 64 KiB.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "base/numbers.hpp"
#include "sillon/gcode/writer.hpp"

namespace sillon {

/// Buffered text output. Without a sink all text is dropped, as estimates need it.
class ChunkedOutput {
 public:
  explicit ChunkedOutput(const GcodeSink* sink) : sink_(sink) {}

  [[nodiscard]] bool failed() const { return failed_; }
  [[nodiscard]] std::int64_t bytes() const { return bytes_; }

  ChunkedOutput& operator<<(std::string_view text) {
    if (sink_ == nullptr) return *this;
    while (text.size() > kSize - used_) {
      const std::size_t part = kSize - used_;
      std::memcpy(buffer_.data() + used_, text.data(), part);
      used_ += part;
      text.remove_prefix(part);
      flush();
    }
    std::memcpy(buffer_.data() + used_, text.data(), text.size());
    used_ += text.size();
    return *this;
  }

  /// Writes value / 10^digits with all digits.
  ChunkedOutput& scaled(std::int64_t value, int digits) {
    if (sink_ == nullptr) return *this;
    if (kSize - used_ < 24) flush();
    used_ = printScaled(buffer_.data() + used_, value, digits) - buffer_.data();
    return *this;
  }

  void flush() {
    if (sink_ == nullptr || used_ == 0) return;
    if (!failed_ && !(*sink_)(std::string_view(buffer_.data(), used_))) failed_ = true;
    bytes_ += static_cast<std::int64_t>(used_);
    used_ = 0;
  }

 private:
  static constexpr std::size_t kSize = 64 * 1024;

  const GcodeSink* sink_;
  std::vector<char> buffer_ = std::vector<char>(kSize);
  std::size_t used_ = 0;
  std::int64_t bytes_ = 0;
  bool failed_ = false;
};

}  // namespace sillon
