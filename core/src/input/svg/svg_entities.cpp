#include "input/svg/svg_node.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace sillon::svg {
namespace {

constexpr std::size_t kMaxEntities = 1000, kMaxName = 64;
constexpr std::size_t kMaxDeclared = std::size_t{1} << 20;  // bytes of all entities, which may contain each other

struct Entity {
  std::string_view name;
  std::string value;
};

class Entities {
 public:
  /// Reads the declarations of a DOCTYPE. \return the offset of their end.
  std::size_t declare(std::string_view text, std::size_t at) {
    std::size_t bytes = 0;
    while ((at = text.find_first_of("<]", at)) != std::string_view::npos && text[at] == '<') {
      const std::string_view rest = text.substr(at);
      const std::string_view close = startsWith(rest, "<!--") ? "-->" : ">";
      const std::size_t quote = rest.find_first_of("\"'>");
      if (startsWith(rest, "<!ENTITY") && quote != std::string_view::npos && rest[quote] != '>') {
        const std::size_t end = rest.find(rest[quote], quote + 1);
        if (end == std::string_view::npos) return text.size();
        // Parameter entities ("% name") and external ones ("name SYSTEM") yield names that no valid reference has.
        const std::string_view name = trimmed(rest.substr(8, quote - 8));
        const auto place = find(name);
        if (place == known_.end() || place->name != name) {
          std::string value = expanded(rest.substr(quote + 1, end - quote - 1), kMaxDeclared);
          bytes += value.size();
          if (bytes > kMaxDeclared || known_.size() == kMaxEntities) refuseTooLarge("SvgEntities");
          known_.insert(place, {name, std::move(value)});
        }
        at += end;
      }
      at = std::min(text.find(close, at), text.size());
    }
    return std::min(at, text.size());
  }

  [[nodiscard]] bool empty() const { return known_.empty(); }

  /// Replaces references to known entities; others stay as they are.
  [[nodiscard]] std::string expanded(std::string_view text, std::size_t maxBytes) {
    std::string out;
    while (true) {
      const std::size_t begin = std::min(text.find('&'), text.size());
      const std::size_t end = text.substr(begin, kMaxName).find(';');
      const auto known = end == std::string_view::npos ? known_.end() : find(text.substr(begin + 1, end - 1));
      const bool isKnown = known != known_.end() && known->name == text.substr(begin + 1, end - 1);
      out += text.substr(0, isKnown ? begin : begin + 1);
      if (isKnown) out += known->value;
      if (out.size() > maxBytes) refuseTooLarge("SvgEntities");
      if (begin == text.size()) return out;
      text.remove_prefix(isKnown ? begin + end + 1 : begin + 1);
    }
  }

 private:
  std::vector<Entity>::iterator find(std::string_view name) {
    return std::lower_bound(known_.begin(), known_.end(), name,
                            [](const Entity& entity, std::string_view wanted) { return entity.name < wanted; });
  }

  std::vector<Entity> known_;  // sorted by name
};

}  // namespace

std::string withEntities(std::string_view text, std::size_t maxBytes) {
  const std::size_t doctype = text.find("<!DOCTYPE");
  const std::size_t subset = text.find_first_of("[>", doctype);
  if (doctype == std::string_view::npos || subset == std::string_view::npos || text[subset] == '>') return {};
  Entities entities;
  const std::size_t end = entities.declare(text, subset);
  if (entities.empty()) return {};
  return std::string(text.substr(0, end)) + entities.expanded(text.substr(end), maxBytes);
}

}  // namespace sillon::svg
