#include "base/refused.hpp"

#include <utility>

#include "base/sentence.hpp"

namespace sillon {
namespace {

constexpr Sentence kReasons[] = {
    {reason::kOverRoundBed, "the plate lies {by} mm over the edge of the round bed"},
    {reason::kOnExcludedZone, "the plate touches the excluded part of the bed; place it elsewhere"},
    {reason::kTooHigh, "with the lift of the nozzle the print is {height} mm high; this printer reaches {most} mm"},
    {reason::kCopiesTooHigh,
     "these plates are {height} mm high; several on one bed, printed one after the other, may be at most {most} mm, or "
     "the print head would touch them"},
    {reason::kNoBeadFits,
     "no bead fits into this shape at a toolpath.spacing of {spacing} mm; use a smaller one or a larger shape"},
    {reason::kLinesTooThin,
     "nothing in the drawing is filled, and no bead fits into its lines at a toolpath.spacing of {spacing} mm; "
     "shape.paint ignore (--paint ignore) fills what they enclose"},
    {reason::kHoleOutside,
     "hole {n} at {x}, {y} mm, {diameter} mm wide, lies outside the shape, which reaches from {left}, {bottom} to "
     "{right}, {top} mm; move it onto the shape, or leave it out"},
    {reason::kOffsetTooDeep,
     "an offset of {offset} mm leaves nothing of the shape, whose deepest place is {depth} mm from the outline; use an "
     "offset that is nearer to 0"},
    {reason::kMissingLetter, "no font has a letter for {letter}; take a font that has it, or leave it out"},
    {reason::kPictureLetter,
     "the font {font} has {letter} only as a picture; take a font that has its outline, or leave it out"},
    {reason::kWhichPrinter, "the file has {count} printers, and none is chosen; name one of {names}"},
    {reason::kRimBelow,
     "print.rim is {rim}, but what shows lies on the bed; print.showSide must be up for a rim, or print.rim 0"},
    {reason::kLinesNumbered, "its lines are numbered, as hosts send them; take the file that the slicer wrote"},
    {reason::kNoMarks,
     "it does not mark its surfaces; files of PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio and Cura do"},
    {reason::kFilamentOpen,
     "the file gives no filament diameter, and its beads may be {thinWidth} mm wide from filament of {thin} mm or "
     "{wideWidth} mm wide from filament of {wide} mm; add a line \"; filament_diameter = {thin}\" or "
     "\"; filament_diameter = {wide}\" at its end"},
    {reason::kNoFilament, "no bead in it pushes filament by E; export it for a firmware that counts filament so"},
};

constexpr Sentence kHints[] = {
    {"TooLarge", "use a larger toolpath.spacing, a smaller size or smaller pictures"},
    {"EmptyShape",
     "the shape needs filled areas wider than a bead; convert text and lines to paths, or make small shapes larger"},
    {"DoesNotFit",
     "make the print smaller, rotate or centre it, print fewer copies or layers, or choose another printer"},
    {"OutOfMemory", "use a larger toolpath.spacing or a smaller size, or close what else needs memory"},
};

}  // namespace

std::span<const Sentence> reasonSentences() { return kReasons; }

std::span<const Sentence> errorHints() { return kHints; }

Error refused(ErrorCode code, const char* reason, std::vector<NamedValue> values) {
  std::string message = filled(sentenceOf(kReasons, reason), values);
  return {code, std::move(message), reason, std::move(values)};
}

}  // namespace sillon
