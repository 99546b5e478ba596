// Converts between JavaScript values and core's plain data. Everything is copied; nothing points into the engine's
// memory.
#pragma once

#include <emscripten/val.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/refused.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/base/words.hpp"
#include "sillon/gcode/writer.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/look/inversion.hpp"
#include "sillon/look/preview.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/printer_import/printer_import.hpp"
#include "sillon/project/project.hpp"
#include "sillon/report/warning.hpp"

namespace sillon::bindings {

using emscripten::val;

/// Copies numbers to a typed array of their own, because a view on shared memory can neither be transferred nor become
/// a Blob.
template <class T>
val copied(const T* data, std::size_t count) {
  return val(emscripten::typed_memory_view(count, data)).template call<val>("slice");
}

/// Copies a text's bytes to a Uint8Array.
inline val copied(std::string_view bytes) {
  return copied(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

/// Copies the elements of a typed array into the engine's memory.
template <class T>
std::vector<T> numbers(const val& array) {
  const auto count = array["length"].as<std::size_t>();
  std::vector<T> out(count);
  if (count > 0) val(emscripten::typed_memory_view(count, out.data())).call<void>("set", array);
  return out;
}

/// Copies the bytes of a typed array into the engine's memory.
inline std::string bytes(const val& array) {
  const auto count = array["length"].as<std::size_t>();
  std::string out(count, '\0');
  if (count > 0) {
    val(emscripten::typed_memory_view(count, reinterpret_cast<std::uint8_t*>(out.data()))).call<void>("set", array);
  }
  return out;
}

inline val toJs(std::string_view text) { return val(std::string(text)); }

/// Makes a list of what a function makes of each item.
template <class Items, class Convert>
val listOf(const Items& items, const Convert& convert) {
  val out = val::array();
  for (const auto& item : items) out.call<void>("push", convert(item));
  return out;
}
/// Makes a list of numbers or texts.
template <class Items>
val listOf(const Items& items) {
  return listOf(items, [](const auto& item) { return item; });
}
inline val toJs(Vec2 v) { return listOf(std::array{v.x, v.y}); }

/// A member of an object.
struct Member {
  Member(const char* named, val what) : name(named), value(std::move(what)) {}
  Member(const char* named, std::string_view text) : Member(named, toJs(text)) {}
  Member(const char* named, const char* text) : Member(named, std::string_view(text)) {}
  Member(const char* named, const std::string& text) : Member(named, std::string_view(text)) {}
  Member(const char* named, bool yes) : Member(named, val(yes)) {}
  Member(const char* named, int number) : Member(named, val(number)) {}
  Member(const char* named, double number) : Member(named, val(number)) {}

  const char* name;
  val value;
};

inline val object(std::initializer_list<Member> members) {
  val out = val::object();
  for (const Member& member : members) out.set(member.name, member.value);
  return out;
}

/// Makes an object of pairs of a name and a text.
template <class Values>
val textsOf(const Values& values) {
  val out = val::object();
  for (const auto& [name, text] : values) out.set(name, val(text));
  return out;
}

inline val toJs(const ImportNote& note) {
  return object({{"code", note.code}, {"values", textsOf(note.values)}, {"message", note.message}});
}

/// Converts a shape; rings become Float64Arrays of x and y in turn.
inline val toJs(const Shape& shape) {
  const auto ringOf = [](const Ring& ring) {
    return copied(reinterpret_cast<const double*>(ring.data()), 2 * ring.size());
  };
  const auto pathOf = [&](const FilledPath& path) {
    return object({{"fillRule", path.fillRule == FillRule::EvenOdd ? "evenodd" : "nonzero"},
                   {"rings", listOf(path.rings, ringOf)}});
  };
  val out = object({{"page", toJs(shape.page)},
                    {"paths", listOf(shape.paths, pathOf)},
                    {"texts", shape.drawing.texts},
                    {"otherFont", shape.drawing.otherFont},
                    {"images", shape.drawing.images},
                    {"offPage", shape.drawing.offPage},
                    {"unpainted", shape.drawing.unpainted}});
  if (!shape.kept.empty()) {
    out.set("kept", listOf(shape.kept, [](const ThinPlace& place) {
              return listOf(std::array{place.at.x, place.at.y, place.areaMm2, place.width});
            }));
  }
  return out;
}

/// Converts back a shape, without the facts of its drawing.
inline Shape shapeFrom(const val& js) {
  Shape shape;
  shape.page = {js["page"][0].as<double>(), js["page"][1].as<double>()};
  const val paths = js["paths"];
  const auto count = paths["length"].as<int>();
  for (int k = 0; k < count; ++k) {
    FilledPath path;
    path.fillRule = paths[k]["fillRule"].as<std::string>() == "evenodd" ? FillRule::EvenOdd : FillRule::NonZero;
    const val rings = paths[k]["rings"];
    const auto ringCount = rings["length"].as<int>();
    for (int r = 0; r < ringCount; ++r) {
      const std::vector<double> flat = numbers<double>(rings[r]);
      Ring ring(flat.size() / 2);
      for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = {flat[2 * i], flat[2 * i + 1]};
      path.rings.push_back(std::move(ring));
    }
    shape.paths.push_back(std::move(path));
  }
  return shape;
}

/// Converts a toolpath, without shape and notes, which are not part of core's toolpath.
inline val toJs(const Toolpath& toolpath) {
  const auto cycleOf = [](const Cycle& cycle) {
    return object({{"points", copied(reinterpret_cast<const float*>(cycle.points.data()), 2 * cycle.points.size())},
                   {"widths", copied(cycle.widths.data(), cycle.widths.size())}});
  };
  return object({{"spacing", toolpath.spacing}, {"cycles", listOf(toolpath.cycles, cycleOf)}});
}

/// Converts back the beads of a toolpath.
inline std::vector<Cycle> cyclesFrom(const val& js) {
  std::vector<Cycle> cycles;
  const auto count = js["length"].as<int>();
  for (int k = 0; k < count; ++k) {
    Cycle cycle;
    const std::vector<float> flat = numbers<float>(js[k]["points"]);
    cycle.points.resize(flat.size() / 2);
    for (std::size_t i = 0; i < cycle.points.size(); ++i) cycle.points[i] = {flat[2 * i], flat[2 * i + 1]};
    cycle.widths = numbers<float>(js[k]["widths"]);
    cycles.push_back(std::move(cycle));
  }
  return cycles;
}

/// Returns Toolpath.look, the look of a plate with pictures.
inline val toJs(const Project& project, const PlatePictures& pictures) {
  const LookParams look = lookOf(project, pictures, 0);
  const auto lampOf = [](const ShownPicture& shown) { return toJs(Vec2{shown.lamp.azimuth, shown.lamp.elevation}); };
  return object({{"colour", listOf(look.colour, [](int channel) { return channel; })},
                 {"slopes", toJs(Vec2{look.roughness.along, look.roughness.across})},
                 {"lampSize", look.lamp.slope},
                 {"lamps", listOf(pictures.shown, lampOf)}});
}

/// Returns Plate.conflict, the tones that several pictures take from each other.
inline val conflictOf(const PlateInput& input, const PlatePictures& pictures) {
  const PictureConflict conflict =
      sillon::conflictOf(input.directions, pictures.shown, pictures.roughness, pictures.level);
  const auto percents = [](const std::vector<float>& of) {
    std::vector<std::int8_t> percent;
    percent.reserve(of.size());
    for (const float off : of) percent.push_back(static_cast<std::int8_t>(std::lround(100 * off)));
    return copied(percent.data(), percent.size());
  };
  return object(
      {{"width", conflict.width}, {"height", conflict.height}, {"missing", listOf(conflict.missing, percents)}});
}

/// Reads a look under its first lamp; undefined gives the default look of plates.
inline LookParams lookFrom(const val& js) {
  LookParams look;
  if (js.isUndefined()) return look;
  for (std::size_t k = 0; k < 3; ++k) look.colour[k] = js["colour"][k].as<std::uint8_t>();
  look.roughness = {js["slopes"][0].as<double>(), js["slopes"][1].as<double>()};
  look.lamp = {js["lamps"][0][0].as<double>(), js["lamps"][0][1].as<double>(), js["lampSize"].as<double>()};
  look.eyeDistance = 0;
  return look;
}

inline val toJs(const Image& image) {
  return object({{"width", image.width},
                 {"height", image.height},
                 {"channels", image.channels},
                 {"samples", copied(image.samples.data(), image.samples.size())}});
}

/// Converts a picture of 8 or 16 bits after checking its sizes. \param name  name for messages.
inline Result<Image> imageFrom(const val& js, const std::string& name) {
  const auto width = js["width"].as<double>();
  const auto height = js["height"].as<double>();
  const auto channels = js["channels"].as<double>();
  const auto length = js["samples"]["length"].as<double>();
  const auto whole = [](double v, double low, double high) {
    return v >= low && v <= high && v == static_cast<double>(static_cast<int>(v));
  };
  const bool sized = whole(width, 1, kMaxImageSide) && whole(height, 1, kMaxImageSide) && whole(channels, 1, 4) &&
                     width * height <= static_cast<double>(kMaxImagePixels);
  if (!sized || length != width * height * channels) {
    return refusedArgument("SamplesUnlikeSides", {{"name", name}, {"side", kMaxImageSide}, {"millions", 100}});
  }
  Image image{static_cast<int>(width), static_cast<int>(height), static_cast<int>(channels), {}};
  if (js["samples"]["BYTES_PER_ELEMENT"].as<int>() == 2) {
    image.samples = numbers<std::uint16_t>(js["samples"]);
  } else {
    const std::string narrow = bytes(js["samples"]);
    image.samples.reserve(narrow.size());
    for (const char c : narrow) {
      image.samples.push_back(static_cast<std::uint16_t>(static_cast<unsigned char>(c) * 257));
    }
  }
  return image;
}

/// Makes a reader of files by their names; a file is bytes or a picture.
inline ReadInput reader(const val& files) {
  return [files](const std::string& name, const std::string& /*what*/) -> Result<InputFile> {
    const val file = files[name];
    if (file.isUndefined() || file.isNull()) {
      return refusedArgument("FileNotGiven", {{"file", inQuotes(name)}});
    }
    if (file["samples"].isUndefined()) {
      std::string content = bytes(file);
      if (content.empty()) {
        return refusedFile("FileEmpty", {{"file", inQuotes(name)}});
      }
      return InputFile(std::move(content));
    }
    Result<Image> image = imageFrom(file, inQuotes(name));
    if (!image) return image.error();
    return InputFile(std::move(image).value());
  };
}

inline val toJs(const std::vector<NamedValue>& list) {
  val values = val::object();
  for (const NamedValue& value : list) {
    values.set(value.name, value.text.empty() ? val(value.number) : val(value.text));
  }
  return values;
}

inline val toJs(const InputNote& note) {
  return object({{"code", note.code}, {"values", toJs(note.values)}, {"message", note.message}});
}

inline val toJs(const Warning& warning) {
  return object({{"code", warningName(warning.code)}, {"values", toJs(warning.values)}, {"message", warning.message}});
}

inline val toJs(const GcodeFinding& finding) {
  return object({{"code", finding.code},
                 {"rule", finding.rule},
                 {"error", finding.error},
                 {"line", static_cast<double>(finding.line)},
                 {"count", static_cast<double>(finding.count)},
                 {"values", textsOf(finding.values)},
                 {"message", finding.message}});
}

/// Converts a list of notes, warnings or findings.
template <class Told>
val toJs(const std::vector<Told>& list) {
  return listOf(list, [](const Told& one) { return toJs(one); });
}

inline val toJs(const GcodeSummary& summary) {
  return object({{"filamentMm", summary.filamentMm},
                 {"filamentCm3", summary.filamentCm3},
                 {"filamentGrams", summary.filamentGrams},
                 {"seconds", summary.seconds},
                 {"moves", static_cast<double>(summary.moves)},
                 {"bytes", static_cast<double>(summary.bytes)},
                 {"clampedLengthMm", summary.clampedLengthMm},
                 {"curveSlowedMm", summary.curveSlowedMm},
                 {"warnings", toJs(summary.warnings)}});
}

/// Converts a check. \param unchecked  result of uncheckedIn()
inline val toJs(const GcodeCheck& check, const std::vector<std::string>& unchecked = {}) {
  const auto numberOf = [](std::int64_t count) { return static_cast<double>(count); };
  val box = val::null();
  if (!check.box.empty()) box = object({{"min", toJs(check.box.min)}, {"max", toJs(check.box.max)}});
  val delay = val::null();
  if (check.delay) {
    delay = object({{"over30", check.delay->over30},
                    {"over120", check.delay->over120},
                    {"most", check.delay->most},
                    {"squeezed", check.delay->squeezed}});
  }
  return object(
      {{"findings", toJs(check.findings)},
       {"unchecked", listOf(unchecked)},
       {"errors", numberOf(check.errors())},
       {"lines", numberOf(check.lines)},
       {"moves", numberOf(check.moves)},
       {"layers", check.layers},
       {"filamentMm", check.filamentMm},
       {"pathMm", check.pathMm},
       {"travelMm", check.travelMm},
       {"closed", numberOf(check.closed)},
       {"open", numberOf(check.open)},
       {"retractions", numberOf(check.retractions)},
       {"fastest", check.fastest},
       {"slowedMm", check.slowedMm},
       {"mostFlow", check.mostFlow},
       {"mostMoves", check.mostMoves},
       {"printer", check.printer},
       {"box", box},
       {"top", check.top},
       {"coverage", listOf(check.coverage, [](double share) { return share < 0 ? val::null() : val(share); })},
       {"neighbourDelay", delay}});
}

inline const char* codeName(ErrorCode code) {
  constexpr const char* kNames[] = {"InvalidArgument", "InvalidFile", "TooLarge",  "OutOfMemory",
                                    "EmptyShape",      "DoesNotFit",  "Cancelled", "Internal"};
  return kNames[toSize(code)];
}

/// Makes {error: {code, message, reason, values}}.
inline val failure(const char* code, const std::string& message, const char* reason = "",
                   const std::vector<NamedValue>& values = {}) {
  val error = object({{"code", code}, {"message", message}, {"reason", reason}, {"values", toJs(values)}});
  return object({{"error", error}});
}
inline val failure(const Error& error) {
  return failure(codeName(error.code), error.message, error.reason, error.values);
}

/// Makes {value}.
inline val success(const val& value) { return object({{"value", value}}); }

}  // namespace sillon::bindings
