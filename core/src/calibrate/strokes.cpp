#include "calibrate/prints.hpp"

namespace sillon {
namespace {

struct Letter {
  char letter;
  const char* strokes;
};

// A point of a stroke is two digits, x 0..4 and y 0..6; blanks separate points, semicolons strokes.
constexpr Letter kLetters[] = {
    {' ', ""},
    {'0', "00 40 46 06 00"},
    {'1', "15 26 20"},
    {'2', "06 46 43 03 00 40"},
    {'3', "06 46 40 00;43 13"},
    {'4', "06 03 43;46 40"},
    {'5', "46 06 03 43 40 00"},
    {'6', "46 06 00 40 43 03"},
    {'7', "06 46 20"},
    {'8', "03 00 40 46 06 03 43"},
    {'9', "00 40 46 06 03 43"},
    {'A', "00 04 26 44 40;03 43"},
    {'B', "03 00 30 41 42 33 03 06 36 45 44 33"},
    {'C', "46 06 00 40"},
    {'D', "00 06 26 44 42 20 00"},
    {'E', "46 06 00 40;03 33"},
    {'F', "46 06 00;03 33"},
    {'G', "46 06 00 40 43 23"},
    {'H', "00 06;40 46;03 43"},
    {'I', "20 26"},
    {'J', "46 40 00 02"},
    {'K', "00 06;46 03 40"},
    {'L', "06 00 40"},
    {'M', "00 06 23 46 40"},
    {'N', "00 06 40 46"},
    {'O', "10 30 42 44 36 16 04 02 10"},
    {'P', "00 06 46 43 03"},
    {'Q', "10 30 42 44 36 16 04 02 10;22 40"},
    {'R', "00 06 46 43 03 40"},
    {'S', "45 36 16 05 04 13 33 42 41 30 10 01"},
    {'T', "06 46;26 20"},
    {'U', "06 00 40 46"},
    {'V', "06 20 46"},
    {'W', "06 10 23 30 46"},
    {'X', "00 46;06 40"},
    {'Y', "06 23 46;23 20"},
    {'Z', "06 46 00 40"},
    {'.', "20 21"},
    {'+', "03 43;21 25"},
    {'/', "00 46"},
    {'%', "00 46;05 16;30 41"},
};

const char* strokesOf(char letter) {
  for (const Letter& known : kLetters) {
    if (known.letter == letter) return known.strokes;
  }
  return "03 43";
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
