#include "sillon/rebrush/rebrush.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel_for.hpp"
#include "base/refused.hpp"
#include "gcode_reader/file_settings.hpp"
#include "gcode_reader/machine.hpp"
#include "gcode_reader/parser.hpp"
#include "rebrush/blocks.hpp"

namespace sillon {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kFinest = 0.05;   // [mm] least side of a cell
constexpr double kMargin = 1;      // [mm] margin around everything that is higher than the first layer
constexpr double kFarthest = 1e4;  // [mm] coordinate that no bed reaches
constexpr double kRound = 0.35;    // share of its height by which a bead falls towards its sides
constexpr float kWidest = 3;       // [mm] largest width of a bead: more is a lump of a purge

struct HighBead {
  Vec2f from;
  Vec2f to;
  float width = 0;
  float top = 0;
  float height = 0;
};

// Hands over all beads of a file, in its order. None is kept: together they would be as large as the text.
class BeadReader {
 public:
  BeadReader(const FileSettings& settings, std::function<void(const HighBead&)> take)
      : take_(std::move(take)),
        machine_(settings.flavor),
        area_(settings.volumetric ? 1 : kPi * settings.filamentDiameter * settings.filamentDiameter / 4) {}

  // Reads one line, and hands over the bead that it lays, if any, with the width that its plastic has.
  void line(const GcodeLine& line) {
    const GcodeParts parts = partsOf(line.text);
    if (parts.code.empty()) {
      if (parts.comment.empty()) return;
      const Mark mark = readMark(parts.comment);
      if (mark.kind == MarkKind::Layer) {
        begun = true;
        below_ = z_;
      }
      if (mark.kind == MarkKind::Height) told_ = mark.value;
      return;
    }
    const GcodeCommand command = commandOf(parts.code);
    const auto move = runCommand(machine_, command, readsWords(command) ? wordsOf(command.rest) : GcodeWords{});
    if (!begun || !move || !(move->e > 0) || !(move->length > 0)) return;
    const double farthest = std::max({std::abs(move->from.x), std::abs(move->from.y), std::abs(move->to.x),
                                      std::abs(move->to.y), std::abs(move->z), move->length});
    if (!(farthest < kFarthest)) {
      beyond = true;
      return;
    }
    z_ = move->z;
    const double height = std::clamp(told_ > 0 ? told_ : z_ - below_, 0.02, 2.0);
    const double section = move->e * area_ / move->length;
    const double width = std::clamp(section / height + (1 - kPi / 4) * height, 0.05, double{kWidest});
    add(*move, static_cast<float>(width), static_cast<float>(height));
  }

  bool begun = false;   // true once a layer was marked
  bool beyond = false;  // true once a bead lies where no bed reaches

 private:
  std::function<void(const HighBead&)> take_;

  // Hands over a move's bead; an arc becomes straight pieces.
  void add(const MachineMove& move, float width, float height) {
    const auto single = [](Vec2 p) { return Vec2f{static_cast<float>(p.x), static_cast<float>(p.y)}; };
    const auto top = static_cast<float>(move.z);
    if (!move.arc || !move.readable) {
      take_({single(move.from), single(move.to), width, top, height});
      return;
    }
    const int pieces = std::clamp(static_cast<int>(std::abs(move.turn) * 8) + 1, 1, 64);
    Vec2 last = move.from;
    for (int k = 1; k <= pieces; ++k) {
      const Vec2 p = onArc(move, static_cast<double>(k) / pieces);
      take_({single(last), single(p), width, top, height});
      last = p;
    }
  }

  MachineState machine_;
  double area_;
  double z_ = 0;      // height of the last bead [mm]
  double below_ = 0;  // height of the layer below [mm]
  double told_ = 0;   // layer height of the last mark [mm]; 0: none
};

// Box around all beads, cut to a margin around those above the lowest ones: purge lines, skirts and brims fall away.
class BeadsBox {
 public:
  void add(const HighBead& bead) {
    if (bead.top < first_) {
      higher_ = whole_;
      first_ = bead.top;
    }
    for (Bounds* box : {&whole_, bead.top > first_ ? &higher_ : nullptr}) {
      if (box == nullptr) continue;
      box->add({bead.from.x, bead.from.y});
      box->add({bead.to.x, bead.to.y});
    }
  }
  [[nodiscard]] bool empty() const { return whole_.empty(); }
  [[nodiscard]] Bounds trimmed() const {
    if (higher_.empty()) return whole_;
    Bounds box;
    box.add({std::max(whole_.min.x, higher_.min.x - kMargin), std::max(whole_.min.y, higher_.min.y - kMargin)});
    box.add({std::min(whole_.max.x, higher_.max.x + kMargin), std::min(whole_.max.y, higher_.max.y + kMargin)});
    return box;
  }

 private:
  Bounds whole_;
  Bounds higher_;
  float first_ = std::numeric_limits<float>::infinity();  // height of the lowest bead so far [mm]
};

// Draws a bead in steps along its longer axis, with one line of cells across it at each step: a bead costs few cells,
// whatever its direction.
void draw(const HighBead& bead, PrintRelief& relief) {
  const auto toCells = [&](Vec2f p) {
    return Vec2{(static_cast<double>(p.x) - relief.corner.x) / relief.cell - 0.5,
                relief.rows - 0.5 - (static_cast<double>(p.y) - relief.corner.y) / relief.cell};
  };
  Vec2 a = toCells(bead.from);
  Vec2 b = toCells(bead.to);
  const bool steep = std::abs(b.y - a.y) > std::abs(b.x - a.x);
  if (steep) {
    std::swap(a.x, a.y);
    std::swap(b.x, b.y);
  }
  if (a.x > b.x) std::swap(a, b);
  const double run = b.x - a.x;
  const double rise = run > 0 ? (b.y - a.y) / run : 0;
  const double half = 0.5 * static_cast<double>(bead.width) / relief.cell;
  const double across = half * std::sqrt(1 + rise * rise);  // half width of the bead along a line of cells [cells]
  const double end = half / std::sqrt(1 + rise * rise);
  const int most = (steep ? relief.rows : relief.columns) - 1;
  const int widest = (steep ? relief.columns : relief.rows) - 1;
  const int from = static_cast<int>(std::ceil(std::clamp(a.x - end, 0.0, most + 1.0)));
  const int to = static_cast<int>(std::floor(std::clamp(b.x + end, -1.0, static_cast<double>(most))));
  for (int u = from; u <= to; ++u) {
    const double middle = a.y + (u - a.x) * rise;
    const int low = static_cast<int>(std::ceil(std::clamp(middle - across, 0.0, widest + 1.0)));
    const int high = static_cast<int>(std::floor(std::clamp(middle + across, -1.0, static_cast<double>(widest))));
    for (int v = low; v <= high; ++v) {
      const double aside = (v - middle) / across;
      const auto z =
          static_cast<float>(static_cast<double>(bead.top) - kRound * static_cast<double>(bead.height) * aside * aside);
      const std::size_t row = steep ? u : v;
      const std::size_t column = steep ? v : u;
      float& height = relief.heights[row * relief.columns + column];
      height = std::max(height, z);
    }
  }
}

}  // namespace

Result<PrintRelief> printRelief(std::string_view gcode, int side, const RunContext& run) {
  if (side < 16 || side > 4096) return outOfRange("side", side, 16, 4096, "");
  const FileSettings settings = readFileSettings(gcode, {});
  BeadsBox around;
  BeadReader beads(settings, [&](const HighBead& bead) { around.add(bead); });
  run.beginJob();
  run.beginStage("reading", 0, 0.5);
  if (!forEachLine(gcode, run, [&](const GcodeLine& line) { beads.line(line); })) {
    return cancelledRun();
  }
  if (beads.beyond) return refusedFile("MoveTooFar", {{"most", 10000}});
  if (around.empty()) return refusedFile(beads.begun ? Reason("NoBeads") : Reason("NoLayers"));
  const Bounds box = around.trimmed();
  const Vec2 room{static_cast<double>(kWidest) / 2, static_cast<double>(kWidest) / 2};
  const Vec2 size = box.size() + 2 * room;
  PrintRelief relief;
  relief.corner = box.min - room;
  relief.cell = std::max(kFinest, std::max(size.x, size.y) / side);
  relief.columns = std::clamp(static_cast<int>(std::ceil(size.x / relief.cell)), 1, side);
  relief.rows = std::clamp(static_cast<int>(std::ceil(size.y / relief.cell)), 1, side);
  relief.heights.assign(cellCount(relief.columns, relief.rows), 0);
  BeadReader again(settings, [&](const HighBead& bead) { draw(bead, relief); });
  run.beginStage("drawing", 0.5, 1);
  if (!forEachLine(gcode, run, [&](const GcodeLine& line) { again.line(line); })) {
    return cancelledRun();
  }
  return relief;
}

}  // namespace sillon
