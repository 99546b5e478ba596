// The stages in order (Alg. 1), in three steps: fields of the shape, the path, and the widths of its beads.
#pragma once

#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/stages.hpp"
#include "sillon/pipeline/pipeline.hpp"

namespace sillon {

/// Times the stages, and reports the share of the job that each one covers.
class StageClock {
 public:
  explicit StageClock(const RunContext& run) : run_(run) { run.beginJob(); }

  /// \param end  share of the job that is done at the end of this stage; measured on plates of a million cells.
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
  /// Times of all stages so far, in order.
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

/// Copies the results of the stages into `Stages`, if they are wanted (generateStages).
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

/// The input of every step besides the results of earlier steps.
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

/// Fields that depend on the shape, the spacing and the bridge only.
struct ShapeFields {
  BorderIndex border;
  SignedDistanceField sdf;
  Parts parts;
};

/// The waves whose zeros are the beads.
struct WaveFields {
  CellConstraints cells;  ///< constraints without the map's lines, which are in `lines` now
  LineField lines;
  SineField waves;
};

/// The path before its widths.
struct RelaxedPath {
  Relaxed relaxed;
  ToolpathResult seen;  ///< result without a toolpath: the figures collected so far
};

/// The lines that the beads follow.
enum class BeadLines {
  Asked,   ///< lines that the maps ask for
  Across,  ///< lines at right angles to those, except along the border
};

/// Options of a path.
struct PathOptions {
  BeadLines lines = BeadLines::Asked;
  bool countDislocations = false;
};

/// Makes outline, distances and parts of a shape (Sec. 4). \return TooLarge, EmptyShape or Cancelled.
Result<ShapeFields> shapeStep(const Shape& shape, const Making& making);

/// Makes the lines and waves, the first part of pathStep. \return Cancelled.
Result<WaveFields> waveStep(const PlateInput& input, const SignedDistanceField& sdf, BeadLines which,
                            const Making& making);

/// Makes the path of a plate before its widths. \return EmptyShape, TooLarge or Cancelled.
Result<RelaxedPath> pathStep(const PlateInput& input, const ShapeFields& shape, const PathOptions& options,
                             const Making& making);

/// Gives a path its widths and simplifies it. \return Cancelled.
Result<ToolpathResult> widthStep(const RelaxedPath& path, const BorderIndex& border, const Making& making);

/// Counts the dislocations of the waves. The clock is stopped meanwhile, because this is not a stage.
/// \return Cancelled.
Result<Dislocations> dislocationStep(const WaveFields& waves, const SignedDistanceField& sdf, const Making& making);

/// Checks parameters, page and maps. \return InvalidArgument if any is out of range. The shape's points are left to
/// resolveOutline.
std::optional<Error> wrongInput(const PlateInput& input, const ToolpathParams& params);

}  // namespace sillon
