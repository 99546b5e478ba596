#include "gcode/file_comments.hpp"

#include <string>

#include "base/numbers.hpp"
#include "gcode/layout.hpp"

namespace sillon {
namespace {

// Centre and outline of a copy, in Klipper's words, for maps of the bed.
std::string place(const GcodeJob& job, std::size_t copy) {
  const Vec2 lo = job.firstPlate.min + mm(job.copies[copy]);
  const Vec2 hi = job.firstPlate.max + mm(job.copies[copy]);
  const auto at = [](Vec2 p) { return fixed(p.x, 2) + "," + fixed(p.y, 2); };
  std::string corners;
  for (const Vec2 p : {lo, Vec2{hi.x, lo.y}, hi, Vec2{lo.x, hi.y}})
    corners += (corners.empty() ? "[" : ",[") + at(p) + "]";
  return " CENTER=" + at(0.5 * (lo + hi)) + " POLYGON=[" + corners + "]";
}

}  // namespace

void defineObjects(ChunkedOutput& out, const GcodeJob& job, GcodeFlavor flavor) {
  if (job.copies.size() < 2 || flavor != GcodeFlavor::Klipper) return;
  for (std::size_t k = 0; k < job.copies.size(); ++k) {
    out << "EXCLUDE_OBJECT_DEFINE NAME=PLATE_" << std::to_string(k) << place(job, k) << "\n";
  }
}

void beginObject(ChunkedOutput& out, const GcodeJob& job, GcodeFlavor flavor, int copy) {
  if (job.copies.size() < 2) return;
  const bool klipper = flavor == GcodeFlavor::Klipper;
  out << (klipper ? "EXCLUDE_OBJECT_START NAME=PLATE_" : "M486 S") << std::to_string(copy) << "\n";
}

void endObject(ChunkedOutput& out, const GcodeJob& job, GcodeFlavor flavor, int copy) {
  if (job.copies.size() < 2) return;
  if (flavor == GcodeFlavor::Klipper) {
    out << "EXCLUDE_OBJECT_END NAME=PLATE_" << std::to_string(copy) << "\n";
  } else {
    out << "M486 S-1\n";
  }
}

}  // namespace sillon
