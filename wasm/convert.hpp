// Converts between JavaScript values and core's plain data. Everything is copied; nothing points into the engine's
// memory.
#pragma once

#include <emscripten/val.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/refused.hpp"
#include "sillon/base/result.hpp"
#include "sillon/base/types.hpp"
#include "sillon/base/words.hpp"
#include "sillon/gcode/writer.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/look/conflict.hpp"
#include "sillon/look/preview.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/printer_import/printer_import.hpp"
#include "sillon/project/project.hpp"
#include "sillon/report/input_note.hpp"
#include "sillon/report/warning.hpp"

namespace convert {

using emscripten::val;

/// Copies numbers to a typed array of their own, because a view on shared memory can neither be transferred nor become
/// a Blob.
template <class T>
val copied(const T* data, std::size_t count) {
  return val(emscripten::typed_memory_view(count, data)).template call<val>("slice");
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
inline val toJs(sillon::Vec2 v) {
  val pair = val::array();
  pair.set(0, v.x);
  pair.set(1, v.y);
  return pair;
}

inline val toJs(const sillon::ImportNote& note) {
  val values = val::object();
  for (const auto& [name, value] : note.values) values.set(name, val(value));
  val out = val::object();
  out.set("code", val(note.code));
  out.set("values", values);
  out.set("message", val(note.message));
  return out;
}

/// Converts a shape; rings become Float64Arrays of x and y in turn.
inline val toJs(const sillon::Shape& shape) {
  val paths = val::array();
  for (const sillon::FilledPath& path : shape.paths) {
    val rings = val::array();
    for (const sillon::Ring& ring : path.rings) {
      rings.call<void>("push", copied(reinterpret_cast<const double*>(ring.data()), 2 * ring.size()));
    }
    val out = val::object();
    out.set("fillRule", toJs(path.fillRule == sillon::FillRule::EvenOdd ? "evenodd" : "nonzero"));
    out.set("rings", rings);
    paths.call<void>("push", out);
  }
  val out = val::object();
  out.set("page", toJs(shape.page));
  out.set("paths", paths);
  out.set("texts", shape.drawing.texts);
  out.set("otherFont", shape.drawing.otherFont);
  out.set("images", shape.drawing.images);
  out.set("offPage", shape.drawing.offPage);
  out.set("unpainted", shape.drawing.unpainted);
  if (!shape.kept.empty()) {
    val kept = val::array();
    for (const sillon::ThinPlace& place : shape.kept) {
      val numbers = val::array();
      for (const double number : {place.at.x, place.at.y, place.areaMm2, place.width})
        numbers.call<void>("push", number);
      kept.call<void>("push", numbers);
    }
    out.set("kept", kept);
  }
  return out;
}

/// Converts back a shape, without the facts of its drawing.
inline sillon::Shape shapeFrom(const val& js) {
  sillon::Shape shape;
  shape.page = {js["page"][0].as<double>(), js["page"][1].as<double>()};
  const val paths = js["paths"];
  const auto count = paths["length"].as<int>();
  for (int k = 0; k < count; ++k) {
    sillon::FilledPath path;
    path.fillRule =
        paths[k]["fillRule"].as<std::string>() == "evenodd" ? sillon::FillRule::EvenOdd : sillon::FillRule::NonZero;
    const val rings = paths[k]["rings"];
    const auto ringCount = rings["length"].as<int>();
    for (int r = 0; r < ringCount; ++r) {
      const std::vector<double> flat = numbers<double>(rings[r]);
      sillon::Ring ring(flat.size() / 2);
      for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = {flat[2 * i], flat[2 * i + 1]};
      path.rings.push_back(std::move(ring));
    }
    shape.paths.push_back(std::move(path));
  }
  return shape;
}

/// Converts a toolpath, without shape and notes, which are not part of core's toolpath.
inline val toJs(const sillon::Toolpath& toolpath) {
  val cycles = val::array();
  for (const sillon::Cycle& cycle : toolpath.cycles) {
    val out = val::object();
    out.set("points", copied(reinterpret_cast<const float*>(cycle.points.data()), 2 * cycle.points.size()));
    out.set("widths", copied(cycle.widths.data(), cycle.widths.size()));
    cycles.call<void>("push", out);
  }
  val out = val::object();
  out.set("spacing", toolpath.spacing);
  out.set("cycles", cycles);
  return out;
}

/// Converts back the beads of a toolpath.
inline std::vector<sillon::Cycle> cyclesFrom(const val& js) {
  std::vector<sillon::Cycle> cycles;
  const auto count = js["length"].as<int>();
  for (int k = 0; k < count; ++k) {
    sillon::Cycle cycle;
    const std::vector<float> flat = numbers<float>(js[k]["points"]);
    cycle.points.resize(flat.size() / 2);
    for (std::size_t i = 0; i < cycle.points.size(); ++i) cycle.points[i] = {flat[2 * i], flat[2 * i + 1]};
    cycle.widths = numbers<float>(js[k]["widths"]);
    cycles.push_back(std::move(cycle));
  }
  return cycles;
}

/// Returns Toolpath.look, the look of a plate with pictures.
inline val toJs(const sillon::Project& project, const sillon::PlatePictures& pictures) {
  const sillon::LookParams look = sillon::lookOf(project, pictures, 0);
  val colour = val::array();
  for (const int channel : look.colour) colour.call<void>("push", channel);
  val lamps = val::array();
  for (const sillon::ShownPicture& shown : pictures.shown) {
    lamps.call<void>("push", toJs(sillon::Vec2{shown.lamp.azimuth, shown.lamp.elevation}));
  }
  val out = val::object();
  out.set("colour", colour);
  out.set("slopes", toJs(sillon::Vec2{look.roughness.along, look.roughness.across}));
  out.set("lampSize", look.lamp.slope);
  out.set("lamps", lamps);
  return out;
}

/// Returns Plate.conflict, the tones that several pictures take from each other.
inline val conflictOf(const sillon::PlateInput& input, const sillon::PlatePictures& pictures) {
  const sillon::PictureConflict conflict =
      sillon::conflictOf(input.directions, pictures.shown, pictures.roughness, pictures.level);
  val missing = val::array();
  for (const std::vector<float>& of : conflict.missing) {
    std::vector<std::int8_t> percent;
    percent.reserve(of.size());
    for (const float off : of) percent.push_back(static_cast<std::int8_t>(std::lround(100 * off)));
    missing.call<void>("push", copied(percent.data(), percent.size()));
  }
  val out = val::object();
  out.set("width", conflict.width);
  out.set("height", conflict.height);
  out.set("missing", missing);
  return out;
}

/// Reads a look under its first lamp; undefined gives the default look of plates.
inline sillon::LookParams lookFrom(const val& js) {
  sillon::LookParams look;
  if (js.isUndefined()) return look;
  for (std::size_t k = 0; k < 3; ++k) look.colour[k] = js["colour"][k].as<std::uint8_t>();
  look.roughness = {js["slopes"][0].as<double>(), js["slopes"][1].as<double>()};
  look.lamp = {js["lamps"][0][0].as<double>(), js["lamps"][0][1].as<double>(), js["lampSize"].as<double>()};
  look.eyeDistance = 0;
  return look;
}

inline val toJs(const sillon::Image& image) {
  val out = val::object();
  out.set("width", image.width);
  out.set("height", image.height);
  out.set("channels", image.channels);
  out.set("samples", copied(image.samples.data(), image.samples.size()));
  return out;
}

/// Converts a picture of 8 or 16 bits after checking its sizes. \param name  name for messages.
inline sillon::Result<sillon::Image> imageFrom(const val& js, const std::string& name) {
  const auto width = js["width"].as<double>();
  const auto height = js["height"].as<double>();
  const auto channels = js["channels"].as<double>();
  const auto length = js["samples"]["length"].as<double>();
  const auto whole = [](double v, double low, double high) {
    return v >= low && v <= high && v == static_cast<double>(static_cast<int>(v));
  };
  const bool sized = whole(width, 1, sillon::kMaxImageSide) && whole(height, 1, sillon::kMaxImageSide) &&
                     whole(channels, 1, 4) && width * height <= static_cast<double>(sillon::kMaxImagePixels);
  if (!sized || length != width * height * channels) {
    return sillon::refusedArgument("SamplesUnlikeSides",
                                   {{"name", name}, {"side", sillon::kMaxImageSide}, {"millions", 100}});
  }
  sillon::Image image{static_cast<int>(width), static_cast<int>(height), static_cast<int>(channels), {}};
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
inline sillon::ReadInput reader(const val& files) {
  return [files](const std::string& name, const std::string& /*what*/) -> sillon::Result<sillon::InputFile> {
    const val file = files[name];
    if (file.isUndefined() || file.isNull()) {
      return sillon::refusedArgument("FileNotGiven", {{"file", sillon::inQuotes(name)}});
    }
    if (file["samples"].isUndefined()) {
      std::string content = bytes(file);
      if (content.empty()) {
        return sillon::refusedFile("FileEmpty", {{"file", sillon::inQuotes(name)}});
      }
      return sillon::InputFile(std::move(content));
    }
    sillon::Result<sillon::Image> image = imageFrom(file, sillon::inQuotes(name));
    if (!image) return image.error();
    return sillon::InputFile(std::move(image).value());
  };
}

inline val toJs(const std::vector<sillon::NamedValue>& list) {
  val values = val::object();
  for (const sillon::NamedValue& value : list) {
    values.set(value.name, value.text.empty() ? val(value.number) : val(value.text));
  }
  return values;
}

inline val toJs(const sillon::InputNote& note) {
  val out = val::object();
  out.set("code", val(note.code));
  out.set("values", toJs(note.values));
  out.set("message", val(note.message));
  return out;
}

inline val toJs(const sillon::Warning& warning) {
  val out = val::object();
  out.set("code", val(sillon::warningName(warning.code)));
  out.set("values", toJs(warning.values));
  out.set("message", val(warning.message));
  return out;
}

/// Converts a list of notes or warnings.
template <class Told>
val toJs(const std::vector<Told>& list) {
  val out = val::array();
  for (const Told& one : list) out.call<void>("push", toJs(one));
  return out;
}

inline val toJs(const sillon::GcodeSummary& summary) {
  val out = val::object();
  out.set("filamentMm", summary.filamentMm);
  out.set("filamentCm3", summary.filamentCm3);
  out.set("filamentGrams", summary.filamentGrams);
  out.set("seconds", summary.seconds);
  out.set("moves", static_cast<double>(summary.moves));
  out.set("bytes", static_cast<double>(summary.bytes));
  out.set("clampedLengthMm", summary.clampedLengthMm);
  out.set("curveSlowedMm", summary.curveSlowedMm);
  out.set("warnings", toJs(summary.warnings));
  return out;
}

/// Converts findings.
inline val toJs(const std::vector<sillon::GcodeFinding>& list) {
  val findings = val::array();
  for (const sillon::GcodeFinding& finding : list) {
    val out = val::object();
    val values = val::object();
    for (const auto& [name, value] : finding.values) values.set(name, val(value));
    out.set("code", val(finding.code));
    out.set("rule", val(finding.rule));
    out.set("error", finding.error);
    out.set("line", static_cast<double>(finding.line));
    out.set("count", static_cast<double>(finding.count));
    out.set("values", values);
    out.set("message", val(finding.message));
    findings.call<void>("push", out);
  }
  return findings;
}

/// Converts a check. \param unchecked  result of uncheckedIn()
inline val toJs(const sillon::GcodeCheck& check, const std::vector<std::string>& unchecked = {}) {
  val out = val::object();
  out.set("findings", toJs(check.findings));
  val names = val::array();
  for (const std::string& name : unchecked) names.call<void>("push", val(name));
  out.set("unchecked", names);
  out.set("errors", static_cast<double>(check.errors()));
  out.set("lines", static_cast<double>(check.lines));
  out.set("moves", static_cast<double>(check.moves));
  out.set("layers", check.layers);
  out.set("filamentMm", check.filamentMm);
  out.set("pathMm", check.pathMm);
  out.set("travelMm", check.travelMm);
  out.set("closed", static_cast<double>(check.closed));
  out.set("open", static_cast<double>(check.open));
  out.set("retractions", static_cast<double>(check.retractions));
  out.set("fastest", check.fastest);
  out.set("slowedMm", check.slowedMm);
  out.set("mostFlow", check.mostFlow);
  out.set("mostMoves", check.mostMoves);
  out.set("printer", val(check.printer));
  out.set("box", val::null());
  if (!check.box.empty()) {
    val box = val::object();
    box.set("min", toJs(check.box.min));
    box.set("max", toJs(check.box.max));
    out.set("box", box);
  }
  out.set("top", check.top);
  val coverage = val::array();
  for (const double share : check.coverage) coverage.call<void>("push", share < 0 ? val::null() : val(share));
  out.set("coverage", coverage);
  val delay = val::null();
  if (check.delay) {
    delay = val::object();
    delay.set("over30", check.delay->over30);
    delay.set("over120", check.delay->over120);
    delay.set("most", check.delay->most);
    delay.set("squeezed", check.delay->squeezed);
  }
  out.set("neighbourDelay", delay);
  return out;
}

inline const char* codeName(sillon::ErrorCode code) {
  switch (code) {
    case sillon::ErrorCode::InvalidArgument:
      return "InvalidArgument";
    case sillon::ErrorCode::InvalidFile:
      return "InvalidFile";
    case sillon::ErrorCode::TooLarge:
      return "TooLarge";
    case sillon::ErrorCode::OutOfMemory:
      return "OutOfMemory";
    case sillon::ErrorCode::EmptyShape:
      return "EmptyShape";
    case sillon::ErrorCode::DoesNotFit:
      return "DoesNotFit";
    case sillon::ErrorCode::Cancelled:
      return "Cancelled";
    case sillon::ErrorCode::Internal:
      break;
  }
  return "Internal";
}

/// Makes {error: {code, message, reason, values}}.
inline val failure(const char* code, const std::string& message, const char* reason = "",
                   const std::vector<sillon::NamedValue>& values = {}) {
  val error = val::object();
  error.set("code", toJs(code));
  error.set("message", val(message));
  error.set("reason", toJs(reason));
  error.set("values", toJs(values));
  val out = val::object();
  out.set("error", error);
  return out;
}
inline val failure(const sillon::Error& error) {
  return failure(codeName(error.code), error.message, error.reason, error.values);
}

/// Makes {value}.
inline val success(const val& value) {
  val out = val::object();
  out.set("value", value);
  return out;
}

}  // namespace convert
