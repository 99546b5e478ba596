#include "input/svg/svg_style.hpp"

#include <algorithm>

namespace sillon::svg {
namespace {

// CSS properties that change what is shown, but are not read.
constexpr std::array<std::string_view, 14> kUnread{"cx", "cy", "d",     "height",    "offset-path", "r", "rotate",
                                                   "rx", "ry", "scale", "translate", "width",       "x", "y"};
const Declared kNothing;
// Pseudo-classes that never hold in a still picture.
constexpr std::array<std::string_view, 5> kOfUse{":hover", ":focus", ":active", ":visited", ":target"};

// Removes the comments of CSS.
std::string withoutComments(std::string_view text) {
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

// Replaces each var() by its fallback. A var() without fallback stays; such a value cannot be read.
std::string withFallbacks(std::string value) {
  for (int rounds = 0; rounds < 8; ++rounds) {  // fallbacks may contain further ones
    const std::size_t begin = value.find("var(");
    const std::size_t comma = value.find_first_of(",)", begin);
    if (comma == std::string::npos || value[comma] == ')') break;
    std::size_t end = comma;
    for (int depth = 1; depth > 0 && ++end < value.size();) depth += (value[end] == '(') - (value[end] == ')');
    const std::string fallback(trimmed(std::string_view(value).substr(comma + 1, end - comma - 1)));
    value.replace(begin, end + 1 - begin, fallback);
  }
  return value;
}

// Tells whether a property is about letters.
constexpr bool isOfLetters(Property property) {
  constexpr auto kOfLetters = [] {
    std::array<bool, std::size(kPropertyNames)> of{};
    for (const Property read :
         {"alignment-baseline"_css, "baseline-shift"_css, "dominant-baseline"_css, "font"_css, "font-family"_css,
          "font-size"_css, "font-style"_css, "letter-spacing"_css, "text-anchor"_css, "text-decoration"_css,
          "text-decoration-line"_css, "white-space"_css, "word-spacing"_css}) {
      of[toSize(read)] = true;
    }
    for (const Property unread : kUnreadOfLetters) of[toSize(unread)] = true;
    return of;
  }();
  return kOfLetters[toSize(property)];
}

// Tells whether a list of media includes screens.
bool isForScreens(std::string_view media) {
  bool found = trimmed(media).empty();
  split(media, ',', [&](std::string_view one) {
    const std::string medium = lowered(trimmed(one));
    found = found || medium == "all" || medium == "screen";
  });
  return found;
}

}  // namespace

void Declared::set(std::string_view newValue, std::int64_t newWeight) {
  if (newWeight < weight) return;
  value = trimmed(newValue);
  weight = newWeight;
}

const Declared& Style::of(Property property) const {
  for (const auto& [known, declared] : declared_) {
    if (known == property) return declared;
  }
  return kNothing;
}

Declared& Style::made(Property property) {
  for (auto& [known, declared] : declared_) {
    if (known == property) return declared;
  }
  return declared_.emplace_back(property, Declared{}).second;
}

void Style::set(Property property, std::string_view value, std::int64_t weight) {
  Declared& declared = made(property);
  if (value.find("var(") == std::string_view::npos) return declared.set(value, weight);
  const std::string resolved = withFallbacks(std::string(value));
  fallsBack_ = fallsBack_ || resolved != value;
  declared.set(resolved, weight);
}

std::string_view Style::unreadFunction() const {
  for (const auto& [property, declared] : declared_) {
    for (const std::string_view function : {"var(", "calc("}) {
      if (declared.value.find(function) != std::string::npos) return function == "var(" ? "var()" : "calc()";
    }
  }
  return {};
}

bool Style::unreadMoves() const {
  return unread_ == "offset-path" || unread_ == "rotate" || unread_ == "scale" || unread_ == "translate";
}

bool Style::setsLetters() const {
  return std::any_of(declared_.begin(), declared_.end(), [](const auto& one) { return isOfLetters(one.first); });
}

bool Style::setsLettersOnly() const {
  return unread_.empty() &&
         std::all_of(declared_.begin(), declared_.end(), [](const auto& one) { return isOfLetters(one.first); });
}

std::size_t Style::cost() const {
  std::size_t sum = 0;
  for (const auto& [property, declared] : declared_) sum += declared.value.size();
  return sum / 4;  // copying costs less than comparing
}

void Style::declare(std::string_view declarations, std::int64_t weight) {
  split(declarations, ';', [&](std::string_view declaration) {
    const std::size_t colon = declaration.find(':');
    if (colon == std::string_view::npos) return;
    const std::string name = lowered(trimmed(declaration.substr(0, colon)).substr(0, 32));
    const auto found = std::find(std::begin(kPropertyNames), std::end(kPropertyNames), name);
    if (found == std::end(kPropertyNames)) {
      const auto unread = std::find(kUnread.begin(), kUnread.end(), name);
      const bool nothing = lowered(trimmed(declaration.substr(colon + 1)).substr(0, 5)) == "none";
      if (unread != kUnread.end() && !nothing) unread_ = *unread;
      return;
    }
    std::string_view value = declaration.substr(colon + 1);
    const std::size_t mark = value.find('!');
    const bool important = mark != std::string_view::npos && lowered(value.substr(mark)).find("important") < 12;
    set(static_cast<Property>(found - std::begin(kPropertyNames)), value.substr(0, mark),
        weight + (important ? 2 * kStyleAttribute : 0));
  });
}

void Style::add(const Style& other) {
  for (const auto& [property, declared] : other.declared_) made(property).set(declared.value, declared.weight);
  if (!other.unread_.empty()) unread_ = other.unread_;
  fallsBack_ = fallsBack_ || other.fallsBack_;
}

void Style::raise(std::int64_t weight) {
  for (auto& [property, declared] : declared_) declared.weight += weight;
}

bool definesProperty(std::string_view css) {
  for (std::size_t at = css.find("--"); at != std::string_view::npos; at = css.find("--", at + 2)) {
    if (at == 0 || css[at - 1] == '{' || css[at - 1] == ';' || isSpace(css[at - 1])) return true;
  }
  return false;
}

void StyleSheet::add(std::string_view text, std::string_view media) {
  const std::string css = withoutComments(text);
  if (!isForScreens(media)) return noteAtRule("@media", css);
  std::string_view rest = css;
  while (true) {
    rest = trimmed(rest);
    const std::size_t open = rest.find_first_of("{;");
    if (open == std::string_view::npos) return;
    const std::string_view head = trimmed(rest.substr(0, open));
    if (rest[open] == ';') {  // @import and similar rules
      rest.remove_prefix(open + 1);
      continue;
    }
    std::size_t end = open + 1;
    for (int depth = 1; depth > 0 && end < rest.size(); ++end) {
      if (rest[end] == '{') ++depth;
      if (rest[end] == '}') --depth;
    }
    const std::string_view body = rest.substr(open + 1, end - open - 1);
    if (startsWith(head, "@")) {
      noteAtRule(head, body);
    } else {
      addRule(head, body);
    }
    rest.remove_prefix(end);
  }
}

// Notes an at-rule that is not read. @media and similar ones may hold rules that count; @font-face and keyframes do not
// change a still picture.
void StyleSheet::noteAtRule(std::string_view head, std::string_view body) {
  const std::string name = lowered(head.substr(0, head.find_first_of(" \t\r\n(")));
  if (name == "@font-face" || name == "@page" || name.find("keyframes") != std::string::npos) return;
  const std::size_t open = body.find('{');
  Style probe;
  if (open != std::string_view::npos) probe.declare(body.substr(open + 1, body.find('}', open) - open - 1), 0);
  note(name, probe.setsLettersOnly());
}

Style StyleSheet::styleOf(const Node& node, Work& work) const {
  Style style;
  for (const auto* a = node.first_attribute(); a; a = a->next_attribute()) {
    const std::string_view name(a->name(), a->name_size());
    const auto found = std::find(std::begin(kPropertyNames), std::end(kPropertyNames), name);
    if (found == std::end(kPropertyNames)) continue;
    style.set(static_cast<Property>(found - std::begin(kPropertyNames)), {a->value(), a->value_size()}, 0);
  }
  if (!rules_.empty()) match(node, style, work);
  for (const auto& [selector, declared] : nested_) {
    if (!selector.fits(node, work)) continue;
    work.spendOnRules(declared.cost());
    style.add(declared);
  }
  style.declare(attribute(node, "style").value_or(""), kStyleAttribute);
  return style;
}

void StyleSheet::match(const Node& node, Style& style, Work& work) const {
  const auto look = [&](const std::string& selector) {
    const auto found = rules_.find(selector);
    if (found == rules_.end()) return;
    work.spendOnRules(found->second.cost());
    style.add(found->second);
  };
  const std::string name(elementName(node));
  look("*");
  look(name);
  std::string_view classes = attribute(node, "class").value_or("");
  while (!(classes = trimmed(classes)).empty()) {
    const auto* end = std::find_if(classes.data(), classes.data() + classes.size(), isSpace);
    const std::string token(classes.data(), end);
    classes.remove_prefix(token.size());
    look('.' + token);
    look(name + '.' + token);
  }
  if (const auto id = attribute(node, "id")) {
    const std::string token(*id);
    look('#' + token);
    look(name + '#' + token);
  }
}

void StyleSheet::addRule(std::string_view selectors, std::string_view body) {
  const std::string_view declarations = body.substr(0, body.find_first_of("{}"));
  if (declarations.size() < body.size() && body[declarations.size()] == '{') note("nested rules");
  Style probe;
  probe.declare(declarations, 0);
  if (probe.empty()) return;
  split(selectors, ',', [&](std::string_view text) {
    text = trimmed(text);
    const auto isIn = [&](std::string_view name) { return text.find(name) != std::string_view::npos; };
    if (text.empty() || std::any_of(kOfUse.begin(), kOfUse.end(), isIn)) return;
    const std::optional<Selector> selector = Selector::read(text);
    if (!selector) {
      note(text, probe.setsLettersOnly());
      return;
    }
    Style style = probe;
    style.raise((selector->specificity() << 40) + ++order_);
    const Compound& last = selector->elements.back();
    if (selector->elements.size() > 1 || last.marks.size() > 1) {
      nested_.emplace_back(*selector, std::move(style));
    } else if (last.marks.empty()) {
      rules_[last.name.empty() ? "*" : last.name].add(style);
    } else {
      rules_[last.name + last.marks[0]].add(style);
    }
  });
}

void StyleSheet::note(std::string_view what, bool lettersOnly) {
  std::string& unread = lettersOnly ? unreadOfLetters_ : unread_;
  if (unread.empty()) unread = quoted(what);
}

}  // namespace sillon::svg
