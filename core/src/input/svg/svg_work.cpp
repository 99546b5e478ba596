#include "input/svg/svg_work.hpp"

#include <string>

#include "input/svg/svg_reader.hpp"

namespace sillon::svg {
namespace {

constexpr std::int64_t kMaxWork = std::int64_t{256} << 20;
constexpr std::int64_t kWorkPerElement = 64;  // bytes that an element without attributes counts as

}  // namespace

void Work::spend(const Node& node) {
  spent_ += kWorkPerElement;
  for (const auto* a = node.first_attribute(); a; a = a->next_attribute()) {
    spent_ += static_cast<std::int64_t>(a->name_size() + a->value_size());
  }
  check("SvgUseRepeats");
}

void Work::spendOnCuts(const FilledPath& path, std::int64_t bytesPerPoint) {
  for (const Ring& ring : path.rings) spent_ += bytesPerPoint * static_cast<std::int64_t>(ring.size());
  check("SvgClipRepeats");
}

void Work::spendOnRules(std::size_t bytes) {
  spent_ += static_cast<std::int64_t>(bytes);
  check("SvgStyleRules");
}

void Work::check(Reason reason) const {
  if (spent_ > kMaxWork) refuseTooLarge(reason);
}

}  // namespace sillon::svg
