// Project files and published scenes. One list of rows (visitProject) is read, written and checked, so that the three
// cannot drift apart. The file is hostile: sizes, nesting and repeated keys are settled before anything is built.
#include "sillon/project.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

#include "preset_data.hpp"
#include "sillon/pipeline.hpp"
#include "sillon/presets.hpp"
#include "sillon/thumbnails.hpp"

namespace sillon {
namespace {

using Json = nlohmann::json;  // sorted keys: look-up stays fast in files made of keys only

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxDepth = 64;
constexpr std::size_t kMaxTextBytes = 1024;
constexpr std::size_t kMaxBlockBytes = 65'536;
constexpr double kMaxSide = 10'000;  // [mm], pages
constexpr double kMaxBed = 5'000;    // [mm], as gcode_job.cpp; beds may have their origin anywhere
constexpr double kMaxNozzle = 2;     // [mm], as gcode_job.cpp
constexpr double kMaxLayerHeight = 0.8 * kMaxNozzle;

template <class T>
struct Name {
  const char* name;
  T value;
};
constexpr std::array<Name<BuiltinShape>, 4> kBuiltins{{{"none", BuiltinShape::None},
                                                       {"rectangle", BuiltinShape::Rectangle},
                                                       {"rounded", BuiltinShape::RoundedRectangle},
                                                       {"disc", BuiltinShape::Disc}}};
constexpr std::array<Name<bool>, 2> kUnitless{{{"px", false}, {"mm", true}}};
constexpr std::array<Name<DirectionEncoding>, 3> kEncodings{{{"angle", DirectionEncoding::Angle},
                                                             {"rotation", DirectionEncoding::Rotation},
                                                             {"tangent", DirectionEncoding::Tangent}}};
constexpr std::array<Name<DirectionMode>, 4> kModes{{{"parallel", DirectionMode::Parallel},
                                                     {"orthogonal", DirectionMode::Orthogonal},
                                                     {"smoothest", DirectionMode::Smoothest},
                                                     {"constrained", DirectionMode::Constrained}}};
constexpr std::array<Name<PerimeterMode>, 3> kPerimeterModes{
    {{"none", PerimeterMode::None}, {"soft", PerimeterMode::Soft}, {"count", PerimeterMode::Count}}};
constexpr std::array<Name<MapFilter>, 2> kMapFilters{
    {{"average", MapFilter::Average}, {"nearest", MapFilter::Nearest}}};
constexpr std::array<Name<PhaseTransport>, 2> kPhaseTransports{
    {{"midpoint", PhaseTransport::Midpoint}, {"neighbour", PhaseTransport::Neighbour}}};
constexpr std::array<Name<GcodeFlavor>, 5> kFlavors{{{"marlin", GcodeFlavor::Marlin},
                                                     {"klipper", GcodeFlavor::Klipper},
                                                     {"reprap", GcodeFlavor::RepRap},
                                                     {"prusa", GcodeFlavor::PrusaBuddy},
                                                     {"bambu", GcodeFlavor::Bambu}}};

constexpr std::array<Name<BasePattern>, 3> kBasePatterns{
    {{"hatched", BasePattern::Hatched}, {"concentric", BasePattern::Concentric}, {"same", BasePattern::Same}}};
constexpr std::array<Name<ShowSide>, 3> kShowSides{
    {{"up", ShowSide::Up}, {"bed", ShowSide::Bed}, {"both", ShowSide::Both}}};

/// A table of presets: the JSON built into the library, and what one row of it is called.
struct PresetTable {
  const char* key;
  const char* noun;
  std::string_view json;
};
constexpr PresetTable kPrinters{"printers", "printer", kPrintersJson};
constexpr PresetTable kFilaments{"filaments", "filament", kFilamentsJson};
constexpr PresetTable kRecipes{"recipes", "recipe", kRecipesJson};

constexpr std::array kSections{"shape", "directions", "modes", "toolpath", "print", "printer"};

/// The fields of a printer with its filament; printers.json and filaments.json have the same keys.
template <class Visitor, class AnyPrinter>
void visitPrinter(Visitor& v, AnyPrinter& p) {
  v.text("name", p.name);
  v.choice("flavor", p.flavor, kFlavors);
  v.point("bedMin", p.bedMin, -kMaxBed, kMaxBed, "mm");
  v.point("bedMax", p.bedMax, -kMaxBed, kMaxBed, "mm");
  v.boolean("roundBed", p.roundBed);
  v.point("excludedMin", p.excludedMin, -kMaxBed, kMaxBed, "mm");
  v.point("excludedMax", p.excludedMax, -kMaxBed, kMaxBed, "mm");
  v.number("maxZ", p.maxZ, 0.05, kMaxBed, "mm");
  v.number("nozzle", p.nozzle, 0.05, kMaxNozzle, "mm");
  v.number("filamentDiameter", p.filamentDiameter, 0.5, 5, "mm");
  v.number("filamentDensity", p.filamentDensity, 0.1, 25, "g/cm3");
  v.text("filamentType", p.filamentType);
  v.boolean("anyTemperature", p.anyTemperature);  // before those it is about
  const double coldest = p.anyTemperature ? 0 : 170;
  const double hottest = p.anyTemperature ? 500 : 300;
  v.number("nozzleTemperature", p.nozzleTemperature, coldest, hottest, "degrees Celsius");
  v.number("firstLayerNozzleTemperature", p.firstLayerNozzleTemperature, coldest, hottest, "degrees Celsius");
  v.number("bedTemperature", p.bedTemperature, 0, p.anyTemperature ? 200 : 120, "degrees Celsius");
  v.number("speed", p.speed, 5, 1000, "mm/s");
  v.number("firstLayerSpeed", p.firstLayerSpeed, 5, 1000, "mm/s");
  v.number("travelSpeed", p.travelSpeed, 5, 1000, "mm/s");
  v.number("machineSpeed", p.machineSpeed, 0, 1000, "mm/s");
  v.number("acceleration", p.acceleration, 1, 100'000, "mm/s2");
  v.number("machineAcceleration", p.machineAcceleration, 0, 100'000, "mm/s2");
  v.number("cornerSpeed", p.cornerSpeed, 0.1, 100, "mm/s");
  v.number("machineCornerSpeed", p.machineCornerSpeed, 0, 100, "mm/s");
  v.number("curveAcceleration", p.curveAcceleration, 0, 100'000, "mm/s2");
  v.number("maxFlow", p.maxFlow, 0.1, 1000, "mm3/s");
  v.number("maxSegmentsPerSecond", p.maxSegmentsPerSecond, 1, 100'000, "1/s");
  v.number("pressureAdvance", p.pressureAdvance, 0, 2, "s");
  v.boolean("setPressureAdvance", p.setPressureAdvance);
  v.number("retractLength", p.retractLength, 0, 20, "mm");
  v.number("retractSpeed", p.retractSpeed, 1, 200, "mm/s");
  v.number("lift", p.lift, 0, 20, "mm");
  v.boolean("absoluteE", p.absoluteE);
  v.block("startGcode", p.startGcode);
  v.block("endGcode", p.endGcode);
  v.text("screenSizes", p.screenSizes);
}

/// The fields of the toolpath; recipes.json has some of the same keys.
template <class Visitor, class AnyParams>
void visitToolpath(Visitor& v, AnyParams& p) {
  v.number("spacing", p.spacing);
  v.choice("perimeterMode", p.perimeterMode, kPerimeterModes);
  v.integer("perimeters", p.perimeters);
  v.number("bridge", p.bridge);
  v.choice("mapFilter", p.mapFilter, kMapFilters);
  v.integer("seed", p.seed);
  v.number("jitter", p.jitter);
  v.choice("phaseTransport", p.phaseTransport, kPhaseTransports);
  v.integer("sweepsPerLevel", p.sweepsPerLevel);
  v.number("spacingBend", p.spacingBend);
  v.number("lineGive", p.lineGive);
  v.number("waveReach", p.waveReach);
  v.number("borderPull", p.borderPull);
  v.number("stitchAlignment", p.stitchAlignment);
  v.integer("relaxationRounds", p.relaxationRounds);
  v.number("relaxationStrength", p.relaxationStrength);
  v.number("relaxationSmoothing", p.relaxationSmoothing);
  v.number("widthBalance", p.widthBalance);
  v.number("beadOverlap", p.beadOverlap);
  v.number("minWidth", p.minWidth);
  v.number("maxWidth", p.maxWidth);
  v.number("simplifyTolerance", p.simplifyTolerance);
}

/// Every field of a project: key, place, range, unit. Rows of the toolpath have no range here: invalidParameter knows
/// it.
template <class Visitor, class AnyProject>
void visitProject(Visitor& v, AnyProject& p) {
  v.begin("shape");
  v.text("file", p.shapeFile);
  v.choice("builtin", p.builtin, kBuiltins);
  v.point("size", p.builtinSize, 0, kMaxSide, "mm");
  v.number("radius", p.builtinRadius, 0, kMaxSide, "mm");
  v.number("pageWidth", p.pageWidth, 0, kMaxSide, "mm");
  v.choice("unitless", p.unitlessIsMm, kUnitless);
  v.end();

  v.begin("directions");
  v.text("file", p.directionFile);
  v.choice("encoding", p.encoding, kEncodings);
  v.number("angle", p.angle, -360, 360, "degrees");
  v.end();

  v.begin("modes");
  v.text("file", p.modeFile);
  v.choice("mode", p.mode, kModes);
  v.end();

  v.begin("toolpath");
  v.recipe("preset", p.toolpath);
  visitToolpath(v, p.toolpath);
  v.end();

  v.begin("print");
  v.integer("layers", p.print.layers, 1, 1000);
  v.integer("base", p.print.base, 0, 1000);
  v.choice("basePattern", p.print.basePattern, kBasePatterns);
  v.choice("showSide", p.print.showSide, kShowSides);
  v.integer("skirt", p.print.skirt, 0, 20);
  v.integer("brim", p.print.brim, 0, 50);
  v.number("elephantFoot", p.print.elephantFoot, 0, 0.5, "mm");
  v.boolean("constantFlow", p.print.constantFlow);
  v.number("coast", p.print.coast, 0, 1, "mm");
  v.point("copies", p.print.copies, 1, 20, "");
  v.number("copyGap", p.print.copyGap, 1, 100, "mm");
  v.number("layerHeight", p.print.layerHeight, 0.05, kMaxLayerHeight, "mm");
  v.number("startHeight", p.print.startHeight, 0, 5000, "mm");
  v.number("firstLayerHeight", p.print.firstLayerHeight, 0, kMaxLayerHeight, "mm");
  v.number("flow", p.print.flow, 0.01, 2, "");
  v.number("baseFlow", p.print.baseFlow, 0.01, 2, "");
  v.number("rotate", p.print.rotate, -360, 360, "degrees");
  v.boolean("mirror", p.print.mirror);
  v.boolean("strict", p.print.strict);
  v.point("place", p.print.place, -kMaxSide, kMaxSide, "mm");
  v.end();

  v.begin("printer");
  v.preset("preset", p.printerPreset, p.printer, kPrinters);
  v.preset("filament", p.filamentPreset, p.printer, kFilaments);
  visitPrinter(v, p.printer);
  v.end();
}

// ---- words for messages

std::string numberText(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  std::string text = Json(value).dump();  // shortest form, the same in every locale
  if (text.size() > 2 && text.compare(text.size() - 2, 2, ".0") == 0) text.resize(text.size() - 2);
  return text;
}

/// Text from a file, fit to be shown: one line, not too long.
std::string inQuotes(std::string_view text) {
  constexpr std::size_t kShown = 60;
  std::string out = "\"";
  for (std::size_t k = 0; k < text.size() && k < kShown; ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    out += byte < 0x20 || byte == 0x7f || byte == '"' ? '?' : text[k];
  }
  // A cut through a UTF-8 character would leave half of it.
  if (text.size() > kShown) {
    while ((static_cast<unsigned char>(out.back()) & 0xC0) == 0x80) out.pop_back();
    if (static_cast<unsigned char>(out.back()) >= 0xC0) out.pop_back();
    out += "...";
  }
  return out + "\"";
}

const char* typeName(const Json& value) {
  if (value.is_null()) return "null";
  if (value.is_boolean()) return "true or false";
  if (value.is_number()) return "a number";
  if (value.is_string()) return "text";
  return value.is_array() ? "a list" : "an object";
}

template <class T, std::size_t n>
std::string choices(const std::array<Name<T>, n>& names) {
  std::string out;
  for (std::size_t k = 0; k < n; ++k) out += (k == 0 ? "" : k + 1 == n ? " or " : ", ") + inQuotes(names[k].name);
  return out;
}

/// Levenshtein distance; both texts are short.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

/// "did you mean ..." with the nearest three, or all there are if none is near.
std::string suggestion(std::string_view key, const std::vector<std::string>& known) {
  constexpr std::size_t kNear = 3;
  std::vector<std::string> near;
  for (std::size_t distance = 0; distance <= kNear; ++distance) {
    for (const std::string& name : known) {
      if (near.size() == 3 || distance >= name.size()) continue;
      if (editDistance(key.substr(0, 64), name) == distance) near.push_back(name);
    }
  }
  std::string out = near.empty() ? "known are " : "did you mean ";
  if (near.empty()) {
    for (std::size_t k = 0; k < known.size(); ++k) out += (k == 0 ? "" : ", ") + known[k];
  } else {
    for (std::size_t k = 0; k < near.size(); ++k) out += (k == 0 ? "" : " or ") + inQuotes(near[k]);
    out += "?";
  }
  return out;
}

// ---- reading

/// Looks a JSON text over without building it: syntax, nesting, repeated keys.
class Inspector : public nlohmann::json_sax<Json> {
 public:
  explicit Inspector(std::string_view text) : text_(text) {}
  std::string problem;

  bool null() override { return true; }
  bool boolean(bool /*value*/) override { return true; }
  bool number_integer(number_integer_t /*value*/) override { return true; }
  bool number_unsigned(number_unsigned_t /*value*/) override { return true; }
  bool number_float(number_float_t /*value*/, const string_t& /*text*/) override { return true; }
  bool string(string_t& /*value*/) override { return true; }
  bool binary(binary_t& /*value*/) override { return true; }
  bool start_object(std::size_t /*size*/) override { return enter(); }
  bool start_array(std::size_t /*size*/) override { return enter(); }
  bool end_object() override { return leave(); }
  bool end_array() override { return leave(); }
  bool key(string_t& key) override {
    if (keys_.back().insert(key).second) return true;
    problem = "key " + inQuotes(key) + " is given twice; each key may be given once";
    return false;
  }
  bool parse_error(std::size_t position, const std::string& /*token*/, const Json::exception& /*why*/) override {
    const std::size_t end = std::min(position, text_.size());
    const std::string_view before = text_.substr(0, end);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t column = end - (before.rfind('\n') + 1);  // npos + 1 is 0
    problem = "the text is not JSON at line " + std::to_string(line) + ", column " + std::to_string(column) +
              "; a project or scene is one JSON object";
    return false;
  }

 private:
  bool enter() {
    if (keys_.size() == kMaxDepth) {
      problem = "the JSON is nested deeper than " + std::to_string(kMaxDepth) + " levels; a project needs 3";
      return false;
    }
    keys_.emplace_back();
    return true;
  }
  bool leave() {
    keys_.pop_back();
    return true;
  }

  std::string_view text_;
  std::vector<std::set<std::string>> keys_;  // of the objects that are open; empty ones for lists
};

/// Fills a project from JSON; stops at the first thing wrong and remembers it. Types only: ranges come later.
class Reader {
 public:
  explicit Reader(const Json& root) : root_(root), object_(&root) {}
  std::string problem;

  void begin(const char* section) {
    known_.clear();
    prefix_ = std::string(section) + ".";
    const auto found = root_.find(section);
    object_ = found == root_.end() ? nullptr : &*found;
    if (object_ == nullptr || object_->is_object()) return;
    fail(section, "an object", *object_);
    object_ = nullptr;
  }

  /// Ends a section (or the top level): what was not asked for is unknown.
  void end() {
    if (object_ == nullptr || !problem.empty()) return;
    for (const auto& item : object_->items()) {
      if (std::find(known_.begin(), known_.end(), item.key()) != known_.end()) continue;
      problem = "unknown key " + inQuotes(prefix_ + item.key()) + "; " + suggestion(item.key(), known_);
      return;
    }
  }

  /// The value of a key, or null if absent.
  const Json* find(const char* key) {
    known_.emplace_back(key);
    if (object_ == nullptr || !problem.empty()) return nullptr;
    const auto found = object_->find(key);
    return found == object_->end() ? nullptr : &*found;
  }

  void text(const char* key, std::string& out) {
    const Json* value = find(key);
    if (value == nullptr) return;
    if (!value->is_string()) return fail(prefix_ + key, "text", *value);
    out = value->get_ref<const std::string&>();
  }

  void block(const char* key, std::string& out) { text(key, out); }

  /// Lays a preset's values under those that follow.
  void preset(const char* key, std::string& out, Printer& printer, const PresetTable& table) {
    text(key, out);
    if (out.empty() || !problem.empty()) return;
    if (const std::string wrong = apply(table, out, printer); !wrong.empty()) problem = prefix_ + key + " " + wrong;
  }

  /// \return what is wrong with the id, beginning with "is".
  template <class Values>
  static std::string apply(const PresetTable& table, const std::string& id, Values& values) {
    const Json all = Json::parse(table.json)[table.key];
    if (all.contains(id)) {
      readPreset(all, id, values);
      return "";
    }
    std::vector<std::string> known;
    for (const auto& item : all.items()) known.push_back(item.key());
    return "is " + inQuotes(id) + ", which is no " + table.noun + "; " + suggestion(id, known);
  }

  static void readPreset(const Json& all, const std::string& id, Printer& printer);
  static void readPreset(const Json& all, const std::string& id, ToolpathParams& params);

  /// Likewise; the name itself is not kept, as all values are in the other fields then.
  void recipe(const char* key, ToolpathParams& params) {
    std::string id;
    text(key, id);
    if (id.empty() || !problem.empty()) return;
    if (const std::string wrong = apply(kRecipes, id, params); !wrong.empty()) problem = prefix_ + key + " " + wrong;
  }

  void boolean(const char* key, bool& out) {
    const Json* value = find(key);
    if (value == nullptr) return;
    if (!value->is_boolean()) return fail(prefix_ + key, "true or false", *value);
    out = value->get<bool>();
  }

  void number(const char* key, double& out, double = 0, double = 0, const char* = "") {
    const Json* value = find(key);
    if (value == nullptr) return;
    if (!value->is_number()) return fail(prefix_ + key, "a number", *value);
    out = value->get<double>();
  }

  void number(const char* key, std::optional<double>& out) {
    const Json* value = find(key);
    if (value == nullptr) return;
    if (value->is_null()) {
      out.reset();
    } else if (value->is_number()) {
      out = value->get<double>();
    } else {
      fail(prefix_ + key, "a number or null", *value);
    }
  }

  template <class Integer>
  void integer(const char* key, Integer& out, Integer low = 0, Integer high = 0) {
    const Json* value = find(key);
    if (value == nullptr) return;
    if (!value->is_number()) return fail(prefix_ + key, "a whole number", *value);
    constexpr auto kLow = std::numeric_limits<Integer>::min();
    constexpr auto kHigh = std::numeric_limits<Integer>::max();
    bool fits = false;
    if (value->is_number_unsigned()) {
      const auto whole = value->get<std::uint64_t>();
      fits = whole <= static_cast<std::uint64_t>(kHigh);
      if (fits) out = static_cast<Integer>(whole);
    } else if (value->is_number_integer()) {  // negative
      const auto whole = value->get<std::int64_t>();
      fits = std::is_signed_v<Integer> && whole >= static_cast<std::int64_t>(kLow);
      if (fits) out = static_cast<Integer>(whole);
    } else {  // 7.0 is a whole number too; beyond 2^53 it may not be the one that was meant
      const auto real = value->get<double>();
      fits = std::floor(real) == real && real >= static_cast<double>(kLow) &&
             real <= std::min(static_cast<double>(kHigh), 9007199254740992.0);
      if (fits) out = static_cast<Integer>(real);
    }
    if (!fits) {
      problem = prefix_ + key + " is " + value->dump() + "; it must be a whole number";
      if (low == high && !std::is_signed_v<Integer>) high = kHigh;
      if (low < high) problem += " from " + std::to_string(low) + " to " + std::to_string(high);
    }
  }

  template <class T, std::size_t n>
  void choice(const char* key, T& out, const std::array<Name<T>, n>& names) {
    const Json* value = find(key);
    if (value == nullptr) return;
    if (!value->is_string()) return fail(prefix_ + key, choices(names), *value);
    const auto& text = value->template get_ref<const std::string&>();
    for (const Name<T>& name : names) {
      if (text == name.name) {
        out = name.value;
        return;
      }
    }
    problem = prefix_ + key + " is " + inQuotes(text) + "; it must be " + choices(names);
  }

  void point(const char* key, Vec2& out, double = 0, double = 0, const char* = "") {
    const Json* value = find(key);
    if (value != nullptr) pair(key, *value, out);
  }

  void point(const char* key, std::optional<Vec2>& out, double = 0, double = 0, const char* = "") {
    const Json* value = find(key);
    if (value == nullptr) return;
    if (value->is_null()) {
      out.reset();
    } else {
      Vec2 read;
      pair(key, *value, read);
      out = read;
    }
  }

 private:
  void pair(const char* key, const Json& value, Vec2& out) {
    if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number()) {
      return fail(prefix_ + key, "two numbers [x, y]", value);
    }
    out = {value[0].get<double>(), value[1].get<double>()};
  }

  void fail(const std::string& key, const std::string& wanted, const Json& value) {
    if (problem.empty()) problem = key + " is " + typeName(value) + "; it must be " + wanted;
  }

  const Json& root_;
  const Json* object_;
  std::string prefix_;
  std::vector<std::string> known_;
};

void Reader::readPreset(const Json& all, const std::string& id, Printer& printer) {
  Reader reader(all);
  reader.begin(id.c_str());
  visitPrinter(reader, printer);
}

void Reader::readPreset(const Json& all, const std::string& id, ToolpathParams& params) {
  Reader reader(all);
  reader.begin(id.c_str());
  visitToolpath(reader, params);
}

/// The version and the keys of published scenes, which a project may use too.
void readTopLevel(Reader& reader, const Json& root, Project& project) {
  int version = kProjectVersion;
  double nozzleWidth = 0;
  double heightShare = 0;
  int perimeters = 1;
  int iterations = 0;
  bool repulse = true;
  bool ignored = false;
  const auto given = [&](const char* key) { return root.contains(key); };

  reader.integer("sillon", version);
  reader.number("nozzle_width", nozzleWidth);
  reader.text("svg_path", project.shapeFile);
  reader.text("line_field_path", project.directionFile);
  reader.text("line_mode_field_path", project.modeFile);
  reader.integer("perimeter_count", perimeters);
  reader.integer("alignment_iter_per_level", iterations);
  reader.integer("seed", project.toolpath.seed);
  reader.boolean("repulse_curves", repulse);
  reader.number("layer_height_rt_nozzle_width", heightShare);
  reader.boolean("force_sdf_computation", ignored);  // a cache switch of its reader
  for (const char* section : kSections) (void)reader.find(section);
  reader.end();
  if (!reader.problem.empty()) return;

  const bool sections = std::any_of(kSections.begin(), kSections.end(), given);
  const auto outside = [&](const char* key, double value, double low, double high) {
    if (!given(key) || (value >= low && value <= high)) return false;
    reader.problem =
        std::string(key) + " is " + numberText(value) + "; it must be " + numberText(low) + " to " + numberText(high);
    return true;
  };
  if (given("sillon") && version != kProjectVersion) {
    reader.problem =
        "sillon is " + std::to_string(version) + "; this program reads version " + std::to_string(kProjectVersion);
  } else if (!given("sillon") && sections) {
    reader.problem = "the project has no version; it must have \"sillon\": " + std::to_string(kProjectVersion);
  } else if (!given("sillon") && !(given("nozzle_width") && given("svg_path"))) {
    reader.problem =
        "the file is no project and no scene; a project has \"sillon\": 1, a scene has \"nozzle_width\" and "
        "\"svg_path\"";
  }
  if (!reader.problem.empty() || outside("nozzle_width", nozzleWidth, 0.05, 20) ||
      outside("perimeter_count", perimeters, 0, 100) || outside("alignment_iter_per_level", iterations, 1, 4000) ||
      outside("layer_height_rt_nozzle_width", heightShare, 0.01, 4)) {
    return;
  }

  if (given("nozzle_width")) {
    project.toolpath.spacing = nozzleWidth;
    project.printer.nozzle = std::min(nozzleWidth, kMaxNozzle);
  }
  if (given("svg_path")) project.unitlessIsMm = true;
  if (given("perimeter_count")) {
    project.toolpath.perimeterMode = perimeters == 0 ? PerimeterMode::None : PerimeterMode::Count;
    project.toolpath.perimeters = perimeters;
  }
  // 8 sweeps in place smooth as well as the 32 published ones, which read the old field throughout.
  if (given("alignment_iter_per_level")) project.toolpath.sweepsPerLevel = std::max(1, iterations / 4);
  if (!repulse) project.toolpath.relaxationRounds = 0;
  if (given("layer_height_rt_nozzle_width")) project.print.layerHeight = heightShare * project.toolpath.spacing;
}

// ---- checking

/// Holds every row against its range; remembers the first that is outside.
class Checker {
 public:
  std::string problem;

  void begin(const char* section) { prefix_ = std::string(section) + "."; }
  void end() {}

  void text(const char* key, const std::string& value) {
    const bool control = std::any_of(value.begin(), value.end(), [](char c) {
      const auto byte = static_cast<unsigned char>(c);
      return byte < 0x20 || byte == 0x7f;
    });
    if (!control && value.size() <= kMaxTextBytes) return;
    fail(prefix_ + key + " is " + inQuotes(value) + "; it must be one line of at most " +
         std::to_string(kMaxTextBytes) + " bytes");
  }

  void block(const char* key, const std::string& value) {
    if (value.size() <= kMaxBlockBytes && value.find('\0') == std::string::npos) return;
    fail(prefix_ + key + " has " + std::to_string(value.size()) + " bytes; it must be text of at most " +
         std::to_string(kMaxBlockBytes));
  }

  void preset(const char* key, const std::string& value, const Printer& /*printer*/, const PresetTable& /*table*/) {
    text(key, value);
  }
  void recipe(const char* /*key*/, const ToolpathParams& /*params*/) {}
  void boolean(const char* /*key*/, bool /*value*/) {}
  template <class T, std::size_t n>
  void choice(const char* /*key*/, T /*value*/, const std::array<Name<T>, n>& /*names*/) {}
  void number(const char* /*key*/, const std::optional<double>& /*value*/) {}
  template <class T>
  void number(const char* /*key*/, const T& /*value*/) {}  // of the toolpath: invalidParameter
  template <class T>
  void integer(const char* /*key*/, const T& /*value*/) {}

  void number(const char* key, double value, double low, double high, const char* unit) {
    if (value >= low && value <= high) return;  // false for NaN
    const std::string space = *unit == '\0' ? "" : " ";
    fail(prefix_ + key + " is " + numberText(value) + space + unit + "; it must be " + numberText(low) + " to " +
         numberText(high));
  }
  void integer(const char* key, int value, int low, int high) { number(key, value, low, high, ""); }
  void point(const char* key, const Vec2& value, double low, double high, const char* unit) {
    number((std::string(key) + ".x").c_str(), value.x, low, high, unit);
    number((std::string(key) + ".y").c_str(), value.y, low, high, unit);
  }
  void point(const char* key, const std::optional<Vec2>& value, double low, double high, const char* unit) {
    if (value) point(key, *value, low, high, unit);
  }

 private:
  void fail(std::string message) {
    if (problem.empty()) problem = std::move(message);
  }
  std::string prefix_;
};

// ---- writing

class Writer {
 public:
  void begin(const char* section) {
    body_ += std::string(",\n  \"") + section + "\": {";
    first_ = true;
  }
  void end() { body_ += "\n  }"; }
  void text(const char* key, const std::string& value) {
    // File names need not be UTF-8; what is not becomes U+FFFD instead of an exception.
    add(key, Json(value).dump(-1, ' ', false, Json::error_handler_t::replace));
  }
  void block(const char* key, const std::string& value) { text(key, value); }
  void preset(const char* key, const std::string& value, const Printer& /*printer*/, const PresetTable& /*table*/) {
    text(key, value);
  }
  void recipe(const char* /*key*/, const ToolpathParams& /*params*/) {}
  void boolean(const char* key, bool value) { add(key, value ? "true" : "false"); }
  void number(const char* key, double value, double = 0, double = 0, const char* = "") { add(key, numberText(value)); }
  void number(const char* key, const std::optional<double>& value) { add(key, value ? numberText(*value) : "null"); }
  template <class Integer>
  void integer(const char* key, Integer value, Integer = 0, Integer = 0) {
    add(key, std::to_string(value));
  }
  template <class T, std::size_t n>
  void choice(const char* key, T value, const std::array<Name<T>, n>& names) {
    for (const Name<T>& name : names) {
      if (value == name.value) add(key, std::string("\"") + name.name + "\"");
    }
  }
  void point(const char* key, const Vec2& value, double, double, const char*) {
    add(key, "[\n      " + numberText(value.x) + ",\n      " + numberText(value.y) + "\n    ]");
  }
  void point(const char* key, const std::optional<Vec2>& value, double low, double high, const char* unit) {
    if (value) {
      point(key, *value, low, high, unit);
    } else {
      add(key, "null");
    }
  }

  [[nodiscard]] std::string file() const {
    return "{\n  \"sillon\": " + std::to_string(kProjectVersion) + body_ + "\n}\n";
  }

 private:
  void add(const char* key, const std::string& value) {
    body_ += std::string(first_ ? "\n" : ",\n") + "    \"" + key + "\": " + value;
    first_ = false;
  }
  std::string body_;
  bool first_ = true;
};

}  // namespace

std::string invalidProject(const Project& project) {
  Checker checker;
  visitProject(checker, project);
  if (!checker.problem.empty()) return checker.problem;
  if (std::string problem = invalidParameter(project.toolpath); !problem.empty()) return problem;
  if (!project.shapeFile.empty() && project.builtin != BuiltinShape::None) {
    return "shape has both file " + inQuotes(project.shapeFile) + " and a builtin; it must have one of them";
  }
  const Printer& printer = project.printer;
  if (!(printer.bedMax.x > printer.bedMin.x && printer.bedMax.y > printer.bedMin.y)) {
    return "printer.bedMax is [" + numberText(printer.bedMax.x) + ", " + numberText(printer.bedMax.y) +
           "] mm; it must be right of and above bedMin [" + numberText(printer.bedMin.x) + ", " +
           numberText(printer.bedMin.y) + "]";
  }
  const Vec2 copies = project.print.copies;
  if (copies.x != std::floor(copies.x) || copies.y != std::floor(copies.y)) {
    return "print.copies is [" + numberText(copies.x) + ", " + numberText(copies.y) + "]; it must be two whole numbers";
  }
  if (const auto sizes = readThumbnailSizes(printer.screenSizes); !sizes) return "printer." + sizes.error().message;
  return "";
}

Result<Project> readProject(std::string_view json) {
  if (json.size() > kMaxBytes) {
    return Error{ErrorCode::TooLarge, "the project is " + std::to_string(json.size()) + " bytes; it must be at most " +
                                          std::to_string(kMaxBytes)};
  }
  Inspector inspector(json);
  if (!Json::sax_parse(json, &inspector)) return Error{ErrorCode::InvalidFile, inspector.problem};
  const Json root = Json::parse(json, nullptr, false);
  if (!root.is_object()) {
    return Error{ErrorCode::InvalidFile, std::string("the JSON is ") + typeName(root) + "; it must be an object"};
  }

  Project project;
  Reader reader(root);
  readTopLevel(reader, root, project);
  visitProject(reader, project);
  if (!reader.problem.empty()) return Error{ErrorCode::InvalidFile, reader.problem};
  if (std::string problem = invalidProject(project); !problem.empty()) {
    return Error{ErrorCode::InvalidArgument, std::move(problem)};
  }
  return project;
}

std::string writeProject(const Project& project) {
  Writer writer;
  visitProject(writer, project);
  return writer.file();
}

std::string writePrinter(const Printer& printer) {
  Writer writer;
  writer.begin("printer");
  visitPrinter(writer, printer);
  writer.end();
  return writer.file();
}

std::vector<Preset> presets(PresetKind kind) {
  const PresetTable& table = kind == PresetKind::Printer ? kPrinters : kFilaments;
  const Json all = Json::parse(table.json)[table.key];
  std::vector<Preset> result;
  for (const auto& item : all.items()) {
    Preset preset{item.key(), {}};
    Reader::readPreset(all, item.key(), preset.printer);
    result.push_back(std::move(preset));
  }
  return result;
}

std::vector<std::string> recipes() {
  const Json all = Json::parse(kRecipes.json)[kRecipes.key];
  std::vector<std::string> ids;
  for (const auto& item : all.items()) ids.push_back(item.key());
  return ids;
}

std::string applyRecipe(const std::string& id, ToolpathParams& params) { return Reader::apply(kRecipes, id, params); }

std::string applyPreset(PresetKind kind, const std::string& id, Printer& printer) {
  return Reader::apply(kind == PresetKind::Printer ? kPrinters : kFilaments, id, printer);
}

}  // namespace sillon
