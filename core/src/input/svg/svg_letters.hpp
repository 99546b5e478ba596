// Text of a drawing: from its elements to runs of letters, and from runs to places of letters.
// https://www.w3.org/TR/SVG2/text.html
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "input/svg/svg_path.hpp"
#include "input/svg/svg_style.hpp"

namespace sillon::svg {

inline constexpr std::int64_t kMaxLetters = 100'000;  ///< bytes of them in a drawing, which <use> may repeat

/// A path that letters stand on, in user units.
class TextPath {
 public:
  void add(Vec2 from, Vec2 to);

  double start = 0;  ///< where letters begin
  [[nodiscard]] double length() const { return length_; }
  /// From the place of a letter to user units: x along the path, y down from it. Nothing beyond its ends.
  [[nodiscard]] std::optional<Matrix> at(double distance) const;

 private:
  struct Side {
    double begin;
    Vec2 from, along;  // a unit vector
  };
  std::vector<Side> sides_;
  double length_ = 0;
};

/// The length that `textLength` gives to letters.
struct Stretch {
  double length = 0;
  bool glyphs = false;  ///< they are as wide as that takes, not set apart
};

/// Letters of one style, at a place of their own or behind the run before them.
struct LetterRun {
  std::string text;
  std::size_t style = 0;       ///< index in LetterRuns::styles()
  std::optional<double> x, y;  ///< [user units]
  Vec2 shift;                  ///< dx and dy [user units]
  double turn = 0;             ///< about the place of its one letter [degrees]
  std::shared_ptr<const TextPath> path;
  std::shared_ptr<const Stretch> stretch;  ///< of all runs that have the same one
};

/// The outline of a letter, or of a line under, through or above letters, in the element's user units.
struct PlacedLetter {
  const std::string* outline;  ///< path data, in font units, y up
  Matrix place;                ///< from font units to user units
  std::size_t style = 0;       ///< index in LetterRuns::styles()
};

/// Collects the letters of a <text> element from left to right, and its white space as CSS has it.
class LetterRuns {
 public:
  /// \param lettersLeft  bytes of letters that the whole drawing may still have.
  explicit LetterRuns(std::int64_t& lettersLeft) : lettersLeft_(lettersLeft) {}

  /// Begins an element, whose attributes `x`, `y`, `dx`, `dy` and `rotate` count for the letters up to its close().
  /// \param units  with the em of the element.
  void open(const Node& node, const UserUnits& units);
  void close();
  /// Letters stand on this path up to the next call; null: on none. \return the path before.
  std::shared_ptr<const TextPath> setPath(std::shared_ptr<const TextPath> path) {
    std::swap(path, path_);
    return path;
  }
  /// Letters are stretched so up to the next call; null: not at all. \return the stretch before.
  std::shared_ptr<const Stretch> setStretch(std::shared_ptr<const Stretch> stretch) {
    std::swap(stretch, stretch_);
    return stretch;
  }
  /// Adds text of the innermost open element. Throws Refused: the drawing has too many letters.
  void add(std::string_view text, const PaintState& paint);
  /// The runs without the space at the end. \param viewport  what percentages refer to. Throws Refused.
  std::vector<LetterRun> take(Vec2 viewport);
  /// One for each element that has letters.
  [[nodiscard]] const std::deque<PaintState>& styles() const { return styles_; }

 private:
  // A letter that attributes can place.
  struct Letter {
    std::size_t begin;  // in text_
    std::size_t style;
    std::optional<double> x, y;
    Vec2 shift;
    double turn = 0;
    std::shared_ptr<const TextPath> path;
    std::shared_ptr<const Stretch> stretch;
  };
  struct Element {
    const Node* node;
    UserUnits units;
    std::size_t begin, end;  // of its letters
    std::size_t style;       // kNoStyle: it has no letters of its own
  };

  void place(const Element& element, Vec2 viewport);

  std::int64_t& lettersLeft_;
  std::string text_;
  std::deque<Letter> letters_;       // vectors hold up to three times as much while they grow
  std::vector<Element> elements_;    // those around before those within
  std::vector<std::size_t> inside_;  // which of them are open, outermost first
  std::deque<PaintState> styles_;
  std::shared_ptr<const TextPath> path_;
  std::shared_ptr<const Stretch> stretch_;
  bool afterSpace_ = true;  // a further space shows nothing
};

/// Shapes lines, each of them once. Outlines are kept once, too: each of 100,000 letters may be a line of its own.
class LetterShaper {
 public:
  explicit LetterShaper(const ShapeLetters& shape) : shape_(shape) {}

  /// Outlines [k] is that of letters[k].
  struct Line {
    ShapedLine line;
    std::vector<const std::string*> outlines;
  };
  /// \return an error of the function given.
  Result<const Line*> of(const DrawingFont& font, const std::string& text);
  /// True where another font stood in for that of a line.
  [[nodiscard]] bool tookOtherFont() const { return tookOtherFont_; }

 private:
  const ShapeLetters& shape_;
  std::unordered_map<std::string, Line> lines_;
  std::unordered_set<std::string> outlines_;
  bool tookOtherFont_ = false;
};

/// Lays the runs out. \return an error of `shaper`.
Result<std::vector<PlacedLetter>> placeLetters(const std::vector<LetterRun>& runs, const std::deque<PaintState>& styles,
                                               LetterShaper& shaper);

/// Properties that change or move letters and are not read.
std::vector<std::string_view> unreadOf(const LetterStyle& letters);

}  // namespace sillon::svg
