#include "sillon/settings/presets.hpp"

#include <doctest/doctest.h>

using namespace sillon;

namespace {

/// As the files of this machine's maker have it: core/data/printers.json.
Project mk4(const char* filament, double nozzle) {
  Project project;
  project.printerProfile = "prusa-mk4";
  REQUIRE_FALSE(applyProfile(ProfileKind::Printer, project.printerProfile, project.printer));
  project.printer.filamentType = filament;
  project.printer.nozzle = nozzle;
  applyAdvance(project.printerProfile, project.printer);
  return project;
}

}  // namespace

TEST_CASE("pressure advance is the maker's for filament and nozzle, and off where it tells none") {
  CHECK(mk4("PLA", 0.4).printer.pressureAdvance == 0.036);
  CHECK(mk4("PETG", 0.6).printer.pressureAdvance == 0.032);
  CHECK(mk4("PETG", 0.6).printer.setPressureAdvance);
  for (const Project& none : {mk4("TPU", 0.4), mk4("PLA", 0.35)}) {
    CHECK(!none.printer.setPressureAdvance);
    CHECK(none.printer.pressureAdvance == Printer().pressureAdvance);
  }
}

TEST_CASE("filaments belong to the family that their type begins with") {
  for (const char* type : {"PLA", "PLA Silk", "PLA+", "PLA-CF", "pla_matte", "PLA2"}) {
    CAPTURE(type);
    CHECK(filamentFamily(type) == "PLA");
    CHECK(usualFan(type) == 100);
    CHECK(mk4(type, 0.4).printer.pressureAdvance == 0.036);
    CHECK(mk4(type, 0.4).printer.setPressureAdvance);
  }
  CHECK(filamentFamily("PA6-GF") == "PA");
  CHECK(filamentFamily("") == "");
  for (const char* type : {"ABS", "ASA", "PC", "PA12-CF", "Nylon", "HIPS", "PP"}) {
    CAPTURE(type);
    CHECK(usualFan(type) <= 20);
  }
  for (const char* type : {"PETG", "PET-CF", "TPU 95A", "Wood", ""}) {
    CAPTURE(type);
    CHECK(usualFan(type) == 50);
  }
  CHECK(!mk4("PLASTIC", 0.4).printer.setPressureAdvance);
}

TEST_CASE("pressure advance follows filament, nozzle and printer, unless it was a person's own") {
  const Project before = mk4("PLA", 0.4);
  Project changed = before;
  changed.printer.filamentType = "PETG";
  changed.printer.nozzle = 0.6;
  followAdvance(before, changed);
  CHECK(changed.printer.pressureAdvance == 0.032);

  Project own = before;
  own.printer.pressureAdvance = 0.05;
  Project off = before;
  off.printer.setPressureAdvance = false;
  for (const Project& given : {own, off}) {
    changed = given;
    changed.printer.filamentType = "PETG";
    followAdvance(given, changed);
    CHECK(changed.printer.pressureAdvance == given.printer.pressureAdvance);
    CHECK(changed.printer.setPressureAdvance == given.printer.setPressureAdvance);

    changed.printerProfile = "prusa-mini";  // another machine, another extruder
    followAdvance(given, changed);
    CHECK(changed.printer.setPressureAdvance);
    CHECK(changed.printer.pressureAdvance == 0.36);
  }

  Project unknown = own;
  unknown.printerProfile.clear();
  changed = unknown;
  changed.printer.nozzle = 0.6;
  followAdvance(unknown, changed);
  CHECK(changed.printer.pressureAdvance == 0.05);
}
