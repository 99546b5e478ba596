// What every re-brushed file promises, seen from outside.
#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sillon/gcode_reader/check.hpp"
#include "sillon/rebrush/rebrush.hpp"

namespace rebrushed {

using namespace sillon;
using doctest::Approx;

inline std::string number(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

/// One direction everywhere.
inline RebrushOptions options(double degrees) {
  RebrushOptions out;
  out.project.layers.emplace_back().as<LayerAngle>()->angle = degrees;
  out.read = [](const std::string& name, const std::string& /*what*/) -> Result<InputFile> {
    return Error{ErrorCode::InvalidFile, "there is no " + name};
  };
  return out;
}

/// A picture of directions or pictures as the only layer. \param contents  whose files are all this image
inline RebrushOptions options(LayerContents contents, Image image) {
  RebrushOptions out;
  out.project.layers.emplace_back().contents = std::move(contents);
  out.read = [image = std::move(image)](const std::string& /*name*/, const std::string& /*what*/) {
    return Result<InputFile>(InputFile(image));
  };
  return out;
}

/// A picture of directions, from -90 to 90 degrees.
inline RebrushOptions mapped(Image image) {
  MapLayer map;
  map.file = "map";
  return options(map, std::move(image));
}

inline std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

/// An interpreter of its own: total filament pushed by moves in the plane, and the state at the end.
struct Ran {
  double laid = 0;
  double e = 0;
  double net = 0;  // pushed less pulled, all moves
  double z = 0;
  Vec2 at;
  double feed = 0;
  int tool = 0;
  std::string fan;
};
inline Ran ranThrough(const std::string& text) {
  Ran ran;
  bool absolute = false;
  for (std::string line : lines(text)) {
    line = line.substr(0, line.find(';'));
    std::istringstream in(line);
    std::string head;
    in >> head;
    if (head == "M82" || head == "M83") absolute = head == "M82";
    if (head == "M106" || head == "M107") ran.fan = line;
    double x = ran.at.x;
    double y = ran.at.y;
    double e = absolute ? ran.e : 0;
    for (std::string word; in >> word;) {
      const double value = std::atof(word.c_str() + 1);
      if (word[0] == 'X') x = value;
      if (word[0] == 'Y') y = value;
      if (word[0] == 'Z' && head == "G1") ran.z = value;
      if (word[0] == 'E') e = value;
      if (word[0] == 'F') ran.feed = value;
    }
    if (head == "G92") ran.e = e;
    if (head != "G0" && head != "G1" && head != "G2" && head != "G3") continue;
    const double push = absolute ? e - ran.e : e;
    if ((x != ran.at.x || y != ran.at.y) && push > 0) ran.laid += push;
    ran.net += push;
    ran.e = absolute ? e : ran.e + push;
    ran.at = {x, y};
  }
  return ran;
}

inline bool isTotal(const std::string& line) {
  return line.starts_with("M73 ") || line.starts_with(";TIME") || line.find("printing time") != std::string::npos;
}

/// Without digits, points and the units of durations that come and go.
inline std::string wordsIn(const std::string& line) {
  std::string words;
  for (const char c : line) {
    if (std::string("0123456789. dhms").find(c) == std::string::npos) words += c;
  }
  return words;
}

/// A move without its X and Y.
inline std::string withoutPlace(const std::string& line) {
  std::istringstream in(line);
  std::string words;
  for (std::string word; in >> word;) {
    if (word[0] != 'X' && word[0] != 'Y') words += word + " ";
  }
  return words;
}

/// Everything that a rewritten file promises, seen from outside.
/// \param travels  a travel follows the last surface: else nothing tells where the nozzle must be.
inline void checkKept(const std::string& before, const Rebrushed& done, bool travels = true) {
  const std::string after = withEdits(before, done.edits);
  // Lines outside the replaced ones are the same, but for X and Y of wipes.
  const std::vector<std::string> old = lines(before);
  const std::vector<std::string> fresh = lines(after);
  std::set<std::size_t> gone;
  for (const RebrushedSurface& made : done.surfaces) {
    const SlicedSurface& surface = done.file.surfaces[made.surface];
    for (std::int64_t k = surface.firstLine; made.replaced && k <= surface.lastLine; ++k)
      gone.insert(static_cast<std::size_t>(k - 1));
  }
  REQUIRE_FALSE(gone.empty());
  std::size_t at = 0;  // in the new file
  int wipes = 0;
  std::int64_t totals = 0;
  bool inside = false;
  for (std::size_t k = 0; k < old.size(); ++k) {
    if (gone.count(k) != 0) {
      inside = true;
      continue;
    }
    if (inside) {  // look for where the old file goes on
      // A wipe goes elsewhere now, and a time is another.
      const auto told = [](const std::string& line) { return isTotal(line) ? wordsIn(line) : withoutPlace(line); };
      const std::string next = told(old[k]);
      std::size_t found = at;
      // A line that the new beads repeat is not the one: the rest behind it must fit as well.
      const auto fits = [&](std::size_t place) {
        for (std::size_t j = 0; j < 4 && k + j < old.size() && gone.count(k + j) == 0; ++j) {
          if (place + j >= fresh.size() || fresh[place + j].substr(0, 3) != old[k + j].substr(0, 3)) return false;
        }
        return told(fresh[place]) == next;
      };
      while (found < fresh.size() && !fits(found)) ++found;
      REQUIRE(found < fresh.size());
      at = found;
      inside = false;
    }
    REQUIRE(at < fresh.size());
    if (fresh[at] != old[k] && isTotal(old[k])) {
      // Other figures in the same words.
      CHECK(wordsIn(fresh[at]) == wordsIn(old[k]));
      ++totals;
      ++at;
      continue;
    }
    if (fresh[at] != old[k]) {
      CAPTURE(old[k]);
      CAPTURE(fresh[at]);
      ++wipes;
      CHECK(old[k].starts_with("G1 X"));
      CHECK(withoutPlace(fresh[at]) == withoutPlace(old[k]));
    }
    ++at;
  }
  CHECK(at == fresh.size());
  CHECK(wipes <= 40);
  CHECK(totals <= done.totals);  // some may stand within a replaced block
  for (const std::string& line : fresh) CHECK_FALSE((line.starts_with("G1") && (line + " ").find(" F0 ") != line.npos));
  const Ran a = ranThrough(before);
  const Ran b = ranThrough(after);
  CHECK(b.laid == Approx(a.laid).epsilon(1e-4));
  CHECK(b.net == Approx(a.net).epsilon(1e-4));
  CHECK(b.e == Approx(a.e).epsilon(1e-4));
  CHECK(b.z == a.z);
  if (travels) CHECK((b.at == a.at));
  CHECK(b.feed == a.feed);
  CHECK(b.fan == a.fan);
  CHECK(checkGcode(after).errors() <= checkGcode(before).errors());
  for (const RebrushedSurface& made : done.surfaces) {
    if (!made.replaced) continue;
    const SlicedSurface& surface = done.file.surfaces[made.surface];
    CHECK(made.volumeMm3 == Approx(surface.volumeMm3).epsilon(0.001));
    CHECK(made.coverage >= 98.45);
    CHECK(made.spill <= 0.5);
    CHECK(made.beyond <= 0.05);
  }
}

}  // namespace rebrushed
