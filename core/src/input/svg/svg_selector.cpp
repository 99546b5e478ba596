#include "input/svg/svg_style.hpp"

#include <algorithm>

#include "input/svg/svg_reader.hpp"

namespace sillon::svg {
namespace {

constexpr std::size_t kMaxElements = 16;  // compounds of a selector; Selector::fits() has a bit for each
constexpr std::string_view kMarks = ".#";

bool isPlain(char c) {
  return isLetter(c) || isDigit(c) || c == '-' || c == '_' || static_cast<unsigned char>(c) > 127;
}

/// Parses a compound such as `g.a#b`; nothing if it contains anything else.
std::optional<Compound> readCompound(std::string_view text, bool child) {
  const std::size_t end = std::min(text.find_first_of(kMarks), text.size());
  Compound compound{std::string(text.substr(0, end)), {}, child};
  if (compound.name == "*") compound.name.clear();
  text.remove_prefix(end);
  while (!text.empty()) {
    const std::size_t next = std::min(text.find_first_of(kMarks, 1), text.size());
    if (next < 2) return std::nullopt;
    compound.marks.emplace_back(text.substr(0, next));
    text.remove_prefix(next);
  }
  const auto plain = [](std::string_view part) { return std::all_of(part.begin(), part.end(), isPlain); };
  if (!plain(compound.name)) return std::nullopt;
  for (const std::string& mark : compound.marks) {
    if (!plain(std::string_view(mark).substr(1))) return std::nullopt;
  }
  return compound;
}

/// Tells whether a list of classes contains one.
bool hasClass(std::string_view classes, std::string_view wanted) {
  for (std::size_t at = classes.find(wanted); at != std::string_view::npos; at = classes.find(wanted, at + 1)) {
    const std::size_t end = at + wanted.size();
    if ((at == 0 || isSpace(classes[at - 1])) && (end == classes.size() || isSpace(classes[end]))) return true;
  }
  return false;
}

}  // namespace

bool Compound::fits(const Node& node, Work& work) const {
  work.spendOnRules(16);
  if (!name.empty() && name != elementName(node)) return false;
  return std::all_of(marks.begin(), marks.end(), [&](std::string_view mark) {
    const std::string_view value = attribute(node, mark[0] == '#' ? "id" : "class").value_or("");
    work.spendOnRules(value.size());
    return mark[0] == '#' ? value == mark.substr(1) : hasClass(value, mark.substr(1));
  });
}

std::optional<Selector> Selector::read(std::string_view text) {
  Selector selector;
  bool child = false;
  while (!(text = trimmed(text)).empty()) {
    if (text[0] == '>') {
      if (child || selector.elements.empty()) return std::nullopt;
      child = true;
      text.remove_prefix(1);
      continue;
    }
    const std::size_t end = std::min(text.find_first_of(" \t\r\n\f>"), text.size());
    std::optional<Compound> compound = readCompound(text.substr(0, end), child);
    if (!compound || selector.elements.size() == kMaxElements) return std::nullopt;
    selector.elements.push_back(*std::move(compound));
    child = false;
    text.remove_prefix(end);
  }
  if (child || selector.elements.empty()) return std::nullopt;
  return selector;
}

bool Selector::fits(const Node& node, Work& work) const {
  if (!elements.back().fits(node, work)) return false;
  if (elements.size() == 1) return true;
  std::vector<const Node*> path;  // from the element up to the root
  for (const Node* up = &node; up && up->type() == rapidxml::node_element; up = up->parent()) path.push_back(up);
  // Bit k is set if the selector up to its element k fits and ends at some element above, or at the parent.
  std::uint32_t above = 0, parent = 0;
  for (std::size_t at = path.size(); at-- > 0;) {
    std::uint32_t here = 0;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const std::uint32_t before = elements[k].child ? parent : above;
      if ((k == 0 || (before >> (k - 1) & 1) != 0) && elements[k].fits(*path[at], work)) here |= 1U << k;
    }
    above |= here;
    parent = here;
  }
  return (parent >> (elements.size() - 1) & 1) != 0;
}

std::int64_t Selector::specificity() const {
  std::int64_t ids = 0, classes = 0, names = 0;
  for (const Compound& element : elements) {
    if (!element.name.empty()) ++names;
    for (const std::string& mark : element.marks) ++(mark[0] == '#' ? ids : classes);
  }
  return std::min<std::int64_t>(ids, 63) << 14 | std::min<std::int64_t>(classes, 127) << 7 | names;
}

}  // namespace sillon::svg
