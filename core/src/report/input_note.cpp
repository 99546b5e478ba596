#include "sillon/report/input_note.hpp"

#include <utility>

namespace sillon {

std::vector<InputNote> inputNotes(const Project& project, const DrawingFacts& drawing) {
  std::vector<InputNote> notes;
  const auto note = [&](const char* code, std::string message) { notes.push_back({code, {}, std::move(message)}); };
  const auto leftOut = [&](const char* code, int count, const std::string& what) {
    if (count == 0) return;
    notes.push_back({code,
                     {{"n", static_cast<double>(count)}},
                     std::to_string(count) + " " + what + " of the drawing " + (count == 1 ? "is" : "are") +
                         " left out; convert text and pictures to paths in the program that made it"});
  };
  const bool asDrawn = !project.shapeFile.empty() && project.pageWidth == 0;
  if (drawing.pixels && asDrawn) {
    note("DrawingInPixels",
         "the drawing is in pixels, each taken as 1/96 inch; shape.pageWidth (--size) gives it another width");
  }
  if (project.shapeFile.empty() ? project.builtinSize.x == 0 : asDrawn && !drawing.svg) {
    note("NoSize", std::string("no size is given, so it is 80 mm wide; ") +
                       (project.shapeFile.empty() ? "shape.size" : "shape.pageWidth") + " (--size) sets it");
  }
  leftOut("TextLeftOut", drawing.texts, "<text>");
  leftOut("ImagesLeftOut", drawing.images, "<image>");
  if (drawing.severalColours) {
    note("SeveralColours",
         "the drawing has several colours, all printed as one solid; the studio gives each a direction of its own");
  }
  if (drawing.linesOnly) {
    note(
        "LinesAsShape",
        "nothing in the drawing is filled, so its lines are the shape; shape.paint ignore (--paint ignore) fills them");
  }
  return notes;
}

}  // namespace sillon
