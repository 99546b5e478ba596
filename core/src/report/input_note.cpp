#include "sillon/report/input_note.hpp"

#include <utility>

#include "base/sentence.hpp"

namespace sillon {
namespace {

constexpr Sentence kSentences[] = {
    {"DrawingInPixels",
     "the drawing is in pixels, each taken as 1/96 inch; shape.pageWidth (--size) gives it another width"},
    {"NoSize", "no size is given, so it is 80 mm wide; {setting} (--size) sets it"},
    {"TextLeftOut",
     "text in the drawing is left out ({n} <text>); convert it to paths in the program that made the drawing"},
    {"TextInOtherFont",
     "text in the drawing is set in a built-in font instead of its own; to keep its letters, convert it to paths in "
     "the "
     "program that made the drawing"},
    {"ImagesLeftOut",
     "pictures in the drawing are left out ({n} <image>); convert them to paths in the program that made the drawing"},
    {"SeveralColours",
     "the drawing has several colours, all printed as one solid; the studio gives each a direction of its own"},
    {"LinesAsShape",
     "nothing in the drawing is filled, so its lines are the shape; shape.paint ignore (--paint ignore) fills them"},
};

}  // namespace

std::span<const Sentence> inputNoteSentences() { return kSentences; }

std::vector<InputNote> inputNotes(const Project& project, const DrawingFacts& drawing) {
  std::vector<InputNote> notes;
  const auto note = [&](const char* code, std::vector<NamedValue> values = {}) {
    std::string message = filled(sentenceOf(kSentences, code), values);
    notes.push_back({code, std::move(values), std::move(message)});
  };
  const bool asDrawn = !project.shapeFile.empty() && project.pageWidth == 0;
  if (drawing.pixels && asDrawn) note("DrawingInPixels");
  if (project.shapeFile.empty() ? project.builtinSize.x == 0 : asDrawn && !drawing.svg) {
    note("NoSize", {{"setting", std::string(project.shapeFile.empty() ? "shape.size" : "shape.pageWidth")}});
  }
  if (drawing.texts > 0) note("TextLeftOut", {{"n", static_cast<double>(drawing.texts)}});
  if (drawing.otherFont) note("TextInOtherFont");
  if (drawing.images > 0) note("ImagesLeftOut", {{"n", static_cast<double>(drawing.images)}});
  if (drawing.severalColours) note("SeveralColours");
  if (drawing.linesOnly) note("LinesAsShape");
  return notes;
}

}  // namespace sillon
