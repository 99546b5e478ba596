// The stages in order (Alg. 1), in three steps: fields of the shape, the path, and the widths of its beads.
#pragma once

#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/stages.hpp"
#include "sillon/pipeline/pipeline.hpp"

namespace sillon {

/// Times stages and tells the run where in the job they lie.
class StageClock {
 public:
  explicit StageClock(const RunContext& run) : run_(run) { run.beginJob(); }

  /// \param end  share of the job done when this stage is; measured on plates of a million cells.
  void start(const char* stage, double end) {
    stop();
    run_.beginStage(stage, done_, end);
    done_ = end;
    stage_ = stage;
    begin_ = std::chrono::steady_clock::now();
  }
  void stop() {
    if (stage_ == nullptr) return;
    times_.push_back({stage_, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count()});
    stage_ = nullptr;
  }
  /// The times of all stages until now, in order.
  std::vector<StageTime> takeTimes() {
    stop();
    return std::move(times_);
  }

 private:
  const RunContext& run_;
  std::vector<StageTime> times_;
  const char* stage_ = nullptr;
  double done_ = 0;
  std::chrono::steady_clock::time_point begin_;
};

/// Copies what the stages make into `Stages`, if somebody asked for them (generateStages).
class Recorder {
 public:
  explicit Recorder(Stages* stages = nullptr) : stages_(stages) {}

  template <class T>
  void operator()(T Stages::*field, const T& made) const {
    if (stages_ != nullptr) stages_->*field = made;
  }

 private:
  Stages* stages_;
};

/// Everything that a step is given besides the results of those before it.
struct Making {
  const ToolpathParams& params;
  const RunContext& run;
  StageClock* clock = nullptr;  ///< null: stages are neither timed nor reported
  Recorder record = Recorder();

  void start(const char* stage, double end) const {
    if (clock != nullptr) clock->start(stage, end);
  }
  void stop() const {
    if (clock != nullptr) clock->stop();
  }
};

/// Fields that only the shape, the spacing and the bridge decide.
struct ShapeFields {
  BorderIndex border;
  SignedDistanceField sdf;
  Parts parts;
};

/// The waves whose zeros are the beads.
struct WaveFields {
  CellConstraints cells;  ///< without the map's lines: they are in `lines` now
  LineField lines;
  SineField waves;
};

/// The path before its widths.
struct RelaxedPath {
  Relaxed relaxed;
  ToolpathResult seen;  ///< without a toolpath: what was seen on the way
};

/// The lines that the beads follow.
enum class BeadLines {
  Asked,   ///< those that the maps ask for
  Across,  ///< at right angles to those, except along the border
};

struct PathOptions {
  BeadLines lines = BeadLines::Asked;
  bool countDislocations = false;
};

/// \return TooLarge, EmptyShape or Cancelled.
Result<ShapeFields> shapeStep(const Shape& shape, const Making& making);

/// The first part of pathStep. \return Cancelled.
Result<WaveFields> waveStep(const PlateInput& input, const SignedDistanceField& sdf, BeadLines which,
                            const Making& making);

/// \return EmptyShape, TooLarge or Cancelled.
Result<RelaxedPath> pathStep(const PlateInput& input, const ShapeFields& shape, const PathOptions& options,
                             const Making& making);

/// \return Cancelled.
Result<ToolpathResult> widthStep(const RelaxedPath& path, const BorderIndex& border, const Making& making);

/// The clock stands still meanwhile: this is not a stage. \return Cancelled.
Result<Dislocations> dislocationStep(const WaveFields& waves, const SignedDistanceField& sdf, const Making& making);

/// InvalidArgument if the parameters, the page or the maps are out of range. resolveOutline judges the shape's points.
std::optional<Error> wrongInput(const PlateInput& input, const ToolpathParams& params);

}  // namespace sillon
