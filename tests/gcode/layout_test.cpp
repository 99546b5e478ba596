#include "gcode/layout.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "sillon/gcode_reader/check.hpp"
#include "support/about.hpp"
#include "support/gcode_job.hpp"
#include "support/told_reason.hpp"

using namespace sillon;
using namespace sillon::test;
using doctest::Approx;

TEST_CASE("a plate shown from below has its mirrored path on the bed and its base above") {
  Job job = plate(30, 20, 1.3);
  job.params.layers = 2;
  Job mirrored = job;
  mirrored.params.mirror = true;
  const Written warned = mirrored.write();
  CHECK(contains(warned.result.value().warnings, "the plate is mirrored but shown from above"));
  const ReadFile flipped = checkFile(mirrored, warned);
  job.params.showSide = ShowSide::Bed;
  const Written written = job.write();
  CHECK_FALSE(contains(written.result.value().warnings, "mirrored"));
  const ReadFile file = checkFile(job, written);
  std::vector<std::string> roles;
  for (const ReadPath& path : file.paths) {
    if (roles.empty() || roles.back() != path.role) roles.push_back(path.role);
  }
  CHECK(roles == std::vector<std::string>{"Custom", "Skirt/Brim", "Top solid infill", "Solid infill"});
  const auto oriented = [](const ReadFile& read, int which) {
    for (const ReadPath& path : read.paths) {
      if (path.role == "Top solid infill" && which-- == 0) return path;
    }
    return ReadPath{};
  };
  for (int k = 0; k < 2; ++k) {
    const ReadPath a = oriented(file, k);
    const ReadPath b = oriented(flipped, k);
    REQUIRE(a.moves.size() == b.moves.size());
    // The layer that is seen begins where its path does, another one elsewhere.
    const auto ends = [](const ReadPath& path) {
      std::vector<std::pair<std::int64_t, std::int64_t>> all;
      for (const ReadMove& move : path.moves) all.emplace_back(move.x1, move.y1);
      std::sort(all.begin(), all.end());
      return all;
    };
    CHECK(ends(a) == ends(b));
  }
}

TEST_CASE("both sides show the plate where its shape is its own mirror image") {
  Job job = plate(30, 20, 1.3);
  job.params.showSide = ShowSide::Both;
  const Written written = job.write();
  REQUIRE(written.result.ok());
  CHECK(checkGcode(written.text, job.printer).errors() == 0);
  const ReadFile file = readGcode(written.text);
  CHECK(file.layers == 4);
  const ReadPath& top = lastPath(file);
  const auto below = std::find_if(file.paths.begin(), file.paths.end(),
                                  [](const ReadPath& path) { return path.role == "Top solid infill"; });
  CHECK(below->layer == 1);
  CHECK(top.layer == 4);
  REQUIRE(below->moves.size() == top.moves.size());
  std::vector<std::pair<std::int64_t, std::int64_t>> a;
  std::vector<std::pair<std::int64_t, std::int64_t>> b;
  for (const ReadMove& move : below->moves) a.emplace_back(220000 - move.x1, move.y1);
  for (const ReadMove& move : top.moves) b.emplace_back(move.x1, move.y1);
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  std::size_t far = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    far += std::abs(a[i].first - b[i].first) > 1 || std::abs(a[i].second - b[i].second) > 1;
  }
  CHECK(far == 0);

  job.shape.paths[0].rings[0] = {{0, 0}, {30, 0}, {30, 20}, {0, 20}};
  job.toolpath.cycles = {{{{1, 1}, {29, 1}, {29, 19}}, {0.4f, 0.4f, 0.4f}}};  // in a triangle
  job.shape.paths[0].rings[0] = {{0, 0}, {30, 0}, {30, 20}};
  const Error error = job.write().result.error();
  CHECK(error.message.find("print.showSide is both, but the shape is not its own mirror image") == 0);
}

TEST_CASE("copies are printed one after the other, and travels pass above those that are done") {
  Job job = plate(30, 20, 1.3);
  job.params.skirt = 2;
  job.params.copies = {2, 3};
  job.params.copyGap = 7;
  const Written written = job.write();
  REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
  CHECK(checkGcode(written.text, job.printer).errors() == 0);
  const ReadFile file = readGcode(written.text);
  CHECK_MESSAGE(file.faults.empty(), file.faults.front());
  CHECK(file.layers == 6 * 3);
  CHECK(valueOf(written.text, "; total layers count = ") == "18");
  std::vector<const ReadPath*> tops;
  int skirts = 0;
  for (const ReadPath& path : file.paths) {
    if (path.role == "Top solid infill") tops.push_back(&path);
    skirts += path.role == "Skirt/Brim" ? 1 : 0;
  }
  CHECK(skirts == 2);
  REQUIRE(tops.size() == 6);
  const int columns[] = {0, 1, 1, 0, 0, 1};  // back and forth
  for (std::size_t k = 1; k < 6; ++k) {
    for (std::size_t i = 0; i < tops[0]->moves.size(); ++i) {
      CHECK(tops[k]->moves[i].x1 - tops[0]->moves[i].x1 == 37000 * columns[k]);
      CHECK(tops[k]->moves[i].y1 - tops[0]->moves[i].y1 == 27000 * static_cast<int>(k / 2));
    }
  }
  // 0.6 mm of plate and 0.4 mm of lift, wherever a travel is longer than a plate's gap.
  for (const ReadMove& move : file.travels) {
    if (move.length() > 7 && move.x0 != 0) CHECK(move.z >= 600);
  }
  const Bounds box = checkGcode(written.text).box;
  CHECK(0.5 * (box.min + box.max) == Vec2{110, 110});
  // Every object begins and ends, one after the other: a host that leaves one out finds the next.
  const auto objectsOf = [](const std::string& text, const std::string& begin, const std::string& end) {
    std::vector<std::string> found;
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; ++at) {
      const std::string line = text.substr(at + 1, text.find('\n', at + 1) - at - 1);
      if (line.starts_with(begin) || line.starts_with(end)) found.push_back(line);
    }
    return found;
  };
  std::vector<std::string> numbered;
  std::vector<std::string> byName;
  for (int k = 0; k < 6; ++k) {
    numbered.push_back("M486 S" + std::to_string(k));
    numbered.push_back("M486 S-1");
    byName.push_back("EXCLUDE_OBJECT_START NAME=PLATE_" + std::to_string(k));
    byName.push_back("EXCLUDE_OBJECT_END NAME=PLATE_" + std::to_string(k));
  }
  CHECK(objectsOf(written.text, "M486 S", "M486 S") == numbered);
  Job klipper = job;
  klipper.printer.flavor = GcodeFlavor::Klipper;
  const std::string named = klipper.write().text;
  CHECK(checkGcode(named, klipper.printer).errors() == 0);
  CHECK(grammarError(named) == "");
  CHECK(named.find("\nEXCLUDE_OBJECT_DEFINE NAME=PLATE_5 CENTER=") <
        named.find("\nEXCLUDE_OBJECT_START NAME=PLATE_0\n"));
  CHECK(objectsOf(named, "EXCLUDE_OBJECT_START", "EXCLUDE_OBJECT_END") == byName);
  // The skirt is around all of them, and stays where one is left out; a brim is the plate's own.
  klipper.params.brim = 2;
  for (const GcodeFlavor flavor : {GcodeFlavor::Klipper, GcodeFlavor::Marlin}) {
    klipper.printer.flavor = flavor;
    const std::string text = klipper.write().text;
    const std::size_t skirt = text.find(";TYPE:Skirt/Brim");
    const std::size_t object = text.find(flavor == GcodeFlavor::Klipper ? "\nEXCLUDE_OBJECT_START" : "\nM486 S0");
    CHECK(skirt < object);
    CHECK(object < text.find(";TYPE:Skirt/Brim", skirt + 1));
    CHECK(text.find(" E", skirt) < object);
  }
  Job single = plate(30, 20, 1.3);
  single.params.skirt = 0;
  CHECK(file.filament > 6 * readGcode(single.write().text).filament * 0.95);

  job.params.copies = {7, 1};
  CHECK(job.write().result.error().message.find("the plates of 252.0 x 20.0 mm reach over the edge of the bed") == 0);
  job.params.copies = {2, 1};
  job.params.base = 20;
  CHECK(job.write().result.error().message.find("these plates are 4.2 mm high; several on one bed") == 0);
  CHECK(toldReason(job.write().result.error()) == "CopiesTooHigh height=4.2 most=3");
  job.params.copies = {1.5, 1};
  CHECK(job.write().result.error().message.find("print.copies is [1.5, 1]; it must be two whole numbers") == 0);
}

TEST_CASE("a round bed holds what lies within its circle and nothing else") {
  Job job = plate(30, 40);
  job.params.skirt = 0;
  job.printer.bedMin = {-25, -25};
  job.printer.bedMax = {25, 25};
  job.printer.roundBed = true;
  const Written good = job.write();  // 25 mm from the centre to each corner, less than a tenth of a bead outside
  const ReadFile file = checkFile(job, good);
  for (const ReadMove& move : file.travels) CHECK(std::hypot(move.x1, move.y1) <= 25000);
  CHECK(file.minX < 0);
  CHECK(split(valueOf(good.text, "; bed_shape = "), ',').size() == 24);

  job.params.place = Vec2{-15.5, -20};
  const Error error = job.write().result.error();
  CHECK(error.code == ErrorCode::DoesNotFit);
  CHECK(error.message ==
        "the plate lies 0.303 mm over the edge of the round bed; it fits when it "
        "is centred");

  CHECK(toldReason(error) == "OverRoundBed by=0.3032");

  job.params.place.reset();
  job.printer.bedMin = {-40, -40};
  job.printer.bedMax = {40, 40};
  job.params.skirt = 1;
  const Written purged = job.write();  // the corners of the skirt lie 32 mm off, within 40
  CHECK(checkFile(job, purged).paths[1].moves.size() == 4);
  job.printer.bedMin = {-31, -31};
  job.printer.bedMax = {31, 31};
  const Written line = job.write();
  CHECK(contains(line.result.value().warnings, "the skirt does not fit"));
  const ReadFile lined = checkFile(job, line);
  for (const ReadMove& move : lined.paths[0].moves) {
    CHECK(std::hypot(move.x0, move.y0) < 31000);
    CHECK(std::hypot(move.x1, move.y1) < 31000);
  }
  CHECK(lined.paths[0].role == "Custom");

  job.printer.bedMax = {31, 30};
  CHECK(job.write().result.error().message.find(
            "printer.roundBed is true on a bed of 62 x 61 mm; it must be a square") == 0);
}

TEST_CASE("nothing touches the excluded part of the bed") {
  Job job = plate(30, 20);
  job.printer.excludedMax = {18, 28};
  const ReadFile file = checkFile(job, job.write());
  CHECK(file.paths[1].closed());
  job.params.skirt = 0;
  const ReadFile purged = checkFile(job, job.write());
  CHECK(purged.paths[0].moves[0].x0 == 23667);  // the purge line begins right of it
  job.params.place = Vec2{17.9, 40};
  CHECK(job.write().result.ok());
  job.params.place = Vec2{17.9, 27};
  CHECK(job.write().result.error().code == ErrorCode::DoesNotFit);
  CHECK(job.write().result.error().message.find("touches the excluded part of the bed") != std::string::npos);
  CHECK(toldReason(job.write().result.error()) == "OnExcludedZone");
  job.printer.excludedMin = {20, 30};  // an island inside the plate
  job.printer.excludedMax = {21, 31};
  job.params.place = Vec2{15, 25};
  CHECK(job.write().result.error().code == ErrorCode::DoesNotFit);
}

TEST_CASE("the plate is centred by its box unless placed by its page") {
  Job job = plate();
  for (Vec2f& p : job.toolpath.cycles[0].points) p = p + Vec2f{100, 7};
  for (Vec2& p : job.shape.paths[0].rings[0]) p = p + Vec2{100, 7};
  job.params.base = 0;
  job.params.skirt = 0;
  ReadPath path = lastPath(checkFile(job, job.write()));
  CHECK(path.moves[0].x0 == 110000 - 15000 + 200);
  CHECK(path.moves[0].y0 == 110000 - 10000 + 200);
  job.params.place = Vec2{-90, 5};
  path = lastPath(checkFile(job, job.write()));
  CHECK(path.moves[0].x0 == 10200);
  CHECK(path.moves[0].y0 == 12200);
  // Origin in the middle of the bed: negative coordinates are legal.
  job.params.place.reset();
  job.printer.bedMin = {-110, -110};
  job.printer.bedMax = {110, 110};
  path = lastPath(checkFile(job, job.write()));
  CHECK(path.moves[0].x0 == -14800);
}

TEST_CASE("a quarter turn of the plate is a quarter turn of every vertex, and a mirror is one") {
  Job job = plate();
  job.params.base = 0;
  job.params.skirt = 0;
  job.params.place = Vec2{50, 60};
  const auto vertices = [&] {
    std::vector<std::pair<std::int64_t, std::int64_t>> out;
    const ReadPath path = lastPath(checkFile(job, job.write()));
    for (const auto& move : path.moves) out.emplace_back(move.x0, move.y0);
    return out;
  };
  const auto straight = vertices();
  // The page of 30 x 20 mm: its corner stays at (50, 60), whatever its turn.
  const auto expect = [&](auto place) {
    const auto turned = vertices();
    REQUIRE(turned.size() == straight.size());
    for (std::size_t k = 0; k < straight.size(); ++k) {
      const auto [x, y] = place(straight[k].first - 50000, straight[k].second - 60000);
      CHECK(std::abs(turned[k].first - 50000 - x) <= 1);
      CHECK(std::abs(turned[k].second - 60000 - y) <= 1);
    }
  };
  using Um = std::pair<std::int64_t, std::int64_t>;
  job.params.rotate = 90;
  expect([](std::int64_t x, std::int64_t y) { return Um{20000 - y, x}; });
  job.params.rotate = -180;
  expect([](std::int64_t x, std::int64_t y) { return Um{30000 - x, 20000 - y}; });
  job.params.rotate = 0;
  job.params.mirror = true;
  expect([](std::int64_t x, std::int64_t y) { return Um{30000 - x, y}; });
  job.params.rotate = 270;
  expect([](std::int64_t x, std::int64_t y) { return Um{y, x}; });  // mirrored first, then turned
}

TEST_CASE("a turned plate keeps its lengths and stays upon the bed or is refused") {
  Job job = plate(200, 20);
  job.printer.bedMax = {220, 120};
  job.params.base = 0;   // its hatches run along the bed's axes
  job.params.skirt = 0;  // and this around a box
  const double straight = job.write().result.value().filamentMm;
  job.params.rotate = 20;
  const Written turned = job.write();
  checkFile(job, turned);
  CHECK(turned.result.value().filamentMm == about(straight, 2e-3));
  job.params.rotate = 60;
  REQUIRE(!job.write().result.ok());
  CHECK(job.write().result.error().code == ErrorCode::DoesNotFit);
  job.params.rotate = 400;
  CHECK(job.write().result.error().message.find("print.rotate is 400 degrees; it must be -360 to 360") == 0);
}

TEST_CASE("what does not fit is refused with the overhang of each side") {
  Job job = plate();
  job.params.place = Vec2{-2, 205.5};
  Written written = job.write();
  REQUIRE(!written.result.ok());
  CHECK(written.result.error().code == ErrorCode::DoesNotFit);
  CHECK(written.result.error().message.find("2.000 mm on the left, 5.500 mm at the back; it fits when it is centred") !=
        std::string::npos);
  CHECK(toldReason(written.result.error()) == "OverBedEdge left=2 back=5.5");
  CHECK(written.text.empty());
  job.params.place.reset();
  job.printer.bedMax = {30, 20};
  CHECK(job.write().result.ok());  // exactly fits
  job.printer.bedMax = {29.9, 20};
  written = job.write();
  REQUIRE(!written.result.ok());
  CHECK(written.result.error().message.find("0.050 mm on the left, 0.050 mm on the right") != std::string::npos);
  // Half a bead counts.
  job.printer.bedMax = {30, 20};
  job.toolpath.cycles[0].points[0].x = 0;
  written = job.write();
  REQUIRE(!written.result.ok());
  CHECK(written.result.error().message.find("0.200 mm on the left") != std::string::npos);
  job.toolpath.cycles[0].points[0] = {30, 20};
  written = job.write();
  REQUIRE(!written.result.ok());
  CHECK(written.result.error().message.find("0.200 mm on the right, 0.200 mm at the back") != std::string::npos);
  job.toolpath.cycles[0].points[0] = {0.2f, 0.2f};
  job.printer.maxZ = 0.9;
  CHECK(job.write().result.error().code == ErrorCode::DoesNotFit);
  CHECK(toldReason(job.write().result.error()) == "TooHigh height=1 most=0.9");
  job.printer.maxZ = 1;
  CHECK(job.write().result.ok());
}

TEST_CASE("what brings a plate upon the bed is told, and helps") {
  const Job job = plate();  // 30 x 20 mm
  const auto fit = [&](Vec2 bed, bool round = false) {
    Printer printer = job.printer;
    printer.bedMax = printer.bedMin + bed;
    printer.roundBed = round;
    return fitBed(job.shape, printer, job.params);
  };
  CHECK(fit({30, 20}).centred);
  CHECK(fit({30, 20}).percent == 100);
  CHECK(!fit({20, 30}).centred);
  CHECK(fit({20, 30}).turned);
  CHECK(!fit({24, 24}).turned);
  CHECK(fit({24, 24}).percent == 80);
  CHECK(fit({36.1, 36.1}, true).centred);  // the diagonal is 36.06
  CHECK(!fit({36, 36}, true).centred);
  CHECK(fit({18.1, 18.1}, true).percent == 50);
  PrintParams two = job.params;
  two.copies = {2, 1};
  Printer printer = job.printer;
  printer.bedMax = printer.bedMin + Vec2{70, 20};
  CHECK(fitBed(job.shape, printer, two).centred);
  two.brim = 1;
  CHECK(!fitBed(job.shape, printer, two).centred);
  printer.bedMax = printer.bedMin + Vec2{100, 100};
  printer.excludedMin = printer.bedMin + Vec2{64, 0};
  printer.excludedMax = printer.bedMax;
  CHECK(!fitBed(job.shape, printer, job.params).centred);
  CHECK(fitBed(job.shape, printer, job.params).turned);  // 20 mm wide, from 40 to 60

  Job tall = plate();
  tall.printer.bedMax = tall.printer.bedMin + Vec2{22, 32};
  Written written = tall.write();
  REQUIRE(!written.result.ok());
  CHECK(written.result.error().message.find("; it fits when it is turned by 90 degrees and centred") !=
        std::string::npos);
  tall.params.rotate = 90;
  CHECK(tall.write().result.ok());
  tall.params.rotate = 0;
  tall.printer.bedMax = tall.printer.bedMin + Vec2{27, 19};
  written = tall.write();
  REQUIRE(!written.result.ok());
  CHECK(written.result.error().message.find("; it fits when it is scaled to 90 % and centred") != std::string::npos);
}
