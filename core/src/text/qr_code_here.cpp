// Makes QR codes with libqrcodegen. Engines in browsers use qr_code_elsewhere.cpp instead.
#include <array>
#include <cstddef>
#include <qrcodegen.hpp>

#include "text/qr_code.hpp"

namespace sillon {

Result<Image> qrModules(const std::string& text, QrCorrection correction, const ReadInput& /*asked in browsers*/) {
  using qrcodegen::QrCode;
  constexpr std::array kLevels{QrCode::Ecc::LOW, QrCode::Ecc::MEDIUM, QrCode::Ecc::QUARTILE, QrCode::Ecc::HIGH};
  try {
    const QrCode code = QrCode::encodeText(text.c_str(), kLevels[toSize(correction)]);
    const int side = code.getSize();
    Image image{side, side, 1, {}};
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) image.samples.push_back(code.getModule(x, y) ? 0 : 65535);
    }
    return image;
  } catch (const qrcodegen::data_too_long&) {
    return qrTooLong(text.size());
  }
}

}  // namespace sillon
