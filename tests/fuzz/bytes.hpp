// What a fuzz target makes of its bytes, one after the other; zeros when there are none left.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace fuzz {

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  [[nodiscard]] bool empty() const { return size_ == 0; }
  std::uint8_t byte() {
    if (size_ == 0) return 0;
    --size_;
    return *data_++;
  }
  /// 0..1.
  double share() { return byte() / 255.0; }
  /// Mostly near `usual`, now and then any double.
  double number(double usual) {
    const int kind = byte();
    if (kind < 200) return usual;
    if (kind < 250) return usual * byte() / 64;
    double value = 0;
    std::uint8_t raw[sizeof value];
    for (std::uint8_t& b : raw) b = byte();
    std::memcpy(&value, raw, sizeof value);
    return value;
  }
  std::string rest(std::size_t most) {
    std::string text(reinterpret_cast<const char*>(data_), size_ < most ? size_ : most);
    data_ += text.size();
    size_ -= text.size();
    return text;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

}  // namespace fuzz
