// Reads our own G-code path by path, for tests that look at single moves; sillon/gcode_reader/check.hpp judges any
// file.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "gcode_reader/parser.hpp"

namespace sillon::test {

inline std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

/// The first line that breaks the grammar, or an empty string.
inline std::string grammarError(std::string_view text) {
  if (text.empty() || text.back() != '\n') return "no final newline";
  text.remove_suffix(1);
  for (const std::string_view line : split(text, '\n')) {
    if (line.starts_with("EXCLUDE_OBJECT_DEFINE ")) continue;  // its polygon is Klipper's own grammar
    if (const char* fault = lineFault(line); fault != nullptr) return std::string(line) + " " + fault;
  }
  return {};
}

/// One G1 that moves in X and Y. Coordinates as printed.
struct ReadMove {
  std::int64_t x0, y0, x1, y1, z;  // [µm]
  std::int64_t e;                  // [0.00001 mm]
  std::int64_t feedrate;           // [mm/min]
  bool extrudes;
  bool retracted;
  [[nodiscard]] double length() const { return std::hypot(double(x1 - x0), double(y1 - y0)) / 1000; }
};

/// Consecutive extruding moves, from a prime to a retraction.
struct ReadPath {
  std::string role;
  int layer = 0;
  std::vector<ReadMove> moves;
  bool retractsAfter = false;
  [[nodiscard]] bool closed() const {
    return moves.front().x0 == moves.back().x1 && moves.front().y0 == moves.back().y1;
  }
  [[nodiscard]] double filament() const {
    std::int64_t sum = 0;
    for (const ReadMove& move : moves) sum += move.e;
    return double(sum) / 1e5;
  }
};

struct ReadFile {
  std::vector<ReadPath> paths;
  std::vector<ReadMove> travels;
  std::vector<ReadMove> wipes;      ///< that draw filament back
  std::vector<std::string> faults;  ///< broken rules of order
  std::int64_t moves = 0;
  int layers = 0;
  double minX = 1e30, minY = 1e30, maxX = -1e30, maxY = -1e30, maxZ = 0;  // [mm]
  double filament = 0;                                                    ///< of moves in X and Y [mm]
};

inline std::int64_t scaledWord(std::string_view word, double unit) {
  return std::llround(std::strtod(std::string(word.substr(1)).c_str(), nullptr) * unit);
}

inline ReadFile readGcode(std::string_view text) {
  ReadFile file;
  std::int64_t x = 0, y = 0, z = 0, feedrate = 0;
  bool homed = false, bedHot = false, nozzleHot = false, absolute = false, relativeE = false, millimetres = false;
  bool originE = false, retracted = false, inPath = false;
  std::string role;
  const auto fault = [&](const char* what, std::string_view line) {
    file.faults.push_back(std::string(what) + ": " + std::string(line));
  };
  for (const std::string_view line : split(text, '\n')) {
    if (line.starts_with(";TYPE:")) role = line.substr(6);
    if (line == ";LAYER_CHANGE") ++file.layers;
    if (line.starts_with(";TYPE:") || line == ";LAYER_CHANGE") {
      if (inPath) fault("comment of structure inside a path", line);
    }
    if (line.empty() || line[0] == ';') continue;
    const std::vector<std::string_view> words = split(line, ' ');
    if (words[0] == "G28") homed = true;
    if (words[0] == "M190") bedHot = true;
    if (words[0] == "M109") nozzleHot = true;
    if (words[0] == "G21") millimetres = true;
    if (words[0] == "G90") absolute = true;
    if (words[0] == "M83") relativeE = true;
    if (words[0] == "G92") originE = line == "G92 E0";
    if (words[0] != "G1") continue;
    ++file.moves;
    if (!(homed && absolute && relativeE && millimetres && originE)) fault("move too early", line);
    const bool cold = !(bedHot && nozzleHot);
    ReadMove move{x, y, x, y, z, 0, 0, false, retracted};
    bool planar = false;
    for (std::size_t k = 1; k < words.size(); ++k) {
      const std::string_view word = words[k];
      const std::size_t dot = word.find('.');
      const std::size_t decimals = dot == std::string_view::npos ? 0 : word.size() - dot - 1;
      if (word[0] == 'F') {
        if (scaledWord(word, 1) == feedrate) fault("F repeated", line);
        feedrate = scaledWord(word, 1);
        if (decimals != 0 || feedrate <= 0) fault("F", line);
      } else if (word[0] == 'E') {
        move.e = scaledWord(word, 1e5);
        move.extrudes = true;
        if (decimals != 5) fault("digits", line);
      } else {
        const std::int64_t value = scaledWord(word, 1000);
        if (decimals != 3) fault("digits", line);
        if (word[0] == 'X') move.x1 = value, planar = true;
        if (word[0] == 'Y') move.y1 = value, planar = true;
        if (word[0] == 'Z') {
          if (words.size() > 3 || (words.size() == 3 && words[2][0] != 'F')) fault("diagonal", line);
          if (inPath) fault("Z inside a path", line);
          if (value == z) fault("Z repeated", line);
          z = value;
          file.maxZ = std::max(file.maxZ, double(z) / 1000);
        }
      }
    }
    move.z = z;
    move.feedrate = feedrate;
    if (feedrate == 0) fault("no F yet", line);
    x = move.x1;
    y = move.y1;
    if (planar) {
      file.minX = std::min(file.minX, double(x) / 1000);
      file.maxX = std::max(file.maxX, double(x) / 1000);
      file.minY = std::min(file.minY, double(y) / 1000);
      file.maxY = std::max(file.maxY, double(y) / 1000);
    }
    if (planar && move.extrudes && move.e < 0) {
      if (!inPath && file.wipes.empty()) fault("retraction out of place", line);
      if (!file.paths.empty()) file.paths.back().retractsAfter = true;
      retracted = true;
      inPath = false;
      file.wipes.push_back(move);
    } else if (planar && move.extrudes) {
      if (cold) fault("extrudes cold", line);
      if (retracted) fault("extrudes while retracted", line);
      if (!inPath) file.paths.push_back({role, file.layers, {}, false});
      inPath = true;
      file.paths.back().moves.push_back(move);
      file.filament += double(move.e) / 1e5;
    } else if (planar) {
      if (inPath) fault("travel inside a path", line);
      if (!retracted && !file.paths.empty()) fault("travel without retraction", line);
      file.travels.push_back(move);
    } else if (move.extrudes) {
      if (move.e < 0) {
        const bool begin = file.paths.empty() && file.layers == 0;  // what a start block left in the nozzle
        if ((!inPath && !begin) || retracted) fault("retraction out of place", line);
        if (!file.paths.empty()) file.paths.back().retractsAfter = true;
        retracted = true;
        inPath = false;
      } else {
        if (!retracted) fault("prime without retraction", line);
        retracted = false;
      }
    }
  }
  return file;
}

/// What follows a key such as "; filament used [mm] = ", or an empty string.
inline std::string valueOf(std::string_view text, std::string_view key) {
  const std::size_t at = text.find(key);
  if (at == std::string_view::npos) return {};
  const std::string_view rest = text.substr(at + key.size());
  return std::string(rest.substr(0, rest.find('\n')));
}

}  // namespace sillon::test
