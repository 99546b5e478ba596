#include "gcode_reader/file_settings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "base/numbers.hpp"
#include "base/refused.hpp"
#include "gcode_reader/layers.hpp"
#include "gcode_reader/machine.hpp"
#include "gcode_reader/parser.hpp"

namespace sillon {
namespace {

constexpr double kLeastLength = 100;  // [mm], least length of all beads, or they tell nothing
constexpr double kShortest = 0.5;     // [mm], shortest bead that counts: E is rounded, which weighs on short ones
constexpr double kLongest = 1000;     // [mm], longest bead that counts: no bed is longer
constexpr double kThinnest = 0.04;    // [mm], least height of a layer that counts
constexpr double kThickest = 1.6;     // [mm], greatest height of such a layer
constexpr std::size_t kMostPlaces = 100'000;  // places that are judged in a file, at most

constexpr double kStep = 1;          // [mm], distance of places on a bead
constexpr double kReach = 2.5;       // [mm], greatest distance of neighbours
constexpr double kSameLine = 0.05;   // [mm], least distance of neighbours; less is the same line once more
constexpr double kParallel = 0.1;    // sine of the angle up to which beads count as parallel
constexpr double kAlike = 0.6;       // least share of the thicker bead's plastic; ironing and gap fill have less
constexpr int kMostCompared = 600;   // comparisons per place: solid layers have 300 in reach, hostile files all places
constexpr double kLeastBeside = 10;  // places with a neighbour, or their distances tell nothing

// Distance of neighbours, divided by the width that their beads have if the filament is 1.75 mm thick. Beads that touch
// have 1, or (2.85 / 1.75)² = 2.65 if it is 2.85 mm thick. No slicer lays many beads closer than 0.6 of their width,
// which is 1.6 with 2.85 mm.
constexpr std::pair<double, double> kTouching{0.6, 1.6};
constexpr std::pair<double, double> kTouchingIfWide{2.2, 3.1};
constexpr double kManyTouch = 0.1;   // share of places that touch: enough for 1.75 mm
constexpr double kFewTouch = 0.02;   // share of places that touch with 1.75 mm: 2.85 mm only below it
constexpr double kMostTouch = 0.3;   // share of places that touch with 2.85 mm: 2.85 mm only from it on
constexpr double kLeastFlat = 0.75;  // width over height of a bead; a narrower one would stand on edge

constexpr std::pair<double, double> kBeads{0.755, 1.99};  // width over nozzle; only one of the filaments fits
constexpr double kUsualNozzle = 0.4;                      // [mm], taken if the nozzle is not known
constexpr double kSameDiameter = 0.1;  // share that a counted diameter may be off: headers round volumes

// Cross-section of a filament [mm²].
double areaOf(double diameter) { return std::numbers::pi * diameter * diameter / 4; }

bool within(double value, const std::pair<double, double>& range) {
  return value >= range.first && value <= range.second;
}

struct ReadBead {
  Vec2 from;
  Vec2 to;
  double length;
  double filament;  ///< filament per mm of bead [mm/mm]
  bool straight;
};

/// One place on a bead.
struct BeadPlace {
  Vec2 at;
  Vec2 along;      ///< direction, of length 1
  double perFace;  ///< filament per mm of bead and mm of layer height [1/mm]
};

/// Numbers of places, by the distances of their neighbours.
struct Distances {
  std::size_t places = 0;
  std::size_t beside = 0;          ///< places with a neighbour
  std::size_t touching = 0;        ///< places whose neighbour touches if the filament is 1.75 mm thick
  std::size_t touchingIfWide = 0;  ///< places whose neighbour touches if it is 2.85 mm thick

  [[nodiscard]] bool known() const { return static_cast<double>(beside) >= kLeastBeside; }
  [[nodiscard]] double share(std::size_t count) const {
    return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(places, 1));
  }
};

/// Places on the straight beads of a layer, kStep apart or less; ends with the bead that reaches `most` places.
std::vector<BeadPlace> placesOn(const std::vector<ReadBead>& layer, double height, std::size_t most) {
  std::vector<BeadPlace> places;
  for (const ReadBead& bead : layer) {
    if (!bead.straight || places.size() >= most) continue;
    const int count = static_cast<int>(std::ceil(bead.length / kStep));
    const Vec2 along = 1 / bead.length * (bead.to - bead.from);
    for (int k = 0; k < count; ++k) {
      places.push_back({bead.from + (k + 0.5) / count * (bead.to - bead.from), along, bead.filament / height});
    }
  }
  return places;
}

/// Key of a square cell of the plane; keys of a column's cells follow each other.
std::int64_t squareOf(std::int64_t x, std::int64_t y) { return x * (std::int64_t{1} << 32) + y; }
/// Column or row of a coordinate; cells have a side of kReach.
std::int64_t columnOf(double coordinate) {
  return static_cast<std::int64_t>(std::floor(std::clamp(coordinate, -1e6, 1e6) / kReach));
}

/// Distance from a place to the nearest parallel bead about as thick as its own [mm]; above kReach: there is none.
/// \param squares  key of the cell and index of each place, sorted.
double neighbourOf(const BeadPlace& place, const std::vector<BeadPlace>& places,
                   const std::vector<std::pair<std::int64_t, std::size_t>>& squares) {
  double nearest = 2 * kReach;
  int compared = 0;
  for (int dx = -1; dx <= 1; ++dx) {
    const std::int64_t first = squareOf(columnOf(place.at.x) + dx, columnOf(place.at.y) - 1);
    auto found = std::lower_bound(squares.begin(), squares.end(), std::pair{first, std::size_t{0}});
    for (; found != squares.end() && found->first <= first + 2 && ++compared <= kMostCompared; ++found) {
      const BeadPlace& other = places[found->second];
      const Vec2 d = other.at - place.at;
      const double distance = std::abs(cross(place.along, d));
      if (distance < kSameLine || distance >= nearest || std::abs(dot(place.along, d)) > 0.51 * kStep) continue;
      if (std::abs(cross(place.along, other.along)) > kParallel) continue;
      if (other.perFace < kAlike * place.perFace || place.perFace < kAlike * other.perFace) continue;
      nearest = distance;
    }
  }
  return nearest;
}

/// Counts the places of a layer by the distances of their neighbours.
void judge(const std::vector<BeadPlace>& places, Distances& distances) {
  std::vector<std::pair<std::int64_t, std::size_t>> squares;
  for (std::size_t k = 0; k < places.size(); ++k) {
    squares.emplace_back(squareOf(columnOf(places[k].at.x), columnOf(places[k].at.y)), k);
  }
  std::sort(squares.begin(), squares.end());
  distances.places += places.size();
  for (const BeadPlace& place : places) {
    const double distance = neighbourOf(place, places, squares);
    if (distance > kReach) continue;
    const double ratio = distance / (place.perFace * areaOf(kThinFilament));
    ++distances.beside;
    distances.touching += within(ratio, kTouching) ? 1 : 0;
    distances.touchingIfWide += within(ratio, kTouchingIfWide) ? 1 : 0;
  }
}

/// Reads a file's beads, layer by layer.
class Scale {
 public:
  explicit Scale(GcodeFlavor flavor) : machine_(flavor) {}

  void line(std::string_view text);
  void finish();

  [[nodiscard]] const Distances& distances() const { return distances_; }
  /// Median of BeadPlace::perFace, weighted by length [1/mm]. \param flat  gets that of perFace over layer height
  /// [1/mm²].
  [[nodiscard]] std::optional<double> perFace(double& flat);
  /// Diameter from the header's volume and the filament that was pushed, if it is one that is sold.
  [[nodiscard]] std::optional<double> counted() const;

 private:
  void comment(std::string_view text);
  void endLayer();

  MachineState machine_;
  bool begun_ = false;
  bool purges_ = false;
  std::vector<ReadBead> layer_;
  double z_ = 0;
  double below_ = 0;
  std::vector<std::pair<double, double>> faces_;  // perFace [1/mm] and length [mm] of each bead
  std::vector<std::pair<double, double>> flats_;  // perFace over layer height [1/mm²] and length [mm]
  Distances distances_;
  double pushed_ = 0;  // filament in beads [mm]
  double volume_ = 0;  // filament by the header [mm³]
  bool severalTools_ = false;
};

// Reads marks of layers, roles, and the header's volume.
void Scale::comment(std::string_view text) {
  begun_ = begun_ || layerMark(text) != LayerMark::None;
  if (text.starts_with("TYPE:")) purges_ = isPurge(text.substr(5));
  volume_ = numberAfter(text, "EXTRUDER_TRAIN.0.MATERIAL.VOLUME_USED:").value_or(volume_);
  severalTools_ = severalTools_ || text.starts_with("EXTRUDER_TRAIN.1.");
}

// Runs a line, and keeps its bead if it lies level and is neither purged nor too short.
void Scale::line(std::string_view text) {
  if (distances_.places >= kMostPlaces && !(volume_ > 0)) return;
  const GcodeParts parts = partsOf(text);
  if (!parts.comment.empty()) comment(parts.comment);
  if (parts.code.empty()) return;
  const GcodeCommand command = commandOf(parts.code);
  const auto move = runCommand(machine_, command, readsWords(command) ? wordsOf(command.rest) : GcodeWords{});
  if (!move) return;
  const bool pushes = begun_ && move->e > 0 && move->length > 0;
  if (pushes) pushed_ += move->e;
  const bool solid = move->length >= kShortest && move->length <= kLongest;
  const bool bead = pushes && !purges_ && solid && move->z == move->zFrom;
  if (!bead || machine_.volumetric || distances_.places >= kMostPlaces) return;
  if (move->z != z_) {
    endLayer();
    z_ = move->z;
  }
  layer_.push_back({move->from, move->to, move->length, move->e / move->length, !move->arc});
}

// Weighs the beads of the layer that has ended.
void Scale::endLayer() {
  if (layer_.empty()) return;
  const double height = z_ - below_;
  if (height >= kThinnest && height <= kThickest) {
    for (const ReadBead& bead : layer_) {
      faces_.emplace_back(bead.filament / height, bead.length);
      flats_.emplace_back(bead.filament / height / height, bead.length);
    }
    judge(placesOn(layer_, height, kMostPlaces - std::min(kMostPlaces, distances_.places)), distances_);
  }
  below_ = z_;
  layer_.clear();
}

void Scale::finish() { endLayer(); }

// Median of values, weighted by length; nothing if the lengths add up to less than kLeastLength.
std::optional<double> medianOf(std::vector<std::pair<double, double>>& values) {
  double total = 0;
  for (const auto& [value, length] : values) total += length;
  if (total < kLeastLength) return std::nullopt;
  std::sort(values.begin(), values.end());
  double passed = 0;
  for (const auto& [value, length] : values) {
    passed += length;
    if (passed >= total / 2) return value;
  }
  return std::nullopt;
}

std::optional<double> Scale::perFace(double& flat) {
  flat = medianOf(flats_).value_or(0);
  return medianOf(faces_);
}

std::optional<double> Scale::counted() const {
  if (!(volume_ > 0) || severalTools_ || !(pushed_ > 0)) return std::nullopt;
  const double diameter = std::sqrt(4 * volume_ / pushed_ / std::numbers::pi);
  for (const double sold : {kThinFilament, kWideFilament}) {
    if (std::abs(diameter - sold) <= kSameDiameter * sold) return sold;
  }
  return std::nullopt;
}

}  // namespace

double WeighedFilament::widthWith(double filamentDiameter) const { return perFace * areaOf(filamentDiameter); }

WeighedFilament weighFilament(std::string_view gcode, GcodeFlavor flavor, std::optional<double> nozzle) {
  Scale scale(flavor);
  forEachLine(gcode, [&](const GcodeLine& line) { scale.line(line.text); });
  scale.finish();
  WeighedFilament weighed;
  double perFlat = 0;
  const std::optional<double> perFace = scale.perFace(perFlat);
  weighed.perFace = perFace.value_or(0);
  if (const auto counted = scale.counted()) {
    weighed.diameter = *counted;
    weighed.evidence = FilamentEvidence::Counted;
    return weighed;
  }
  if (!perFace) return weighed;

  const double size = nozzle.value_or(kUsualNozzle);
  const auto fits = [&](double diameter) {
    const double width = weighed.widthWith(diameter);
    return width >= kBeads.first * size && width <= kBeads.second * size;
  };
  const auto decided = [&](double diameter, FilamentEvidence evidence) {
    weighed.diameter = diameter;
    weighed.evidence = evidence;
    return weighed;
  };
  const Distances& distances = scale.distances();
  const double touching = distances.share(distances.touching);
  if (distances.known() && touching >= kManyTouch) {
    return decided(kThinFilament, fits(kThinFilament) ? FilamentEvidence::Fits : FilamentEvidence::Odd);
  }
  const bool touchesIfWide =
      distances.known() && touching < kFewTouch && distances.share(distances.touchingIfWide) >= kMostTouch;
  const bool standsOnEdge = perFlat * areaOf(kThinFilament) < kLeastFlat;
  if (fits(kThinFilament)) {
    return decided(kThinFilament, touchesIfWide ? FilamentEvidence::Open : FilamentEvidence::Fits);
  }
  if (touchesIfWide)
    return decided(kWideFilament, fits(kWideFilament) ? FilamentEvidence::Fits : FilamentEvidence::Odd);
  if (!fits(kWideFilament)) return decided(kThinFilament, FilamentEvidence::Odd);
  const bool sure = standsOnEdge || nozzle.has_value();  // else a finer nozzle is as likely as the wider filament
  return decided(sure ? kWideFilament : kThinFilament, sure ? FilamentEvidence::Fits : FilamentEvidence::Open);
}

Error askForFilament(const WeighedFilament& weighed) {
  const auto told = [](double diameter) { return decimal(diameter, 2); };
  return refusedFile("FilamentOpen", {{"thinWidth", told(weighed.widthWith(kThinFilament))},
                                      {"thin", told(kThinFilament)},
                                      {"wideWidth", told(weighed.widthWith(kWideFilament))},
                                      {"wide", told(kWideFilament)}});
}

}  // namespace sillon
