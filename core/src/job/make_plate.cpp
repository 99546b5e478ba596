#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "compose/visible.hpp"
#include "input/plate_size.hpp"
#include "job/place_on_bed.hpp"
#include "pictures/parts.hpp"
#include "report/told.hpp"
#include "sillon/compose/compose.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/job/plate.hpp"
#include "sillon/settings/table.hpp"

namespace sillon {
namespace {

// Durations of the parts of a job relative to that of one toolpath (wave, one thread, in a browser).
constexpr double kTrials = 0.7;  // three plates of a hundred beads each, which choose a lamp
constexpr double kMeasures = 0.15;

/// Progress of a job whose parts have known weights.
class PartsProgress {
 public:
  /// \param ahead  total weight of all parts that are known so far.
  PartsProgress(const RunContext& run, double ahead) : run_(run), whole_(run, 0, 1), ahead_(ahead) {}

  /// Adds a part that was not known before.
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

/// Makes a plate, step by step.
class Maker {
 public:
  Maker(Plate& plate, const ReadInput& read, const PlateOptions& options, const RunContext& run)
      : plate_(plate), read_(read), options_(options), run_(run), parts_(run, weight()) {}

  std::optional<Error> make() {
    for (auto step : {&Maker::compose, &Maker::makeSeen, &Maker::makeBelow, &Maker::measure}) {
      if (auto error = (this->*step)()) return error;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] const ToolpathParams& params() const { return plate_.project.toolpath; }
  /// Tells whether the visible path is made. Corrections of pictures need it even for the path below, because they turn
  /// its directions as well.
  [[nodiscard]] bool makesSeen() const { return options_.path != PlatePath::Below || pathsFor(plate_.project) > 1; }
  [[nodiscard]] bool measures() const { return options_.measure && options_.path != PlatePath::Below; }
  [[nodiscard]] double weight() const {
    return (makesSeen() ? pathsFor(plate_.project) : 0) + (options_.path != PlatePath::Seen ? 1 : 0) +
           (measures() ? kMeasures : 0);
  }

  std::optional<Error> compose() {
    auto input = readPlateInput(plate_.project, read_, run_);
    if (!input) return input.error();
    if (placeOnBed(plate_.project, input.value().shape, options_.placing)) {
      input = readPlateInput(plate_.project, read_, run_);
      if (!input) return input.error();
    }
    if (auto error = plateTooLarge(bounds(input.value().shape).size(), params().spacing, run_.memory())) return error;
    const auto onTrial = [&](int trial, int trials) {
      if (trial == 0) parts_.add(kTrials);
      parts_.begin(kTrials / trials);
    };
    auto composed =
        sillon::compose(plate_.project, std::move(input).value(), {read_, options_.keptPictures, onTrial}, run_);
    if (!composed) return composed.error();
    plate_.composition = std::move(composed).value();
    return std::nullopt;
  }

  std::optional<Error> makeSeen() {
    if (makesSeen()) {
      const bool count = measures() && options_.countDislocations;
      const auto make = [&](const PlateInput& input) {
        parts_.begin(1);
        return options_.session != nullptr ? options_.session->generateToolpath(input, params(), run_, count)
                                           : generateToolpath(input, params(), run_, count);
      };
      auto made = makeShown(plate_.project, plate_.composition, read_, make, run_);
      if (!made) return made.error();
      plate_.result = std::move(made).value();
    }
    plate_.input = plate_.composition.laid();
    plate_.seenLayers = seeLayers(plate_.project, plate_.composition.layers.placed, plate_.composition);
    return std::nullopt;
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
    if (!options_.judgePictures) return std::nullopt;
    auto shown = judgePictures(plate_.composition, plate_.toolpath(), run_);
    if (!shown) return shown.error();
    plate_.shown = std::move(shown).value();
    return std::nullopt;
  }

  Plate& plate_;
  const ReadInput& read_;
  const PlateOptions& options_;
  const RunContext& run_;
  PartsProgress parts_;
};

LayersTold layersTold(const Plate& plate) {
  return toldOf(plate.composition.layers.placed, plate.seenLayers, plate.input.shape.page,
                plate.project.toolpath.spacing);
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
  const std::vector<InputNote> more = layersTold(*this).notes;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::vector<Warning> Plate::warnings() const {
  std::vector<PictureMeasures> measured;  // measures of the pictures of the lowest layer
  for (std::size_t k = 0; k < std::min(shown.size(), pictures().shown.size()); ++k) {
    measured.push_back(shown[k].measures);
  }
  std::vector<Warning> all = plateWarnings(input.shape.drawing, result.apart, pictureFacts(pictures(), measured),
                                           measures, input.shape.page, result.toolpath.spacing);
  const std::vector<Warning> more = layersTold(*this).warnings;
  all.insert(all.end(), more.begin(), more.end());
  if (gcode) all.insert(all.end(), gcode->warnings.begin(), gcode->warnings.end());
  return all;
}

Report Plate::report() const {
  Report out = reportOf(result, measures);
  out.threads = threads;
  for (const JudgedPicture& picture : shown) {
    out.pictures.push_back({picture.layer, picture.file, picture.lamp, picture.measures});
  }
  out.layers = seenLayers;
  out.fromGcode = judgedByGcode;
  if (gcode) out.print = {gcode->seconds, gcode->filamentMm, gcode->filamentGrams};
  out.delay = delay;
  out.notes = notes();
  out.warnings = warnings();
  return out;
}

}  // namespace sillon
