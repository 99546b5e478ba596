// Reads the text of a drawing: elements become runs of letters, and runs become placed letters.
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

#include "input/shaped_line.hpp"
#include "input/svg/svg_path.hpp"
#include "input/svg/svg_style.hpp"

namespace sillon::svg {

inline constexpr std::int64_t kMaxLetters = 100'000;  ///< bytes of letters in a drawing, with repetitions by <use>

/// A path that letters stand on, in user units.
class TextPath {
 public:
  void add(Vec2 from, Vec2 to);

  double start = 0;  ///< distance along the path at which letters begin
  [[nodiscard]] double length() const { return length_; }
  /// Returns the frame of a letter: x along the path, y down from it, to user units. Empty beyond the path's ends.
  [[nodiscard]] std::optional<Matrix> at(double distance) const;

 private:
  struct Leg {
    double begin;
    Vec2 from, along;  // `along` is a unit vector
  };
  std::vector<Leg> legs_;
  double length_ = 0;
};

/// The length that `textLength` gives to letters.
struct TextLength {
  double length = 0;
  bool glyphs = false;  ///< letters are widened to fit the length instead of set apart
};

/// Letters of one style, at a place of their own or directly after the run before.
struct LetterRun {
  std::string text;
  std::size_t style = 0;       ///< index in LetterRuns::styles()
  std::optional<double> x, y;  ///< [user units]
  Vec2 shift;                  ///< dx and dy [user units]
  double turn = 0;             ///< turn about the place of the run's only letter [degrees]
  std::shared_ptr<const TextPath> path;
  std::shared_ptr<const TextLength> stretch;  ///< shared by all runs of one textLength
};

/// The outline of a letter, or of a line under, through or above letters, in the element's user units.
struct PlacedLetter {
  const std::string* outline;  ///< path data, in font units, y up
  Matrix place;                ///< from font units to user units
  std::size_t style = 0;       ///< index in LetterRuns::styles()
};

/// Collects the letters of a <text> element from left to right, and collapses white space by the rules of CSS.
class LetterRuns {
 public:
  /// \param lettersLeft  bytes of letters that the whole drawing may still have.
  explicit LetterRuns(std::int64_t& lettersLeft) : lettersLeft_(lettersLeft) {}

  /// Begins an element; its `x`, `y`, `dx`, `dy` and `rotate` apply to the letters up to its close().
  /// \param units  units with the em of the element.
  void open(const Node& node, const UserUnits& units);
  void close();
  /// Sets the path for letters up to the next call; null: none. \return the path before.
  std::shared_ptr<const TextPath> setPath(std::shared_ptr<const TextPath> path) {
    std::swap(path, path_);
    return path;
  }
  /// Sets the stretch for letters up to the next call; null: none. \return the stretch before.
  std::shared_ptr<const TextLength> setStretch(std::shared_ptr<const TextLength> stretch) {
    std::swap(stretch, stretch_);
    return stretch;
  }
  /// Adds text of the innermost open element. Throws Refused if the drawing has too many letters.
  void add(std::string_view text, const PaintState& paint);
  /// Returns the runs, without a space at the end. \param viewport  size that percentages refer to. Throws Refused.
  std::vector<LetterRun> take(Vec2 viewport);
  /// Returns the paint of each element that has letters.
  [[nodiscard]] const std::deque<PaintState>& styles() const { return styles_; }

 private:
  // A letter, with the place and turn that attributes may give it.
  struct Letter {
    std::size_t begin;  // offset in text_
    std::size_t style;
    std::optional<double> x, y;
    Vec2 shift;
    double turn = 0;
    std::shared_ptr<const TextPath> path;
    std::shared_ptr<const TextLength> stretch;
  };
  struct Element {
    const Node* node;
    UserUnits units;
    std::size_t begin, end;  // range of its letters
    std::size_t style;       // kNoStyle if the element has no letters of its own
  };

  void place(const Element& element, Vec2 viewport);

  std::int64_t& lettersLeft_;
  std::string text_;
  std::deque<Letter> letters_;       // a deque, because a vector takes up to three times the memory while it grows
  std::vector<Element> elements_;    // elements before those that they contain
  std::vector<std::size_t> inside_;  // indices of the open elements, outermost first
  std::deque<PaintState> styles_;
  std::shared_ptr<const TextPath> path_;
  std::shared_ptr<const TextLength> stretch_;
  bool afterSpace_ = true;  // true if a further space shows nothing
};

/// Shapes each distinct line once. Outlines are kept once, too, because each of 100,000 letters may be a line of its
/// own.
class LetterShaper {
 public:
  explicit LetterShaper(const ShapeLetters& shape) : shape_(shape) {}

  /// A shaped line; outlines[k] belongs to letters[k].
  struct Line {
    ShapedLine line;
    std::vector<const std::string*> outlines;
  };
  /// Returns the shaped line of a text. \return an error of the function that shapes.
  Result<const Line*> of(const DrawingFont& font, const std::string& text);
  /// Tells whether another font stood in for that of some line.
  [[nodiscard]] bool tookOtherFont() const { return tookOtherFont_; }

 private:
  const ShapeLetters& shape_;
  std::unordered_map<std::string, Line> lines_;
  std::unordered_set<std::string> outlines_;
  bool tookOtherFont_ = false;
};

/// Computes the places of all letters of the runs. \return an error of `shaper`.
Result<std::vector<PlacedLetter>> placeLetters(const std::vector<LetterRun>& runs, const std::deque<PaintState>& styles,
                                               LetterShaper& shaper);

/// Returns the names of properties that would change or move these letters but are not read.
std::vector<std::string_view> unreadOf(const LetterStyle& letters);

}  // namespace sillon::svg
