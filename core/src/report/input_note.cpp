#include "sillon/report/warning.hpp"

#include <utility>

#include "base/sentence.hpp"
#include "report/told.hpp"
#include "report/told_json.hpp"

namespace sillon {
namespace {

constexpr Sentence kSentences[] = {
    {"DrawingInPixels",
     "the drawing is in pixels, each taken as 1/96 inch; shape.pageWidth (--size) gives it another width"},
    {"MakersPixels",
     "the drawing is in pixels, each taken as 1/96 inch; in {maker}, which made it, it is {width} mm wide: "
     "shape.pageWidth (--size {width}) makes it so"},
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
    {"CutOut",
     "the picture has a transparent ground, which is printed, too; the same file as shape.file (--shape) prints its "
     "opaque part alone"},
    {"LinesAsShape",
     "nothing in the drawing is filled, so its lines are the shape; shape.paint ignore (--paint ignore) fills them"},
};

void add(std::vector<InputNote>& notes, const char* code, std::vector<NamedValue> values = {}) {
  std::string message = filled(sentenceOf(kSentences, code), values);
  notes.push_back({code, std::move(values), std::move(message)});
}

// Adds notes on parts of a drawing that are not shown as drawn, whatever it is used for.
void addLost(const DrawingFacts& drawing, std::vector<InputNote>& notes) {
  if (drawing.texts > 0) add(notes, "TextLeftOut", {{"n", static_cast<double>(drawing.texts)}});
  if (drawing.otherFont) add(notes, "TextInOtherFont");
  if (drawing.images > 0) add(notes, "ImagesLeftOut", {{"n", static_cast<double>(drawing.images)}});
  if (drawing.severalColours) add(notes, "SeveralColours");
}

}  // namespace

std::span<const Sentence> inputNoteSentences() { return kSentences; }

std::vector<InputNote> inputNotes(const Project& project, const DrawingFacts& drawing) {
  std::vector<InputNote> notes;
  const bool asDrawn = !project.shapeFile.empty() && project.pageWidth == 0;
  if (drawing.pixels && asDrawn && drawing.maker.empty()) add(notes, "DrawingInPixels");
  if (drawing.pixels && asDrawn && !drawing.maker.empty()) {
    add(notes, "MakersPixels", {{"maker", drawing.maker}, {"width", drawing.makerWidth}});
  }
  if (project.shapeFile.empty() ? project.builtinSize.x == 0 : asDrawn && !drawing.svg) {
    add(notes, "NoSize", {{"setting", std::string(project.shapeFile.empty() ? "shape.size" : "shape.pageWidth")}});
  }
  addLost(drawing, notes);
  if (drawing.cutOut) add(notes, "CutOut");
  if (drawing.linesOnly) add(notes, "LinesAsShape");
  return notes;
}

std::vector<InputNote> layerNotes(const DrawingFacts& drawing, std::size_t layer) {
  std::vector<InputNote> notes;
  addLost(drawing, notes);
  for (InputNote& note : notes) tellOfLayer(note, layer);
  return notes;
}

std::string notesJson(const std::vector<InputNote>& notes) {
  return toldJson(notes, [](const InputNote& note) { return note.code; });
}

}  // namespace sillon
