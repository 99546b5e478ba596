#include "printer/dialect.hpp"

#include <doctest/doctest.h>

#include <string>
#include <string_view>

#include "sillon/gcode_reader/check.hpp"
#include "sillon/settings/presets.hpp"
#include "support/gcode_job.hpp"

using namespace sillon;
using namespace sillon::test;
using doctest::Approx;

TEST_CASE(
    "each dialect sets acceleration, corner speed and pressure advance in its own words, and all but Klipper back") {
  struct Words {
    GcodeFlavor flavor;
    const char* acceleration;
    const char* back;
    const char* advance;
    const char* none;
    const char* name;
    const char* corner;
    const char* cornerBack;
  };
  const Words all[] = {
      {GcodeFlavor::Marlin, "M204 P1000 T1000\n", "M204 P4000 T4000\n", "M900 K0.0400\n", "M900 K0\n", "marlin2",
       "M205 X10.00 Y10.00\n", "M205 X15.00 Y15.00\n"},
      {GcodeFlavor::Klipper, "M204 S1000\n", "M204 S4000\n", "SET_PRESSURE_ADVANCE ADVANCE=0.0400\n",
       "SET_PRESSURE_ADVANCE ADVANCE=0\n", "klipper", "SET_VELOCITY_LIMIT SQUARE_CORNER_VELOCITY=5.00\n",
       "SET_VELOCITY_LIMIT SQUARE_CORNER_VELOCITY=7.50\n"},
      {GcodeFlavor::RepRap, "M204 P1000 T1000\n", "M204 P4000 T4000\n", "M572 D0 S0.0400\n", "M572 D0 S0\n",
       "reprapfirmware", "M566 X600 Y600\n", "M566 X900 Y900\n"},
      {GcodeFlavor::PrusaBuddy, "M204 P1000 T1000\n", "M204 P4000 T4000\n", "M572 S0.0400\n", "M572 S0\n", "marlin2",
       "M205 X10.00 Y10.00\n", "M205 X15.00 Y15.00\n"},
      {GcodeFlavor::Bambu, "M204 S1000\n", "M204 S4000\n", "M900 K0.0400\n", "M900 K0\n", "marlin",
       "M205 X10.00 Y10.00\n", "M205 X15.00 Y15.00\n"}};
  for (const Words& words : all) {
    Job job = plate();
    job.printer.flavor = words.flavor;
    job.printer.setPressureAdvance = true;
    job.printer.machineAcceleration = 4000;
    job.printer.machineCornerSpeed = 7.5;
    if (words.flavor == GcodeFlavor::Bambu) job.printer.startGcode = "G28\nM190 S60\nM109 S220";
    const Written written = job.write();
    checkFile(job, written);
    const std::string& text = written.text;
    CAPTURE(words.name);
    const std::size_t set = text.find(std::string("\n") + words.advance);
    const std::size_t unset = text.find(std::string("\n") + words.none);
    CHECK(set < text.find(";LAYER_CHANGE"));
    const std::size_t last = text.rfind(";TYPE:Top solid infill");
    const std::size_t back = text.find(std::string("\n") + words.back);
    const std::size_t cornerBack = text.find(std::string("\n") + words.cornerBack);
    if (words.flavor == GcodeFlavor::Klipper) {  // it knows no cap: nothing is raised above what was set
      CHECK(unset == std::string::npos);
      CHECK(back == std::string::npos);
      CHECK(cornerBack == std::string::npos);
    } else {
      CHECK((unset != std::string::npos && unset > last));
      CHECK((back != std::string::npos && back > last));
      CHECK((cornerBack != std::string::npos && cornerBack > last));
    }
    CHECK(text.find(std::string("\n") + words.acceleration) < text.find(";LAYER_CHANGE"));
    CHECK(text.find(std::string("\n") + words.corner) < text.find(";LAYER_CHANGE"));
    CHECK(valueOf(text, "; gcode_flavor = ") == words.name);
    CHECK((text.find("; CHANGE_LAYER\n; Z_HEIGHT: 0.2\n") != std::string::npos) ==
          (words.flavor == GcodeFlavor::Bambu));
  }
  Job job = plate();
  job.printer.flavor = GcodeFlavor::Bambu;
  CHECK(job.write().result.error().message.find("printer.startGcode is empty; Bambu printers need") == 0);
  CHECK(job.write().text.empty());
}

TEST_CASE("absolute E carries the same plastic and starts anew with every layer") {
  Job job = plate();
  const ReadFile relative = checkFile(job, job.write());
  job.printer.absoluteE = true;
  const std::string text = job.write().text;
  CHECK(text.find("\nM82\n") != std::string::npos);
  CHECK(text.find("\nM83\n") == std::string::npos);
  std::int64_t e = 0;
  std::int64_t sum = 0;
  int resets = 0;
  for (const std::string_view line : split(text, '\n')) {
    if (line == "G92 E0") e = 0, ++resets;
    const std::size_t at = line.find(" E");
    if (!line.starts_with("G1 ") || at == std::string_view::npos) continue;
    const std::int64_t now = scaledWord(line.substr(at + 1), 1e5);
    if (line.find(" X") != std::string_view::npos) sum += now - e;
    e = now;
  }
  CHECK(resets == 1 + 3);
  job.printer.endGcode = "G1 E-2 F600\nM104 S0\nM140 S0";  // draws back by 2 mm, in either mode
  CHECK(job.write().text.find("\nG92 E0\nG1 E-2 F600\n") != std::string::npos);
  CHECK(static_cast<double>(sum) / 1e5 == Approx(relative.filament).epsilon(1e-9));
}

TEST_CASE("every printer and filament makes a file without faults") {
  for (const PrinterProfile& preset : profiles(ProfileKind::Printer)) {
    for (const PrinterProfile& filament : profiles(ProfileKind::Filament)) {
      CAPTURE(preset.id + " " + filament.id);
      Job job = plate(30, 20, 0.5);
      job.printer = preset.printer;
      REQUIRE_FALSE(applyProfile(ProfileKind::Filament, filament.id, job.printer));
      if (job.printer.flavor == GcodeFlavor::Bambu) {
        CHECK(job.write().result.error().message.find("printer.startGcode is empty") == 0);
        job.printer.startGcode = "G28\nM190 S{first_layer_bed_temperature}\nM109 S{first_layer_temperature}";
      }
      const Written written = job.write();
      REQUIRE_MESSAGE(written.result.ok(), written.result.error().message);
      const GcodeCheck check = checkGcode(written.text, job.printer);
      CHECK(check.errors() == 0);
      CHECK(check.layers == 3);
      CHECK(checkGcode(written.text).errors() == 0);  // by the settings the file itself tells
    }
  }
}
