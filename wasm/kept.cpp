#include "kept.hpp"

#include <algorithm>
#include <cstring>
#include <list>
#include <stdexcept>
#include <utility>

#include "call.hpp"
#include "convert.hpp"

namespace sillon::bindings::kept {
namespace {

constexpr std::size_t kMostPlates = 2;
constexpr std::size_t kMostNumbers = 8;  // limit on numbers of the same beads

struct Plate {
  std::list<int> numbers;
  Toolpath toolpath;
};

std::list<Plate> plates;  // least recently used first; a list, so that references to the others stay valid
int gcodeNumber = 0;
std::string gcodeText;

template <class T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool sameCycles(const Toolpath& a, const Toolpath& b) {
  return std::equal(a.cycles.begin(), a.cycles.end(), b.cycles.begin(), b.cycles.end(),
                    [](const Cycle& one, const Cycle& other) {
                      return sameBytes(one.points, other.points) && sameBytes(one.widths, other.widths);
                    });
}

Toolpath& usedLast(std::list<Plate>::iterator plate) {
  plates.splice(plates.end(), plates, plate);
  return plate->toolpath;
}

}  // namespace

void keep(int number, Toolpath toolpath) {
  const auto same = std::find_if(plates.begin(), plates.end(),
                                 [&](const Plate& plate) { return sameCycles(plate.toolpath, toolpath); });
  if (same == plates.end()) {
    if (plates.size() == kMostPlates) plates.pop_front();
    plates.push_back({{number}, std::move(toolpath)});
    return;
  }
  same->numbers.push_back(number);
  if (same->numbers.size() > kMostNumbers) same->numbers.pop_front();
  usedLast(same);
}

const Toolpath& toolpathOf(const val& js) {
  const val cycles = js["cycles"];
  const auto number = cycles["number"].as<int>();
  if (!cycles["value"].isUndefined()) {
    keep(number, {cyclesFrom(cycles["value"]), 0});
  }
  const auto found = std::find_if(plates.begin(), plates.end(), [number](const Plate& plate) {
    return std::find(plate.numbers.begin(), plate.numbers.end(), number) != plate.numbers.end();
  });
  if (found == plates.end()) throw std::logic_error("the beads " + std::to_string(number) + " are not kept");
  Toolpath& toolpath = usedLast(found);
  toolpath.spacing = js["spacing"].as<double>();
  return toolpath;
}

void keep(int number, std::string gcode) {
  gcodeNumber = number;
  gcodeText = std::move(gcode);
}

const std::string& gcodeOf(int number) {
  if (number != gcodeNumber) throw std::logic_error("the G-code " + std::to_string(number) + " is not kept");
  return gcodeText;
}

std::vector<int> numbers() {
  std::vector<int> all;
  for (const Plate& plate : plates) all.insert(all.end(), plate.numbers.begin(), plate.numbers.end());
  if (gcodeNumber > 0) all.push_back(gcodeNumber);
  return all;
}

}  // namespace sillon::bindings::kept
