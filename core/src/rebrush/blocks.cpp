#include "rebrush/blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

#include "base/numbers.hpp"
#include "base/parallel_for.hpp"
#include "base/sort_key.hpp"
#include "gcode_reader/machine.hpp"
#include "gcode_reader/parser.hpp"
#include "rebrush/region.hpp"
#include "sillon/geometry/outline.hpp"

namespace sillon {
namespace {

constexpr double kThreeBeads = 3;              // narrower surfaces are left [spacings]
constexpr double kTenSquares = 10;             // smaller surfaces are left [spacings²]
constexpr double kNotch = 0.3;                 // [spacings], between the ends of beads: narrower than walls
constexpr double kLooseFilament = 0.02;        // [mm] that retractions inside a block may gain or lose
constexpr double kShortWipe = 1;               // [mm] without plastic behind the last bead
constexpr double kLongBead = 1;                // [mm], shorter beads tell no flow: E is rounded
constexpr double kLongTravel = 1;              // [mm], shorter ones may be wipes
constexpr double kFullFlow = 0.01;             // by which flow may differ from 1 before it counts as set so
constexpr double kMostFlow = 0.25;             // by which a slicer's flow may differ from 1
constexpr double kJoined = 0.01;               // [mm] between the end of a bead and the beginning of the next
constexpr double kFlatEnds = 0.01;             // of a region that plastic does not fill, if its beads end at its edge
constexpr int kLookAhead = 500;                // lines after a block
constexpr std::size_t kMostItems = 5'000'000;  // lines of one stretch

// A line within a stretch of one role.
struct Item {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::int64_t number = 0;
  std::optional<MachineMove> move;
  MachineState before;
  MachineState after;
  std::string object;
  double acceleration = 0;

  [[nodiscard]] bool bead() const { return move && move->e > 0 && move->length > 0; }
};

// Editors and shells of Windows write one.
std::string_view withoutByteOrderMark(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

double median(std::vector<std::pair<double, double>> valueAndWeight) {
  std::sort(valueAndWeight.begin(), valueAndWeight.end());
  double all = 0;
  for (const auto& entry : valueAndWeight) all += entry.second;
  double sum = 0;
  for (const auto& [value, weight] : valueAndWeight) {
    sum += weight;
    if (2 * sum >= all) return value;
  }
  return 0;
}

// Between neighbouring straight beads: half of them lie closer [mm]. 0: there are too few.
double neighbourDistance(const std::vector<Item>& items) {
  constexpr double kLong = 2;         // [mm]
  constexpr double kParallel = 0.02;  // sine
  constexpr std::size_t kEnough = 8;
  std::vector<std::pair<double, double>> distances;
  const MachineMove* last = nullptr;
  for (const Item& item : items) {
    if (!item.bead() || item.move->arc || item.move->length < kLong) continue;
    const Vec2 d = 1 / item.move->length * (item.move->to - item.move->from);
    if (last != nullptr && std::abs(cross(d, last->to - last->from)) < kParallel * last->length) {
      distances.emplace_back(std::abs(cross(d, last->from - item.move->from)), 1.0);
    }
    last = &*item.move;
  }
  return distances.size() < kEnough ? 0 : median(std::move(distances));
}

bool isSurface(RoleKind role) {
  return role != RoleKind::Other && role != RoleKind::Ironing && role != RoleKind::Purge;
}

bool joined(Vec2 a, Vec2 b) { return length(a - b) < kJoined; }

// Whether most beads are followed by a way without plastic.
bool areSeparate(const std::vector<RegionBead>& beads) {
  std::size_t gaps = 1;
  for (std::size_t k = 1; k < beads.size(); ++k) gaps += joined(beads[k - 1].to, beads[k].from) ? 0 : 1;
  return 2 * gaps > beads.size();
}

// Cuts beads back by half their width where no other bead goes on: OrcaSlicer and Bambu Studio end separate lines at
// the edge of the surface, others half a bead before it.
std::vector<RegionBead> withFlatEnds(std::vector<RegionBead> beads) {
  for (std::size_t first = 0; first < beads.size();) {
    std::size_t last = first;
    while (last + 1 < beads.size() && joined(beads[last].to, beads[last + 1].from)) ++last;
    const auto cut = [](Vec2& end, Vec2 other, double width) {
      const double size = length(end - other);
      if (size > 0) end = end + std::min(width / 2, 0.49 * size) / size * (other - end);
    };
    if (!joined(beads[first].from, beads[last].to)) {
      const RegionBead head = beads[first];
      cut(beads[first].from, head.to, head.width);
      cut(beads[last].to, beads[last].from, beads[last].width);
    }
    first = last + 1;
  }
  return beads;
}

double areaOf(const RegionField& field) {
  const auto inside = std::count_if(field.part.begin(), field.part.end(), [](std::int32_t part) { return part >= 0; });
  return static_cast<double>(inside) * field.cell * field.cell;
}

class Reader {
 public:
  Reader(std::string_view text, const FileSettings& settings) : text_(text), machine_(settings.flavor) {
    area_ = std::numbers::pi * settings.filamentDiameter * settings.filamentDiameter / 4;
    volumetric_ = settings.volumetric;
    out_.settings = settings;
  }

  void line(const GcodeLine& line);
  Result<SlicedBlocks> finish();

 private:
  void mark(const Mark& mark);
  void beginLayer(std::string_view name);
  void beginOnBed();
  void endSkins();
  void endStretch();
  void addPart(const std::vector<Item>& items, const std::shared_ptr<const RegionField>& shared, int part,
               double breadth, double width, double flow, const std::vector<int>& partOf);
  void keep(SurfaceBlock& block, const Item& item, std::map<std::string, std::size_t>& places) const;
  void lookAhead(SurfaceBlock& block) const;
  void takeRole();
  [[nodiscard]] bool byCura() const { return program_ && program_->slicer == Slicer::Cura; }
  [[nodiscard]] double beadSection(const MachineMove& move) const {
    return move.e * (volumetric_ ? 1 : area_) / move.length;
  }
  [[nodiscard]] std::string_view lineOf(const Item& item) const {
    std::string_view line = text_.substr(item.begin, item.end - item.begin);
    while (line.ends_with('\n') || line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }
  void leave(SurfaceBlock& block, LeftBecause why) const {
    if (block.surface.left == LeftBecause::None) block.surface.left = why;
  }

  std::string_view text_;
  MachineState machine_;
  double acceleration_ = 1000;  // [mm/s²], of most printers that say nothing
  double area_ = 0;
  bool volumetric_ = false;
  std::map<int, double> mostFeed_;  // of each tool's beads [mm of filament / s]
  bool changesTool_ = false;
  bool numbered_ = false;
  SlicedBlocks out_;
  std::optional<Program> program_;
  bool marked_ = false;  // any role

  RoleKind told_ = RoleKind::Other;  // by the last mark
  RoleKind role_ = RoleKind::Other;  // what counts of it in this layer
  bool onBed_ = false;               // this layer lies on the bed; of objects printed one by one, each has such a layer
  std::optional<double> firstZ_;     // as a mark tells it
  std::string firstLayer_;           // the mark of Cura
  double travelSpeed_ = 0;           // of the last travel [mm/s]
  bool pushed_ = false;              // any bead
  double height_ = 0;
  double layerZ_ = 0;
  double previousZ_ = 0;
  bool heightTold_ = false;
  std::string object_;
  std::vector<Item> items_;
  Skins skins_;
  std::size_t layerBegin_ = 0;  // its first block
};

void Reader::line(const GcodeLine& line) {
  out_.file.lines = line.number;
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
  const bool collecting = isSurface(role_);
  Item item;
  if (collecting) {
    item.begin = line.offset;
    item.end = line.offset + line.text.size() + line.end.size();
    item.number = line.number;
    item.before = machine_;
    item.acceleration = acceleration_;
    item.object = object_;
  }
  std::optional<MachineMove> move;
  if (!parts.code.empty()) {
    const GcodeCommand command = commandOf(parts.code);
    if (const double other = accelerationOf(parts.code); other > 0) acceleration_ = other;
    move = runCommand(machine_, command, readsWords(command) ? wordsOf(command.rest) : GcodeWords{});
  }
  if (move && move->e > 0 && move->length > 0) {
    layerZ_ = move->z;
    if (out_.file.layers > 0 && role_ != RoleKind::Purge && !changesTool_ && move->length > kLongBead) {
      double& most = mostFeed_[machine_.tool];
      most = std::max(most, move->e / move->length * machine_.speed);
    }
    if (byCura()) skins_.bead(move->from, move->to);
    pushed_ = true;
  } else if (move && move->xy && move->length > kLongTravel) {
    travelSpeed_ = machine_.speed;
  }
  if (collecting && items_.size() < kMostItems) {
    item.move = move;
    item.after = machine_;
    items_.push_back(std::move(item));
  }
}

void Reader::mark(const Mark& mark) {
  switch (mark.kind) {
    case MarkKind::Layer:
      endStretch();
      beginLayer(mark.name);
      return;
    case MarkKind::Z:
      if (out_.file.layers == 1) firstZ_ = mark.value;
      if (firstZ_ && mark.value <= *firstZ_) beginOnBed();
      return;
    case MarkKind::Role:
      marked_ = true;
      endStretch();
      told_ = mark.role;
      takeRole();
      if (role_ == RoleKind::Ironing) {
        for (std::size_t k = layerBegin_; k < out_.blocks.size(); ++k) leave(out_.blocks[k], LeftBecause::Ironed);
      }
      return;
    case MarkKind::Height:
      height_ = mark.value;
      heightTold_ = true;
      return;
    case MarkKind::Object:
      object_ = std::string(mark.name.substr(0, 80));
      return;
    case MarkKind::None:
    case MarkKind::Width:
      return;
  }
}

// Cura tells the role anew in each layer, the others where it changes.
void Reader::beginLayer(std::string_view name) {
  if (byCura()) told_ = RoleKind::Other;
  endSkins();
  ++out_.file.layers;
  layerBegin_ = out_.blocks.size();
  previousZ_ = layerZ_;
  onBed_ = false;
  if (out_.file.layers == 1) firstLayer_ = std::string(name);
  if (out_.file.layers == 1 || (byCura() && name == firstLayer_)) beginOnBed();
  takeRole();
}

void Reader::beginOnBed() {
  onBed_ = true;
  previousZ_ = 0;
  takeRole();
}

void Reader::takeRole() {
  const bool ofBottoms = told_ == RoleKind::FirstSolid || told_ == RoleKind::Bottom;
  role_ = ofBottoms && !onBed_ ? RoleKind::Other : told_;
}

void Reader::endSkins() {
  for (SurfaceBlock& top : skins_.endLayer()) out_.blocks.push_back(std::move(top));
}

// Splits a stretch of one role into connected surfaces.
void Reader::endStretch() {
  std::vector<Item> items = std::move(items_);
  items_.clear();
  while (!items.empty() && !items.back().bead()) items.pop_back();
  if (items.empty()) return;
  const double z = items.back().move->z;
  const double height = heightTold_ ? height_ : std::max(0.0, z - previousZ_);
  if (!(height > 0.01 && height < 5)) return;

  std::vector<std::pair<double, double>> sections;
  for (const Item& item : items) {
    if (item.bead()) sections.emplace_back(beadSection(*item.move), item.move->length);
  }
  // Beads are rectangles with round sides: their section is h (w - h) + pi h²/4. Cura reckons with plain rectangles.
  const double rounding = byCura() ? 0 : (1 - std::numbers::pi / 4) * height;
  const double told = median(std::move(sections)) / height;
  // A flow ratio other than 1 makes beads thinner than their distance: the filament is known to need that.
  const double distance = neighbourDistance(items);
  double flow = distance > 0.05 ? told / distance : 1;
  if (std::abs(flow - 1) <= kFullFlow || std::abs(flow - 1) > kMostFlow) flow = 1;
  const double spacing = told / flow;
  // Cura irons under the same mark.
  if (role_ == RoleKind::Skin && spacing <= 0.05) {
    skins_.leave(LeftBecause::Ironed);
    for (std::size_t k = layerBegin_; k < out_.blocks.size(); ++k) leave(out_.blocks[k], LeftBecause::Ironed);
  }
  if (!(spacing > 0.05 && spacing < 5)) return;
  const double width = spacing + rounding;
  std::vector<RegionBead> beads;
  std::vector<Vec2> middles(items.size());  // of beads
  double filled = 0;                        // [mm²]
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (!items[k].bead()) continue;
    const MachineMove& move = *items[k].move;
    const double own = std::clamp(beadSection(move) / height / flow + rounding, 0.5 * width, 1.5 * width);
    middles[k] = 0.5 * (move.from + move.to);
    filled += beadSection(move) * move.length / height / flow;
    if (!move.arc || !move.readable) {
      beads.push_back({move.from, move.to, own});
      continue;
    }
    const int pieces = std::clamp(static_cast<int>(std::abs(move.turn) * 8) + 1, 1, 64);
    Vec2 last = move.from;
    for (int piece = 1; piece <= pieces; ++piece) {
      const Vec2 p = piece == pieces ? move.to : onArc(move, static_cast<double>(piece) / pieces);
      beads.push_back({last, p, own});
      last = p;
      if (piece == (pieces + 1) / 2) middles[k] = p;
    }
  }
  Result<RegionField> made = fieldOfBeads(beads, kNotch * spacing);
  if (!made) return;
  if (const double area = areaOf(made.value()); filled < (1 - kFlatEnds) * area && areSeparate(beads)) {
    Result<RegionField> flat = fieldOfBeads(withFlatEnds(std::move(beads)), kNotch * spacing);
    if (flat && std::abs(areaOf(flat.value()) - filled) < area - filled) made = std::move(flat);
  }
  const auto shared = std::make_shared<const RegionField>(std::move(made).value());
  const RegionField& field = *shared;
  const std::vector<float> depth = depths(field);
  const std::vector<double> breadth = breadths(field, depth);

  std::vector<int> partOf(items.size(), -1);
  std::vector<int> order;
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (!items[k].bead()) continue;
    const int cell = field.at(middles[k]);
    if (cell < 0) continue;
    const int part = field.part[cell];
    partOf[k] = part;
    if (std::find(order.begin(), order.end(), part) == order.end()) order.push_back(part);
  }
  for (const int part : order) {
    if (part >= 0) addPart(items, shared, part, breadth[part], width, flow, partOf);
  }
}

void Reader::addPart(const std::vector<Item>& items, const std::shared_ptr<const RegionField>& shared, int part,
                     double breadth, double width, double flow, const std::vector<int>& partOf) {
  const RegionField& field = *shared;
  std::size_t first = items.size();
  std::size_t last = 0;
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (partOf[k] != part) continue;
    first = std::min(first, k);
    last = k;
  }
  SurfaceBlock block;
  SlicedSurface& surface = block.surface;
  surface.side =
      role_ == RoleKind::Top || (role_ == RoleKind::Skin && !onBed_) ? SurfaceSide::Top : SurfaceSide::Bottom;
  surface.layer = out_.file.layers;
  surface.z = items[first].move->z;
  surface.height = heightTold_ ? height_ : std::max(0.0, surface.z - previousZ_);
  surface.object = items[first].object;
  surface.tool = items[first].before.tool;
  surface.width = width;
  surface.flow = flow;
  surface.entry = items[first].move->from;
  surface.exit = items[last].move->to;
  surface.firstLine = items[first].number;
  surface.lastLine = items[last].number;
  surface.begin = items[first].begin;
  surface.end = items[last].end;
  block.before = items[first].before;
  block.acceleration = items[first].acceleration;
  block.travelSpeed = travelSpeed_;
  block.after = items[last].after;
  block.lineEnd =
      text_.substr(items[first].begin, items[first].end - items[first].begin).ends_with("\r\n") ? "\r\n" : "\n";

  double laid = 0;
  double loose = 0;
  double length = 0;
  std::vector<std::pair<double, double>> speeds;
  std::map<std::string, std::size_t> places;
  for (std::size_t k = first; k <= last; ++k) {
    const Item& item = items[k];
    if (item.object != surface.object) leave(block, LeftBecause::Object);
    if (item.after.inches || !item.after.absolute || volumetric_ || item.after.volumetric)
      leave(block, LeftBecause::Modes);
    if (!item.move) {
      keep(block, item, places);
      continue;
    }
    if (item.move->arc && !item.move->readable) leave(block, LeftBecause::Modes);
    if (!item.bead()) {
      loose += item.move->e;
      continue;
    }
    if (partOf[k] != part) leave(block, LeftBecause::Interleaved);
    if (item.move->z != surface.z || item.move->zFrom != surface.z) leave(block, LeftBecause::Height);
    laid += item.move->e;
    length += item.move->length;
    speeds.emplace_back(item.after.speed, item.move->length);
  }
  surface.volumeMm3 = laid * (volumetric_ ? 1 : area_);
  surface.speed = median(std::move(speeds));
  surface.spacing = length > 0 ? width - (1 - std::numbers::pi / 4) * surface.height : 0;
  if (byCura()) surface.spacing = width;
  if (std::abs(loose) > kLooseFilament || block.after.firmwareRetracted != block.before.firmwareRetracted ||
      block.after.absoluteE != block.before.absoluteE || block.after.tool != block.before.tool ||
      !(block.before.origin == block.after.origin)) {
    leave(block, LeftBecause::Command);
  }
  Result<Shape> region = regionOf(field, part, 2 * width * width, surface.corner);
  if (!region) return;
  surface.region = std::move(region).value();
  const Result<Outline> outline = resolveOutline(surface.region);
  if (!outline) return;
  surface.areaMm2 = outline.value().area;
  if (breadth < kThreeBeads * surface.spacing) leave(block, LeftBecause::Narrow);
  if (surface.areaMm2 < kTenSquares * surface.spacing * surface.spacing) leave(block, LeftBecause::Small);
  const double fill = surface.volumeMm3 / (surface.areaMm2 * surface.height);
  if (!(fill > 0.8 && fill < 1.2)) leave(block, LeftBecause::Flow);
  lookAhead(block);
  if (role_ == RoleKind::Skin && surface.side == SurfaceSide::Top) {
    skins_.add(std::move(block), shared, part);
  } else {
    out_.blocks.push_back(std::move(block));
  }
}

// The commands that replace an earlier one altogether: of the same name, that set the same, for the same tool.
std::string kindOf(const GcodeCommand& command) {
  std::string kind(command.name);
  if (command.is('M', 117)) return kind;  // text
  std::string_view rest = command.rest;
  while (!(rest = trimmed(rest)).empty()) {
    const std::string_view word = rest.substr(0, rest.find(' '));
    rest.remove_prefix(word.size());
    const std::size_t equal = word.find('=');
    const bool named = command.letter == 0 && equal != std::string_view::npos;
    double value = 0;
    const bool number = named && readNumber(word.substr(equal + 1), value) > 0;
    const bool whose =
        command.letter == 0 ? !number : std::string_view("TDPtdp").find(word[0]) != std::string_view::npos;
    kind += ' ';
    kind += whose ? word : word.substr(0, named ? equal : 1);
  }
  return kind;
}

// What was set inside the block and holds on: the last of each kind, in their order.
void Reader::keep(SurfaceBlock& block, const Item& item, std::map<std::string, std::size_t>& places) const {
  const std::string_view line = lineOf(item);
  const GcodeParts parts = partsOf(line);
  const auto put = [&](const std::string& key) {
    const auto [place, fresh] = places.emplace(key, block.kept.size());
    if (!fresh) block.kept[place->second].clear();
    place->second = block.kept.size();
    block.kept.emplace_back(line);
  };
  if (parts.code.empty()) {
    const Mark mark = readMark(parts.comment);
    if (mark.kind == MarkKind::Width) put("width");
    if (mark.kind == MarkKind::Height) put("height");
    return;
  }
  const GcodeCommand command = commandOf(parts.code);
  if (command.letter == 'G' && command.sub == 0) {
    const bool origin = command.code == 92 && parts.code.find_first_of("XYZ") == std::string_view::npos;
    const bool ofTool = command.rest.find_first_of("PLpl") != std::string_view::npos;
    const bool retraction = (command.code == 10 && !ofTool) || command.code == 11;
    if (!origin && !retraction && command.code != 90) leave(block, LeftBecause::Command);
    return;
  }
  if (command.letter == 'M' && command.sub == 0) {
    switch (command.code) {
      case 82:
      case 83:
        return;
      case 106:
      case 107:
        return put("fan " + decimal(wordsOf(command.rest).at('P'), 3));
      case 104:  // does not wait
      case 140:
      case 73:
      case 117:
      case 201:
      case 203:
      case 204:
      case 205:
      case 572:
      case 900:
        return put(kindOf(command));
      default:
        return leave(block, LeftBecause::Command);
    }
  }
  if (command.name == "SET_VELOCITY_LIMIT" || command.name == "SET_PRESSURE_ADVANCE" ||
      command.name == "SET_PRINT_STATS_INFO") {
    return put(kindOf(command));
  }
  leave(block, LeftBecause::Command);
}

// Wipes and the first travel behind the block: what they need of where it ended.
void Reader::lookAhead(SurfaceBlock& block) const {
  MachineState machine = block.after;
  bool done = false;
  int lines = 0;
  std::string_view rest = text_.substr(block.surface.end);
  std::size_t offset = block.surface.end;
  while (!rest.empty() && !done && lines++ < kLookAhead) {
    const std::size_t lineFeed = rest.find('\n');
    const std::size_t size = lineFeed == std::string_view::npos ? rest.size() : lineFeed + 1;
    const GcodeParts parts = partsOf(trimmed(rest.substr(0, size - (lineFeed == std::string_view::npos ? 0 : 1))));
    const std::size_t begin = offset;
    rest.remove_prefix(size);
    offset += size;
    if (parts.code.empty()) continue;
    const GcodeCommand command = commandOf(parts.code);
    if (command.is('G', 28) || command.is('M', 84)) return;
    const GcodeWords words = readsWords(command) ? wordsOf(command.rest) : GcodeWords{};
    if (command.is('G', 92) && (words.has('X') || words.has('Y'))) return leave(block, LeftBecause::Travel);
    const auto move = runCommand(machine, command, words);
    if (!move || !move->xy) continue;
    if (!machine.absolute || move->arc || machine.inches || move->e > 0) return leave(block, LeftBecause::Travel);
    if (move->e < 0) {
      if (!words.has('X') || !words.has('Y')) return leave(block, LeftBecause::Travel);
      block.wipes.push_back({begin, offset, move->length});
      continue;
    }
    // A wipe may leave out a coordinate that does not change; a travel must name its place.
    if (!words.has('X') || !words.has('Y')) return leave(block, LeftBecause::Travel);
    if (byCura() && block.wipes.empty() && !move->toldF && move->length < kShortWipe && block.after.at == move->from &&
        move->z == move->zFrom) {
      block.wipes.push_back({begin, offset, move->length});
      continue;
    }
    block.next = move->to;
    block.nextEnd = offset;
    block.tightBefore = machine.firmwareRetracted || machine.retracted > block.after.retracted + 0.05;
    done = true;
  }
}

Result<SlicedBlocks> Reader::finish() {
  const bool inside = isSurface(role_) && !items_.empty() && items_.back().bead();
  endStretch();
  if (inside && !out_.blocks.empty()) leave(out_.blocks.back(), LeftBecause::Cut);
  endSkins();
  endSkins();
  const auto refuse = [](const char* why) { return Error{ErrorCode::InvalidFile, why}; };
  if (numbered_) return refuse("its lines are numbered, as hosts send them; take the file that the slicer wrote");
  if (!program_ || !marked_ || out_.file.layers == 0) {
    return refuse(
        "it does not mark its surfaces; files of PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio and Cura do");
  }
  if (out_.settings.weighed.evidence == FilamentEvidence::Open) {
    return Error{ErrorCode::InvalidFile, askForFilament(out_.settings.weighed)};
  }
  if (!pushed_) return refuse("no bead in it pushes filament by E; export it for a firmware that counts filament so");
  out_.file.slicer = program_->slicer;
  out_.filamentArea = area_;
  for (SurfaceBlock& block : out_.blocks) {
    const int tool = block.surface.tool;
    block.mostFlow = std::max(mostFlowOf(out_.settings, tool), mostFeed_[tool] * area_);
  }
  out_.file.program = program_->name;
  if (out_.settings.nozzle > 0) out_.file.nozzle = out_.settings.nozzle;
  sortBy(out_.blocks, [](const SurfaceBlock& block) { return block.surface.begin; });
  return std::move(out_);
}

}  // namespace

Result<SlicedBlocks> readBlocks(std::string_view gcode, const RunContext& run) {
  if (gcode.starts_with("GCDE")) {
    return Error{
        ErrorCode::InvalidFile,
        "it is binary G-code (.bgcode); in PrusaSlicer switch off Preferences, Other, \"Use binary G-code when the "
        "printer supports it\", and export again"};
  }
  Reader reader(gcode, readFileSettings(gcode, {}));
  run.beginStage("reading", 0, 1);
  if (!forEachLine(gcode, run, [&](const GcodeLine& line) { reader.line(line); })) {
    return cancelledRun();
  }
  return reader.finish();
}

}  // namespace sillon
