// Takes QR codes that JavaScript has made (wasm/src/text/text.ts) by the same algorithm.
#include <variant>

#include "text/qr_code.hpp"

namespace sillon {

Result<Image> qrModules(const std::string& text, QrCorrection correction, const ReadInput& read) {
  constexpr const char* kLevels[] = {"low", "medium", "quartile", "high"};
  Result<InputFile> given = read(std::string("qr:") + kLevels[static_cast<int>(correction)] + "\n" + text, "QR code");
  if (!given) return given.error();
  if (auto* image = std::get_if<Image>(&given.value())) return std::move(*image);
  return qrTooLong(text.size());
}

}  // namespace sillon
