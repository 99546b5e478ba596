// Sentences of the reasons for refusing a job. A reason's code and the names of its values stay; its words may change.
#pragma once

#include <cstddef>
#include <string_view>

#include "sillon/base/sentence.hpp"

namespace sillon {

inline constexpr Sentence kReasons[] = {
    {"Cancelled", "the run was cancelled"},

    // Shapes, texts, pictures and projects.
    {"NoBeadFits",
     "no bead fits into this shape at a toolpath.spacing of {spacing} mm; use a smaller one or a larger shape"},
    {"LinesTooThin",
     "nothing in the drawing is filled, and no bead fits into its lines at a toolpath.spacing of {spacing} mm; "
     "shape.paint ignore (--paint ignore) fills what they enclose"},
    {"HoleOutside",
     "hole {n} at {x}, {y} mm, {diameter} mm wide, lies outside the shape, which reaches from {left}, {bottom} to "
     "{right}, {top} mm; move it onto the shape, or leave it out"},
    {"OffsetTooDeep",
     "an offset of {offset} mm leaves nothing of the shape, whose deepest place is {depth} mm from the outline; use an "
     "offset that is nearer to 0"},
    {"MissingLetter", "no font has a letter for {letter}; take a font that has it, or leave it out"},
    {"PictureLetter",
     "the font {font} has {letter} only as a picture; take a font that has its outline, or leave it out"},

    // Prints, printers and files of other programs.
    {"OverRoundBed", "the plate lies {by} mm over the edge of the round bed"},
    {"OnExcludedZone", "the plate touches the excluded part of the bed; place it elsewhere"},
    {"TooHigh", "with the lift of the nozzle the print is {height} mm high; this printer reaches {most} mm"},
    {"CopiesTooHigh",
     "these plates are {height} mm high; several on one bed, printed one after the other, may be at most {most} mm, or "
     "the print head would touch them"},
    {"WhichPrinter", "the file has {count} printers, and none is chosen; name one of {names}"},
    {"RimBelow",
     "print.rim is {rim}, but what shows lies on the bed; print.showSide must be up for a rim, or print.rim 0"},
    {"LinesNumbered", "its lines are numbered, as hosts send them; take the file that the slicer wrote"},
    {"NoMarks",
     "it does not mark its surfaces; files of PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio and Cura do"},
    {"FilamentOpen",
     "the file gives no filament diameter, and its beads may be {thinWidth} mm wide from filament of {thin} mm or "
     "{wideWidth} mm wide from filament of {wide} mm; add a line \"; filament_diameter = {thin}\" or "
     "\"; filament_diameter = {wide}\" at its end"},
    {"NoFilament", "no bead in it pushes filament by E; export it for a firmware that counts filament so"},
};

/// A row of kReasons by its code. A code that has no row does not compile.
struct Reason {
  consteval Reason(const char* code) {  // NOLINT(google-explicit-constructor)
    while (std::string_view(kReasons[row].code) != code) ++row;
  }

  std::size_t row = 0;
};

}  // namespace sillon
