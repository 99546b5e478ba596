// Sentences of the reasons for refusing a job. A reason's code and the names of its values stay; its words may change.
#pragma once

#include <cstddef>
#include <string_view>

#include "sillon/base/result.hpp"

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
    {"SizeOutOfRange", "{name} is {value} mm; it must be more than 0 and at most {most} mm"},
    {"HeightOutOfRange",
     "at a width of {width} mm the height is {height} mm; it must be more than 0 and at most {most} mm"},
    {"RadiusNegative", "shape.radius is {radius} mm; it must be 0 or more"},
    {"InnerOutOfRange",
     "shape.inner is {inner} mm; it must be more than 0 and less than the shorter side of {side} mm"},
    {"HolesLeaveNothing", "the holes leave nothing of the shape; make them smaller or fewer"},
    {"OutlineTooManyPieces",
     "the outline has too many edges or meets itself too often; at most 4 million pieces can be read; merge its paths "
     "in a drawing program, or draw it as a PNG"},
    {"OutlineTooDetailed", "the outline is too detailed for this spacing or this memory; simplify the drawing"},
    {"ShapePointTooFar", "the shape has a point at {x}, {y} mm; both coordinates must be -{most} to {most} mm"},
    {"NoOutline", "the shape has no outline; it needs at least one closed path"},
    {"NoInside", "the shape encloses no area; it needs at least one closed path with an inside"},
    {"MaskWithoutPixels", "the mask has no pixels; it needs a picture of 1 to 4 channels"},
    {"MaskTooDetailed", "the outline of the mask has more than 4 million points; use a smaller or less noisy picture"},
    {"MaskEmpty", "the mask is empty; some of its pixels must be at least 50 % bright or opaque"},
    {"PageOutOfRange", "the page is {width} x {height} mm; both sides must be 0.001 to 100000 mm"},
    {"PathPointTooFar", "the toolpath has a point outside -100000 to 100000 mm"},
    {"BeadTooWide", "the toolpath has a bead width outside 0 to 1000 mm"},
    {"PathTooLong", "the plate needs more than a thousand million path points; use a larger toolpath.spacing"},
    {"SamplesUnlikePicture",
     "{name} is a picture of {width} x {height} pixels with {channels} channels and {samples} samples; it must have "
     "pixels, 1 to 4 channels and a sample for each"},
    {"SamplesUnlikeSides",
     "{name} is a picture whose sides, channels and number of samples do not fit; it must have 1 to 4 channels, sides "
     "of 1 to {side} pixels, at most {millions} million pixels, and a sample for each channel of each pixel"},
    {"ValuesUnlikeMap",
     "the map of {name} is {width} x {height} pixels with {values} values; it must have a pixel at least, and one "
     "value for each"},
    {"TangentsNeedColours",
     "the direction map is a picture with {channels} channels; tangents need red and green, 3 or 4"},
    {"AngleNotFinite", "the angle is not a finite number of degrees; it must be one"},
    {"PictureCutOff", "{file} cannot be read as {format}: it is cut off; copy or download it again"},
    {"PictureDamaged", "{file} cannot be read as {format}: it is damaged; save it again in a picture editor"},
    {"PictureHeader",
     "{file} cannot be read as {format}: its header is damaged or of an unknown kind; save it again in a picture "
     "editor"},
    {"PictureEmpty", "{file} cannot be read as {format}: it holds no picture"},
    {"PictureScans",
     "{file} cannot be read as {format}: it has more than 100 scans; save it again in a picture editor"},
    {"PicturePacked", "{file} cannot be read as {format}: it is packed (run lengths); save it without compression"},
    {"PictureTooLarge",
     "{file} has {width} x {height} pixels; at most {side} per side and {millions} million in all are allowed, "
     "{transparent} million with transparency"},
    {"FileEmpty", "{file} is empty; it must hold at least one byte"},
    {"FileNotGiven", "{file} is named but not given; hand its bytes over"},
    {"FormatUnread",
     "{file} is a {kind} file; pictures must be PNG, JPEG, BMP or TGA, and drawings plain SVG in UTF-8"},
    {"UnknownPicture",
     "{file} is not a picture that can be read (it begins with bytes {bytes}); PNG, JPEG, BMP and TGA can"},
    {"UnknownFont", "the font is {font}; it must be a file that is handed over, or one of {known}"},
    {"NoFont",
     "{font} is no font; it must be a TrueType or OpenType file, plain or packed (.ttf, .otf, .woff, .woff2)"},
    {"FontTooDetailed", "the letters of {font} have more than {megabytes} MiB of curves; take another font"},
    {"LineLongerThanCircle",
     "the line is {line} mm long and its circle {circle} mm; take a larger circle, smaller letters or fewer of them"},
    {"TextWithoutInk", "the text has no ink; it must have letters that can be seen"},
    {"QrTooLong",
     "the text has {bytes} bytes; no QR code of this correction holds it: shorten it, or lower the correction"},
    {"SvgNotText", "the drawing is not UTF-8 text; save it as plain SVG"},
    {"SvgEmpty", "the file holds no <svg> element; save the drawing as plain SVG"},
    {"SvgNotXml", "the file is not well-formed XML in line {line}, at {text}; save it again in a drawing program"},
    {"SvgFirstElement", "the first element is {text}; it must be <svg>"},
    {"SvgNested", "elements nest deeper than {most} levels; ungroup them in a drawing program"},
    {"SvgNamespaces", "the file declares more than {most} namespaces at one place; save it as plain SVG"},
    {"SvgEntities",
     "the entities of the DOCTYPE are too many or too long; at most 1000 are read, of 1 MiB in all, for a text of 64 "
     "MiB"},
    {"SvgUseRepeats", "<use> repeats so many elements that the drawing becomes too large; repeat fewer"},
    {"SvgClipRepeats",
     "clipping repeats so many outlines that the drawing becomes too large; combine the paths under each clip path or "
     "mask into one"},
    {"SvgStyleRules", "<style> has so many rules that the drawing becomes too large; save it with fewer"},
    {"SvgLoosePieces", "there are too many outlines without paint; combine some of them"},
    {"SvgPoints", "the outlines have more than {most} points; simplify the drawing"},
    {"SvgPointTooFar", "a point lies more than 1 km away; coordinates in mm must be within 1000000"},
    {"SvgLetters", "the drawing has more than {most} letters; convert text to paths, or leave some out"},
    {"SvgArcRadii", "the radii of an arc are too small for its length; draw the arc as a curve"},
    {"SvgWithoutSize", "the size of the drawing is unknown; <svg> needs width and height, or a viewBox"},
    {"SvgPageSide",
     "{attribute} is {text}, which makes a side of {value} mm; it must be more than 0 and at most {most} mm"},
    {"SvgNegativeSize", "width and height must not be negative"},
    {"SvgNegative", "{attribute} is {text}; it must not be negative"},
    {"SvgUnit", "{attribute} is {text}; known units are mm, cm, in, pt, pc, px, Q, em, ex and %"},
    {"SvgLengths", "{attribute} is {text}; it must be lengths"},
    {"SvgHrefElsewhere", "href is {text}; it must name an element of this file by #id"},
    {"SvgHrefUnknown", "href is {text}, but no element has this id"},
    {"SvgShowsItself", "{attribute} is {text}, which shows itself again"},
    {"SvgNumber", "{attribute} has {text} where a number must stand"},
    {"SvgNumberTooLarge", "{attribute} has the number {text}, which is too large"},
    {"SvgFlag", "{attribute} has {text} where a flag 0 or 1 must stand"},
    {"SvgSign", "{attribute} has {text} where a {sign} must stand"},
    {"SvgCommand", "{attribute} has {text} where a command M L H V C S Q T A or Z must stand"},
    {"SvgFirstCommand", "{attribute} has {text} where M, the first command, must stand"},
    {"SvgUnitHere", "{attribute} has {text} where a known unit must stand"},
    {"SvgTransform", "{attribute} has {text} where a transform such as translate(1 2) must stand"},
    {"SvgEnd", "{attribute} has {text} where it must end"},
    {"SvgTransformNumbers",
     "transform has {text} with {count} numbers; it must be matrix, translate, scale, rotate, skewX or skewY with the "
     "numbers it takes"},
    {"SvgTransformOrigin", "transform-origin is {text}; it must be two lengths, or words such as center"},
    {"SvgViewBox", "viewBox is {text}; its width and height must be more than 0"},
    {"SvgAspectRatio",
     "preserveAspectRatio is {text}; it must be none or an alignment such as xMidYMid, then meet or slice"},
    {"PaintOffPage",
     "all that is painted lies off the page or is clipped away; shape.paint ignore (--paint ignore) takes outlines "
     "whatever their paint and place"},
    {"NothingDrawn",
     "the drawing has no area to fill; it needs paths, basic shapes, lines with a stroke or text that can be set in a "
     "built-in font (images do not count)"},
    {"NotJson", "the text is not JSON at line {line}, column {column}; a project or scene is one JSON object"},
    {"JsonTooDeep", "the JSON is nested deeper than {most} levels; a project needs 5"},
    {"KeyLike", "unknown key {setting}; similar names: {near}", "name"},
    {"KeyUnknown", "unknown key {setting}; known are {known}", "name"},
    {"KeyMissing", "{setting} has no {key}; it must have one"},
    {"NameLike", "{name} is unknown for {setting}; similar names: {near}"},
    {"NameUnknown", "{name} is unknown for {setting}; known are {known}"},
    {"NotText", "{setting} is of the JSON type {type}; it must be text"},
    {"NotFlag", "{setting} is of the JSON type {type}; it must be true or false"},
    {"NotNumber", "{setting} is of the JSON type {type}; it must be a number"},
    {"NotNumberOrNull", "{setting} is of the JSON type {type}; it must be a number or null"},
    {"NotWhole", "{setting} is of the JSON type {type}; it must be a whole number"},
    {"NotWholeNumber", "{setting} is {value}; it must be a whole number from {low} to {high}"},
    {"NotPair", "{setting} is of the JSON type {type}; it must be two numbers [x, y]"},
    {"NotWholePair", "{setting} is {value}; it must be two whole numbers"},
    {"NotList", "{setting} is of the JSON type {type}; it must be a list"},
    {"NotObject", "{setting} is of the JSON type {type}; it must be an object"},
    {"NotPoints", "{setting} must be a list of numbers x, y, x, y, ... in mm"},
    {"NotChoice", "{setting} is {value}; it must be {choices}"},
    {"OtherKind", "{setting} is not for the kind {kind}; it has {known}"},
    {"OtherVersion", "sillon is {version}; this program reads version {known}"},
    {"NoVersion", "the project has no version; it must have \"sillon\": {known}"},
    {"NoProject",
     "the file is neither a project nor a scene; a project has \"sillon\": 1, a scene has \"nozzle_width\" and "
     "\"svg_path\""},
    {"NoShape", "there is no shape; give a shape file, a built-in shape ({names}) or a direction picture"},
    {"TextTooLong", "{setting} has {bytes} bytes; it must be text of at most {most}"},
    {"NotOneLine", "{setting} is {value}; it must be one line of at most {most} bytes"},
    {"TooMany", "{setting} has {count} entries; it may have up to {most}"},
    {"TooManyPoints", "{setting} have {count} points; they may have up to {most}"},
    {"NotColour", "{setting} is {value}; it must be \"#rrggbb\""},
    {"FileNotNamed", "{setting} is empty; it must name a file"},
    {"TextMissing", "{setting} is empty; it must have letters"},
    {"PicturesMissing", "layers.pictures is empty; it must have at least one picture"},
    {"EchoOfNothing", "layers.file is empty; an echo must name a drawing, or have letters in layers.text"},
    {"TwoShapes", "shape has both file {file} and a builtin; it must have one of them"},
    {"BedSides", "printer.bedMax is {max} mm; it must be {low} to {high} mm right of and above printer.bedMin {min}"},
    {"RoundBedSides", "printer.roundBed is true on a bed of {width} x {depth} mm; it must be a square"},
    {"ScreenSizes",
     "printer.screenSizes must be at most 8 sizes of 16 to 1024 pixels, such as \"16x16/QOI, 300x300/PNG\""},
    {"CropReversed", "layers.cropMax is {max}; it must be right of and above layers.cropMin {min}"},
    {"SeveralPlates", "the file holds {count} plates; export them one by one, so that none is forgotten"},

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

    // G-code.
    {"TooThinFor", "{setting} is {value}, but the shape is too thin for lines of {width} mm; it must be 0 here"},
    {"FewPoints", "cycle {cycle} (from 0) has {points} different points at 0.001 mm; it must have at least 3"},
    {"WidthsUnlikePoints",
     "the toolpath has a line with {points} points and {widths} widths; there must be one width per point, and at "
     "least 2"},
    {"PointTooFar", "a point lies at ({x}, {y}) mm; coordinates must be -100000 to 100000"},
    {"BeadTooThick",
     "a bead would be {width} x {height} mm = {area} mm2; it must be at most 4 nozzle2 = {most} mm2, so "
     "toolpath.spacing is too wide for the nozzle"},
    {"BadDate", "date is {date}; it must look like \"1970-01-01 at 00:00:00 UTC\""},
    {"NamesSlicer", "{setting} must not contain \"generated by\"; hosts would take the file for another slicer's"},
    {"ScarfAndCoast",
     "print.scarf is {scarf} mm beside a print.coast of {coast}; one of them must be 0: both shape the end of a cycle"},
    {"SideOnBed",
     "print.startHeight is {height} mm; it must be 0 where print.showSide is not up, as that side lies on the bed"},
    {"ThumbnailSize",
     "a thumbnail is {width} x {height} pixels in {bytes} bytes; it must be 1 to 1024 pixels per side and all of them "
     "1 to 700000 bytes"},
    {"PatchesPlain",
     "patches are printed as they are; print.showSide must be up, print.rotate 0, print.mirror off, print.copies 1x1, "
     "print.startHeight 0, print.rim 0 and print.basePattern hatched or concentric"},
    {"NoLength", "a patch has a line of no length; it must have two different points"},
    {"PatchOutside", "a patch has a point at ({x}, {y}) mm, outside the shape that carries it"},
    {"PatchFlow",
     "patch {patch} (from 0): speed is {speed} mm/s, for which a bead of {section} mm2 needs {needs} mm3/s; "
     "printer.maxFlow is {most}"},
    {"NoAcross", "print.basePattern is across, which needs a second toolpath, made across the first; none was given"},
    {"NoArea", "the shape has no area; there is nothing to print"},
    {"NoLines", "the toolpath has no lines; there is nothing to print"},
    {"FlowTooLow", "printer.maxFlow is {flow} mm3/s; beads of {section} mm2 need at least {least} to print at 5 mm/s"},
    {"NotMirrored",
     "print.showSide is both, but the shape is not its own mirror image: {points} points of the path would lie "
     "outside; it must be up or bed here"},
    {"CrossesItself", "the path's crossings with itself are {times}; print.strict allows none"},
    {"NotHomed", "printer.startGcode does not home; it must have G28 or a start macro"},
    {"DrawnBack", "printer.startGcode draws filament back by G10; it must give it back by G11"},
    {"BambuStart",
     "printer.startGcode is empty; Bambu printers need the start block of a file that their own slicer made: sillon "
     "import cube.gcode.3mf > mine.json reads it"},
    {"BreaksWritten", "{block} has line breaks written as \\n; each command must be on a line of its own"},
    {"NoEndif", "{block} has \"{text}\" in line {line}, which has no endif"},
    {"NoIf", "{block} has \"{text}\" in line {line}, which has no if before it"},
    {"NoValue", "{block} has \"{text}\" in line {line}, which stands for no value here; put the value itself there"},
    {"NotEvaluated",
     "{block} has \"{text}\" in line {line}, which cannot be evaluated here; keep only the branch that applies"},
    {"WritingStopped", "writing was stopped before the file was complete"},
    {"NoSink", "no sink was given to write to"},
    {"NotOriented",
     "the G-code has no oriented layer on this page; it must be one that was written with these settings"},

    // Packed files, bodies and zones.
    {"PackedCutOff", "the {file} is cut off; fetch or export it again"},
    {"PackedDamaged", "the {file} is damaged; fetch or export it again"},
    {"PackedUnknown", "the {file} is packed in a way that is not known here; export plain G-code instead"},
    {"PackedEncrypted", "the {file} is encrypted; export it without encryption"},
    {"PackedEmpty", "the {file} holds no G-code; slice the plate before it is exported"},
    {"FileTooLarge", "the file, or what is packed in it, has {megabytes} MiB; it may have at most {most}"},
    {"PrintTooLarge",
     "the file is {megabytes} MiB; it must be at most {most}: put fewer objects into it, or slice with a coarser "
     "resolution"},
    {"NoTriangles", "the body has no triangle with an area"},
    {"BrokenMesh", "the mesh has a point that is not finite, or a triangle without three points of it"},
    {"ZoneEntangled", "a zone is too entangled to cut into triangles; fewer or wider zones are not"},
    {"Entangled",
     "the outline of {points} points crosses or touches itself in a way that cannot be cut into triangles; it must be "
     "simpler"},
    {"StlCutOff", "the STL is cut off, or another kind of file"},
    {"StlCorner", "the STL has a corner that is not three numbers"},
    {"StlTooFar", "the STL reaches further than 10000 mm"},
    {"StlTooLarge", "the STL has more than 10 million triangles; it must have at most that"},
    {"NoBase", "print.base is 0; it must be at least 1 for a body of the base layers"},
    {"FilamentsDisagree",
     "the .gcode.3mf is for filament {package}, but the G-code for filament {gcode}; both must come from one file of "
     "your slicer, sliced with one filament: import the printer from it anew"},
    {"ZonesTooSmall", "the shape is too small for zones; a cell of them is {cell} mm wide"},
    {"BodyFlat", "the body is flat; there is nothing to see from above"},
    {"ArchiveEmpty", "the file is an archive (ZIP) without G-code in it; export the G-code from your slicer"},
    {"NotForBambu",
     "the G-code is not for a Bambu Lab printer, and others read no .gcode.3mf; take the printer from a file of your "
     "own slicer (sillon import your.gcode.3mf), or write plain G-code"},
    {"ManyFilaments",
     "the G-code loads {count} filaments, and a new .gcode.3mf lists one; take the printer from a file that was sliced "
     "with one filament"},

    // Printers of other programs.
    {"UnknownContent",
     "the file is neither G-code nor settings of a slicer; G-code, .ini, .json, .orca_printer and .3mf are read"},
    {"BedUntold",
     "the file does not tell the bed, and its beads lie left of or before the origin, from ({left}, {front}) to "
     "({right}, {back}); take a file of a slicer that tells it, such as PrusaSlicer or Orca"},
    {"BlockTooLong", "{block} of the file is longer than {most} bytes"},
    {"NoLayers",
     "the G-code marks no layer (;LAYER_CHANGE, ; CHANGE_LAYER or ;LAYER:0); export it from a slicer that does"},
    {"NoBeads", "the G-code extrudes nothing after its first layer mark"},
    {"TwoFilaments",
     "its start block loads filament {loaded}, but its first bead is of filament {used}; slice the file with one "
     "filament"},
    {"NoPrinterSettings", "the file has no setting of a printer that is known here"},
    {"NoSuchPrinter", "the file has no printer {printer}; name one of {names}"},
    {"ResinPrinter", "the printer {printer} hardens resin; G-code is made for printers with a nozzle"},
    {"OtherPreset", "the preset is of a {kind} and not of a printer; export the printer, or a project"},
    {"BedElsewhere",
     "the preset inherits its bed or its start block from {name}, which lies in another file; open G-code that was "
     "sliced for this printer"},

    // Photographs of coupons.
    {"BeadsTooSmall",
     "a bead is {pixels} pixels wide in the photograph; it must be at least 4.5: go nearer, or take a camera with more "
     "pixels"},
    {"NoBeadsSeen",
     "a square lies there, but no beads of a coupon are seen on it; the photograph is blurred, or it shows something "
     "else"},
    {"NoPlainGround",
     "the photograph has no plain ground along its border; lay the whole coupon on plain paper with some of it on all "
     "sides"},
    {"NoCoupon",
     "the photograph shows no coupon; lay it on plain paper of another colour, so that it fills about half of the "
     "picture"},
    {"CouponCutOff", "the coupon is cut off by the photograph's border; all of it and some ground around it must show"},
    {"NotSquare", "the photograph shows no coupon; what lies there is not square, or is cut off or covered"},
    {"PhotoTooSmall", "the photograph has {width} x {height} pixels; each side must have at least {least}"},
    {"PhotoTooLarge", "the photograph has {width} x {height} pixels; it may have 64 million: take it with fewer"},
    {"ManyLamps",
     "the coupon does not shine as it would under one lamp; switch all other lamps off, and close the curtains"},
    {"Blurred",
     "the photograph is blurred by {blur} mm; it may be by {most}: hold the camera still and let it focus on the "
     "coupon"},
    {"LowContrast",
     "the brightest beads are {contrast} times as bright as the darkest, and must be 1.5 times; use one small lamp, "
     "low over the coupon, in a dark room"},
    {"OtherWidths",
     "beads would be {percent} % as wide as they were asked for, and must be 90 to 110 %; the coupon is of other "
     "settings, or the light shows the beads too poorly: move the lamp around the coupon"},
    {"OtherElevation",
     "lamp elevation is {elevation} degrees, and the photograph shows the lamp at {seen} +- {error}; measure it again "
     "at the coupon, over the table, or leave it out"},
    {"BurntPhoto",
     "the photograph is burnt: {percent} % of the spirals' pixels are at full scale, and 2 % may be; expose it less"},
    {"StretchedPhoto",
     "no camera sees a square like that; the photograph is stretched, or cut out of one side of a larger one: give the "
     "whole picture as it was taken"},
    {"SlopesUnclear",
     "slopes cannot be told in this light: {value} degrees within {error}; use a smaller lamp, or one that is farther "
     "away"},
    {"NoReadings", "there is no reading to join; give at least one"},
    {"ReadingsApart",
     "photograph {photograph} has slopes of {value} degrees, and their middle is {middle}; they are not of one coupon, "
     "or one is lit too poorly"},
    {"AllDirections", "{kind} tries all directions; from and to must be left out"},
    {"StepsTooFine", "{kind} from {from} to {to} has {count} values; to must be at least {least} above from"},

    // Files whose surfaces get new beads.
    {"FitWithoutBed", "fit is bed, but the file does not give its bed; it must be face, object or all"},
    {"MoveTooFar", "a move goes further than {most} mm from the origin; no bed is as large"},
    {"SurfaceEmpty", "the surface covers nothing"},
    {"BinaryGcode",
     "it is binary G-code (.bgcode); in PrusaSlicer switch off Preferences, Other, \"Use binary G-code when the "
     "printer supports it\", and export again"},
    {"FileNotRead", "the file was not read by readSlicedFile"},
    {"NoSuchSurface", "surface {surface} is chosen; the file has {count}"},
    {"NoSurface", "the file has no surface of the kind that was asked for"},
    {"SurfacesOverlap", "two surfaces share a line of the file"},

    // Looks and spools.
    {"NeedsMoreMemory", "this needs more memory than there is; make it smaller, or use smaller pictures"},
    {"JudgedTooFine",
     "the pictures would be judged at more than 100 million points; use a larger toolpath.spacing or a smaller size"},
    {"PreviewTooLarge",
     "preview of panels {width} pixels wide would be beyond {most} pixels per side or 100 million in all; choose "
     "fewer"},
    {"WeakLamp",
     "the lamp makes no direction of this spool more than 1.5 times as bright as another; choose a lower or a smaller "
     "lamp, or a glossier spool"},
    {"SpoolFile", "a file of spools must be JSON of the form {form}"},
    {"SpoolForm", "{where} must have the form {form}"},
    {"SpoolKey", "{where} has the key {key}; it must have the form {form}"},
    {"SpoolName", "{where} must be called by 1 to 40 letters, digits, - and _"},
    {"SpoolTaken", "{where} is one that comes with the program; call yours otherwise"},
    {"KeyTwice", "key {key} is given twice; each key may be given once"},
    {"ManySpools", "a file has {count} spools; it may have at most {most}"},

    // Jobs.
    {"CheckRefuses",
     "the G-code would be refused by `check`: {what} (line {line} of the file); change the start or end code, or the "
     "settings of it"},
    {"ZonesConstrained",
     "zones show directions as they are given, so the mode must be constrained; --mode constrained sets it"},
};

/// A row of kReasons by its code. A code that has no row does not compile.
struct Reason {
  consteval Reason(const char* code) {  // NOLINT(google-explicit-constructor)
    while (std::string_view(kReasons[row].code) != code) ++row;
  }

  std::size_t row = 0;
};

}  // namespace sillon
