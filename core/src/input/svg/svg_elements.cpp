#include "input/svg/svg_node.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include "geometry/outline.hpp"
#include "input/shaped_line.hpp"
#include "input/svg/svg_letters.hpp"
#include "input/svg/svg_path.hpp"
#include "input/svg/svg_style.hpp"

namespace sillon::svg {
namespace {

constexpr double kMaxPage = 1e5;  // longest side of a page [mm]
constexpr double kFaint = 0.5;  // opacity up to which paint counts as faint; the second tones of icons have 0.2 to 0.4
constexpr double kLeastFaint = 0.005;  // share of the shape's area, below which no tone would be missed

struct Inherited {
  Matrix toWorld = Matrix::Identity();
  Vec2 viewport;  // size that percentages refer to, in user units
  PaintState paint;
  std::vector<std::shared_ptr<const Limit>> limits;
  int depth = 0;
};

bool hasEnglish(std::string_view languages) {
  bool found = false;
  split(languages, ',', [&](std::string_view language) {
    found = found || lowered(trimmed(language)) == "en" || startsWith(lowered(trimmed(language)), "en-");
  });
  return found;
}

// Tells whether an element requires no extension and is meant for English readers, or for all.
bool isMeant(const Node& node) {
  const auto languages = attribute(node, "systemLanguage");
  return !attribute(node, "requiredExtensions") && (!languages || hasEnglish(*languages));
}

bool isRoot(const Node& node) { return !node.parent()->parent(); }

// Tells whether children or CSS animate an element; such an element is read at rest.
bool isAnimated(const Node& node, const Style& style) {
  for (const Property property : {"animation"_css, "animation-name"_css}) {
    if (style.isCss(property) && style.word(property) != "none") return true;
  }
  for (const Node* child = node.first_node(); child; child = child->next_sibling()) {
    if (startsWith(elementName(*child), "animate") || elementName(*child) == "set") return true;
  }
  return false;
}

// Aspect of an element that is read.
enum class Aspect {
  Painted,
  Mask,      // painted shapes, except that black hides
  Clip,      // outlines filled by clip-rule
  Outlines,  // outlines, whatever their paint and limits
};

class DrawingReader {
 public:
  DrawingReader(const SvgOptions& options, const Node*& current)
      : options_(options),
        current_(current),
        units_{options.unitlessIsMm ? 1 : kMmPerPx, options.unitlessIsMm ? 16 * kMmPerPx : 16},
        reading_(options.ignorePaint ? Aspect::Outlines : Aspect::Painted),
        shaper_(options_.letters) {}

  SvgPainting read(const Node& root) {
    current_ = &root;
    collect(root);
    std::optional<ViewBox> box = viewBoxOf(root);
    const Vec2 page = pageSize(root, box);
    // Curves and strokes are made at their printed size: scaled up later, they would have too few points.
    const double scale = options_.width > 0 ? options_.width / page.x : 1;
    shape_.page = {std::round(page.x * scale * 1e6) / 1e6, std::round(page.y * scale * 1e6) / 1e6};
    if (!(shape_.page.y > 0 && shape_.page.y <= kMaxPage)) {
      refuseTooLarge("HeightOutOfRange", {{"width", shape_.page.x}, {"height", shape_.page.y}, {"most", kMaxPage}});
    }

    Inherited state;
    state.paint = initialPaint();
    toPage_ = matrix(units_.mm * scale, 0, 0, -units_.mm * scale, 0, shape_.page.y);
    const Vec2 size = page * (1 / units_.mm);
    state.viewport = size;
    state.toWorld = toPage_;
    page_ = *limitOf({{Ring{{0, 0}, {shape_.page.x, 0}, shape_.page, {0, shape_.page.y}}}, FillRule::NonZero});
    drawRoot(root, state, box);
    const bool unread = shape_.drawing.texts + shape_.drawing.images > 0;
    if (layers_.empty() && !painted_ && !unread && reading_ == Aspect::Painted) {
      shape_.drawing.unpainted = true;
      reading_ = Aspect::Outlines;
      drawRoot(root, state, box);
    }
    current_ = nullptr;
    if (reading_ == Aspect::Outlines) {
      joinLoose(loose_, layers_);
      alternateNested(layers_);
    }
    if (layers_.empty()) {
      throw Refused{refused(ErrorCode::EmptyShape, painted_ ? Reason("PaintOffPage") : Reason("NothingDrawn"))};
    }
    shape_.drawing.faintMm2 = reading_ == Aspect::Painted ? faintArea() : 0;
    std::vector<PathPaint> paints;
    for (PaintLayer& layer : layers_) {
      shape_.paths.push_back(std::move(layer.path));
      paints.push_back(layer.paint);
    }
    shape_.drawing.linesOnly = reading_ == Aspect::Painted && !filled_;
    if (!offPage_.paths.empty()) {
      const Result<Outline> lost = resolveOutline(offPage_);
      if (lost) shape_.drawing.offPage = lost.value().area;
    }
    return {std::move(shape_), std::move(paints)};
  }

 private:
  // Indexes ids and style sheets.
  void collect(const Node& node) {
    if (const auto id = attribute(node, "id")) byId_.emplace(*id, &node);
    definesProperty_ = definesProperty_ || definesProperty(attribute(node, "style").value_or(""));
    const std::string type = lowered(attribute(node, "type").value_or(""));
    if (elementName(node) == "style" && (type.empty() || type == "text/css")) {
      for (const Node* text = node.first_node(); text; text = text->next_sibling()) {
        definesProperty_ = definesProperty_ || definesProperty({text->value(), text->value_size()});
        styleSheet_.add({text->value(), text->value_size()}, attribute(node, "media").value_or(""));
      }
    }
    for (const Node* child = node.first_node(); child; child = child->next_sibling()) {
      if (child->type() == rapidxml::node_element) collect(*child);
    }
  }

  // Returns the size of the page [mm]; a missing side follows from the viewBox.
  Vec2 pageSize(const Node& root, std::optional<ViewBox>& box) {
    shape_.drawing.svg = true;
    shape_.drawing.pixels = !options_.unitlessIsMm;
    const auto side = [&](const char* name) -> std::optional<double> {
      const std::optional<Length> length = lengthOf(root, name);
      if (!length || length->percent) return std::nullopt;
      if (length->unit.mm > 0 || length->unit.ems > 0) shape_.drawing.pixels = length->unit.mm == kMmPerPx;
      const double mm = units_.of(length->value, length->unit) * units_.mm;
      checkPageSide(name, mm, attribute(root, name).value_or(""));
      return mm;
    };
    const std::optional<double> width = side("width"), height = side("height");
    if (width && height) return {*width, *height};
    if (!box && !width && !height) box = drawnBox(root);
    if (!box) refuse("SvgWithoutSize");
    Vec2 page = box->size * units_.mm;
    if (width) page = {*width, *width * box->size.y / box->size.x};
    if (height) page = {*height * box->size.x / box->size.y, *height};
    checkPageSide("viewBox", page.x, attribute(root, "viewBox").value_or(""));
    checkPageSide("viewBox", page.y, attribute(root, "viewBox").value_or(""));
    return page;
  }

  // Returns the box around all that is painted, or around all outlines if nothing is.
  std::optional<ViewBox> drawnBox(const Node& root) {
    const std::int64_t points = pointsLeft_, letters = lettersLeft_;
    Inherited state;
    state.paint = initialPaint();
    state.viewport = {300, 150};  // the default size in browsers
    page_ = {{}, {{-kMaxCoordinate, -kMaxCoordinate}, {kMaxCoordinate, kMaxCoordinate}}, true};
    Bounds drawn;
    for (const Aspect reading : {reading_, Aspect::Outlines}) {
      if (!drawn.empty()) break;
      for (const PaintLayer& layer : drawnAs(reading, [&] { drawRoot(root, state, std::nullopt); })) {
        const Bounds box = boxOf(layer.path.rings);
        drawn.add(box.min);
        drawn.add(box.max);
      }
    }
    std::tie(pointsLeft_, lettersLeft_) = std::tie(points, letters);
    loose_.clear();
    current_ = &root;
    return drawn.empty() ? std::nullopt : std::optional(ViewBox{drawn.min, drawn.size()});
  }

  static void checkPageSide(const char* name, double mm, std::string_view text) {
    if (std::round(mm * 1e6) > 0 && mm <= kMaxPage) return;
    throw Refused{refused(mm > kMaxPage ? ErrorCode::TooLarge : ErrorCode::InvalidFile, "SvgPageSide",
                          {{"attribute", name}, {"text", quoted(text)}, {"value", mm}, {"most", kMaxPage}})};
  }

  // Reads into `state` the properties that all elements share. Returns false if the element is not displayed.
  bool enter(const Node& node, Inherited& state) {
    current_ = &node;
    if (++state.depth > kMaxDepth) {
      refuseTooLarge("SvgNested", {{"most", kMaxDepth}});
    }
    work_.spend(node);
    const Style style = styleSheet_.styleOf(node, work_);
    if (style.word("display"_css) == "none") return false;
    applyTo(state.paint, node, style, state.viewport);
    state.toWorld = state.toWorld * transformOf(node, style, state);
    noteUnread(node, style, state);
    if (reading_ == Aspect::Outlines) return true;
    addLimits(node, style, state);
    current_ = &node;
    return true;
  }

  // Returns `transform` about `transform-origin`.
  Matrix transformOf(const Node& node, const Style& style, const Inherited& state) {
    const std::string& text = style.value("transform"_css);
    if (text.empty()) return Matrix::Identity();
    const bool isCss = style.isCss("transform"_css);
    try {
      CssLengths css{unitsOf(state.paint), state.viewport};
      Vec2 corner;
      if (style.word("transform-box"_css) == "fill-box") {
        const Bounds box = userBox(node, state);
        if (box.empty()) return Matrix::Identity();
        corner = box.min;
        css.box = box.size();
      }
      std::string about = style.value("transform-origin"_css);
      if (about.empty()) about = isRoot(node) ? "center" : "0 0";  // the root is a box of CSS
      const Vec2 origin = corner + parseOrigin(about, css);
      current_ = &node;
      return shifted(origin.x, origin.y) * parseTransform(text, isCss ? &css : nullptr) * shifted(-origin.x, -origin.y);
    } catch (const Refused&) {
      if (!isCss) throw;
      note("transform " + quoted(text));
      return Matrix::Identity();
    }
  }

  // Notes, once, a feature that viewers show and this reader does not.
  void note(const std::string& what) {
    std::vector<std::string>& unread = shape_.drawing.unread;
    if (reading_ == Aspect::Outlines || unread.size() == kMostUnread) return;
    if (std::find(unread.begin(), unread.end(), what) == unread.end()) unread.push_back(what);
  }

  // Notes CSS and features of an element that would change what is shown, and are not read.
  void noteUnread(const Node& node, const Style& style, const Inherited& state) {
    if (isAnimated(node, style)) note("animation");
    if (!state.paint.visible || style.empty()) return;
    if (reading_ != Aspect::Clip) noteEffects(style);
    const std::string_view function = style.fallsBack() && definesProperty_ ? "var()" : style.unreadFunction();
    if (!function.empty()) note("CSS " + quoted(function));
    const std::string_view name = elementName(node);
    // Groups have neither place nor size of their own, but they move their children.
    const bool hasPlace = !isRoot(node) && name != "g" && name != "a";
    if (hasPlace ? !style.unread().empty() : style.unreadMoves()) note("CSS " + quoted(style.unread()));
  }

  // Notes markers and filters, which clip paths ignore.
  void noteEffects(const Style& style) {
    for (const Property marker : {"marker"_css, "marker-start"_css, "marker-mid"_css, "marker-end"_css}) {
      if (targetOf(style.value(marker), "marker")) note("<marker>");
    }
    const std::string filter = style.word("filter"_css);
    const bool isFunction = filter.find('(') != std::string::npos && !startsWith(filter, "url");
    if (isFunction || targetOf(style.value("filter"_css), "filter")) note("<filter>");
  }

  // Returns the element that url(#id) names, if it is of the given kind.
  [[nodiscard]] const Node* targetOf(std::string_view value, std::string_view kind) const {
    const std::string_view id = urlOf(value);
    const auto found = id.empty() ? byId_.end() : byId_.find(id);
    return found == byId_.end() || elementName(*found->second) != kind ? nullptr : found->second;
  }

  // Returns the paint that applies where nothing declares a property.
  PaintState initialPaint() {
    PaintState paint;
    paint.letters.size = units_.em;
    paint.letters.font = fontOf("");
    return paint;
  }

  // Returns the units of lengths for an element with this paint.
  [[nodiscard]] UserUnits unitsOf(const PaintState& paint) const { return {units_.mm, paint.letters.size}; }

  // Chooses a font for a list of families. The last choice is kept: the list may be long, and elements that follow each
  // other mostly share it.
  const DrawingFont& fontOf(std::string_view families) {
    if (options_.letters.choose && (font_.name.empty() || families != families_)) {
      font_ = options_.letters.choose(families);
      families_ = families;
    }
    return font_;
  }

  // Applies the declarations of an element to the paint that it inherits.
  void applyTo(PaintState& paint, const Node& node, const Style& style, Vec2 viewport) {
    const double diagonal = std::sqrt(dot(viewport, viewport) / 2);
    const PaintContext context{
        [&](std::string_view id) { return serverPaint(id, byId_, styleSheet_, paint.color, work_); },
        [&](std::string_view text) { return unitsOf(paint).ofStyle(text, diagonal); },
        [&](std::string_view families) { return fontOf(families); }};
    if (const auto space = attribute(node, "xml:space")) paint.letters.keepsSpaces = *space == "preserve";
    apply(style, context, paint);
    const std::string_view name = elementName(node);
    if (name == "text" || name == "tspan" || name == "textPath") raiseLetters(style, context, paint.letters);
  }

  // Draws the root element and all that it contains.
  void drawRoot(const Node& root, Inherited state, const std::optional<ViewBox>& box) {
    shape_.drawing.texts = shape_.drawing.images = 0;
    if (!styleSheet_.unread().empty()) note("CSS " + styleSheet_.unread());
    if (!enter(root, state)) return;
    if (box) {
      state.toWorld = state.toWorld * fit(root, *box, state.viewport);
      state.viewport = box->size;
    }
    drawChildren(root, state);
  }

  void drawChildren(const Node& node, const Inherited& state) {
    for (const Node* child = node.first_node(); child; child = child->next_sibling()) draw(*child, state);
  }

  // Draws an element; elements not named here are not drawn: <defs>, <symbol>, <clipPath>, foreign ones, ...
  void draw(const Node& node, Inherited state) {
    const std::string_view name = elementName(node);
    const bool unread = name == "flowRoot" || name == "image";
    if (!isMeant(node)) return;
    if (name == "foreignObject") note("<foreignObject>");
    if (!unread && name != "text" && name != "g" && name != "a" && name != "switch" && name != "svg" && name != "use" &&
        !isShape(name)) {
      return;
    }
    if (!enter(node, state)) return;
    if (unread) {
      noteMedium(name == "image", state);
      return;
    }
    drawContent(node, state);
  }

  // Counts texts and images that are not drawn. In masks and clip paths they are only noted, because these are read as
  // often as they are used.
  void noteMedium(bool isImage, const Inherited& state) {
    if (reading_ != Aspect::Outlines && !state.paint.visible) return;
    if (reading_ == Aspect::Mask || reading_ == Aspect::Clip) return note(isImage ? "<image>" : "<text>");
    ++(isImage ? shape_.drawing.images : shape_.drawing.texts);
  }

  // Draws the content of an element whose own attributes have been read.
  void drawContent(const Node& node, const Inherited& state) {
    const std::string_view name = elementName(node);
    if (name == "g" || name == "a") drawChildren(node, state);
    if (name == "switch") drawSwitch(node, state);
    if (name == "svg") drawViewport(node, state, nullptr);
    if (name == "use") drawUse(node, state);
    if (isShape(name)) drawShape(node, state);
    if (name == "text") drawText(node, state);
  }

  // Draws the first child of a <switch> that isMeant().
  void drawSwitch(const Node& node, const Inherited& state) {
    for (const Node* child = node.first_node(); child; child = child->next_sibling()) {
      const std::string_view name = elementName(*child);
      if (!name.empty() && name != "foreignObject" && isMeant(*child)) return draw(*child, state);
    }
  }

  // Draws a nested <svg> or a <symbol>. \param use  the element that shows it and may give another size, or null.
  void drawViewport(const Node& node, Inherited state, const Node* use) {
    const UserUnits units = unitsOf(state.paint);
    const auto side = [&](const char* name, double full) {
      if (use && lengthOf(*use, name)) return units.of(*use, name, full, full);
      return units.of(node, name, full, full);
    };
    const Vec2 size{side("width", state.viewport.x), side("height", state.viewport.y)};
    if (size.x < 0 || size.y < 0) refuse("SvgNegativeSize");
    if (size.x == 0 || size.y == 0) return;
    const double x = units.of(node, "x", state.viewport.x, 0);
    const double y = units.of(node, "y", state.viewport.y, 0);
    state.toWorld = state.toWorld * shifted(x, y);
    state.viewport = size;
    const std::string overflow = styleSheet_.styleOf(node, work_).word("overflow"_css);
    if (reading_ != Aspect::Outlines && overflow != "visible" && overflow != "auto") {
      state.limits.push_back(rectangleLimit({0, 0}, size, state.toWorld));
    }
    if (const auto box = viewBoxOf(node)) {
      state.toWorld = state.toWorld * fit(node, *box, size);
      state.viewport = box->size;
    }
    drawChildren(node, state);
  }

  // Returns the element that a <use> refers to, or null if it has no href.
  const Node* usedBy(const Node& use) {
    const std::optional<std::string_view> href = hrefOf(use);
    if (!href) return nullptr;
    const std::string_view target = trimmed(*href);
    if (!startsWith(target, "#")) refuse("SvgHrefElsewhere", {{"text", quoted(target)}});
    const auto found = byId_.find(target.substr(1));
    if (found == byId_.end()) refuse("SvgHrefUnknown", {{"text", quoted(target)}});
    return found->second;
  }

  // Draws the element that a <use> refers to, with the place and size of the <use>.
  void drawUse(const Node& node, Inherited state) {
    const Node* const used = usedBy(node);
    if (!used) return;
    const Node& shown = *used;
    if (std::find(uses_.begin(), uses_.end(), used) != uses_.end()) {
      refuse("SvgShowsItself", {{"attribute", "href"}, {"text", quoted(*hrefOf(node))}});
    }
    state.paint.outer = std::make_shared<const std::pair<Paint, Paint>>(state.paint.fill, state.paint.stroke);
    const double x = unitsOf(state.paint).of(node, "x", state.viewport.x, 0);
    const double y = unitsOf(state.paint).of(node, "y", state.viewport.y, 0);
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

  void drawShape(const Node& node, const Inherited& state) {
    Outliner out(state.toWorld, options_.tolerance, pointsLeft_);
    if (!outlineShape(out, node, state.viewport, unitsOf(state.paint))) return;
    if (state.paint.strokeAlpha() >= kFaintest && state.paint.line.dashes && attribute(node, "pathLength")) {
      note("pathLength");
    }
    paint(out, state.paint, state);
  }

  // Draws a text; if some letter cannot be drawn, the text counts as left out.
  void drawText(const Node& node, const Inherited& state) {
    LetterRuns letters(lettersLeft_);
    if (!options_.letters.shape) return noteMedium(false, state);
    std::vector<Inherited> states;
    collectLetters(node, state, letters, states);
    const std::vector<LetterRun> runs = letters.take(state.viewport);
    const Result<std::vector<PlacedLetter>> placed = placeLetters(runs, letters.styles(), shaper_);
    if (!placed) return noteMedium(false, state);
    for (const PaintState& style : letters.styles()) noteLetters(style);
    for (const PlacedLetter& letter : placed.value()) {
      Outliner out(state.toWorld * letter.place, options_.tolerance, pointsLeft_);
      drawPath(out, *letter.outline);
      paint(out, letters.styles()[letter.style], states[letter.style]);
    }
    shape_.drawing.otherFont = shape_.drawing.otherFont || shaper_.tookOtherFont();
  }

  /// Collects the letters of an element and its children. \param states  receives one state for each of
  /// letters.styles().
  void collectLetters(const Node& node, const Inherited& state, LetterRuns& letters, std::vector<Inherited>& states) {
    const double length = unitsOf(state.paint).ofStyle(attribute(node, "textLength").value_or(""), state.viewport.x);
    const bool glyphs = attribute(node, "lengthAdjust").value_or("") == "spacingAndGlyphs";
    std::shared_ptr<const TextLength> around;
    if (length > 0) around = letters.setStretch(std::make_shared<const TextLength>(TextLength{length, glyphs}));
    if (around) note("textLength");  // a textLength inside another one is not read
    letters.open(node, unitsOf(state.paint));
    for (const Node* child = node.first_node(); child; child = child->next_sibling()) {
      if (child->type() == rapidxml::node_data || child->type() == rapidxml::node_cdata) {
        letters.add({child->value(), child->value_size()}, state.paint);
        states.resize(letters.styles().size(), state);
      } else if (child->type() == rapidxml::node_element) {
        const std::string_view name = elementName(*child);
        if ((name != "tspan" && name != "a" && name != "textPath") || !isMeant(*child)) continue;
        Inherited inside = state;
        if (!enter(*child, inside)) continue;
        if (name != "textPath") {
          collectLetters(*child, inside, letters, states);
        } else if (auto path = elementName(node) == "textPath" ? nullptr : textPathOf(*child, inside)) {
          letters.setPath(std::move(path));
          collectLetters(*child, inside, letters, states);
          letters.setPath(nullptr);
        }
      }
    }
    letters.close();
    if (length > 0) letters.setStretch(std::move(around));
  }

  // Returns the path of a <textPath>, or null if it refers to no outline; then its text is not shown.
  std::shared_ptr<const TextPath> textPathOf(const Node& node, const Inherited& state) {
    const std::string_view target = trimmed(hrefOf(node).value_or(""));
    const auto found = startsWith(target, "#") ? byId_.find(target.substr(1)) : byId_.end();
    const auto data = attribute(node, "path");
    if (!data && (found == byId_.end() || elementName(*found->second) != "path")) return nullptr;
    const Node& shape = data ? node : *found->second;
    if (std::abs(state.toWorld.linear().determinant()) < 1e-30) return nullptr;
    const Matrix own = data ? Matrix::Identity() : transformOf(shape, styleSheet_.styleOf(shape, work_), state);
    Outliner out(state.toWorld * own, options_.tolerance, pointsLeft_);
    drawPath(out, data ? *data : attribute(shape, "d").value_or(""));
    current_ = &node;
    const Matrix back = state.toWorld.inverse();
    const auto user = [&](Vec2 p) {
      const Eigen::Vector2d at = back * Eigen::Vector2d(p.x, p.y);
      return Vec2{at.x(), at.y()};
    };
    TextPath path;
    for (const PathLine& line : out.lines()) {
      for (std::size_t k = 1; k < line.points.size(); ++k) path.add(user(line.points[k - 1]), user(line.points[k]));
      if (line.closed) path.add(user(line.points.back()), user(line.points.front()));
    }
    path.start = unitsOf(state.paint).of(node, "startOffset", path.length(), 0);
    return std::make_shared<const TextPath>(std::move(path));
  }

  void noteLetters(const PaintState& style) {
    if (!style.visible) return;
    if (!styleSheet_.unreadOfLetters().empty()) note("CSS " + styleSheet_.unreadOfLetters());
    for (const std::string_view name : unreadOf(style.letters)) note(std::string(name));
  }

  // Fills and strokes an outline according to its paint.
  void paint(const Outliner& out, const PaintState& paint, const Inherited& state) {
    if (reading_ == Aspect::Outlines) {
      const std::size_t before = loose_.size();
      FilledPath path{out.rings(&loose_), paint.fillRule};
      for (std::size_t k = before; k < loose_.size(); ++k) loose_[k].layer = layers_.size();
      return show(std::move(path), state);
    }
    if (reading_ == Aspect::Clip) {
      if (paint.visible) show({out.rings(), paint.clipRule}, state);
      return;
    }
    if (paint.fillAlpha() >= kFaintest) {
      noteServer(paint.fill);
      std::vector<Ring> rings = out.rings();
      filled_ = filled_ || (reading_ == Aspect::Painted && !rings.empty());
      show({std::move(rings), paint.fillRule}, state, paint.fill, paint.fillAlpha());
    }
    if (paint.strokeAlpha() >= kFaintest) {
      noteServer(paint.stroke);
      const Matrix& pen = paint.strokeScales ? state.toWorld : toPage_;
      show({strokeRings(out.lines(), paint.line, pen, options_.tolerance, pointsLeft_), FillRule::NonZero}, state,
           paint.stroke, paint.strokeAlpha());
    }
  }

  void noteServer(const Paint& paint) {
    if (paint.pattern) note("<pattern>");
    if (paint.gradient && reading_ == Aspect::Mask && !paint.black()) note("gradient in <mask>");
  }

  // Adds the part of a path that lies within all limits and on the page.
  void show(FilledPath path, const Inherited& state, const Paint& paint = {}, double alpha = 1) {
    if (path.rings.empty()) return;
    if (reading_ == Aspect::Outlines) {
      layers_.push_back({std::move(path)});
      return;
    }
    const bool hides = reading_ == Aspect::Mask && paint.black() && !maskByAlpha_;
    if (hides && alpha < 1 - kFaintest) return;  // grey still shows
    if (reading_ == Aspect::Painted) painted_ = true;
    std::vector<const Limit*> limits;
    for (const auto& limit : state.limits) limits.push_back(limit.get());
    std::shared_ptr<const Limit> seen;
    if (paint.fading) seen = seenOf(*paint.fading, state, boxOf(path.rings));
    if (seen) limits.push_back(seen.get());
    path = within(std::move(path), limits, work_);
    if (reading_ == Aspect::Painted) path = onPage(std::move(path));
    if (path.rings.empty()) return;
    if (reading_ == Aspect::Painted) {
      if (layers_.empty()) colour_ = paint.colour;
      shape_.drawing.severalColours = shape_.drawing.severalColours || paint.colour != colour_;
    }
    layers_.push_back({std::move(path), !hides, {static_cast<std::uint32_t>(paint.colour & 0xFFFFFF), alpha}});
  }

  // Returns the visible part of a gradient, or null if all of it is visible.
  std::shared_ptr<const Limit> seenOf(const Node& gradient, const Inherited& state, const Bounds& around) {
    const Node* const node = current_;
    const GradientPlace place{state.toWorld, userBox(*node, state), state.viewport, unitsOf(state.paint), around};
    current_ = node;
    std::optional<FilledPath> seen = seenOfGradient(gradient, place, byId_, styleSheet_, work_);
    return seen ? limitOf(*std::move(seen)) : nullptr;
  }

  // Returns DrawingFacts::faintMm2. Faint shapes on or along firm ones are shadows, not a second tone.
  double faintArea() const {
    const auto isFaint = [](const PaintLayer& layer) { return layer.paint.alpha <= kFaint; };
    const auto faint = std::count_if(layers_.begin(), layers_.end(), isFaint);
    if (faint == 0 || faint == std::ssize(layers_)) return 0;
    Shape all, firm;
    for (const PaintLayer& layer : layers_) {
      all.paths.push_back(layer.path);
      if (!isFaint(layer)) firm.paths.push_back(layer.path);
    }
    const Result<Outline> whole = resolveOutline(all), without = resolveOutline(firm);
    if (!whole || !without) return 0;
    const double area = whole.value().area - without.value().area;
    return area > kLeastFaint * whole.value().area ? area : 0;
  }

  FilledPath onPage(FilledPath path) {
    const Bounds box = boxOf(path.rings);
    if (covers(page_, box)) return path;
    for (FilledPath& off : beyondBox(path, page_, work_)) offPage_.paths.push_back(std::move(off));
    return within(std::move(path), {&page_}, work_);
  }

  std::shared_ptr<const Limit> rectangleLimit(Vec2 corner, Vec2 size, const Matrix& toWorld) {
    Outliner out(toWorld, options_.tolerance, pointsLeft_);
    drawRectangle(out, corner, size, {});
    return limitOf({out.rings(), FillRule::NonZero});
  }

  // Adds `clip-path` and `mask` of an element to its limits. A reference to no element limits nothing.
  void addLimits(const Node& node, const Style& style, Inherited& state) {
    const auto named = [&](Property property, const char* kind) -> const Node* {
      const std::string& value = style.value(property);
      const Node* const target = targetOf(value, kind);
      // covers circle(), linear-gradient(), and url() of another file
      if (value.find('(') != std::string::npos && urlOf(value).empty()) note("CSS " + quoted(nameOf(property)));
      if (std::find(uses_.begin(), uses_.end(), target) != uses_.end()) {
        refuse("SvgShowsItself", {{"attribute", nameOf(property)}, {"text", quoted(value)}});
      }
      return target;
    };
    const Node* const clip = named("clip-path"_css, "clipPath");
    const Node* const mask = named("mask"_css, "mask");
    if (clip) addClip(*clip, node, state);
    if (mask) addMask(*mask, node, state);
  }

  // Returns the units of a limit: user space, or the element's box if `attributeName` says objectBoundingBox.
  Matrix unitsOf(const Node& limit, const char* attributeName, bool boxIsDefault, const Node& node,
                 const Inherited& state) {
    const auto units = attribute(limit, attributeName);
    const bool byBox = units ? trimmed(*units) == "objectBoundingBox" : boxIsDefault;
    if (!byBox) return Matrix::Identity();
    const Bounds box = userBox(node, state);
    if (box.empty()) return matrix(0, 0, 0, 0, 0, 0);
    return matrix(box.size().x, 0, 0, box.size().y, box.min.x, box.min.y);
  }

  // Returns the box around all outlines of an element, without strokes, in its user units.
  Bounds userBox(const Node& node, Inherited state) {
    if (std::abs(state.toWorld.linear().determinant()) < 1e-30) return {};
    const Matrix toUser = state.toWorld.inverse();
    state.limits.clear();
    const std::int64_t points = pointsLeft_;
    const int texts = shape_.drawing.texts;
    const std::size_t loose = loose_.size();
    const Node* shown = &node;  // a part of a text has the box of the whole text
    while (elementName(*shown) == "tspan" || elementName(*shown) == "textPath") shown = shown->parent();
    const std::vector<PaintLayer> layers = drawnAs(Aspect::Outlines, [&] { drawContent(*shown, state); });
    loose_.resize(loose);
    pointsLeft_ = points;
    shape_.drawing.texts = texts;
    Bounds box;
    for (const PaintLayer& layer : layers) {
      for (const Ring& ring : layer.path.rings) {
        for (const Vec2 p : ring) {
          const Eigen::Vector2d user = toUser * Eigen::Vector2d(p.x, p.y);
          box.add({user.x(), user.y()});
        }
      }
    }
    return box;
  }

  // Returns the layers that `body` draws, and leaves those of the drawing as they are.
  template <class Body>
  std::vector<PaintLayer> drawnAs(Aspect reading, const Body& body) {
    std::vector<PaintLayer> kept;
    kept.swap(layers_);
    const Aspect before = std::exchange(reading_, reading);
    body();
    reading_ = before;
    kept.swap(layers_);
    return kept;
  }

  // Returns the paint that an element inherits from its place in the document.
  PaintState inheritedBy(const Node& node, const Inherited& state) {
    PaintState paint = initialPaint();
    if (const Node* parent = node.parent(); parent && parent->type() == rapidxml::node_element) {
      paint = inheritedBy(*parent, state);
    }
    work_.spend(node);
    applyTo(paint, node, styleSheet_.styleOf(node, work_), state.viewport);
    paint.opacity = 1;
    return paint;
  }

  // Returns the initial state for the children of <clipPath> or <mask>.
  Inherited stateInside(const Node& limit, const Inherited& state) {
    Inherited inside;
    inside.toWorld = state.toWorld;
    inside.viewport = state.viewport;
    inside.paint = inheritedBy(limit, state);
    inside.depth = state.depth + 1;
    if (inside.depth > kMaxDepth) refuseTooLarge("SvgNested", {{"most", kMaxDepth}});
    return inside;
  }

  // Adds the area of a <clipPath> to the limits of an element.
  void addClip(const Node& clip, const Node& node, Inherited& state) {
    Inherited inside = stateInside(clip, state);
    uses_.push_back(&clip);
    const Style style = styleSheet_.styleOf(clip, work_);
    addLimits(clip, style, inside);
    inside.toWorld =
        inside.toWorld * transformOf(clip, style, inside) * unitsOf(clip, "clipPathUnits", false, node, state);
    const std::vector<PaintLayer> layers = drawnAs(Aspect::Clip, [&] {
      for (const Node* child = clip.first_node(); child; child = child->next_sibling()) {
        const Node* const target = elementName(*child) == "use" ? usedBy(*child) : child;  // groups do not count
        const std::string_view name = target ? elementName(*target) : std::string_view();
        if (name == "text" || isShape(name)) draw(*child, inside);
      }
    });
    uses_.pop_back();
    state.limits.push_back(limitOf(flattened(layers, work_)));
  }

  // Adds the frame of a <mask>, and the area that it shows, to the limits of an element.
  void addMask(const Node& mask, const Node& node, Inherited& state) {
    const Matrix frame = unitsOf(mask, "maskUnits", true, node, state);
    const auto frameUnits = attribute(mask, "maskUnits");
    const bool byBox = !frameUnits || trimmed(*frameUnits) == "objectBoundingBox";
    const Vec2 full = byBox ? Vec2{1, 1} : state.viewport;
    const UserUnits units = unitsOf(state.paint);
    const Vec2 corner{units.of(mask, "x", full.x, -0.1 * full.x), units.of(mask, "y", full.y, -0.1 * full.y)};
    const Vec2 size{units.of(mask, "width", full.x, 1.2 * full.x), units.of(mask, "height", full.y, 1.2 * full.y)};
    Inherited inside = stateInside(mask, state);
    inside.toWorld = state.toWorld * unitsOf(mask, "maskContentUnits", false, node, state);
    uses_.push_back(&mask);
    const Style style = styleSheet_.styleOf(mask, work_);
    addLimits(mask, style, inside);
    const bool before = std::exchange(maskByAlpha_, style.word("mask-type"_css) == "alpha");
    const std::vector<PaintLayer> layers = drawnAs(Aspect::Mask, [&] { drawChildren(mask, inside); });
    maskByAlpha_ = before;
    uses_.pop_back();
    state.limits.push_back(
        rectangleLimit(corner, {std::max(0.0, size.x), std::max(0.0, size.y)}, state.toWorld * frame));
    state.limits.push_back(limitOf(flattened(layers, work_)));
  }

  SvgOptions options_;
  const Node*& current_;
  UserUnits units_;
  Aspect reading_;
  bool maskByAlpha_ = false;
  Matrix toPage_ = Matrix::Identity();  // from the page's units to mm
  Shape shape_;
  std::vector<PaintLayer> layers_;
  std::vector<LoosePiece> loose_;
  Limit page_;
  Shape offPage_;
  bool painted_ = false;  // true if something is painted, even off the page
  bool filled_ = false;
  std::uint64_t colour_ = 0;  // colour of the first painted layer
  Ids byId_;
  StyleSheet styleSheet_;
  bool definesProperty_ = false;   // true if some declaration defines a custom property, for var()
  std::vector<const Node*> uses_;  // elements that <use>, clip-path or mask is showing, outermost first
  std::int64_t pointsLeft_ = kMaxPoints;
  std::int64_t lettersLeft_ = kMaxLetters;
  std::string families_;  // families for which font_ was chosen
  DrawingFont font_;
  LetterShaper shaper_;
  Work work_;
};

}  // namespace

SvgPainting drawElements(const Node& root, const SvgOptions& options, const Node*& current) {
  return DrawingReader(options, current).read(root);
}

}  // namespace sillon::svg
