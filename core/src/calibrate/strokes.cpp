#include "calibrate/prints.hpp"

namespace sillon {
namespace {

// Strokes of a letter. A point is two digits, x 0..4 and y 0..6; blanks separate points, semicolons strokes.
const char* strokesOf(char letter) {
  switch (letter) {
    case ' ':
      return "";
    case '0':
      return "00 40 46 06 00";
    case '1':
      return "15 26 20";
    case '2':
      return "06 46 43 03 00 40";
    case '3':
      return "06 46 40 00;43 13";
    case '4':
      return "06 03 43;46 40";
    case '5':
      return "46 06 03 43 40 00";
    case '6':
      return "46 06 00 40 43 03";
    case '7':
      return "06 46 20";
    case '8':
      return "03 00 40 46 06 03 43";
    case '9':
      return "00 40 46 06 03 43";
    case 'A':
      return "00 04 26 44 40;03 43";
    case 'B':
      return "03 00 30 41 42 33 03 06 36 45 44 33";
    case 'C':
      return "46 06 00 40";
    case 'D':
      return "00 06 26 44 42 20 00";
    case 'E':
      return "46 06 00 40;03 33";
    case 'F':
      return "46 06 00;03 33";
    case 'G':
      return "46 06 00 40 43 23";
    case 'H':
      return "00 06;40 46;03 43";
    case 'I':
      return "20 26";
    case 'J':
      return "46 40 00 02";
    case 'K':
      return "00 06;46 03 40";
    case 'L':
      return "06 00 40";
    case 'M':
      return "00 06 23 46 40";
    case 'N':
      return "00 06 40 46";
    case 'O':
      return "10 30 42 44 36 16 04 02 10";
    case 'P':
      return "00 06 46 43 03";
    case 'Q':
      return "10 30 42 44 36 16 04 02 10;22 40";
    case 'R':
      return "00 06 46 43 03 40";
    case 'S':
      return "45 36 16 05 04 13 33 42 41 30 10 01";
    case 'T':
      return "06 46;26 20";
    case 'U':
      return "06 00 40 46";
    case 'V':
      return "06 20 46";
    case 'W':
      return "06 10 23 30 46";
    case 'X':
      return "00 46;06 40";
    case 'Y':
      return "06 23 46;23 20";
    case 'Z':
      return "06 46 00 40";
    case '.':
      return "20 21";
    case '+':
      return "03 43;21 25";
    case '/':
      return "00 46";
    case '%':
      return "00 46;05 16;30 41";
    default:
      return "03 43";
  }
}

}  // namespace

double textWidth(std::string_view text) {
  if (text.empty()) return 0;
  return kLetterAdvance * static_cast<double>(text.size() - 1) + kLetterWidth;
}

std::vector<std::vector<Vec2>> textStrokes(std::string_view text, Vec2 corner, double unit) {
  std::vector<std::vector<Vec2>> strokes;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char letter = text[k] >= 'a' && text[k] <= 'z' ? static_cast<char>(text[k] - 'a' + 'A') : text[k];
    const Vec2 origin = corner + Vec2{unit * kLetterAdvance * static_cast<double>(k), 0};
    const char* at = strokesOf(letter);
    if (*at != '\0') strokes.emplace_back();
    for (; *at != '\0'; at += at[2] == '\0' ? 2 : 3) {
      strokes.back().push_back(origin +
                               unit * Vec2{static_cast<double>(at[0] - '0'), static_cast<double>(at[1] - '0')});
      if (at[2] == ';') strokes.emplace_back();
    }
  }
  return strokes;
}

}  // namespace sillon
