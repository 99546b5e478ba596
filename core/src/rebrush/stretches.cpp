#include "rebrush/stretches.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "base/parallel_for.hpp"
#include "base/refused.hpp"
#include "gcode_reader/parser.hpp"

namespace sillon {
namespace {

constexpr double kLongBead = 1;    // [mm] least length of a bead whose feed counts, because E is rounded
constexpr double kLongTravel = 1;  // [mm] Shorter moves do not count as travels, because they may be wipes.
// A stretch holds at most this many lines, to bound memory. Later lines are left out of it, and stay in the file as the
// slicer wrote them.
constexpr std::size_t kMostLines = 5'000'000;

// Removes the byte order mark that editors and shells of Windows write.
std::string_view withoutByteOrderMark(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

// Tells whether the beads of a role can belong to a surface whose directions are replaced.
bool isSurface(RoleKind role) {
  return role != RoleKind::Other && role != RoleKind::Ironing && role != RoleKind::Purge;
}

// Follows layers and roles by their marks and the machine by its commands, and hands over events.
class EventReader {
 public:
  EventReader(const FileSettings& settings, const std::function<void(SlicedEvent)>& visit)
      : settings_(settings), visit_(visit), machine_(settings.flavor) {
    facts_.filamentArea = std::numbers::pi * settings.filamentDiameter * settings.filamentDiameter / 4;
  }

  void line(const GcodeLine& line);
  Result<SlicedFacts> finish();

 private:
  void mark(const Mark& mark);
  void beginLayer(std::string_view name);
  void beginOnBed();
  void takeRole();
  void endStretch();
  void laid(const MachineMove& move);
  [[nodiscard]] bool byCura() const { return program_ && program_->slicer == Slicer::Cura; }

  const FileSettings& settings_;
  const std::function<void(SlicedEvent)>& visit_;
  SlicedFacts facts_;
  MachineState machine_;
  double acceleration_ = 1000;  // [mm/s²] usual value, for files that set none
  bool changesTool_ = false;
  bool numbered_ = false;
  std::optional<Program> program_;
  bool marked_ = false;  // true once a role was marked
  bool pushed_ = false;  // true once a bead was laid

  RoleKind told_ = RoleKind::Other;  // role of the last mark
  RoleKind role_ = RoleKind::Other;  // role that is in force; solid infill and bottoms count only in layers on the bed
  bool onBed_ = false;
  std::optional<double> firstZ_;  // Z of the first layer, if a mark gives it [mm]
  std::string firstLayer_;        // text of the first layer's mark
  double layerZ_ = 0;
  double previousZ_ = 0;
  std::optional<double> height_;
  double travelSpeed_ = 0;
  std::string object_;
  std::vector<StretchLine> lines_;
};

// Reads one line: its mark or command, and its place in a stretch if its role may be a surface.
void EventReader::line(const GcodeLine& line) {
  facts_.file.lines = line.number;
  const GcodeParts parts = partsOf(line.offset == 0 ? withoutByteOrderMark(line.text) : line.text);
  numbered_ = numbered_ || parts.numbered;
  changesTool_ = toolChangeMark(parts).value_or(changesTool_);
  if (parts.code.empty()) {
    if (parts.comment.empty()) return;
    if (!program_) program_ = programOf(parts.comment);
    mark(readMark(parts.comment));
  } else if (const auto object = objectOf(parts.code)) {
    object_ = *object;
  }
  const bool collecting = isSurface(role_) && lines_.size() < kMostLines;
  StretchLine entry;
  if (collecting) {
    entry.begin = line.offset;
    entry.end = line.offset + line.text.size() + line.end.size();
    entry.number = line.number;
    entry.before = machine_;
    entry.acceleration = acceleration_;
    entry.object = object_;
  }
  std::optional<MachineMove> move;
  if (!parts.code.empty()) {
    const GcodeCommand command = commandOf(parts.code);
    if (const double other = accelerationOf(parts.code); other > 0) acceleration_ = other;
    move = runCommand(machine_, command, readsWords(command) ? wordsOf(command.rest) : GcodeWords{});
  }
  if (move && move->e > 0 && move->length > 0) {
    laid(*move);
  } else if (move && move->xy && move->length > kLongTravel) {
    travelSpeed_ = machine_.speed;
  }
  if (!collecting) return;
  entry.move = move;
  entry.after = machine_;
  lines_.push_back(std::move(entry));
}

// Notes a bead: its height, and its feed if that counts towards the tool's largest one.
void EventReader::laid(const MachineMove& move) {
  layerZ_ = move.z;
  pushed_ = true;
  if (facts_.file.layers > 0 && role_ != RoleKind::Purge && !changesTool_ && move.length > kLongBead) {
    double& most = facts_.mostFeed[machine_.tool];
    most = std::max(most, move.e / move.length * machine_.speed);
  }
  if (byCura()) visit_(BeadLaid{move.from, move.to});
}

// Follows a mark: layers and roles end the stretch so far.
void EventReader::mark(const Mark& mark) {
  switch (mark.kind) {
    case MarkKind::Layer:
      endStretch();
      beginLayer(mark.name);
      return;
    case MarkKind::Z:
      if (facts_.file.layers == 1) firstZ_ = mark.value;
      if (firstZ_ && mark.value <= *firstZ_) beginOnBed();
      return;
    case MarkKind::Role:
      marked_ = true;
      endStretch();
      told_ = mark.role;
      takeRole();
      if (role_ == RoleKind::Ironing) visit_(LayerIroned{});
      return;
    case MarkKind::Height:
      height_ = mark.value;
      return;
    case MarkKind::Object:
      object_ = std::string(mark.name.substr(0, 80));
      return;
    case MarkKind::None:
    case MarkKind::Width:
      return;
  }
}

// Begins a layer. Cura marks the role anew in each layer, the other slicers only where it changes.
void EventReader::beginLayer(std::string_view name) {
  if (byCura()) told_ = RoleKind::Other;
  visit_(LayerBegins{});
  ++facts_.file.layers;
  previousZ_ = layerZ_;
  onBed_ = false;
  if (facts_.file.layers == 1) firstLayer_ = std::string(name);
  if (facts_.file.layers == 1 || (byCura() && name == firstLayer_)) beginOnBed();
  takeRole();
}

// Notes that the layer lies on the bed.
void EventReader::beginOnBed() {
  onBed_ = true;
  previousZ_ = 0;
  takeRole();
}

// Takes the role of the last mark; solid infill and bottoms count only on the bed.
void EventReader::takeRole() {
  const bool ofBottoms = told_ == RoleKind::FirstSolid || told_ == RoleKind::Bottom;
  role_ = ofBottoms && !onBed_ ? RoleKind::Other : told_;
}

// Hands over the lines so far, up to the last bead, as one stretch.
void EventReader::endStretch() {
  Stretch stretch;
  stretch.lines = std::move(lines_);
  lines_.clear();
  while (!stretch.lines.empty() && !stretch.lines.back().bead()) stretch.lines.pop_back();
  if (stretch.lines.empty()) return;
  stretch.role = role_;
  stretch.layer = facts_.file.layers;
  stretch.onBed = onBed_;
  stretch.byCura = byCura();
  stretch.height = height_;
  stretch.previousZ = previousZ_;
  stretch.travelSpeed = travelSpeed_;
  stretch.filamentArea = facts_.filamentArea;
  stretch.volumetric = settings_.volumetric;
  visit_(std::move(stretch));
}

// Ends the last stretch, and refuses files whose surfaces cannot be found or replaced.
Result<SlicedFacts> EventReader::finish() {
  facts_.cut = isSurface(role_) && !lines_.empty() && lines_.back().bead();
  endStretch();
  if (numbered_) return refusedFile("LinesNumbered");
  if (!program_ || !marked_ || facts_.file.layers == 0) return refusedFile("NoMarks");
  if (settings_.weighed.evidence == FilamentEvidence::Open) return askForFilament(settings_.weighed);
  if (!pushed_) return refusedFile("NoFilament");
  facts_.file.slicer = program_->slicer;
  facts_.file.program = program_->name;
  if (settings_.nozzle > 0) facts_.file.nozzle = settings_.nozzle;
  return std::move(facts_);
}

}  // namespace

double Stretch::heightAt(double z) const { return height.value_or(std::max(0.0, z - previousZ)); }

Result<SlicedFacts> readEvents(std::string_view gcode, const FileSettings& settings,
                               const std::function<void(SlicedEvent)>& visit, const RunContext& run) {
  if (gcode.starts_with("GCDE")) return refusedFile("BinaryGcode");
  EventReader reader(settings, visit);
  run.beginStage("reading", 0, 1);
  if (!forEachLine(gcode, run, [&](const GcodeLine& line) { reader.line(line); })) return cancelledRun();
  return reader.finish();
}

}  // namespace sillon
