#include "gcode_reader/file_settings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "base/numbers.hpp"
#include "base/refused.hpp"
#include "gcode_reader/layers.hpp"
#include "gcode_reader/machine.hpp"
#include "gcode_reader/parser.hpp"

namespace sillon {
namespace {

constexpr double kLeastLength = 100;          // [mm] of beads, or too little is known
constexpr double kShortest = 0.5;             // [mm] of a bead: its E is rounded
constexpr double kLongest = 1000;             // [mm] of a bead: no bed is longer
constexpr double kThinnest = 0.04;            // [mm] of a layer
constexpr double kThickest = 1.6;             // [mm]
constexpr std::size_t kMostPlaces = 100'000;  // that are judged

constexpr double kStep = 1;          // [mm] between places on a bead
constexpr double kReach = 2.5;       // [mm] to a neighbour, at most
constexpr double kSameLine = 0.05;   // [mm] between neighbours; less is the same line once more
constexpr double kParallel = 0.1;    // sine
constexpr double kAlike = 0.6;       // of the thicker bead's plastic; ironing and gap fill have less
constexpr int kMostCompared = 600;   // places for each: solid layers have 300 within reach, hostile files all of theirs
constexpr double kLeastBeside = 10;  // [places] with a neighbour, or their distances tell nothing

// Distances of neighbours over the width that 1.75 mm filament gives them. Beads that touch have 1, and those of 2.85
// mm filament have 2.65. No slicer lays many beads closer than 0.6 of their width, which would be 1.6 there.
constexpr std::pair<double, double> kTouching{0.6, 1.6};
constexpr std::pair<double, double> kTouchingIfWide{2.2, 3.1};
constexpr double kManyTouch = 0.1;   // of all places
constexpr double kFewTouch = 0.02;   // of all places
constexpr double kMostTouch = 0.3;   // of all places
constexpr double kLeastFlat = 0.75;  // [height], widths; a bead lower than that would stand on edge

constexpr std::pair<double, double> kBeads{0.755, 1.99};  // [nozzle], widths; of one of both filaments alone
constexpr double kUsualNozzle = 0.4;                      // [mm]
constexpr double kSameDiameter = 0.1;                     // of a diameter that is counted: headers round volumes

double areaOf(double diameter) { return std::numbers::pi * diameter * diameter / 4; }

bool within(double value, const std::pair<double, double>& range) {
  return value >= range.first && value <= range.second;
}

struct Bead {
  Vec2 from;
  Vec2 to;
  double length;
  double filament;  ///< for each mm [mm/mm]
  bool straight;
};

/// One place on a bead.
struct Place {
  Vec2 at;
  Vec2 along;      ///< of length 1
  double perFace;  ///< [1/mm]
};

/// What distances of neighbours say of all places.
struct Distances {
  std::size_t places = 0;
  std::size_t beside = 0;          ///< with a neighbour
  std::size_t touching = 0;        ///< with 1.75 mm filament
  std::size_t touchingIfWide = 0;  ///< with 2.85 mm filament

  [[nodiscard]] bool known() const { return static_cast<double>(beside) >= kLeastBeside; }
  [[nodiscard]] double share(std::size_t count) const {
    return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(places, 1));
  }
};

std::vector<Place> placesOn(const std::vector<Bead>& layer, double height, std::size_t most) {
  std::vector<Place> places;
  for (const Bead& bead : layer) {
    if (!bead.straight || places.size() >= most) continue;
    const int count = static_cast<int>(std::ceil(bead.length / kStep));
    const Vec2 along = 1 / bead.length * (bead.to - bead.from);
    for (int k = 0; k < count; ++k) {
      places.push_back({bead.from + (k + 0.5) / count * (bead.to - bead.from), along, bead.filament / height});
    }
  }
  return places;
}

/// A square of the plane, of the size of kReach.
std::int64_t squareOf(std::int64_t x, std::int64_t y) { return x * (std::int64_t{1} << 32) + y; }
std::int64_t columnOf(double coordinate) {
  return static_cast<std::int64_t>(std::floor(std::clamp(coordinate, -1e6, 1e6) / kReach));
}

/// From a place to the nearest parallel bead as thick as its own [mm]; above kReach: there is none.
double neighbourOf(const Place& place, const std::vector<Place>& places,
                   const std::vector<std::pair<std::int64_t, std::size_t>>& squares) {
  double nearest = 2 * kReach;
  int compared = 0;
  for (int dx = -1; dx <= 1; ++dx) {
    const std::int64_t first = squareOf(columnOf(place.at.x) + dx, columnOf(place.at.y) - 1);
    auto found = std::lower_bound(squares.begin(), squares.end(), std::pair{first, std::size_t{0}});
    for (; found != squares.end() && found->first <= first + 2 && ++compared <= kMostCompared; ++found) {
      const Place& other = places[found->second];
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

void judge(const std::vector<Place>& places, Distances& distances) {
  std::vector<std::pair<std::int64_t, std::size_t>> squares;
  for (std::size_t k = 0; k < places.size(); ++k) {
    squares.emplace_back(squareOf(columnOf(places[k].at.x), columnOf(places[k].at.y)), k);
  }
  std::sort(squares.begin(), squares.end());
  distances.places += places.size();
  for (const Place& place : places) {
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
  /// Half of the beads have less, by their length [1/mm]. \param flat  gets the same of widths over heights.
  [[nodiscard]] std::optional<double> perFace(double& flat);
  /// The diameter by the header's volume, if it is one that is sold.
  [[nodiscard]] std::optional<double> counted() const;

 private:
  void comment(std::string_view text);
  void endLayer();

  MachineState machine_;
  bool begun_ = false;
  bool purges_ = false;
  std::vector<Bead> layer_;
  double z_ = 0;
  double below_ = 0;
  std::vector<std::pair<double, double>> faces_;  // filament per face [1/mm], length [mm]
  std::vector<std::pair<double, double>> flats_;  // the same over the height [1/mm²], length [mm]
  Distances distances_;
  double pushed_ = 0;  // [mm] of filament, in beads
  double volume_ = 0;  // [mm³]
  bool severalTools_ = false;
};

void Scale::comment(std::string_view text) {
  begun_ = begun_ || layerMark(text) != LayerMark::None;
  if (text.starts_with("TYPE:")) purges_ = isPurge(text.substr(5));
  volume_ = numberAfter(text, "EXTRUDER_TRAIN.0.MATERIAL.VOLUME_USED:").value_or(volume_);
  severalTools_ = severalTools_ || text.starts_with("EXTRUDER_TRAIN.1.");
}

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

void Scale::endLayer() {
  if (layer_.empty()) return;
  const double height = z_ - below_;
  if (height >= kThinnest && height <= kThickest) {
    for (const Bead& bead : layer_) {
      faces_.emplace_back(bead.filament / height, bead.length);
      flats_.emplace_back(bead.filament / height / height, bead.length);
    }
    judge(placesOn(layer_, height, kMostPlaces - std::min(kMostPlaces, distances_.places)), distances_);
  }
  below_ = z_;
  layer_.clear();
}

void Scale::finish() { endLayer(); }

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
  return refused(ErrorCode::InvalidFile, reason::kFilamentOpen,
                 {{"thinWidth", told(weighed.widthWith(kThinFilament))},
                  {"thin", told(kThinFilament)},
                  {"wideWidth", told(weighed.widthWith(kWideFilament))},
                  {"wide", told(kWideFilament)}});
}

}  // namespace sillon
