#include "sillon/report/warning.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "base/sentence.hpp"
#include "base/sort_key.hpp"
#include "report/told.hpp"
#include "report/told_json.hpp"
#include "sillon/base/words.hpp"

namespace sillon {
namespace {

// Sentences in the order of WarningCode, which is alphabetical.
constexpr Sentence kSentences[] = {
    {"AccelerationHeld", "printer.acceleration is {asked} mm/s2; it is held at printer.machineAcceleration, {held}"},
    {"BaseTooThin",
     "a bottom layer covers only {percent} % of the shape; places too narrow for its lines have nothing below them"},
    {"BlockMovesLow", "{block} goes down to Z {z}; what stands there is {height} mm high"},
    {"DetailLost",
     "{area} mm2 are narrower than a bead and stay empty (places: {n}); {share} % of that would print at a page width "
     "of {size} mm"},
    {"DrawingFaint",
     "{area} mm2 of the drawing are painted at half opacity or less and printed like the rest; a variant of one tone "
     "shows its lines"},
    {"DrawingLettersLost", "the letters {letters} of the drawing are left out: no font has them"},
    {"DrawingOffPage", "{area} mm2 of the drawing lie off its page and are cut off"},
    {"DrawingUnpainted", "nothing in the drawing is painted, so its outlines are the shape"},
    {"DrawingUnread",
     "these parts of the drawing are not read: {what}; compare the plate with what viewers show, or convert the "
     "drawing to paths in the program that made it"},
    {"EndHot", "the end G-code leaves a heater on; M104 S0, M140 S0 and M141 S0 turn the heaters off"},
    {"EndLine", "line {line} of the end G-code: {what}", "rule"},
    {"FillRatio", "the plastic fills {percent} % of the shape's area; 97 to 105 % print well"},
    {"FlatBeads", "at {n} points beads are no wider than the layer is high ({height} mm)"},
    {"LayerAlike",
     "{percent} % of layer {layer} lie within 15 degrees of what is below and cannot be seen; another layers.angle "
     "shows them, and so does layers.fill across"},
    {"LayerBeside",
     "{percent} % of layer {layer} lie beside the plate or in its holes; it is {width} x {height} mm and the page "
     "{pageWidth} x {pageHeight}: make it smaller, or move it"},
    {"LayerCovered", "{percent} % of layer {layer} are covered by layers above it; move it, or raise it"},
    {"LayerLeftOut", "layer {layer} is left out: no font has a letter for {letter}"},
    {"LayerLettersLent", "the letters {letters} of layer {layer} come from {font}: its own font lacks them"},
    {"LayerLettersLost", "the letters {letters} of layer {layer} are left out: no font has them"},
    {"LayerOnlyPicture", "layer {layer} is left out: its font has {letter} only as a picture"},
    {"LayerUnderRim", "{percent} % of layer {layer} lie under print.rim; make it smaller, or move it"},
    {"LayerUnreadable",
     "the code of layer {layer} cannot be read; its whole square must lie on the plate, uncovered, in two directions "
     "that differ, with modules wider than a bead"},
    {"LettersLent", "the letters {letters} come from {font}: the font of the text lacks them"},
    {"ManyBytes", "the file has {mb} MB; printers get slow above 100"},
    {"ManyMoves", "the file has {n} moves; printers get slow above 2 million"},
    {"MaxFlowSlows", "printer.maxFlow slows {percent} % of the path"},
    {"MirroredUp", "the plate is mirrored but shown from above; writing on it reads backwards"},
    {"NoPressureAdvance",
     "nothing sets pressure advance on this printer, so top layers run evenly at {speed} mm/s, {minutes} min "
     "longer than at {asked}; printer.setPressureAdvance sets it, printer.showSpeed the speed"},
    {"NotPrimed",
     "the plate leaves no room for a purge line, so the nozzle is not primed and the first beads may be thin"},
    {"NotPrimedAbovePrint",
     "nothing is printed beside a print that stands on the bed, so the nozzle is not primed; a bottom layer hides "
     "that"},
    {"OutsideShape", "points of the path that lie more than 0.1 mm outside the shape: {n}"},
    {"PictureLost",
     "picture {picture} is hard to recognise in the beads (r {r}; 0.7 is enough); a larger size or a smaller "
     "toolpath.spacing shows more of it"},
    {"PictureOneTone",
     "picture {picture} has one tone on this plate, so nothing can be seen in it; use a picture with bright and dark "
     "parts wider than a bead"},
    {"PicturesCrowded",
     "{n} pictures are too many for one plate: picture {picture} is hard to recognise in its directions (r {r}; 0.7 is "
     "enough); use fewer pictures, or ones that differ less"},
    {"PressureAdvanceReset",
     "pressure advance is {value} after the print, until the printer restarts or another file sets it"},
    {"PrintOnBed",
     "a print of {height} mm stands on the bed while the printer homes; homing (G28) and probing (G29) must not come "
     "down on it"},
    {"PrintedApart",
     "toolpaths that lie apart from the rest of their part: {n}, around X {x}, Y {y} mm; what joins them is too thin "
     "for a bead, which a larger size, a smaller toolpath.spacing or shape.keepThin may mend"},
    {"SegmentsSlow", "printer.maxSegmentsPerSecond slows {percent} % of the path"},
    {"SkirtLeftOut", "the skirt does not fit the bed and was left out"},
    {"SpeedHeld", "{field} is {asked} mm/s; it is held at printer.machineSpeed, {held}"},
    {"StartFlow",
     "the start G-code sets the flow to {percent} % (M221), which holds for the whole print, on top of "
     "printer.filamentFlow"},
    {"StartLine", "line {line} of the start G-code: {what}", "rule"},
    {"StartScales",
     "the start G-code sets the speed to {percent} % (M220); it is put back to 100 % before the first bead"},
    {"StartTemperature", "the start G-code leaves the nozzle at {hot} degrees; the first layer is meant for {meant}"},
    {"ThinLayers", "print.layerHeight is {value} mm; layers thinner than 0.2 nozzle diameters tear"},
    {"ThinLetters",
     "{percent} % of what layer {layer} draws is narrower than two beads and hard to read; a larger size, a bolder "
     "font or a smaller toolpath.spacing helps"},
    {"ThinModules",
     "the modules of layer {layer} are {size} mm wide, less than two beads, and hard to read; a larger size, a shorter "
     "text or a smaller toolpath.spacing helps"},
    {"UnusualFilament", "printer.filamentDiameter is {value} mm; filament is sold with 1.75 and 2.85"},
    {"UnusualFlow", "{field} is {value}; 0.8 to 1.1 is usual"},
    {"WidthHeld",
     "{percent} % of the path is printed with a width held at {low} or {high} mm (0.6 and 1.6 nozzle diameters)"},
};

/// Tells whether the sentences are sorted and complete, at compile time.
constexpr bool standInOrder() {
  for (std::size_t k = 1; k < std::size(kSentences); ++k) {
    if (!(std::string_view(kSentences[k - 1].code) < kSentences[k].code)) return false;
  }
  return std::size(kSentences) == toSize(WarningCode::WidthHeld) + 1;
}
static_assert(standInOrder(), "one sentence per code, in the order of WarningCode");

const Sentence& sentence(WarningCode code) { return kSentences[toSize(code)]; }

/// Warns of places narrower than a bead.
std::vector<Warning> lossWarnings(const Measures& measures, Vec2 page, double spacing) {
  if (!(measures.lostAreaMm2 > 0.005 * measures.shapeAreaMm2)) return {};
  // The thinnest tenth is left out, because it may be hairlines that no size would save.
  std::vector<ThinPlace> byWidth = measures.lostPlaces;
  sortBy(byWidth, [](const ThinPlace& place) { return -place.width; });
  double printed = 0;
  double width = byWidth.front().width;
  for (const ThinPlace& place : byWidth) {
    if (printed >= 0.9 * measures.lostAreaMm2) break;
    printed += place.areaMm2;
    width = place.width;
  }
  // The advice must exceed the present width; for a place a hundredth too thin, rounding could otherwise give that
  // width.
  const double size = std::max(std::ceil(page.x * spacing / std::max(width, 0.01 * spacing)), std::floor(page.x) + 1);
  return {{WarningCode::DetailLost,
           {{"area", measures.lostAreaMm2},
            {"n", static_cast<double>(measures.lostPlaces.size())},
            {"share", std::round(100 * printed / measures.lostAreaMm2)},
            {"size", size}}}};
}

std::vector<Warning> apartWarnings(const std::vector<Vec2>& apart) {
  if (apart.empty()) return {};
  return {{WarningCode::PrintedApart,
           {{"n", static_cast<double>(apart.size())},
            {"x", std::round(10 * apart.front().x) / 10},
            {"y", std::round(10 * apart.front().y) / 10}}}};
}

}  // namespace

Warning::Warning(WarningCode of, std::vector<NamedValue> with)
    : code(of), values(std::move(with)), message(filled(sentence(code), values)) {}

const NamedValue* Warning::value(const std::string& name) const {
  const auto found =
      std::find_if(values.begin(), values.end(), [&](const NamedValue& value) { return name == value.name; });
  return found == values.end() ? nullptr : &*found;
}

const char* warningName(WarningCode code) { return sentence(code).code; }

std::span<const Sentence> warningSentences() { return kSentences; }

std::vector<Warning> letterWarnings(const std::vector<LackedLetter>& lacked, std::size_t layer) {
  std::vector<std::pair<std::string, std::string>> byFont;  // fonts and their letters
  for (const LackedLetter& one : lacked) {
    const auto same = [&](const auto& other) { return other.first == one.font; };
    const auto known = std::find_if(byFont.begin(), byFont.end(), same);
    const std::string letter = letterWithCode(one.letter);
    if (known == byFont.end()) {
      byFont.emplace_back(one.font, letter);
    } else {
      known->second += ", " + letter;
    }
  }
  std::vector<Warning> warnings;
  for (const auto& [font, letters] : byFont) {
    std::vector<NamedValue> values{{"letters", letters}};
    if (!font.empty()) values.emplace_back("font", font);
    if (layer > 0) values.emplace_back("layer", static_cast<double>(layer));
    const WarningCode lost = layer > 0 ? WarningCode::LayerLettersLost : WarningCode::DrawingLettersLost;
    const WarningCode lent = layer > 0 ? WarningCode::LayerLettersLent : WarningCode::LettersLent;
    warnings.push_back({font.empty() ? lost : lent, std::move(values)});
  }
  return warnings;
}

std::vector<Warning> drawingWarnings(const DrawingFacts& drawing) {
  std::vector<Warning> warnings = letterWarnings(drawing.lacked, 0);
  if (drawing.faintMm2 > 0) warnings.push_back({WarningCode::DrawingFaint, {{"area", drawing.faintMm2}}});
  // Smaller areas come from edges that only graze those of the page.
  if (drawing.offPage >= 0.01) {
    warnings.push_back({WarningCode::DrawingOffPage, {{"area", drawing.offPage}}});
  }
  if (drawing.unpainted) warnings.push_back({WarningCode::DrawingUnpainted, {}});
  if (!drawing.unread.empty()) {
    std::string what;
    for (const std::string& feature : drawing.unread) what += (what.empty() ? "" : ", ") + feature;
    warnings.push_back({WarningCode::DrawingUnread, {{"what", what}}});
  }
  return warnings;
}

std::vector<Warning> drawingWarnings(const DrawingFacts& drawing, std::size_t layer) {
  std::vector<Warning> warnings = drawingWarnings(drawing);
  for (Warning& warning : warnings) tellOfLayer(warning, layer);
  return warnings;
}

std::vector<Warning> pictureWarnings(const std::vector<PictureFacts>& pictures) {
  constexpr double kRecognised = 0.7;
  std::vector<Warning> warnings;
  const PictureFacts* crowded = nullptr;
  const PictureFacts* lost = nullptr;
  const auto number = [&](const PictureFacts& one) { return static_cast<double>(&one - pictures.data() + 1); };
  const auto hundredths = [](double r) { return std::round(100 * r) / 100; };
  for (const PictureFacts& one : pictures) {
    if (one.oneTone) {
      warnings.push_back({WarningCode::PictureOneTone, {{"picture", number(one)}}});
      continue;
    }
    if (one.fieldR < kRecognised && (crowded == nullptr || one.fieldR < crowded->fieldR)) crowded = &one;
    if (one.seenR < kRecognised && (lost == nullptr || one.seenR < lost->seenR)) lost = &one;
  }
  if (crowded != nullptr) {
    warnings.push_back({WarningCode::PicturesCrowded,
                        {{"n", static_cast<double>(pictures.size())},
                         {"picture", number(*crowded)},
                         {"r", hundredths(crowded->fieldR)}}});
  } else if (lost != nullptr) {
    warnings.push_back({WarningCode::PictureLost, {{"picture", number(*lost)}, {"r", hundredths(lost->seenR)}}});
  }
  return warnings;
}

std::vector<Warning> plateWarnings(const DrawingFacts& drawing, const std::vector<Vec2>& apart,
                                   const std::vector<PictureFacts>& pictures, const std::optional<Measures>& measures,
                                   Vec2 page, double spacing) {
  std::vector<Warning> all = drawingWarnings(drawing);
  const auto add = [&all](std::vector<Warning> more) { std::move(more.begin(), more.end(), std::back_inserter(all)); };
  add(apartWarnings(apart));
  add(pictureWarnings(pictures));
  if (measures) add(lossWarnings(*measures, page, spacing));
  return all;
}

std::vector<Warning> layerWarnings(const std::vector<SeenLayer>& layers, Vec2 page, double spacing) {
  constexpr double kMuchThin = 0.2;      // share of narrow parts that is too much; serifs alone have less
  constexpr double kMayBeHidden = 0.02;  // hidden share of letters, drawings and codes that is tolerated
  // Tolerated share of a drawing that lies within 15 degrees of the layer below. A drawing filled at one angle over an
  // echo of itself merges with it wherever its outline has that angle, and is still visible.
  constexpr double kOfDrawingAlike = 0.1;
  constexpr double kIsLeft = 0.02;  // visible share that any other layer must keep
  const auto percent = [](double share) { return std::round(100 * share); };
  const auto tenths = [](double length) { return std::round(10 * length) / 10; };
  std::vector<Warning> warnings;
  for (const SeenLayer& one : layers) {
    const NamedValue layer{"layer", static_cast<double>(one.layer)};
    const double hidden = one.beside + one.underRim + one.covered;
    const double most = std::max({one.beside, one.underRim, one.covered, one.alike});
    const bool drawing = one.kind == LayerKind::Drawing;
    const bool exact = drawing || one.kind == LayerKind::Text || one.kind == LayerKind::Code;
    const bool much = exact ? hidden > kMayBeHidden || one.alike > (drawing ? kOfDrawingAlike : kMayBeHidden)
                            : hidden + one.alike > 1 - kIsLeft;
    const auto tell = [&](WarningCode code, double share, std::vector<NamedValue> more = {}) {
      if (!much || (share < most && share < kMayBeHidden)) return;
      more.insert(more.begin(), {{"percent", percent(share)}, layer});
      warnings.push_back({code, std::move(more)});
    };
    tell(WarningCode::LayerBeside, one.beside,
         {{"width", tenths(one.size.x)},
          {"height", tenths(one.size.y)},
          {"pageWidth", tenths(page.x)},
          {"pageHeight", tenths(page.y)}});
    tell(WarningCode::LayerUnderRim, one.underRim);
    tell(WarningCode::LayerCovered, one.covered);
    tell(WarningCode::LayerAlike, one.alike);
    if (one.readable && !*one.readable) {
      warnings.push_back({WarningCode::LayerUnreadable, {layer}});
    } else if (one.readable && one.module < 2 * spacing) {
      warnings.push_back({WarningCode::ThinModules, {layer, {"size", std::round(100 * one.module) / 100}}});
    }
    if (one.thin >= kMuchThin) {
      warnings.push_back({WarningCode::ThinLetters, {{"percent", percent(one.thin)}, layer}});
    }
  }
  return warnings;
}

std::string warningsJson(const std::vector<Warning>& warnings) {
  return toldJson(warnings, [](const Warning& warning) { return warningName(warning.code); });
}

}  // namespace sillon
