#include "sillon/job/plate.hpp"

#include <string_view>
#include <utility>

namespace sillon {

Result<GcodeSummary> writePathGcode(const PathToWrite& path, const Printer& printer, const PrintParams& print,
                                    const GcodeSink& sink, const RunContext& run) {
  PrintParams told = print;
  told.date = path.date;
  told.notes = path.notes;
  auto thumbnails = lookThumbnails(path.seen, path.shape.page, printer.screenSizes, path.look, run);
  if (!thumbnails) return thumbnails.error();
  told.thumbnails = std::move(thumbnails).value();
  const auto untilCancelled = [&](std::string_view piece) { return sink(piece) && !run.cancelled(); };
  return writeGcode(path.seen, path.shape, printer, told, untilCancelled, path.below);
}

}  // namespace sillon
