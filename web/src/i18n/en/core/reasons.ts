// Made by tools/generate.mjs from the core's words: ./dev generate.
export const words = {
  'reason.OverRoundBed': "The plate lies {by} mm over the edge of the round bed.",
  'reason.OnExcludedZone': "The plate touches the excluded part of the bed; place it elsewhere.",
  'reason.TooHigh': "With the lift of the nozzle the print is {height} mm high; this printer reaches {most} mm.",
  'reason.CopiesTooHigh': "These plates are {height} mm high; several on one bed, printed one after the other, may be at most {most} mm, or the print head would touch them.",
  'reason.NoBeadFits': "No bead fits into this shape at a “Line width” of {spacing} mm; use a smaller one or a larger shape.",
  'reason.LinesTooThin': "Nothing in the drawing is filled, and no bead fits into its lines at a “Line width” of {spacing} mm; “Paint” ignore (--paint ignore) fills what they enclose.",
  'reason.HoleOutside': "Hole {n} at {x}, {y} mm, {diameter} mm wide, lies outside the shape, which reaches from {left}, {bottom} to {right}, {top} mm; move it onto the shape, or leave it out.",
  'reason.OffsetTooDeep': "An offset of {offset} mm leaves nothing of the shape, whose deepest place is {depth} mm from the outline; use an offset that is nearer to 0.",
  'reason.MissingLetter': "No font has a letter for {letter}; take a font that has it, or leave it out.",
  'reason.PictureLetter': "The font {font} has {letter} only as a picture; take a font that has its outline, or leave it out.",
  'reason.WhichPrinter': "The file has {count} printers, and none is chosen; name one of {names}.",
  'reason.RimBelow': "“Rim” is {rim}, but what shows lies on the bed; “Side to show” must be up for a rim, or “Rim” 0.",
  'reason.LinesNumbered': "Its lines are numbered, as hosts send them; take the file that the slicer wrote.",
  'reason.NoMarks': "It does not mark its surfaces; files of PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio and Cura do.",
  'reason.FilamentOpen': "The file gives no filament diameter, and its beads may be {thinWidth} mm wide from filament of {thin} mm or {wideWidth} mm wide from filament of {wide} mm; add a line “; filament_diameter = {thin}” or “; filament_diameter = {wide}” at its end.",
  'reason.NoFilament': "No bead in it pushes filament by E; export it for a firmware that counts filament so.",
} as const;
