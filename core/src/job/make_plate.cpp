#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>

#include "input/plate_size.hpp"
#include "job/place_on_bed.hpp"
#include "sillon/compose/compose.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/job/plate.hpp"
#include "sillon/settings/table.hpp"

namespace sillon {
namespace {

// Times of the parts of a job, in times of one toolpath (wave, one thread, in a browser).
constexpr double kTrials = 0.7;  // three plates of a hundred beads, which choose a lamp
constexpr double kMeasures = 1.5;

/// The progress of a job whose parts are known by their weights.
class Parts {
 public:
  /// \param ahead  weight of all parts that are known now.
  Parts(const RunContext& run, double ahead) : run_(run), whole_(run, 0, 1), ahead_(ahead) {}

  /// A part that was not known before.
  void add(double weight) { ahead_ += weight; }
  /// Begins the next part.
  void begin(double weight) {
    const double all = done_ + ahead_;
    part_.reset();
    part_.emplace(run_, done_ / all, (done_ + weight) / all);
    done_ += weight;
    ahead_ -= weight;
  }

 private:
  const RunContext& run_;
  ProgressShare whole_;
  std::optional<ProgressShare> part_;
  double done_ = 0;
  double ahead_;
};

class Maker {
 public:
  Maker(Plate& plate, const ReadInput& read, const PlateOptions& options, const RunContext& run)
      : plate_(plate), read_(read), options_(options), run_(run), parts_(run, weight()) {}

  std::optional<Error> make() {
    for (auto step : {&Maker::readInput, &Maker::solve, &Maker::makeSeen, &Maker::correctLayers, &Maker::makeBelow,
                      &Maker::measure}) {
      if (auto error = (this->*step)()) return error;
    }
    return std::nullopt;
  }

 private:
  Result<ToolpathResult> makeComposed(PlateInput input, const LayerStack& layers) {
    parts_.begin(1);
    layOver(layers, input);
    const bool count = measures() && options_.countDislocations;
    return options_.session != nullptr ? options_.session->generateToolpath(input, params(), run_, count)
                                       : generateToolpath(input, params(), run_, count);
  }
  /// Number of plates that are made anew for the pictures of layers.
  [[nodiscard]] int correctionsOfLayers() const {
    const bool shown = std::any_of(plate_.project.layers.begin(), plate_.project.layers.end(), [](const Layer& layer) {
      return layer.visible && layer.kind == LayerKind::Picture;
    });
    return shown && plate_.project.pictures.localContrast == 0 ? plate_.project.pictures.corrections : 0;
  }
  [[nodiscard]] const ToolpathParams& params() const { return plate_.project.toolpath; }
  /// Corrections of pictures turn the directions, also those of the path below.
  [[nodiscard]] bool makesSeen() const {
    return options_.path != PlatePath::Below || !plate_.project.pictures.files.empty() || correctionsOfLayers() > 0;
  }
  [[nodiscard]] bool measures() const { return options_.measure && options_.path != PlatePath::Below; }
  [[nodiscard]] double weight() const {
    return (makesSeen() ? platesFor(plate_.project.pictures) + correctionsOfLayers() : 0) +
           (options_.path != PlatePath::Seen ? 1 : 0) + (measures() ? kMeasures : 0);
  }

  std::optional<Error> readInput() {
    auto input = readPlateInput(plate_.project, read_, run_);
    if (!input) return input.error();
    if (placeOnBed(plate_.project, input.value().shape, options_.placing)) {
      input = readPlateInput(plate_.project, read_, run_);
      if (!input) return input.error();
    }
    plate_.input = std::move(input).value();
    return plateTooLarge(bounds(plate_.input.shape).size(), params().spacing, run_.memory());
  }

  std::optional<Error> solve() {
    const auto onTrial = [&](int trial, int trials) {
      if (trial == 0) parts_.add(kTrials);
      parts_.begin(kTrials / trials);
    };
    auto layers = makeLayers(plate_.project, plate_.input.shape, read_, run_);
    if (!layers) return layers.error();
    layers_ = std::move(layers).value();
    plate_.layers = std::move(layers_.placed);
    auto pictures = solvePictures(plate_.project, read_, plate_.input, run_, options_.keptPictures, onTrial);
    if (!pictures) return pictures.error();
    plate_.pictures = std::move(pictures).value();
    return std::nullopt;
  }

  std::optional<Error> makeSeen() {
    if (!makesSeen()) return std::nullopt;
    const auto make = [&](const PlateInput& input, int /*round*/, int /*rounds*/) {
      return makeComposed(input, layers_);
    };
    auto made = makeShownPlate(plate_.project, plate_.pictures, plate_.input, make, run_);
    if (!made) return made.error();
    plate_.result = std::move(made).value();
    return std::nullopt;
  }

  /// Pictures of layers are looked at, and solved for anew as makeShownPlate does with those of the whole plate. From
  /// here on nothing is.
  std::optional<Error> correctLayers() {
    const int rounds = correctionsOfLayers();
    if (layers_.pictures.empty() || !makesSeen() || (rounds == 0 && !measures())) {
      lay();
      return std::nullopt;
    }
    LayerStack tried = layers_;
    ToolpathResult result = plate_.result;
    double highest = -1e9;
    for (int round = 0;; ++round) {
      const LayerStack shown = tried;
      const auto seen = askForMissing(tried, result.toolpath, plate_.input.shape.page, plate_.pictures.roughness, run_);
      if (!seen) return seen.error();
      const double sum = std::accumulate(seen.value().begin(), seen.value().end(), 0.0,
                                         [](double all, const PictureMeasures& one) { return all + one.r; });
      if (sum > highest) {
        highest = sum;
        judge(seen.value());
        layers_ = shown;
        plate_.result = std::move(result);
      }
      if (round == rounds) break;
      auto again = makeLayers(plate_.project, plate_.input.shape, read_, run_, &tried);
      if (!again) return again.error();
      tried = std::move(again).value();
      auto made = makeComposed(plate_.input, tried);
      if (!made) return made.error();
      result = std::move(made).value();
    }
    lay();
    return std::nullopt;
  }

  void lay() {
    plate_.seenLayers = seeLayers(plate_.project, plate_.layers, layers_, plate_.input.directions);
    layOver(layers_, plate_.input);
  }

  void judge(const std::vector<PictureMeasures>& seen) {
    plate_.layerPictures.clear();
    for (const auto& [number, picture] : layers_.pictures) {
      plate_.layerPictures.push_back({number + 1, picture.lamp, seen[plate_.layerPictures.size()]});
    }
  }

  std::optional<Error> makeBelow() {
    if (options_.path == PlatePath::Seen) return std::nullopt;
    parts_.begin(1);
    auto made = generateAcross(plate_.input, params(), run_);
    if (!made) return made.error();
    if (options_.path == PlatePath::Below) {
      plate_.result = std::move(made).value();
    } else {
      plate_.below = std::move(made).value().toolpath;
    }
    return std::nullopt;
  }

  std::optional<Error> measure() {
    if (!measures()) return std::nullopt;
    parts_.begin(kMeasures);
    const PlateInput& input = plate_.input;
    auto measured = measureToolpath(plate_.toolpath(), input, params(), run_,
                                    options_.countDislocations ? plate_.result.dislocations : Dislocations{});
    if (!measured) return measured.error();
    plate_.measures = std::move(measured).value();
    if (plate_.pictures.shown.empty() || !options_.judgePictures) return std::nullopt;
    auto shown =
        measurePictures(plate_.toolpath(), input.shape.page, plate_.pictures.shown, plate_.pictures.roughness, run_);
    if (!shown) return shown.error();
    plate_.shown = std::move(shown).value();
    return std::nullopt;
  }

  Plate& plate_;
  const ReadInput& read_;
  const PlateOptions& options_;
  const RunContext& run_;
  Parts parts_;
  LayerStack layers_;
};

/// Calls body(drawing, number) for the drawings of all layers, whose numbers begin with 1. Hidden ones have none.
template <class Body>
void forDrawings(const Plate& plate, const Body& body) {
  for (std::size_t k = 0; k < plate.layers.size(); ++k) {
    for (const DrawingFacts& drawing : plate.layers[k].drawings) body(drawing, k + 1);
  }
}

}  // namespace

Result<Plate> makePlate(Project project, const ReadInput& read, const PlateOptions& options, const RunContext& run) {
  if (auto wrong = invalidSettings(project)) return *std::move(wrong);
  Plate plate;
  plate.project = std::move(project);
  plate.threads = run.threads();
  if (auto error = Maker(plate, read, options, run).make()) return *std::move(error);
  return plate;
}

std::vector<InputNote> Plate::notes() const {
  std::vector<InputNote> all = inputNotes(project, input.shape.drawing);
  forDrawings(*this, [&](const DrawingFacts& drawing, std::size_t layer) {
    const std::vector<InputNote> more = layerNotes(drawing, layer);
    all.insert(all.end(), more.begin(), more.end());
  });
  return all;
}

std::vector<Warning> Plate::warnings() const {
  std::vector<Warning> all = plateWarnings(input.shape.drawing, result.apart, pictureFacts(pictures, shown), measures,
                                           input.shape.page, result.toolpath.spacing);
  forDrawings(*this, [&](const DrawingFacts& drawing, std::size_t layer) {
    const std::vector<Warning> more = drawingWarnings(drawing, layer);
    all.insert(all.end(), more.begin(), more.end());
  });
  const std::vector<Warning> ofLetters = letterWarnings(layers);
  all.insert(all.end(), ofLetters.begin(), ofLetters.end());
  const std::vector<Warning> ofLayers = layerWarnings(seenLayers, input.shape.page, project.toolpath.spacing);
  all.insert(all.end(), ofLayers.begin(), ofLayers.end());
  if (gcode) all.insert(all.end(), gcode->warnings.begin(), gcode->warnings.end());
  return all;
}

Report Plate::report() const {
  Report out = reportOf(result, measures);
  out.threads = threads;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    out.pictures.push_back({pictures.shown[k].file, pictures.shown[k].lamp, shown[k]});
  }
  out.layers = seenLayers;
  if (measures) out.layerPictures = layerPictures;
  out.fromGcode = judgedByGcode;
  if (gcode) out.print = {gcode->seconds, gcode->filamentMm, gcode->filamentGrams};
  out.delay = delay;
  out.notes = notes();
  out.warnings = warnings();
  return out;
}

}  // namespace sillon
