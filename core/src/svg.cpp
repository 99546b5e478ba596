// SVG 1.1/2 geometry to polygons: https://www.w3.org/TR/SVG2/ (paths: chapter 9, basic shapes: 10, units and viewports:
// 8). RapidXML reads the XML, fast_float the numbers.
#include "sillon/svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fast_float/fast_float.h>
#include <Eigen/Geometry>
#include <rapidxml/rapidxml.hpp>

namespace sillon {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kMmPerPx = 25.4 / 96;
constexpr std::size_t kMaxBytes = std::size_t{64} << 20;
constexpr int kMaxDepth = 200;  // of elements, <use> counted in: each level costs stack
constexpr std::int64_t kMaxPoints = 2'000'000;
constexpr std::int64_t kMaxWork =
    4 * static_cast<std::int64_t>(kMaxBytes);  // bytes read while drawing; <use> reads again
constexpr std::int64_t kWorkPerElement = 64;   // bytes an element without attributes counts as
constexpr double kMaxPage = 1e5;               // [mm]
constexpr double kMaxCoordinate = 1e6;         // [mm]; 1e12 nm are exact in a double

// Thrown and caught in this file only: parsing is deep, and each level would have to hand errors on.
struct Refused {
  ErrorCode code;
  std::string problem;
};

[[noreturn]] void refuse(const std::string& problem) { throw Refused{ErrorCode::InvalidFile, problem}; }
[[noreturn]] void refuseTooLarge(const std::string& problem) { throw Refused{ErrorCode::TooLarge, problem}; }

// ---- text ----

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }
bool startsWith(std::string_view text, std::string_view head) { return text.substr(0, head.size()) == head; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && isSpace(text.back())) text.remove_suffix(1);
  return text;
}

std::string lowered(std::string_view text) {
  std::string copy(text);
  std::transform(copy.begin(), copy.end(), copy.begin(), lower);
  return copy;
}

// Text of the file inside a message: short, printable.
std::string quoted(std::string_view text) {
  std::string copy(text.substr(0, 40));
  for (char& c : copy) {
    if (c < ' ' || c > '~') c = '?';
  }
  return "\"" + copy + (text.size() > 40 ? "...\"" : "\"");
}

// Calls body(piece) for the pieces between separators.
template <class Body>
void split(std::string_view text, char separator, const Body& body) {
  while (true) {
    const std::size_t end = text.find(separator);
    body(text.substr(0, end));
    if (end == std::string_view::npos) return;
    text.remove_prefix(end + 1);
  }
}

// Numbers, flags and words of an attribute from left to right.
class Reader {
 public:
  Reader(std::string_view text, const char* what) : text_(text), what_(what) {}

  bool atEnd() {
    skipSpace();
    return at_ == text_.size();
  }
  [[nodiscard]] char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  char take() { return text_[at_++]; }
  [[nodiscard]] std::string_view rest() const { return text_.substr(at_); }

  void skipSpace() {
    while (at_ < text_.size() && isSpace(text_[at_])) ++at_;
  }
  void skipSeparator() {
    skipSpace();
    if (peek() != ',') return;
    ++at_;
    skipSpace();
  }
  void expect(char c) {
    skipSpace();
    if (peek() != c) fail(std::string("'") + c + "'");
    ++at_;
  }
  std::string_view word() {
    const std::size_t begin = at_;
    while (isLetter(peek())) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  // A finite number; separators before it are skipped.
  double number() {
    skipSeparator();
    std::size_t begin = at_;
    std::size_t first = begin + (peek() == '+' || peek() == '-' ? 1 : 0);
    // The library would also take "inf" and "nan".
    if (first >= text_.size() || !(isDigit(text_[first]) || text_[first] == '.')) fail("a number");
    if (text_[begin] == '+') begin = first;
    double value = 0;
    const auto [end, error] = fast_float::from_chars(text_.data() + begin, text_.data() + text_.size(), value);
    if (error != std::errc{}) fail("a number");
    if (!std::isfinite(value)) refuse("the number " + quoted(rest()) + " in " + what_ + " is too large");
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }

  // The flags of an arc may stand together: "a1 1 0 0110 10".
  bool flag() {
    skipSeparator();
    if (peek() != '0' && peek() != '1') fail("a flag 0 or 1");
    return take() == '1';
  }

  [[noreturn]] void fail(const std::string& expected) const {
    if (at_ >= text_.size()) refuse(what_ + " ends where " + expected + " must follow");
    refuse(what_ + " has " + quoted(rest()) + " where " + expected + " must stand");
  }

 private:
  std::string_view text_;
  std::string what_;
  std::size_t at_ = 0;
};

// ---- XML ----

using Node = rapidxml::xml_node<>;

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

// Local name of an SVG element; empty for text, comments and elements of other vocabularies.
std::string_view elementName(const Node& node) {
  if (node.type() != rapidxml::node_element) return {};
  std::string_view name(node.name(), node.name_size());
  if (startsWith(name, "svg:")) name.remove_prefix(4);
  return name.find(':') == std::string_view::npos ? name : std::string_view{};
}

std::optional<std::string_view> attribute(const Node& node, std::string_view name) {
  const auto* found = node.first_attribute(name.data(), name.size());
  if (!found) return std::nullopt;
  return std::string_view(found->value(), found->value_size());
}

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

using Matrix = Eigen::Affine2d;

// (x, y) -> (a x + c y + e, b x + d y + f), as SVG counts them.
Matrix matrix(double a, double b, double c, double d, double e, double f) {
  Matrix m = Matrix::Identity();
  m.linear() << a, c, b, d;
  m.translation() << e, f;
  return m;
}

Matrix shifted(double x, double y) { return Matrix(Eigen::Translation2d(x, y)); }
Matrix rotation(double degrees) { return Matrix(Eigen::Rotation2Dd(degrees / 180 * kPi)); }

Vec2 vectorBy(const Matrix& m, Vec2 v) {
  const Eigen::Vector2d out = m.linear() * Eigen::Vector2d(v.x, v.y);
  return {out.x(), out.y()};
}
Vec2 pointBy(const Matrix& m, Vec2 p) { return vectorBy(m, p) + Vec2{m.translation().x(), m.translation().y()}; }

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
      result = result * matrix(1, 0, std::tan(v[0] / 180 * kPi), 1, 0, 0);
    } else if (name == "skewY" && n == 1) {
      result = result * matrix(1, std::tan(v[0] / 180 * kPi), 0, 1, 0, 0);
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

// ---- CSS ----

// What `display` and `fill-rule` may come from: the last of the most specific wins.
struct Declared {
  std::string value;
  std::int64_t weight = -1;

  void set(std::string_view newValue, std::int64_t newWeight) {
    if (newWeight < weight) return;
    value = lowered(newValue);
    weight = newWeight;
  }
};
struct Style {
  Declared display;
  Declared fillRule;

  void declare(std::string_view declarations, std::int64_t weight) {
    split(declarations, ';', [&](std::string_view declaration) {
      const std::size_t colon = declaration.find(':');
      if (colon == std::string_view::npos) return;
      const std::string name = lowered(trimmed(declaration.substr(0, colon)).substr(0, 16));
      std::string_view value = declaration.substr(colon + 1);
      value = trimmed(value.substr(0, value.find('!')));  // without !important, which is not honoured
      if (name == "display") display.set(value, weight);
      if (name == "fill-rule") fillRule.set(value, weight);
    });
  }
  void add(const Style& other) {
    display.set(other.display.value, other.display.weight);
    fillRule.set(other.fillRule.value, other.fillRule.weight);
  }
};

// Rules of <style> elements whose selector is *, a name, a class, an id, or a name with a class or id.
class StyleSheet {
 public:
  void add(std::string_view text) {
    const std::string css = withoutComments(text);
    std::string_view rest = css;
    while (true) {
      rest = trimmed(rest);
      const std::size_t open = rest.find_first_of("{;");
      if (open == std::string_view::npos) return;
      const std::string_view head = trimmed(rest.substr(0, open));
      if (rest[open] == ';') {  // @import and the like
        rest.remove_prefix(open + 1);
        continue;
      }
      std::size_t end = open + 1;
      for (int depth = 1; depth > 0 && end < rest.size(); ++end) {
        if (rest[end] == '{') ++depth;
        if (rest[end] == '}') --depth;
      }
      if (!startsWith(head, "@")) {
        const std::string_view body = rest.substr(open + 1, end - open - 1);
        addRule(head, body.substr(0, body.find('}')));
      }
      rest.remove_prefix(end);
    }
  }

  [[nodiscard]] Style match(const Node& node) const {
    Style style;
    if (rules_.empty()) return style;
    const auto look = [&](const std::string& selector) {
      const auto found = rules_.find(selector);
      if (found != rules_.end()) style.add(found->second);
    };
    const std::string name(elementName(node));
    look("*");
    look(name);
    std::string_view classes = attribute(node, "class").value_or("");
    while (!(classes = trimmed(classes)).empty()) {
      const auto* end = std::find_if(classes.data(), classes.data() + classes.size(), isSpace);
      const std::string token(classes.data(), end);
      classes.remove_prefix(token.size());
      look("." + token);
      look(name + "." + token);
    }
    if (const auto id = attribute(node, "id")) {
      look("#" + std::string(*id));
      look(name + "#" + std::string(*id));
    }
    return style;
  }

 private:
  static std::string withoutComments(std::string_view text) {
    std::string css;
    while (true) {
      const std::size_t begin = text.find("/*");
      css += text.substr(0, begin);
      if (begin == std::string_view::npos) return css;
      const std::size_t end = text.find("*/", begin + 2);
      if (end == std::string_view::npos) return css;
      css += ' ';
      text.remove_prefix(end + 2);
    }
  }

  void addRule(std::string_view selectors, std::string_view declarations) {
    Style probe;
    probe.declare(declarations, 0);
    if (probe.display.weight < 0 && probe.fillRule.weight < 0) return;
    split(selectors, ',', [&](std::string_view selector) {
      selector = trimmed(selector);
      if (selector.empty() || selector.find_first_of(" \t\r\n>+~:[") != std::string_view::npos) return;
      const std::size_t mark = selector.find_first_of(".#");
      const bool hasMark = mark != std::string_view::npos;
      if (hasMark && selector.find_first_of(".#", mark + 1) != std::string_view::npos) return;
      if (hasMark && mark == 1 && selector[0] == '*') selector.remove_prefix(1);
      // As CSS counts: ids, then classes, then names, then order.
      std::int64_t specificity = hasMark ? (selector.find('#') != std::string_view::npos ? 4 : 2) : 0;
      if (selector[0] != '.' && selector[0] != '#' && selector[0] != '*') specificity += 1;
      Style style = probe;
      const std::int64_t weight = (specificity << 40) + ++order_;
      if (style.display.weight >= 0) style.display.weight = weight;
      if (style.fillRule.weight >= 0) style.fillRule.weight = weight;
      rules_[std::string(selector)].add(style);
    });
  }

  std::unordered_map<std::string, Style> rules_;
  std::int64_t order_ = 0;
};

// ---- outlines ----

// Polygons of one element. Takes curves in the element's coordinates, keeps points in mm, y up.
class Outliner {
 public:
  Outliner(const Matrix& toWorld, double tolerance, std::int64_t& pointsLeft)
      : toWorld_(toWorld), tolerance_(tolerance), pointsLeft_(pointsLeft) {}

  void line(Vec2 from, Vec2 to) {
    begin(from);
    add(pointBy(toWorld_, to));
  }

  void quadratic(Vec2 from, Vec2 control, Vec2 to) {
    begin(from);
    const Vec2 a = pointBy(toWorld_, from), b = pointBy(toWorld_, control), c = pointBy(toWorld_, to);
    const int n = pieces(2 * length(a - 2.0 * b + c));
    for (int i = 1; i < n; ++i) {
      const double t = static_cast<double>(i) / n, s = 1 - t;
      add(s * s * a + 2 * s * t * b + t * t * c);
    }
    add(c);
  }

  void cubic(Vec2 from, Vec2 control1, Vec2 control2, Vec2 to) {
    begin(from);
    const Vec2 a = pointBy(toWorld_, from), b = pointBy(toWorld_, control1);
    const Vec2 c = pointBy(toWorld_, control2), d = pointBy(toWorld_, to);
    const int n = pieces(6 * std::max(length(a - 2.0 * b + c), length(b - 2.0 * c + d)));
    for (int i = 1; i < n; ++i) {
      const double t = static_cast<double>(i) / n, s = 1 - t;
      add(s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d);
    }
    add(d);
  }

  // center + cos(angle) u + sin(angle) v for `sweep` radians from `angle`; `to` is the exact end.
  void arc(Vec2 from, Vec2 center, Vec2 u, Vec2 v, double angle, double sweep, Vec2 to) {
    begin(from);
    const Vec2 c = pointBy(toWorld_, center), p = vectorBy(toWorld_, u), q = vectorBy(toWorld_, v);
    // The second derivative stays below the longest half axis of the transformed ellipse.
    const double pp = dot(p, p), qq = dot(q, q), pq = dot(p, q);
    const double axis = std::sqrt((pp + qq + std::sqrt((pp - qq) * (pp - qq) + 4 * pq * pq)) / 2);
    const int n = std::max(pieces(axis * sweep * sweep), static_cast<int>(std::ceil(std::abs(sweep) / (kPi / 4))));
    for (int i = 1; i < n; ++i) {
      const double at = angle + sweep * i / n;
      add(c + std::cos(at) * p + std::sin(at) * q);
    }
    add(pointBy(toWorld_, to));
  }

  void quarter(Vec2 center, Vec2 u, Vec2 v) { arc(center + u, center, u, v, 0, kPi / 2, center + v); }

  void close() {
    while (ring_.size() > 1 && ring_.back() == ring_.front()) ring_.pop_back();
    if (hasArea()) rings_.push_back(std::move(ring_));
    ring_.clear();
  }

  std::vector<Ring> take() {
    close();
    return std::move(rings_);
  }

 private:
  // A curve over t in [0, 1] whose second derivative stays below `bend` leaves the chord of a piece of 1/n by at most
  // bend / (8 n²).
  [[nodiscard]] int pieces(double bend) const {
    const double n = std::ceil(std::sqrt(bend / (8 * tolerance_)));
    if (!(n <= static_cast<double>(pointsLeft_))) refusePoints();
    return std::max(1, static_cast<int>(n));
  }

  void begin(Vec2 from) {
    if (ring_.empty()) add(pointBy(toWorld_, from));
  }

  void add(Vec2 p) {
    if (!(std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate)) {
      refuse("a point lies more than 1 km away; coordinates in mm must be within 1000000");
    }
    // The + 0 turns -0 into 0.
    p = {std::round(p.x * 1e6) / 1e6 + 0.0, std::round(p.y * 1e6) / 1e6 + 0.0};
    if (!ring_.empty() && ring_.back() == p) return;
    if (--pointsLeft_ < 0) refusePoints();
    ring_.push_back(p);
  }

  [[noreturn]] static void refusePoints() {
    refuseTooLarge("the outlines have more than " + std::to_string(kMaxPoints) + " points");
  }

  // Whether the points span more than a line of 1 nm.
  [[nodiscard]] bool hasArea() const {
    if (ring_.size() < 3) return false;
    Vec2 longest;
    for (const Vec2 p : ring_) {
      if (length(p - ring_[0]) > length(longest)) longest = p - ring_[0];
    }
    const double room = 1e-6 * length(longest);
    return std::any_of(ring_.begin(), ring_.end(),
                       [&](Vec2 p) { return std::abs(cross(longest, p - ring_[0])) >= 0.999 * room; });
  }

  Matrix toWorld_;
  double tolerance_;
  std::int64_t& pointsLeft_;
  Ring ring_;
  std::vector<Ring> rings_;
};

// Sec. B.2.4 of SVG 2: from end points to the centre.
void arcTo(Outliner& out, Vec2 from, Vec2 radii, double degrees, bool large, bool clockwise, Vec2 to) {
  if (from == to) return;
  double rx = std::abs(radii.x), ry = std::abs(radii.y);
  if (rx == 0 || ry == 0) return out.line(from, to);
  const Matrix turn = rotation(degrees);
  const Matrix back = rotation(-degrees);
  // On the unit circle: half the chord h, its distance from the centre.
  Vec2 h = vectorBy(back, 0.5 * (from - to));
  h = {h.x / rx, h.y / ry};
  const double half = dot(h, h);
  if (!(half < 1e100)) refuse("the radii of an arc are too small for its length");
  if (half < 1e-14 && !large) return out.line(from, to);  // leaves the chord by less than 1e-7 of it
  if (half > 1) {                                         // too small to reach: grown until they do
    rx *= std::sqrt(half);
    ry *= std::sqrt(half);
    h = h * (1 / std::sqrt(half));
  }
  const double distance = std::sqrt(std::max(0.0, 1 / std::min(half, 1.0) - 1)) * (large == clockwise ? -1 : 1);
  const Vec2 center{h.y * distance, -h.x * distance};  // in units of the radii, from the chord's middle
  const Vec2 first = h - center, last = -h - center;
  double sweep = std::atan2(cross(first, last), dot(first, last));
  if (clockwise && sweep < 0) sweep += 2 * kPi;
  if (!clockwise && sweep > 0) sweep -= 2 * kPi;
  const Vec2 u = vectorBy(turn, {rx, 0}), v = vectorBy(turn, {0, ry});
  out.arc(from, 0.5 * (from + to) + center.x * u + center.y * v, u, v, std::atan2(first.y, first.x), sweep, to);
}

void drawPath(Outliner& out, std::string_view text) {
  if (trimmed(text) == "none") return;
  Reader reader(text, "d");
  Vec2 at, start, control;  // control: last one of a curve, for the smooth ones
  char command = '\0', previous = '\0';
  while (!reader.atEnd()) {
    previous = command;
    if (isLetter(reader.peek())) {
      if (std::string_view("MmLlHhVvCcSsQqTtAaZz").find(reader.peek()) == std::string_view::npos) {
        reader.fail("a command M L H V C S Q T A or Z");
      }
      command = reader.take();
    } else if (command == 'M' || command == 'm') {
      command = command == 'M' ? 'L' : 'l';
    } else if (command == 'Z' || command == 'z') {
      reader.fail("a command");
    }
    if (previous == '\0' && lower(command) != 'm') reader.fail("M, the first command,");

    const char kind = lower(command);
    const Vec2 origin = kind == command ? at : Vec2{};
    const auto point = [&] {
      const double x = reader.number();
      return origin + Vec2{x, reader.number()};
    };
    const char before = lower(previous);
    switch (kind) {
      case 'm':
        out.close();
        start = at = point();
        break;
      case 'z':
        out.close();
        at = start;
        break;
      case 'h':
      case 'v':
      case 'l': {
        Vec2 to = at;
        if (kind == 'h') to.x = origin.x + reader.number();
        if (kind == 'v') to.y = origin.y + reader.number();
        if (kind == 'l') to = point();
        out.line(at, to);
        at = to;
        break;
      }
      case 'c':
      case 's': {
        const bool smooth = before == 'c' || before == 's';
        const Vec2 first = kind == 'c' ? point() : (smooth ? 2.0 * at - control : at);
        control = point();
        const Vec2 to = point();
        out.cubic(at, first, control, to);
        at = to;
        break;
      }
      case 'q':
      case 't': {
        const bool smooth = before == 'q' || before == 't';
        control = kind == 'q' ? point() : (smooth ? 2.0 * at - control : at);
        const Vec2 to = point();
        out.quadratic(at, control, to);
        at = to;
        break;
      }
      default: {  // 'a'
        const double rx = reader.number();
        const double ry = reader.number();
        const double degrees = reader.number();
        const bool large = reader.flag();
        const bool clockwise = reader.flag();
        const Vec2 to = point();
        arcTo(out, at, {rx, ry}, degrees, large, clockwise, to);
        at = to;
      }
    }
  }
}

void drawPolygon(Outliner& out, std::string_view text) {
  Reader reader(text, "points");
  std::optional<Vec2> previous;
  while (!reader.atEnd()) {
    const double x = reader.number();
    const Vec2 p{x, reader.number()};
    if (previous) out.line(*previous, p);
    previous = p;
  }
}

void drawEllipse(Outliner& out, Vec2 center, Vec2 radii) {
  const Vec2 u{radii.x, 0}, v{0, radii.y};
  out.quarter(center, u, v);
  out.quarter(center, v, -u);
  out.quarter(center, -u, -v);
  out.quarter(center, -v, u);
}

void drawRectangle(Outliner& out, Vec2 corner, Vec2 size, Vec2 radii) {
  const Vec2 r{std::min(radii.x, size.x / 2), std::min(radii.y, size.y / 2)};
  const Vec2 end = corner + size;
  if (!(r.x > 0 && r.y > 0)) {
    out.line(corner, {end.x, corner.y});
    out.line({end.x, corner.y}, end);
    out.line(end, {corner.x, end.y});
    return;
  }
  const Vec2 u{r.x, 0}, v{0, r.y};
  out.quarter({end.x - r.x, corner.y + r.y}, -v, u);
  // The quarters' ends are the straight sides.
  const auto corneredAt = [&](Vec2 center, Vec2 first, Vec2 second, Vec2 from) {
    out.line(from, center + first);
    out.quarter(center, first, second);
  };
  corneredAt({end.x - r.x, end.y - r.y}, u, v, {end.x, corner.y + r.y});
  corneredAt({corner.x + r.x, end.y - r.y}, v, -u, {end.x - r.x, end.y});
  corneredAt({corner.x + r.x, corner.y + r.y}, -u, -v, {corner.x, end.y - r.y});
}

// ---- the drawing ----

struct State {
  Matrix toWorld = Matrix::Identity();
  Vec2 viewport;  // what percentages refer to, in user units
  FillRule fillRule = FillRule::NonZero;
  int depth = 0;
};

class Drawing {
 public:
  explicit Drawing(const SvgOptions& options)
      : options_(options), mmPerUserUnit_(options.unitlessIsMm ? 1 : kMmPerPx) {}

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
    drawRoot(root, state, box);
    current_ = nullptr;
    if (shape_.paths.empty()) {
      throw Refused{
          ErrorCode::EmptyShape,
          "the drawing has no area to fill; it needs paths or basic shapes (text, images and lines do not count)"};
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
    shape_.drawing = {true, !options_.unitlessIsMm, 0, 0};
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

  Style styleOf(const Node& node) const {
    Style style;
    if (const auto value = attribute(node, "display")) style.display.set(trimmed(*value), 0);
    if (const auto value = attribute(node, "fill-rule")) style.fillRule.set(trimmed(*value), 0);
    style.add(styleSheet_.match(node));
    style.declare(attribute(node, "style").value_or(""), std::int64_t{1} << 62);
    return style;
  }

  // Reads what all elements share into `state`. False if the element is not displayed.
  bool enter(const Node& node, State& state) {
    current_ = &node;
    if (++state.depth > kMaxDepth) {
      refuseTooLarge("<use> nests elements deeper than " + std::to_string(kMaxDepth) + " levels");
    }
    spend(node);
    const Style style = styleOf(node);
    if (style.display.value == "none") return false;
    if (style.fillRule.value == "evenodd") state.fillRule = FillRule::EvenOdd;
    if (style.fillRule.value == "nonzero") state.fillRule = FillRule::NonZero;
    if (const auto transform = attribute(node, "transform")) {
      state.toWorld = state.toWorld * parseTransform(*transform);
    }
    return true;
  }

  void drawRoot(const Node& root, State state, const std::optional<ViewBox>& box) {
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

  // Elements not named here are not drawn: <defs>, <symbol>, <clipPath>, <text>, <line>, foreign ones, ...
  void draw(const Node& node, State state) {
    const std::string_view name = elementName(node);
    const bool group = name == "g" || name == "a";
    if ((name == "text" || name == "flowRoot" || name == "image") && styleOf(node).display.value != "none") {
      ++(name == "image" ? shape_.drawing.images : shape_.drawing.texts);
    }
    if (!group && name != "switch" && name != "svg" && name != "use" && !isShape(name)) return;
    if (!enter(node, state)) return;
    if (group) drawChildren(node, state);
    if (name == "switch") drawSwitch(node, state);
    if (name == "svg") drawViewport(node, state, nullptr);
    if (name == "use") drawUse(node, state);
    if (isShape(name)) drawShape(node, name, state);
  }

  static bool isShape(std::string_view name) {
    return name == "path" || name == "rect" || name == "circle" || name == "ellipse" || name == "polygon" ||
           name == "polyline";
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
      drawPolygon(out, attribute(node, "points").value_or(""));
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
    std::vector<Ring> rings = out.take();
    if (!rings.empty()) shape_.paths.push_back({std::move(rings), state.fillRule});
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
  Shape shape_;
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
