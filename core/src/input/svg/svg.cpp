// SVG 1.1/2 geometry to polygons: https://www.w3.org/TR/SVG2/ (units and viewports: chapter 8). RapidXML reads the XML,
// fast_float the numbers.
#include "sillon/input/svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fast_float/fast_float.h>
#include <Eigen/Geometry>
#include <rapidxml/rapidxml.hpp>

#include "input/svg/svg_node.hpp"
#include "input/svg/svg_paint.hpp"
#include "input/svg/svg_path.hpp"
#include "input/svg/svg_reader.hpp"
#include "input/svg/svg_stroke.hpp"
#include "input/svg/svg_style.hpp"
#include "sillon/geometry/outline.hpp"

namespace sillon {
namespace {

using namespace svg;

constexpr double kMmPerPx = 25.4 / 96;
constexpr std::size_t kMaxBytes = std::size_t{64} << 20;
constexpr int kMaxDepth = 200;  // of elements, <use> counted in: each level costs stack
constexpr std::int64_t kMaxWork =
    4 * static_cast<std::int64_t>(kMaxBytes);  // bytes read while drawing; <use> reads again
constexpr std::int64_t kWorkPerElement = 64;   // bytes an element without attributes counts as
constexpr std::int64_t kWorkPerCut = 400;      // bytes a point that is cut off or kept by clipping counts as
constexpr double kMaxPage = 1e5;               // [mm]

// ---- XML ----

// Checks tags from left to right as RapidXML will read them, but a little stricter, so that its recursion is known
// to be shallow before it starts.
class NestingCheck {
 public:
  explicit NestingCheck(std::string_view text) : text_(text) {}

  void run() {
    int depth = 0;
    while ((at_ = text_.find('<', at_)) != std::string_view::npos) {
      const std::string_view rest = text_.substr(at_);
      if (startsWith(rest, "<!--")) {
        skipPast("-->", 4);
      } else if (startsWith(rest, "<![CDATA[")) {
        skipPast("]]>", 9);
      } else if (startsWith(rest, "<?")) {
        skipPast("?>", 2);
      } else if (startsWith(rest, "<!DOCTYPE")) {
        at_ += 9;
        skipDoctype();
      } else if (startsWith(rest, "</")) {
        skipPast(">", 2);
        --depth;
      } else {
        ++at_;
        if (skipTag() && ++depth > kMaxDepth) {
          refuseTooLarge("the file nests elements deeper than " + std::to_string(kMaxDepth) + " levels");
        }
      }
    }
  }

 private:
  [[nodiscard]] char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  [[noreturn]] void malformed(const std::string& problem) const {
    const auto line =
        1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.size())), '\n');
    refuse("the file is not well-formed XML: " + problem + " in line " + std::to_string(line));
  }

  void skipPast(std::string_view end, std::size_t offset) {
    const std::size_t found = text_.find(end, at_ + offset);
    if (found == std::string_view::npos) malformed("no '" + std::string(end) + "' closes what begins");
    at_ = found + end.size();
  }

  void skipDoctype() {
    int brackets = 0;
    for (; peek() != '>' || brackets > 0; ++at_) {
      if (at_ >= text_.size()) malformed("a DOCTYPE without end");
      if (peek() == '[') ++brackets;
      if (peek() == ']' && brackets > 0) --brackets;
    }
    ++at_;
  }

  void skipSpace() {
    while (isSpace(peek()) && peek() != '\f') ++at_;
  }

  void skipName() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && std::string_view(" \t\n\r/>=").find(text_[at_]) == std::string_view::npos) {
      if (std::string_view("<\"'?!&").find(text_[at_]) != std::string_view::npos) break;
      ++at_;
    }
    if (at_ == begin)
      malformed(at_ < text_.size() ? "an unexpected " + quoted(text_.substr(at_, 1)) : "an unfinished tag");
  }

  // Returns whether the tag opens an element.
  bool skipTag() {
    skipName();
    skipSpace();
    while (peek() != '>' && peek() != '/') {
      skipName();
      skipSpace();
      if (peek() != '=') malformed("an attribute without value");
      ++at_;
      skipSpace();
      const char quote = peek();
      if (quote != '"' && quote != '\'') malformed("an attribute without quotes");
      ++at_;
      skipPast(std::string_view(&quote, 1), 0);
      skipSpace();
    }
    const bool opens = peek() == '>';
    if (!opens) ++at_;
    if (peek() != '>') malformed("a '/' without '>'");
    ++at_;
    return opens;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

// ---- lengths ----

// Millimetres per unit of a CSS length; 0 for no unit, nothing for an unknown one. em and ex: of a 16 px font.
std::optional<double> mmPerUnit(const std::string& unit) {
  static constexpr std::array<std::pair<std::string_view, double>, 11> kUnits{{{"", 0},
                                                                               {"px", kMmPerPx},
                                                                               {"mm", 1},
                                                                               {"cm", 10},
                                                                               {"q", 0.25},
                                                                               {"in", 25.4},
                                                                               {"pt", 25.4 / 72},
                                                                               {"pc", 25.4 / 6},
                                                                               {"em", 16 * kMmPerPx},
                                                                               {"rem", 16 * kMmPerPx},
                                                                               {"ex", 8 * kMmPerPx}}};
  for (const auto& [name, mm] : kUnits) {
    if (name == unit) return mm;
  }
  return std::nullopt;
}

struct Length {
  double value = 0;
  double mmPerUnit = 0;  // 0: user units
  bool percent = false;
};

// Nothing for a missing attribute and for "auto".
std::optional<Length> lengthOf(const Node& node, const char* name) {
  const auto text = attribute(node, name);
  if (!text || trimmed(*text) == "auto") return std::nullopt;
  Reader reader(trimmed(*text), name);
  Length length;
  length.value = reader.number();
  if (reader.rest() == "%") {
    length.percent = true;
    return length;
  }
  const auto unit = mmPerUnit(lowered(reader.rest()));
  if (!unit) {
    refuse(std::string(name) + " is " + quoted(*text) + "; known units are mm, cm, in, pt, pc, px, Q, em, ex and %");
  }
  length.mmPerUnit = *unit;
  return length;
}

// ---- transforms and viewports ----

// (x, y) -> (a x + c y + e, b x + d y + f), as SVG counts them.
Matrix matrix(double a, double b, double c, double d, double e, double f) {
  Matrix m = Matrix::Identity();
  m.linear() << a, c, b, d;
  m.translation() << e, f;
  return m;
}

Matrix shifted(double x, double y) { return Matrix(Eigen::Translation2d(x, y)); }

Matrix parseTransform(std::string_view text) {
  Reader reader(text, "transform");
  Matrix result = Matrix::Identity();
  if (trimmed(text) == "none") return result;
  while (!reader.atEnd()) {
    reader.skipSeparator();
    const std::string_view name = reader.word();
    if (name.empty()) reader.fail("a transform such as translate(1 2)");
    reader.expect('(');
    std::array<double, 6> v{};
    std::size_t n = 0;
    for (reader.skipSpace(); reader.peek() != ')'; reader.skipSpace()) {
      if (n == v.size()) reader.fail("')'");
      v[n++] = reader.number();
    }
    reader.expect(')');
    if (name == "matrix" && n == 6) {
      result = result * matrix(v[0], v[1], v[2], v[3], v[4], v[5]);
    } else if (name == "translate" && (n == 1 || n == 2)) {
      result = result * shifted(v[0], v[1]);
    } else if (name == "scale" && (n == 1 || n == 2)) {
      result = result * matrix(v[0], 0, 0, n == 1 ? v[0] : v[1], 0, 0);
    } else if (name == "rotate" && (n == 1 || n == 3)) {
      result = result * shifted(v[1], v[2]) * rotation(v[0]) * shifted(-v[1], -v[2]);
    } else if (name == "skewX" && n == 1) {
      result = result * matrix(1, 0, std::tan(v[0] / 180 * std::numbers::pi), 1, 0, 0);
    } else if (name == "skewY" && n == 1) {
      result = result * matrix(1, std::tan(v[0] / 180 * std::numbers::pi), 0, 1, 0, 0);
    } else {
      refuse("transform has " + quoted(name) + " with " + std::to_string(n) +
             " numbers; it must be matrix, translate, scale, rotate, skewX or skewY with the numbers it takes");
    }
  }
  return result;
}

struct ViewBox {
  Vec2 min;
  Vec2 size;
};

std::optional<ViewBox> viewBoxOf(const Node& node) {
  const auto text = attribute(node, "viewBox");
  if (!text || trimmed(*text) == "none") return std::nullopt;
  Reader reader(*text, "viewBox");
  ViewBox box;
  box.min.x = reader.number();
  box.min.y = reader.number();
  box.size.x = reader.number();
  box.size.y = reader.number();
  if (!reader.atEnd()) reader.fail("the end");
  if (!(box.size.x > 0 && box.size.y > 0)) {
    refuse("viewBox is " + quoted(*text) + "; its width and height must be more than 0");
  }
  return box;
}

// Lays a viewBox into a viewport of the given size at the origin, as preserveAspectRatio says.
Matrix fit(const Node& node, const ViewBox& box, Vec2 size) {
  const std::string_view text = attribute(node, "preserveAspectRatio").value_or("");
  Reader reader(text, "preserveAspectRatio");
  reader.skipSpace();
  std::string_view align = reader.word();
  if (align == "defer") {
    reader.skipSpace();
    align = reader.word();
  }
  reader.skipSpace();
  const std::string_view mode = reader.word();
  const auto unknown = [&] {
    refuse("preserveAspectRatio is " + quoted(text) +
           "; it must be none or an alignment such as xMidYMid, then meet or slice");
  };
  if (!reader.atEnd() || !(mode.empty() || mode == "meet" || mode == "slice")) unknown();

  Vec2 scale{size.x / box.size.x, size.y / box.size.y};
  if (align == "none") return matrix(scale.x, 0, 0, scale.y, -box.min.x * scale.x, -box.min.y * scale.y);

  if (align.empty()) align = "xMidYMid";
  const auto share = [&](std::string_view part) {  // of the free room that lies before the box
    if (part == "Min") return 0.0;
    if (part == "Mid") return 0.5;
    if (part != "Max") unknown();
    return 1.0;
  };
  if (align.size() != 8 || align[0] != 'x' || align[4] != 'Y') unknown();
  const Vec2 before{share(align.substr(1, 3)), share(align.substr(5, 3))};
  const double s = mode == "slice" ? std::max(scale.x, scale.y) : std::min(scale.x, scale.y);
  return matrix(s, 0, 0, s, before.x * (size.x - box.size.x * s) - box.min.x * s,
                before.y * (size.y - box.size.y * s) - box.min.y * s);
}

// ---- the drawing ----

// What is shown lies inside of it.
struct Limit {
  FilledPath area;
  Bounds box;
  bool isBox = false;  // nothing of the box is outside
};

struct State {
  Matrix toWorld = Matrix::Identity();
  Vec2 viewport;  // what percentages refer to, in user units
  PaintState paint;
  std::vector<std::shared_ptr<const Limit>> limits;
  int depth = 0;
};

// An area that adds to what lies below it, or hides it.
struct Layer {
  FilledPath path;
  bool adds = true;
};

// What of an element counts.
enum class Reading {
  Painted,
  Mask,      // painted; black hides
  Clip,      // its outline, by clip-rule
  Outlines,  // its outline, whatever its paint and limits
};

Bounds boxOf(const std::vector<Ring>& rings) {
  Bounds box;
  for (const Ring& ring : rings) {
    for (const Vec2 p : ring) box.add(p);
  }
  return box;
}

class Drawing {
 public:
  explicit Drawing(const SvgOptions& options)
      : options_(options),
        mmPerUserUnit_(options.unitlessIsMm ? 1 : kMmPerPx),
        reading_(options.ignorePaint ? Reading::Outlines : Reading::Painted) {}

  Shape read(const Node& root) {
    current_ = &root;
    collect(root);
    const std::optional<ViewBox> box = viewBoxOf(root);
    const Vec2 page = pageSize(root, box);
    shape_.page = {std::round(page.x * 1e6) / 1e6, std::round(page.y * 1e6) / 1e6};

    State state;
    const Matrix toPage = matrix(mmPerUserUnit_, 0, 0, -mmPerUserUnit_, 0, shape_.page.y);
    const Vec2 size = page * (1 / mmPerUserUnit_);
    state.viewport = size;
    state.toWorld = toPage;
    page_ = *limitOf({{Ring{{0, 0}, {shape_.page.x, 0}, shape_.page, {0, shape_.page.y}}}, FillRule::NonZero});
    drawRoot(root, state, box);
    const bool unread = shape_.drawing.texts + shape_.drawing.images > 0;
    if (layers_.empty() && !painted_ && !unread && reading_ == Reading::Painted) {
      shape_.drawing.unpainted = true;
      reading_ = Reading::Outlines;
      drawRoot(root, state, box);
    }
    current_ = nullptr;
    if (layers_.empty()) {
      throw Refused{ErrorCode::EmptyShape,
                    painted_ ? "all that is painted lies off the page or is clipped away; \"paint\": \"ignore\" takes "
                               "outlines whatever their paint and place"
                             : "the drawing has no area to fill; it needs paths, basic shapes or lines with a stroke "
                               "(text and images do not count)"};
    }
    for (Layer& layer : layers_) shape_.paths.push_back(std::move(layer.path));
    shape_.drawing.linesOnly = reading_ == Reading::Painted && !filled_;
    if (!offPage_.paths.empty()) {
      const Result<Outline> lost = resolveOutline(offPage_);
      if (lost) shape_.drawing.offPage = lost.value().area;
    }
    return std::move(shape_);
  }

  // The element that was being read when reading stopped; null outside of elements.
  [[nodiscard]] const Node* current() const { return current_; }

 private:
  // Indexes ids and style sheets.
  void collect(const Node& node) {
    if (const auto id = attribute(node, "id")) byId_.emplace(*id, &node);
    if (elementName(node) == "style") {
      for (const Node* text = node.first_node(); text; text = text->next_sibling()) {
        styleSheet_.add({text->value(), text->value_size()});
      }
    }
    for (const Node* child = node.first_node(); child; child = child->next_sibling()) {
      if (child->type() == rapidxml::node_element) collect(*child);
    }
  }

  // [mm]; a missing side follows from the viewBox.
  Vec2 pageSize(const Node& root, const std::optional<ViewBox>& box) {
    shape_.drawing.svg = true;
    shape_.drawing.pixels = !options_.unitlessIsMm;
    const auto side = [&](const char* name) -> std::optional<double> {
      const std::optional<Length> length = lengthOf(root, name);
      if (!length || length->percent) return std::nullopt;
      if (length->mmPerUnit > 0) shape_.drawing.pixels = length->mmPerUnit == kMmPerPx;
      const double mm = length->value * (length->mmPerUnit > 0 ? length->mmPerUnit : mmPerUserUnit_);
      checkPageSide(name, mm, attribute(root, name).value_or(""));
      return mm;
    };
    const std::optional<double> width = side("width"), height = side("height");
    if (width && height) return {*width, *height};
    if (!box) refuse("the size of the drawing is unknown; <svg> needs width and height, or a viewBox");
    Vec2 page = box->size * mmPerUserUnit_;
    if (width) page = {*width, *width * box->size.y / box->size.x};
    if (height) page = {*height * box->size.x / box->size.y, *height};
    checkPageSide("the width by the viewBox", page.x, attribute(root, "viewBox").value_or(""));
    checkPageSide("the height by the viewBox", page.y, attribute(root, "viewBox").value_or(""));
    return page;
  }

  static void checkPageSide(const std::string& what, double mm, std::string_view text) {
    if (std::round(mm * 1e6) > 0 && mm <= kMaxPage) return;
    const std::string problem = what + " is " + quoted(text) + "; it must be more than 0 and at most 100000 mm";
    if (mm > kMaxPage) refuseTooLarge(problem);
    refuse(problem);
  }

  void spend(const Node& node) {
    work_ += kWorkPerElement;
    for (const auto* a = node.first_attribute(); a; a = a->next_attribute()) {
      work_ += static_cast<std::int64_t>(a->name_size() + a->value_size());
    }
    if (work_ > kMaxWork) refuseTooLarge("<use> repeats so many elements that the drawing becomes too large");
  }

  // Reads what all elements share into `state`. False if the element is not displayed.
  bool enter(const Node& node, State& state) {
    current_ = &node;
    if (++state.depth > kMaxDepth) {
      refuseTooLarge("<use> nests elements deeper than " + std::to_string(kMaxDepth) + " levels");
    }
    spend(node);
    const Style style = styleSheet_.styleOf(node);
    if (style.word(Property::Display) == "none") return false;
    apply(style, contextOf(state), state.paint);
    if (const auto transform = attribute(node, "transform")) {
      state.toWorld = state.toWorld * parseTransform(*transform);
    }
    if (reading_ == Reading::Outlines) return true;
    addLimits(node, style, state);
    current_ = &node;
    return true;
  }

  PaintContext contextOf(const State& state) {
    const double diagonal = std::sqrt(dot(state.viewport, state.viewport) / 2);
    return {[this](std::string_view id) {
              const auto found = byId_.find(id);
              if (found == byId_.end()) return false;
              const std::string_view name = elementName(*found->second);
              return name == "linearGradient" || name == "radialGradient" || name == "pattern";
            },
            [this, diagonal](std::string_view text) { return cssLength(text, diagonal); }};
  }

  // In user units; NaN for what is none.
  [[nodiscard]] double cssLength(std::string_view text, double full) const {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    text = trimmed(text);
    if (text.empty()) return kNone;
    double value = 0;
    if (text[0] == '+') text.remove_prefix(1);
    const auto [end, error] = fast_float::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || !std::isfinite(value)) return kNone;
    const std::string unit = lowered(text.substr(static_cast<std::size_t>(end - text.data())));
    if (unit == "%") return value / 100 * full;
    const auto mm = mmPerUnit(unit);
    if (!mm) return kNone;
    return *mm > 0 ? value * *mm / mmPerUserUnit_ : value;
  }

  void drawRoot(const Node& root, State state, const std::optional<ViewBox>& box) {
    shape_.drawing.texts = shape_.drawing.images = 0;
    if (!enter(root, state)) return;
    if (box) {
      state.toWorld = state.toWorld * fit(root, *box, state.viewport);
      state.viewport = box->size;
    }
    drawChildren(root, state);
  }

  void drawChildren(const Node& node, const State& state) {
    for (const Node* child = node.first_node(); child; child = child->next_sibling()) draw(*child, state);
  }

  // Elements not named here are not drawn: <defs>, <symbol>, <clipPath>, <text>, foreign ones, ...
  void draw(const Node& node, State state) {
    const std::string_view name = elementName(node);
    const bool unread = name == "text" || name == "flowRoot" || name == "image";
    if (!unread && name != "g" && name != "a" && name != "switch" && name != "svg" && name != "use" && !isShape(name)) {
      return;
    }
    if (!enter(node, state)) return;
    if (unread) {
      const bool counts = reading_ == Reading::Outlines || (reading_ == Reading::Painted && state.paint.visible);
      if (counts) ++(name == "image" ? shape_.drawing.images : shape_.drawing.texts);
      return;
    }
    drawContent(node, state);
  }

  // What an element shows once its own attributes are read.
  void drawContent(const Node& node, const State& state) {
    const std::string_view name = elementName(node);
    if (name == "g" || name == "a") drawChildren(node, state);
    if (name == "switch") drawSwitch(node, state);
    if (name == "svg") drawViewport(node, state, nullptr);
    if (name == "use") drawUse(node, state);
    if (isShape(name)) drawShape(node, name, state);
  }

  static bool isShape(std::string_view name) {
    return name == "path" || name == "rect" || name == "circle" || name == "ellipse" || name == "polygon" ||
           name == "polyline" || name == "line";
  }

  // The first child that asks for nothing we lack; languages are not compared.
  void drawSwitch(const Node& node, const State& state) {
    for (const Node* child = node.first_node(); child; child = child->next_sibling()) {
      const std::string_view name = elementName(*child);
      if (name.empty() || name == "foreignObject" || attribute(*child, "requiredExtensions")) continue;
      return draw(*child, state);
    }
  }

  // A nested <svg> or a <symbol>. \param use  the element that shows it and may give another size, or null.
  void drawViewport(const Node& node, State state, const Node* use) {
    const auto side = [&](const char* name, double full) {
      if (use && lengthOf(*use, name)) return userUnits(*use, name, full, full);
      return userUnits(node, name, full, full);
    };
    const Vec2 size{side("width", state.viewport.x), side("height", state.viewport.y)};
    if (size.x < 0 || size.y < 0) refuse("width and height must not be negative");
    if (size.x == 0 || size.y == 0) return;
    const double x = userUnits(node, "x", state.viewport.x, 0);
    const double y = userUnits(node, "y", state.viewport.y, 0);
    state.toWorld = state.toWorld * shifted(x, y);
    state.viewport = size;
    const std::string overflow = styleSheet_.styleOf(node).word(Property::Overflow);
    if (reading_ != Reading::Outlines && overflow != "visible" && overflow != "auto") {
      state.limits.push_back(rectangleLimit({0, 0}, size, state.toWorld));
    }
    if (const auto box = viewBoxOf(node)) {
      state.toWorld = state.toWorld * fit(node, *box, size);
      state.viewport = box->size;
    }
    drawChildren(node, state);
  }

  void drawUse(const Node& node, State state) {
    std::optional<std::string_view> href = attribute(node, "href");
    if (!href) href = attribute(node, "xlink:href");
    if (!href) return;
    const std::string_view target = trimmed(*href);
    if (!startsWith(target, "#")) refuse("href is " + quoted(target) + "; it must name an element of this file by #id");
    const auto found = byId_.find(target.substr(1));
    if (found == byId_.end()) refuse("href is " + quoted(target) + ", but no element has this id");
    const Node& shown = *found->second;
    if (std::find(uses_.begin(), uses_.end(), &shown) != uses_.end()) {
      refuse("href is " + quoted(target) + ", which shows itself again");
    }
    const double x = userUnits(node, "x", state.viewport.x, 0);
    const double y = userUnits(node, "y", state.viewport.y, 0);
    state.toWorld = state.toWorld * shifted(x, y);

    uses_.push_back(&shown);
    const std::string_view name = elementName(shown);
    if (name == "symbol" || name == "svg") {
      if (enter(shown, state)) drawViewport(shown, state, &node);
    } else {
      draw(shown, state);
    }
    uses_.pop_back();
  }

  void drawShape(const Node& node, std::string_view name, const State& state) {
    const Vec2 view = state.viewport;
    const double diagonal = std::sqrt(dot(view, view) / 2);
    Outliner out(state.toWorld, options_.tolerance, pointsLeft_);
    if (name == "path") {
      drawPath(out, attribute(node, "d").value_or(""));
    } else if (name == "polygon" || name == "polyline") {
      drawPolygon(out, attribute(node, "points").value_or(""), name == "polygon");
    } else if (name == "line") {
      out.line({userUnits(node, "x1", view.x, 0), userUnits(node, "y1", view.y, 0)},
               {userUnits(node, "x2", view.x, 0), userUnits(node, "y2", view.y, 0)});
      out.end();
    } else if (name == "rect") {
      const Vec2 corner{userUnits(node, "x", view.x, 0), userUnits(node, "y", view.y, 0)};
      const Vec2 size{positive(node, "width", view.x, 0), positive(node, "height", view.y, 0)};
      if (size.x == 0 || size.y == 0) return;
      drawRectangle(out, corner, size, radiiOf(node, view));
    } else {
      const Vec2 center{userUnits(node, "cx", view.x, 0), userUnits(node, "cy", view.y, 0)};
      const double r = name == "circle" ? positive(node, "r", diagonal, 0) : 0;
      const Vec2 radii = name == "circle" ? Vec2{r, r} : radiiOf(node, view);
      if (radii.x == 0 || radii.y == 0) return;
      drawEllipse(out, center, radii);
    }
    const PaintState& paint = state.paint;
    if (reading_ == Reading::Outlines) return show({out.rings(), paint.fillRule}, state);
    if (reading_ == Reading::Clip) {
      if (paint.visible) show({out.rings(), paint.clipRule}, state);
      return;
    }
    if (paint.fillAlpha() >= kFaintest) {
      std::vector<Ring> rings = out.rings();
      filled_ = filled_ || (reading_ == Reading::Painted && !rings.empty());
      show({std::move(rings), paint.fillRule}, state, paint.fill.black, paint.fillAlpha());
    }
    if (paint.strokeAlpha() >= kFaintest) {
      show({strokeRings(out.lines(), paint.line, state.toWorld, options_.tolerance, pointsLeft_), FillRule::NonZero},
           state, paint.stroke.black, paint.strokeAlpha());
    }
  }

  // Adds what lies within all limits, and on the page.
  void show(FilledPath path, const State& state, bool black = false, double alpha = 1) {
    if (path.rings.empty()) return;
    if (reading_ == Reading::Outlines) {
      layers_.push_back({std::move(path)});
      return;
    }
    const bool hides = reading_ == Reading::Mask && black && !maskByAlpha_;
    if (hides && alpha < 1 - kFaintest) return;  // grey still shows
    if (reading_ == Reading::Painted) painted_ = true;
    std::vector<const Limit*> limits;
    for (const auto& limit : state.limits) limits.push_back(limit.get());
    path = within(std::move(path), limits);
    if (reading_ == Reading::Painted) path = onPage(std::move(path));
    if (!path.rings.empty()) layers_.push_back({std::move(path), !hides});
  }

  FilledPath onPage(FilledPath path) {
    const Bounds box = boxOf(path.rings);
    if (covers(page_, box)) return path;
    const std::vector<FilledPath> both{path, page_.area};
    FilledPath off = combine(both, [](const std::vector<char>& filled) { return filled[0] != 0 && filled[1] == 0; });
    if (!off.rings.empty()) offPage_.paths.push_back(std::move(off));
    return within(std::move(path), {&page_});
  }

  // ---- clipping and masking ----

  // Less than this over a straight edge is not worth a cut [mm].
  static constexpr double kOverlap = 1e-3;

  static bool covers(const Limit& limit, const Bounds& box) {
    return limit.isBox && box.min.x >= limit.box.min.x - kOverlap && box.min.y >= limit.box.min.y - kOverlap &&
           box.max.x <= limit.box.max.x + kOverlap && box.max.y <= limit.box.max.y + kOverlap;
  }

  FilledPath within(FilledPath path, const std::vector<const Limit*>& limits) {
    const Bounds box = boxOf(path.rings);
    std::vector<FilledPath> paths{std::move(path)};
    for (const Limit* limit : limits) {
      if (covers(*limit, box)) continue;
      const Bounds& other = limit->box;
      if (other.empty() || other.min.x >= box.max.x || other.max.x <= box.min.x || other.min.y >= box.max.y ||
          other.max.y <= box.min.y) {
        return {};
      }
      paths.push_back(limit->area);
    }
    if (paths.size() == 1) return std::move(paths[0]);
    return combine(paths, [](const std::vector<char>& filled) {
      return std::find(filled.begin(), filled.end(), 0) == filled.end();
    });
  }

  FilledPath combine(const std::vector<FilledPath>& paths, const InsideRule& rule) {
    for (const FilledPath& path : paths) {
      for (const Ring& ring : path.rings) work_ += kWorkPerCut * static_cast<std::int64_t>(ring.size());
    }
    if (work_ > kMaxWork) refuseTooLarge("clipping repeats so many outlines that the drawing becomes too large");
    Result<FilledPath> area = combined(paths, rule);
    if (!area) throw Refused{area.error().code, area.error().message};
    return std::move(area).value();
  }

  static std::shared_ptr<const Limit> limitOf(FilledPath area) {
    auto limit = std::make_shared<Limit>();
    limit->box = boxOf(area.rings);
    limit->isBox = area.rings.size() == 1 && area.rings[0].size() == 4;
    if (limit->isBox) {
      const Ring& ring = area.rings[0];
      for (std::size_t k = 0; k < 4; ++k) {
        const Vec2 side = ring[(k + 1) % 4] - ring[k];
        if (side.x != 0 && side.y != 0) limit->isBox = false;
      }
    }
    limit->area = std::move(area);
    return limit;
  }

  std::shared_ptr<const Limit> rectangleLimit(Vec2 corner, Vec2 size, const Matrix& toWorld) {
    Outliner out(toWorld, options_.tolerance, pointsLeft_);
    drawRectangle(out, corner, size, {});
    return limitOf({out.rings(), FillRule::NonZero});
  }

  // `clip-path` and `mask` of an element. What names nothing limits nothing.
  void addLimits(const Node& node, const Style& style, State& state) {
    const auto named = [&](Property property, const char* kind) -> const Node* {
      const std::string_view id = urlOf(style.value(property));
      const auto found = id.empty() ? byId_.end() : byId_.find(id);
      if (found == byId_.end() || elementName(*found->second) != kind) return nullptr;
      if (std::find(uses_.begin(), uses_.end(), found->second) != uses_.end()) {
        refuse(std::string(kPropertyNames[static_cast<std::size_t>(property)]) + " is \"url(#" +
               std::string(id.substr(0, 40)) + ")\", which shows itself again");
      }
      return found->second;
    };
    const Node* const clip = named(Property::ClipPath, "clipPath");
    const Node* const mask = named(Property::Mask, "mask");
    if (clip) addClip(*clip, node, state);
    if (mask) addMask(*mask, node, state);
  }

  // User space of the element, or of its box where `attributeName` says objectBoundingBox.
  Matrix unitsOf(const Node& limit, const char* attributeName, bool boxIsDefault, const Node& node,
                 const State& state) {
    const auto units = attribute(limit, attributeName);
    const bool byBox = units ? trimmed(*units) == "objectBoundingBox" : boxIsDefault;
    if (!byBox) return Matrix::Identity();
    const Bounds box = userBox(node, state);
    if (box.empty()) return matrix(0, 0, 0, 0, 0, 0);
    return matrix(box.size().x, 0, 0, box.size().y, box.min.x, box.min.y);
  }

  // Of all outlines of an element, without strokes, in its user units.
  Bounds userBox(const Node& node, State state) {
    if (std::abs(state.toWorld.linear().determinant()) < 1e-30) return {};
    const Matrix toUser = state.toWorld.inverse();
    state.limits.clear();
    const std::int64_t points = pointsLeft_;
    const std::vector<Layer> layers = drawnAs(Reading::Outlines, [&] { drawContent(node, state); });
    pointsLeft_ = points;
    Bounds box;
    for (const Layer& layer : layers) {
      for (const Ring& ring : layer.path.rings) {
        for (const Vec2 p : ring) {
          const Eigen::Vector2d user = toUser * Eigen::Vector2d(p.x, p.y);
          box.add({user.x(), user.y()});
        }
      }
    }
    return box;
  }

  // What `body` draws, apart from the drawing itself.
  template <class Body>
  std::vector<Layer> drawnAs(Reading reading, const Body& body) {
    std::vector<Layer> kept;
    kept.swap(layers_);
    const Reading before = std::exchange(reading_, reading);
    body();
    reading_ = before;
    kept.swap(layers_);
    return kept;
  }

  // What an element inherits where it stands.
  PaintState inheritedBy(const Node& node, const State& state) {
    PaintState paint;
    if (const Node* parent = node.parent(); parent && parent->type() == rapidxml::node_element) {
      paint = inheritedBy(*parent, state);
    }
    spend(node);
    apply(styleSheet_.styleOf(node), contextOf(state), paint);
    paint.opacity = 1;
    return paint;
  }

  // For what is inside of <clipPath> or <mask>.
  State stateInside(const Node& limit, const Matrix& units, const State& state) {
    State inside;
    inside.toWorld = state.toWorld * units;
    inside.viewport = state.viewport;
    inside.paint = inheritedBy(limit, state);
    inside.depth = state.depth + 1;
    if (inside.depth > kMaxDepth) refuseTooLarge("clipping nests deeper than " + std::to_string(kMaxDepth) + " levels");
    return inside;
  }

  void addClip(const Node& clip, const Node& node, State& state) {
    State inside = stateInside(clip, unitsOf(clip, "clipPathUnits", false, node, state), state);
    uses_.push_back(&clip);
    addLimits(clip, styleSheet_.styleOf(clip), inside);
    if (const auto transform = attribute(clip, "transform")) {
      inside.toWorld = inside.toWorld * parseTransform(*transform);
    }
    const std::vector<Layer> layers = drawnAs(Reading::Clip, [&] {
      for (const Node* child = clip.first_node(); child; child = child->next_sibling()) {
        const std::string_view name = elementName(*child);
        if (name == "use" || isShape(name)) draw(*child, inside);
      }
    });
    uses_.pop_back();
    state.limits.push_back(limitOf(flattened(layers)));
  }

  void addMask(const Node& mask, const Node& node, State& state) {
    const Matrix frame = unitsOf(mask, "maskUnits", true, node, state);
    const auto units = attribute(mask, "maskUnits");
    const bool byBox = !units || trimmed(*units) == "objectBoundingBox";
    const Vec2 full = byBox ? Vec2{1, 1} : state.viewport;
    const Vec2 corner{userUnits(mask, "x", full.x, -0.1 * full.x), userUnits(mask, "y", full.y, -0.1 * full.y)};
    const Vec2 size{userUnits(mask, "width", full.x, 1.2 * full.x), userUnits(mask, "height", full.y, 1.2 * full.y)};
    State inside = stateInside(mask, unitsOf(mask, "maskContentUnits", false, node, state), state);
    uses_.push_back(&mask);
    const Style style = styleSheet_.styleOf(mask);
    addLimits(mask, style, inside);
    const bool before = std::exchange(maskByAlpha_, style.word(Property::MaskType) == "alpha");
    const std::vector<Layer> layers = drawnAs(Reading::Mask, [&] { drawChildren(mask, inside); });
    maskByAlpha_ = before;
    uses_.pop_back();
    state.limits.push_back(
        rectangleLimit(corner, {std::max(0.0, size.x), std::max(0.0, size.y)}, state.toWorld * frame));
    state.limits.push_back(limitOf(flattened(layers)));
  }

  // Layers from below upwards as one area.
  FilledPath flattened(const std::vector<Layer>& layers) {
    if (layers.empty()) return {};
    if (layers.size() == 1) return layers[0].adds ? layers[0].path : FilledPath{};
    std::vector<FilledPath> paths;
    for (const Layer& layer : layers) paths.push_back(layer.path);
    return combine(paths, [&](const std::vector<char>& filled) {
      for (std::size_t k = layers.size(); k-- > 0;) {
        if (filled[k] != 0) return layers[k].adds;
      }
      return false;
    });
  }

  // rx and ry; a missing one is like the other.
  Vec2 radiiOf(const Node& node, Vec2 view) const {
    const bool hasX = lengthOf(node, "rx").has_value(), hasY = lengthOf(node, "ry").has_value();
    const double rx = positive(node, "rx", view.x, 0), ry = positive(node, "ry", view.y, 0);
    return {hasX ? rx : ry, hasY ? ry : rx};
  }

  // \param full  100 % in user units
  double userUnits(const Node& node, const char* name, double full, double missing) const {
    const std::optional<Length> length = lengthOf(node, name);
    if (!length) return missing;
    if (length->percent) return length->value / 100 * full;
    return length->mmPerUnit > 0 ? length->value * length->mmPerUnit / mmPerUserUnit_ : length->value;
  }

  double positive(const Node& node, const char* name, double full, double missing) const {
    const double value = userUnits(node, name, full, missing);
    if (value < 0) refuse(std::string(name) + " is " + quoted(*attribute(node, name)) + "; it must not be negative");
    return value;
  }

  SvgOptions options_;
  double mmPerUserUnit_;
  Reading reading_;
  bool maskByAlpha_ = false;
  Shape shape_;
  std::vector<Layer> layers_;
  Limit page_;
  Shape offPage_;
  bool painted_ = false;  // something is, be it off the page
  bool filled_ = false;
  const Node* current_ = nullptr;
  std::unordered_map<std::string_view, const Node*> byId_;
  StyleSheet styleSheet_;
  std::vector<const Node*> uses_;  // targets being shown, outermost first
  std::int64_t pointsLeft_ = kMaxPoints;
  std::int64_t work_ = 0;
};

std::int64_t lineAt(std::string_view text, std::size_t offset) {
  return 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size())), '\n');
}

// "<path id="a"> in line 3: "
std::string placeOf(const Node& node, std::string_view text, const char* buffer) {
  std::string place = "<" + std::string(elementName(node));
  if (const auto id = attribute(node, "id")) place += " id=" + quoted(*id);
  // RapidXML's names point into the buffer it parsed, a copy of the text.
  return place + "> in line " + std::to_string(lineAt(text, static_cast<std::size_t>(node.name() - buffer))) + ": ";
}

}  // namespace

Result<Shape> readSvg(std::string_view text, const SvgOptions& options) {
  if (!(options.tolerance >= 1e-4 && options.tolerance <= 10)) {
    return Error{ErrorCode::InvalidArgument, "The tolerance of curves is out of range; it must be 0.0001 to 10 mm"};
  }
  if (text.size() > kMaxBytes) {
    return Error{ErrorCode::TooLarge, "The SVG file is larger than 64 MiB"};
  }
  std::string buffer;
  Drawing drawing(options);
  try {
    if (startsWith(text, "\x1f\x8b")) refuse("the file is compressed (svgz); save it as plain SVG");
    if (text.find('\0') != std::string_view::npos) refuse("the file is not UTF-8 text");
    NestingCheck(text).run();
    buffer = text;
    const auto document = std::make_unique<rapidxml::xml_document<>>();  // 64 KiB: too large for small stacks
    document->parse<rapidxml::parse_validate_closing_tags>(buffer.data());
    const Node* root = document->first_node();
    if (!root || elementName(*root) != "svg") {
      refuse(root ? "the first element is " + quoted({root->name(), root->name_size()}) + "; it must be <svg>"
                  : "the file holds no <svg> element");
    }
    try {
      return drawing.read(*root);
    } catch (Refused& refused) {
      // Named here, while the nodes live.
      if (drawing.current()) refused.problem = placeOf(*drawing.current(), text, buffer.data()) + refused.problem;
      throw;
    }
  } catch (const Refused& refused) {
    return Error{refused.code, "SVG: " + refused.problem};
  } catch (const rapidxml::parse_error& error) {
    const std::size_t offset = static_cast<std::size_t>(error.where<char>() - buffer.data());
    return Error{ErrorCode::InvalidFile, "SVG: the file is not well-formed XML: " + std::string(error.what()) +
                                             " in line " + std::to_string(lineAt(text, offset))};
  }
}

}  // namespace sillon
