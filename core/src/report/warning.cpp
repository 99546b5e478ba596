#include "sillon/report/warning.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/json.hpp"
#include "base/numbers.hpp"
#include "base/sentence.hpp"
#include "base/sort_key.hpp"

namespace sillon {
namespace {

struct Row {
  WarningCode code;
  const char* name;
  const char* sentence;  // {name} stands for a value
};

constexpr Row kRows[] = {
    {WarningCode::AccelerationHeld, "AccelerationHeld",
     "acceleration is {asked} mm/s2; it is held at machineAcceleration, {held}"},
    {WarningCode::BaseTooThin, "BaseTooThin",
     "a base layer covers only {percent} % of the shape; places too narrow for its lines have nothing below them"},
    {WarningCode::BlockMovesLow, "BlockMovesLow", "{block} goes down to Z {z}; what stands there is {height} mm high"},
    {WarningCode::DetailLost, "DetailLost",
     "{area} mm2 are narrower than a bead and stay empty, in places: {n}; {share} % of that would print at a page "
     "width "
     "of {size} mm"},
    {WarningCode::DrawingFaint, "DrawingFaint",
     "{area} mm2 of the drawing are painted at half opacity or less and printed like the rest; take a variant of one "
     "tone to "
     "see its lines"},
    {WarningCode::DrawingOffPage, "DrawingOffPage",
     "{area} mm2 of the drawing lie off its page and are cut off, as viewers do"},
    {WarningCode::DrawingUnpainted, "DrawingUnpainted",
     "nothing in the drawing is painted, so its outlines were taken as the shape"},
    {WarningCode::DrawingUnread, "DrawingUnread",
     "not read of the drawing: {what}; compare the plate with what viewers show, or convert the drawing to paths in "
     "the program that made it"},
    {WarningCode::EndHot, "EndHot",
     "endGcode leaves a nozzle, the bed or the chamber hot; M104 S0, M140 S0 and M141 S0 turn them off"},
    {WarningCode::EndLine, "EndLine", "line {line} of endGcode: {what}"},
    {WarningCode::FillRatio, "FillRatio", "the plastic fills {percent} % of the shape's area; 97 to 105 print well"},
    {WarningCode::FlatBeads, "FlatBeads", "{n} points have beads no wider than the layer is high ({height} mm)"},
    {WarningCode::ManyBytes, "ManyBytes", "the file has {mb} MB; hosts get slow above 100"},
    {WarningCode::ManyMoves, "ManyMoves", "the file has {n} moves; hosts get slow above 2 million"},
    {WarningCode::MaxFlowSlows, "MaxFlowSlows", "maxFlow slows {percent} % of the path"},
    {WarningCode::MirroredUp, "MirroredUp",
     "the plate is mirrored but shown from above; writing on it reads backwards"},
    {WarningCode::NoPressureAdvance, "NoPressureAdvance",
     "nothing sets pressure advance on this printer, so oriented layers run evenly at {speed} mm/s, {minutes} min "
     "longer "
     "than at {asked}; the project's printer.setPressureAdvance sets it, printer.showSpeed the speed"},
    {WarningCode::NotPrimed, "NotPrimed", "the plate leaves no room for a purge line; the first beads may be thin"},
    {WarningCode::NotPrimedAbovePrint, "NotPrimedAbovePrint",
     "nothing is printed beside a print that stands on the bed; the nozzle is not primed"},
    {WarningCode::OutsideShape, "OutsideShape", "{n} points of the path lie more than 0.1 mm outside the shape"},
    {WarningCode::PictureLost, "PictureLost",
     "picture {picture} is hard to recognise in the beads (r {r}; 0.7 is enough); a larger size or a smaller spacing "
     "shows more of it"},
    {WarningCode::PictureOneTone, "PictureOneTone",
     "picture {picture} has one tone on this plate, so nothing can be seen in it; give a picture with bright and dark "
     "parts wider than a bead"},
    {WarningCode::PicturesCrowded, "PicturesCrowded",
     "{n} pictures are too many for one plate: picture {picture} is hard to recognise in its directions (r {r}; 0.7 is "
     "enough); use fewer pictures, or ones that differ less"},
    {WarningCode::PressureAdvanceReset, "PressureAdvanceReset",
     "pressure advance is {value} after the print, until the printer restarts or another file sets it"},
    {WarningCode::PrintOnBed, "PrintOnBed",
     "a print of {height} mm stands on the bed while the start block homes; G28 and G29 must not come down on it on "
     "this printer"},
    {WarningCode::PrintedApart, "PrintedApart",
     "toolpaths that lie apart from the rest of their part: {n}, round x {x}, y {y} mm; what joins them is too thin "
     "for a bead, which a larger size, a smaller spacing or keepThin may mend"},
    {WarningCode::SegmentsSlow, "SegmentsSlow", "maxSegmentsPerSecond slows {percent} % of the path"},
    {WarningCode::SkirtLeftOut, "SkirtLeftOut", "the skirt does not fit the bed and was left out"},
    {WarningCode::SpeedHeld, "SpeedHeld", "{field} is {asked} mm/s; it is held at machineSpeed, {held}"},
    {WarningCode::StartFlow, "StartFlow",
     "startGcode sets the flow to {percent} % (M221), which holds for the whole print, beside filamentFlow"},
    {WarningCode::StartLine, "StartLine", "line {line} of startGcode: {what}"},
    {WarningCode::StartScales, "StartScales",
     "startGcode sets the speed to {percent} % (M220); it is put back to 100 before the first bead"},
    {WarningCode::StartTemperature, "StartTemperature",
     "startGcode leaves the nozzle at {hot} degrees; the first layer is meant for {meant}"},
    {WarningCode::ThinLayers, "ThinLayers", "layerHeight is {value} mm; below 0.2 nozzle layers tear"},
    {WarningCode::UnusualFilament, "UnusualFilament",
     "filamentDiameter is {value} mm; filament is sold with 1.75 and 2.85"},
    {WarningCode::UnusualFlow, "UnusualFlow", "{field} is {value}; 0.8 to 1.1 is usual"},
    {WarningCode::WidthHeld, "WidthHeld",
     "{percent} % of the path is printed with a width held at {low} or {high} mm (0.6 and 1.6 nozzle)"},
};

constexpr bool rowsStandInOrder() {
  for (int k = 0; k < static_cast<int>(std::size(kRows)); ++k) {
    if (static_cast<int>(kRows[k].code) != k) return false;
  }
  return true;
}
static_assert(rowsStandInOrder(), "one row per code, in the order of WarningCode");

const Row& row(WarningCode code) { return kRows[static_cast<std::size_t>(code)]; }

/// The warning about places narrower than a bead.
std::vector<Warning> lossWarnings(const Measures& measures, Vec2 page, double spacing) {
  if (!(measures.lostAreaMm2 > 0.005 * measures.shapeAreaMm2)) return {};
  // The thinnest tenth may be hairlines that no size would save.
  std::vector<ThinPlace> byWidth = measures.lostPlaces;
  sortBy(byWidth, [](const ThinPlace& place) { return -place.width; });
  double printed = 0;
  double width = byWidth.front().width;
  for (const ThinPlace& place : byWidth) {
    if (printed >= 0.9 * measures.lostAreaMm2) break;
    printed += place.areaMm2;
    width = place.width;
  }
  // Never the present width: for a place a hundredth too thin, rounding could give it.
  const double size = std::max(std::ceil(page.x * spacing / std::max(width, 0.01 * spacing)), std::floor(page.x) + 1);
  return {{WarningCode::DetailLost,
           {{"area", measures.lostAreaMm2},
            {"n", static_cast<double>(measures.lostPlaces.size())},
            {"share", std::round(100 * printed / measures.lostAreaMm2)},
            {"size", size}}}};
}

std::string sentenceOf(WarningCode code, const std::vector<NamedValue>& values) {
  return filled(row(code).sentence, [&](std::string_view name) {
    for (const NamedValue& value : values) {
      if (name == value.name) return value.text.empty() ? decimal(value.number, 3) : value.text;
    }
    return std::string();
  });
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
    : code(of), values(std::move(with)), message(sentenceOf(code, values)) {}

const NamedValue* Warning::value(const std::string& name) const {
  const auto found =
      std::find_if(values.begin(), values.end(), [&](const NamedValue& value) { return name == value.name; });
  return found == values.end() ? nullptr : &*found;
}

const char* warningName(WarningCode code) { return row(code).name; }

std::vector<Warning> drawingWarnings(const DrawingFacts& drawing) {
  std::vector<Warning> warnings;
  if (drawing.faintMm2 > 0) warnings.push_back({WarningCode::DrawingFaint, {{"area", drawing.faintMm2}}});
  // Edges that only graze the page's are no loss.
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

std::string warningsJson(const std::vector<Warning>& warnings) {
  std::string list;
  for (const Warning& warning : warnings) {
    std::string values;
    for (const NamedValue& value : warning.values) {
      values += (values.empty() ? "" : ",") + jsonString(value.name) + ":" +
                (value.text.empty() ? jsonNumber(value.number) : jsonString(value.text));
    }
    list += (list.empty() ? "" : ",") + ("{\"code\":" + jsonString(warningName(warning.code))) + ",\"values\":{" +
            values + "},\"message\":" + jsonString(warning.message) + "}";
  }
  return "[" + list + "]";
}

}  // namespace sillon
