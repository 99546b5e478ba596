#include <algorithm>
#include <cmath>
#include <string>

#include "base/numbers.hpp"
#include "gcode/base_layers.hpp"
#include "gcode/layout.hpp"

namespace sillon {
namespace {

constexpr double kInset = 0.02;  // [mm], more than loops are off their distance: no bead may stick out
constexpr int kMaxLoops = 1000;

}  // namespace

std::optional<Error> addRim(GcodeJob& job, const Shape& body, PointUm offset, const Printer& printer,
                            const PrintParams& params) {
  if (params.rim == 0) return std::nullopt;
  const double line = printer.nozzle;
  const int count = std::clamp(static_cast<int>(std::lround(params.rimWidth / line)), 1, kMaxLoops);
  const Result<std::vector<Polyline>> loops = offsetLoops(body, -line / 2 - kInset, -line, count);
  if (!loops) return loops.error();
  for (const Polyline& loop : loops.value()) {
    BeadPath path = placed(loop, offset, line, true);
    if (path.points.size() >= 3) job.rim.push_back(std::move(path));
  }
  if (!job.rim.empty()) return std::nullopt;
  return Error{ErrorCode::InvalidArgument, "print.rim is " + std::to_string(params.rim) +
                                               ", but the shape is too thin for lines of " + decimal(line, 3) +
                                               " mm; it must be 0 here"};
}

}  // namespace sillon
