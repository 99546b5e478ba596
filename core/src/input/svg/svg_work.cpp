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
  check("<use> repeats so many elements");
}

void Work::spendOnCuts(const FilledPath& path, std::int64_t bytesPerPoint) {
  for (const Ring& ring : path.rings) spent_ += bytesPerPoint * static_cast<std::int64_t>(ring.size());
  check("clipping repeats so many outlines", "; combine the paths under each clip path or mask into one");
}

void Work::spendOnRules(std::size_t bytes) {
  spent_ += static_cast<std::int64_t>(bytes);
  check("<style> has so many rules");
}

void Work::check(const char* problem, const char* wayOut) const {
  if (spent_ > kMaxWork) refuseTooLarge(std::string(problem) + " that the drawing becomes too large" + wayOut);
}

}  // namespace sillon::svg
