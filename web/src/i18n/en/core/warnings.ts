// Made by tools/generate.mjs from the core's words: ./dev generate.
export const words = {
  'warning.AccelerationHeld': '“Acceleration” is {asked} mm/s²; it is held at “Machine acceleration”, {held}.',
  'warning.BaseTooThin':
    'A base layer covers only {percent}% of the shape; places too narrow for its lines have nothing below them.',
  'warning.BlockMovesLow': '{block} goes down to Z {z}; what stands there is {height} mm high.',
  'warning.DetailLost':
    '{area} mm² are narrower than a bead and stay empty (places: {n}); {share}% of that would print at a page width of {size} mm.',
  'warning.DrawingFaint':
    '{area} mm² of the drawing are painted at half opacity or less and printed like the rest; a variant of one tone shows its lines.',
  'warning.DrawingLettersLost': 'The letters {letters} of the drawing are left out: no font has them.',
  'warning.DrawingOffPage': '{area} mm² of the drawing lie off its page and are cut off.',
  'warning.DrawingUnpainted': 'Nothing in the drawing is painted, so its outlines are the shape.',
  'warning.DrawingUnread':
    'These parts of the drawing are not read: {what}; compare the plate with what viewers show, or convert the drawing to paths in the program that made it.',
  'warning.EndHot': 'The end G-code leaves a heater on; M104 S0, M140 S0 and M141 S0 turn the heaters off.',
  'warning.EndLine': 'Line {line} of the end G-code: {what}.',
  'warning.FillRatio': 'The plastic fills {percent}% of the shape’s area; 97 to 105% print well.',
  'warning.FlatBeads': 'At {n} points beads are no wider than the layer is high ({height} mm).',
  'warning.LayerAlike':
    '{percent}% of layer {layer} lie within 15° of what is below and cannot be seen; another “Angle” shows them, and so does “Fill” across.',
  'warning.LayerBeside':
    '{percent}% of layer {layer} lie beside the plate or in its holes; it is {width} × {height} mm and the page {pageWidth} × {pageHeight}: make it smaller, or move it.',
  'warning.LayerCovered': '{percent}% of layer {layer} are covered by layers above it; move it, or raise it.',
  'warning.LayerLeftOut': 'Layer {layer} is left out: no font has a letter for {letter}.',
  'warning.LayerLettersLent': 'The letters {letters} of layer {layer} come from {font}: its own font lacks them.',
  'warning.LayerLettersLost': 'The letters {letters} of layer {layer} are left out: no font has them.',
  'warning.LayerOnlyPicture': 'Layer {layer} is left out: its font has {letter} only as a picture.',
  'warning.LayerUnderRim': '{percent}% of layer {layer} lie under “Rim”; make it smaller, or move it.',
  'warning.LayerUnreadable':
    'The code of layer {layer} cannot be read; its whole square must lie on the plate, uncovered, in two directions that differ, with modules wider than a bead.',
  'warning.LettersLent': 'The letters {letters} come from {font}: the font of the text lacks them.',
  'warning.ManyBytes': 'The file has {mb} MB; printers get slow above 100.',
  'warning.ManyMoves': 'The file has {n} moves; printers get slow above 2 million.',
  'warning.MaxFlowSlows': '“Maximum flow” slows {percent}% of the path.',
  'warning.MirroredUp': 'The plate is mirrored but shown from above; writing on it reads backwards.',
  'warning.NoPressureAdvance':
    'Nothing sets pressure advance on this printer, so oriented layers run evenly at {speed} mm/s, {minutes} min longer than at {asked}; “Set pressure advance” sets it, “Speed, oriented layers” the speed.',
  'warning.NotPrimed':
    'The plate leaves no room for a purge line, so the nozzle is not primed and the first beads may be thin.',
  'warning.NotPrimedAbovePrint':
    'Nothing is printed beside a print that stands on the bed, so the nozzle is not primed; a base layer hides that.',
  'warning.OutsideShape': 'Points of the path that lie more than 0.1 mm outside the shape: {n}.',
  'warning.PictureLost':
    'Picture {picture} is hard to recognise in the beads (r {r}; 0.7 is enough); a larger size or a smaller spacing shows more of it.',
  'warning.PictureOneTone':
    'Picture {picture} has one tone on this plate, so nothing can be seen in it; use a picture with bright and dark parts wider than a bead.',
  'warning.PicturesCrowded':
    '{n} pictures are too many for one plate: picture {picture} is hard to recognise in its directions (r {r}; 0.7 is enough); use fewer pictures, or ones that differ less.',
  'warning.PressureAdvanceReset':
    'Pressure advance is {value} after the print, until the printer restarts or another file sets it.',
  'warning.PrintOnBed':
    'A print of {height} mm stands on the bed while the printer homes; homing (G28) and probing (G29) must not come down on it.',
  'warning.PrintedApart':
    'Toolpaths that lie apart from the rest of their part: {n}, around X {x}, Y {y} mm; what joins them is too thin for a bead, which a larger size, a smaller spacing or “Keep thin places” may mend.',
  'warning.SegmentsSlow': '“Moves per second” slows {percent}% of the path.',
  'warning.SkirtLeftOut': 'The skirt does not fit the bed and was left out.',
  'warning.SpeedHeld': '{field} is {asked} mm/s; it is held at “Machine speed limit”, {held}.',
  'warning.StartFlow':
    'The start G-code sets the flow to {percent}% (M221), which holds for the whole print, on top of “Filament flow”.',
  'warning.StartLine': 'Line {line} of the start G-code: {what}.',
  'warning.StartScales':
    'The start G-code sets the speed to {percent}% (M220); it is put back to 100% before the first bead.',
  'warning.StartTemperature': 'The start G-code leaves the nozzle at {hot} °C; the first layer is meant for {meant}.',
  'warning.ThinLayers': '“Layer height” is {value} mm; layers thinner than 0.2 nozzle diameters tear.',
  'warning.ThinLetters':
    '{percent}% of what layer {layer} draws is narrower than two beads and hard to read; a larger size, a bolder font or a smaller spacing helps.',
  'warning.ThinModules':
    'The modules of layer {layer} are {size} mm wide, less than two beads, and hard to read; a larger size, a shorter text or a smaller spacing helps.',
  'warning.UnusualFilament': '“Filament diameter” is {value} mm; filament is sold with 1.75 and 2.85.',
  'warning.UnusualFlow': '{field} is {value}; 0.8 to 1.1 is usual.',
  'warning.WidthHeld':
    '{percent}% of the path is printed with a width held at {low} or {high} mm (0.6 and 1.6 nozzle diameters).',
} as const;
