#include "input/svg/svg_node.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace sillon::svg {
namespace {

constexpr std::size_t kMaxBindings = 64;  // bindings at one place; every prefixed name is looked up among them
constexpr std::string_view kSvg = "http://www.w3.org/2000/svg", kXlink = "http://www.w3.org/1999/xlink";

// Returns the prefix of a name with its colon, or an empty string if there is none.
std::string_view prefixOf(std::string_view name) { return name.substr(0, std::min(name.find(':') + 1, name.size())); }

std::string_view nameOf(const rapidxml::xml_base<>& named) { return {named.name(), named.name_size()}; }

class Namespaces {
 public:
  void run(Node& root) {
    declare(root);
    svg_ = uriOf(prefixOf(nameOf(root)));
    bound_.resize(2);
    resolve(root);
  }

 private:
  // Adds the namespaces that an element declares.
  void declare(const Node& node) {
    for (const auto* a = node.first_attribute(); a; a = a->next_attribute()) {
      const std::string_view name = nameOf(*a);
      if (name != "xmlns" && !startsWith(name, "xmlns:")) continue;
      if (bound_.size() == kMaxBindings) refuseTooLarge("SvgNamespaces", {{"most", kMaxBindings}});
      bound_.emplace_back(name.substr(std::min<std::size_t>(name.size(), 6)),
                          std::string_view(a->value(), a->value_size()));
    }
  }

  // Returns the namespace of a prefix, or the prefix itself if it is not declared.
  [[nodiscard]] std::string_view uriOf(std::string_view prefix) const {
    prefix = prefix.substr(0, prefix.size() - (prefix.empty() ? 0 : 1));
    const auto found = std::find_if(bound_.rbegin(), bound_.rend(), [&](const auto& b) { return b.first == prefix; });
    return found == bound_.rend() ? prefix : found->second;
  }

  // Renames an element, its XLink references, and all elements inside it.
  void resolve(Node& node) {
    const std::size_t outside = bound_.size();
    declare(node);
    const std::string_view name = nameOf(node), prefix = prefixOf(name);
    const std::string_view uri = uriOf(prefix);
    const bool isSvg = uri == svg_ || uri == kSvg;
    node.name(node.name() + prefix.size(), isSvg ? name.size() - prefix.size() : 0);
    for (auto* a = node.first_attribute(); a; a = a->next_attribute()) {
      const std::string_view full = nameOf(*a), before = prefixOf(full);
      if (!before.empty() && full.substr(before.size()) == "href" && uriOf(before) == kXlink) a->name("xlink:href");
    }
    for (Node* child = node.first_node(); child; child = child->next_sibling()) {
      if (child->type() == rapidxml::node_element) resolve(*child);
    }
    bound_.resize(outside);
  }

  // Prefixes and their namespaces, innermost last; these two may be used without a declaration.
  std::vector<std::pair<std::string_view, std::string_view>> bound_{{"svg", kSvg}, {"xlink", kXlink}};
  std::string_view svg_;  // namespace of the root, whatever it is: some files declare none or a wrong one
};

}  // namespace

void resolveNamespaces(Node& root) {
  const std::string_view name = nameOf(root);
  if (name.substr(prefixOf(name).size()) != "svg") {
    refuse("SvgFirstElement", {{"text", quoted(name)}});
  }
  Namespaces().run(root);
}

}  // namespace sillon::svg
