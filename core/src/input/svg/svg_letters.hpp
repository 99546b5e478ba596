// Text of a drawing: from its elements to runs of letters, and from runs to places of letters.
// https://www.w3.org/TR/SVG2/text.html
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/svg/svg_path.hpp"
#include "input/svg/svg_style.hpp"

namespace sillon::svg {

/// Letters of one style, at a place of their own or behind the run before them.
struct LetterRun {
  std::string text;
  PaintState paint;
  std::optional<double> x, y;  ///< [user units]
  Vec2 shift;                  ///< dx and dy [user units]
};

/// A letter's outline in the element's user units.
struct PlacedLetter {
  std::string outline;  ///< path data, in font units, y up
  Matrix place;         ///< from font units to user units
  std::size_t run = 0;
};

/// Collects the runs of a <text> element from left to right, and its white space as CSS's `normal` has it.
class LetterRuns {
 public:
  /// Takes the attributes `x`, `y`, `dx` and `dy` of an element, whose text follows.
  void begin(const Node& node, Vec2 viewport, const UserUnits& units);
  void add(std::string_view text, const PaintState& paint, bool keepsSpaces);
  /// The runs without the spaces at the ends of lines.
  std::vector<LetterRun> take();

 private:
  void push(std::string text, const PaintState& paint);
  void trim();

  std::vector<LetterRun> runs_;
  std::vector<double> xs_, ys_;  ///< places of the letters that come next
  Vec2 shift_;
  std::size_t next_ = 0;
  bool afterSpace_ = true;  ///< a further space shows nothing
};

/// Tells whether white space before a child, which the parser drops where it stands alone, separates words.
bool hasSpaceBefore(const Node& child);

/// Lays the runs out. \return an error of `shape`.
Result<std::vector<PlacedLetter>> placeLetters(const std::vector<LetterRun>& runs, const ShapeLetters& shape,
                                               const UserUnits& units);

}  // namespace sillon::svg
