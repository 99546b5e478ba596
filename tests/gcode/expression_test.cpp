// What slicers' expressions come to; where PrusaSlicer is installed, it evaluates the same ones.
#include "gcode/blocks.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "support/damaged.hpp"
#include "support/installed.hpp"

using namespace sillon;
namespace fs = std::filesystem;

namespace {

const std::vector<TemplateValue> kValues{{{"first_layer_temperature", "TEMP"}, {"215"}},
                                         {{"first_layer_bed_temperature"}, {"60"}},
                                         {{"layer_height"}, {"0.2"}, false},
                                         {{"nozzle_diameter"}, {"0.4"}, false},
                                         {{"max_print_height"}, {"200"}, false},
                                         {{"travel_speed"}, {"130"}, false},
                                         {{"filament_type"}, {"PETG"}},
                                         {{"is_extruder_used"}, {"true", "false"}},
                                         {{"initial_tool"}, {"0"}},
                                         {{"printer_notes"}, {"PRINTER_VENDOR_X PRINTER_MODEL_MK4"}},
                                         {{"bed_temperature"}, {"60", "65", "70"}}};

struct Case {
  const char* expression;
  const char* value;
};
const Case kCases[] = {
    {"first_layer_temperature[0] - 60", "155"},
    {"first_layer_temperature[initial_tool]", "215"},
    {"first_layer_bed_temperature[0] / 7", "8"},
    {"first_layer_bed_temperature[0] % 7", "4"},
    {"-first_layer_bed_temperature[0] + 100", "40"},
    {"2 + 3 * 4", "14"},
    {"(2 + 3) * 4", "20"},
    {"7 / 2", "3"},
    {"7.0 / 2", "3.5"},
    {"max_print_height / 8 * 2", "50"},
    {"travel_speed * 60", "7800"},
    {"min(max_print_height, 150.5)", "150.5"},
    {"max(first_layer_temperature[0], 220)", "220"},
    {"round(layer_height * 12)", "2"},
    {"int(layer_height * 12)", "2"},
    {"layer_height < 0.25 and nozzle_diameter[0] > 0.3", "true"},
    {"layer_height < 0.1 or nozzle_diameter[0] == 0.4", "true"},
    {"not (layer_height < 0.1)", "true"},
    {"filament_type[0] == \"PETG\" ? 1 : 2", "1"},
    {"filament_type[0] != \"PETG\" ? 1 : filament_type[0] == \"PLA\" ? 2 : 3", "3"},
    {"\"\" + (filament_type[0] == \"FLEX\" ? 1 : 0)", "0"},
    {"\"a\" + \"b\"", "ab"},
    {"filament_type[0] == 1", "false"},
    {"first_layer_temperature[0] == \"215\"", "true"},
    {"(layer_height < 1) == \"true\"", "true"},
    {"\"x\" + digits(7, 3)", "x  7"},
    {"\"x\" + digits(layer_height * 17, 6, 2)", "x  3.40"},
    {"zdigits(7, 3)", "007"},
    {"zdigits(layer_height - 1, 6, 1)", "-000.8"},
    {"printer_notes =~ /.*PRINTER_MODEL_MK4.*/", "true"},
    {"printer_notes =~ /.*PRINTER_MODEL_MK4/", "true"},
    {"printer_notes =~ /PRINTER_MODEL_MK4.*/", "false"},
    {"printer_notes !~ /.*MODEL_(MK3|MINI).*/", "true"},
    {"printer_notes =~ /.*MODEL_(MK3|MK.).*/", "true"},
};

// Functions and variables of PrusaSlicer 2.6 and later, as its documentation has them.
const Case kNewer[] = {
    {"is_nil(nil)", "true"},
    {"is_nil(layer_height) ? 1 : 2", "2"},
    {"is_nil(nil) ? 150 : nil", "150"},
    {"one_of(filament_type[0], \"PLA\", \"PETG\")", "true"},
    {"one_of(filament_type[0], \"PLA\", /AB.*/, ~\".*FLEX\")", "false"},
    {"one_of(filament_type[0], /AB.*/, ~\"PE.*\")", "true"},
    {"one_of(\"a\")", "false"},
    {"one_of(7, 1, 7)", "true"},
    {"interpolate_table(5, (0, 10), (10, 20), (20, 0))", "15"},
    {"interpolate_table(15, (0, 10), (10, 20), (20, 0))", "10"},
    {"interpolate_table(-1, (0, 10), (10, 20))", "10"},
    {"interpolate_table(30, (0, 10), (10, 20))", "20"},
    {"size(bed_temperature)", "3"},
    {"empty(bed_temperature)", "false"},
    {"\"a\\\"b\" + \"\\\\\"", "a\"b\\"},
    {"\"abc\" < \"abd\" and \"b\" > \"abd\" and \"a\" <= \"a\"", "true"},
    {"\"MK4S\" =~ /MK[0-9]S?/", "true"},
    {"\"MK4\" =~ /MK[0-9]S?/", "true"},
    {"\"MKX\" =~ /MK[^0-9]/", "true"},
    {"\"MK-\" =~ /MK[0-9-]+/", "true"},
    {"\"MK305\" =~ /MK\\d+/", "true"},
    {"\"MK305\" =~ /MK\\d/", "false"},
    {"\"a b_1\" =~ /\\w\\s\\w*/", "true"},
    {"\"a/b.c\" =~ /a\\/b\\.c/", "true"},
    {"\"axc\" =~ /a\\.c/", "false"},
    {"\"abab\" =~ /(ab)+/", "true"},
    {"\"aba\" =~ /(ab)+/", "false"},
    {"\"\" =~ /(ABS)?(PC)*/", "true"},
    {"\"PCPC\" =~ /^(ABS)?(PC)*$/", "true"},
    {"\"a\" =~ /b|a/", "true"},
};

}  // namespace

TEST_CASE("expressions of slicers have their values") {
  for (const Case& c : kCases) {
    CAPTURE(c.expression);
    CHECK(evaluated(c.expression, kValues) == std::string(c.value));
  }
  for (const Case& c : kNewer) {
    CAPTURE(c.expression);
    CHECK(evaluated(c.expression, kValues) == std::string(c.value));
  }
  CHECK(evaluated("is_extruder_used[1]", kValues) == "false");
  CHECK(evaluated("first_layer_temperature[4]", kValues) == "215");  // of fewer tools the first one's counts
  CHECK(evaluated("1 == \"true\" and 0 == \"false\" and 0 != \"true\"", kValues) == "true");  // settings in files
  CHECK(evaluated("random(2, 8)", kValues) == "2");  // in its range, and the same each time
}

TEST_CASE("what has no value, or is no expression, has none, unless it does not count") {
  for (const char* bad : {"",
                          "other",
                          "first_layer_temperature[-1]",
                          "1 +",
                          "(1",
                          "1)",
                          "1 2",
                          "\"a",
                          "a b",
                          "1 / 0",
                          "1 % 0",
                          "filament_type[0] + ",
                          "filament_type[0] - 1",
                          "filament_type[0] < 1",
                          "printer_notes =~ /.*(a/",
                          "printer_notes =~ /a)/",
                          "printer_notes =~ /[a/",
                          "printer_notes =~ /*a/",
                          "printer_notes =~ /a{2}/",
                          "printer_notes =~ /\\bM/",
                          "nil",
                          "nil + 1",
                          "-nil",
                          "-filament_type[0]",
                          "is_nil(other)",
                          "size(other)",
                          "interpolate_table(1, (5, 1), (0, 2))",
                          "interpolate_table(1, 2)",
                          "one_of(1, other)",
                          "printer_notes =~ a",
                          "sqrt(4)",
                          "digits(1, 30)",
                          "digits(1, 2, 9)",
                          "digits(1)",
                          "min(1)",
                          "1 ? 2",
                          "1e999",
                          "99999999 * 99999999",
                          "other ? 1 : 2",
                          "first_layer_temperature[0]]",
                          "!",
                          "not",
                          "min(1, 2",
                          "1..2"}) {
    CAPTURE(bad);
    CHECK(evaluated(bad, kValues) == std::nullopt);
  }
  CHECK(evaluated("true or other", kValues) == "true");
  CHECK(evaluated("false and other", kValues) == "false");
  CHECK(evaluated("true ? 1 : other", kValues) == "1");
  CHECK(evaluated("false ? 1 / 0 : 2", kValues) == "2");
  CHECK(evaluated(std::string(100000, '(') + "1", kValues) == std::nullopt);
  CHECK(evaluated(std::string(100000, '-') + "1", kValues) == std::nullopt);
  CHECK(evaluated(std::string(100000, '!') + "1", kValues) == std::nullopt);
  CHECK(evaluated("printer_notes =~ /" + std::string(100000, 'a') + "/", kValues) == std::nullopt);
  std::string slow;
  for (int k = 0; k < 20; ++k) slow += ".*(P|.)";
  CHECK(evaluated("printer_notes =~ /" + slow + "x/", kValues) == "false");  // way by way it would take for ever
  CHECK(evaluated("printer_notes =~ /((((.*)*)*)*)*x/", kValues) == "false");
  scenes::Random random(5);
  for (int round = 0; round < 5000; ++round) {
    const std::string whole = kCases[static_cast<std::size_t>(round) % std::size(kCases)].expression;
    const std::string text = scenes::damaged(whole + std::string(20, ' '), random, 3, 6);
    CHECK(evaluated(text, kValues).value_or("").size() < 1000);
  }
}

TEST_CASE("blocks keep what is chosen, line by line") {
  const auto expand = [](std::string_view text) {
    const Result<std::string> out = expandTemplate(text, kValues, "startGcode");
    return out ? out.value() : "error: " + out.error().message;
  };
  CHECK(expand("{if layer_height < 0.25}M1{else}M2{endif} S{first_layer_temperature[0] - 5}") == "M1 S210\n");
  CHECK(expand("{if layer_height > 0.25}M1{elsif nozzle_diameter[0] == 0.4}M2{elsif other}M3{else}M4{endif}") ==
        "M2\n");
  CHECK(expand("G28\n{if layer_height > 1}\nM1\n{if other}M2{endif}\n{else}\nM3\n{endif}\nM4") ==
        "G28\n\n\n\n\nM3\n\nM4\n");  // lines keep their numbers
  CHECK(expand("{if is_extruder_used[1]}M104 T1 S{first_layer_temperature[1]}{endif}\nG28") == "\nG28\n");
  // What ends behind a comment, as in Prusa's blocks.
  CHECK(expand("{if layer_height < 1}G1 Z{layer_height + 1} ; up {to|it}{endif}\nM84 ; {what} [it]") ==
        "G1 Z1.2 ; up {to|it}\nM84 ; {what} [it]\n");
  CHECK(expand("{if layer_height < 0.1\n or nozzle_diameter[0] > 1}M1{endif}G28") == "\nG28\n");
  CHECK(expand("M1 [first_layer_temperature[initial_tool]]") == "M1 215\n");
  CHECK(expand("G28\n{if other}M1{endif}") ==
        "error: startGcode has \"{if other}\" in line 2, which cannot be evaluated here; keep only the branch "
        "that applies");
  CHECK(expand("{if true}M1") == "error: startGcode has \"{if true}\" in line 1, which has no endif");
  CHECK(expand("M1\n{endif}") == "error: startGcode has \"{endif}\" in line 2, which has no if before it");
  CHECK(expand("{if true}{if false}M1{else}M2{endif}{else}M3{endif}") == "M2\n");
  // Statements, and values of the block's own.
  const std::pair<const char*, const char*> statements[] = {
      {"{local a = 3; local b = a * 2.5}M1 S{a} P{b}", "M1 S3 P7.5\n"},
      {"{local a = 7}{a / 2} {a = 7.0}{a / 2}", "3 3.5\n"},
      {"{global t = (1, 2 + 3, \"x\")}{t[1]}{t[2]}{size(t)}", "5x3\n"},
      {"{local t = repeat(3, 4)}{t[1] = 9}{t[0]},{t[1]},{t[2]}", "4,9,4\n"},
      {"{local t = bed_temperature}{t[2]}{size(t)}", "703\n"},
      {"{local a = (1 + 2) * 4}{a}", "12\n"},
      {"{local a = ()}{empty(a)}", "true\n"},
      {"{first_layer_temperature[0];;layer_height;}", "2150.2\n"},
      {"{if layer_height > 1 then 1 elsif layer_height > 0.1 then 2 else 3 endif}", "2\n"},
      {"{if true then local a = 5; a else other; \"}\" =~ /else/ endif}{a + 1}", "56\n"},
      {"{if false}{other / }{else}M1{endif}", "M1\n"},
      {"{if false then if other then 1 else 2 endif else if true}M3{endif endif}", "M3\n"},
      {"[bed_temperature_[initial_tool]]", "60\n"},
      {"G1 E-0.8{e_retracted[initial_tool] = 0.8; e_retracted[3] = 2}", "G1 E-0.8\nG92 E0\nG1 E0.8 F1500\n"},
      {"{e_retracted = 1}M1", "M1\nG92 E0\nG1 E1 F1500\n"},
      {"; {local a}\n{local a = 2}\n{a}", "; {local a}\n\n2\n"},
      // Comments reach as far as in the lines that are put out: hidden ones hide nothing, and line breaks end them.
      {"{if false};{endif}M104 S<TEMP>", "M104 S215\n"},
      {"{if false}M1 ; [a < \"b{endif}M2", "M2\n"},
      {"; up{1;\n2}\nM104 S<TEMP>", "; up12\n\nM104 S215\n"},
      {"; {layer_height\n} S<TEMP>", "; 0.2\n S215\n"},
      {"; {\"M1\\n\"}M104 S<TEMP>", "; M1\nM104 S215\n"},
      {"; {layer_height in mm} {1", "; {layer_height in mm} {1\n"},
  };
  for (const auto& [text, value] : statements) {
    const auto textNow = text;  // clang 14 captures no structured binding
    CAPTURE(textNow);
    CHECK(expand(text) == value);
  }
  for (const char* bad : {"{a = 1}", "{layer_height = 1}", "{local a = (1, 2)}{a[2] = 1}", "{local a = other}{1}",
                          "{local a = repeat(5000, 1)}", "{local a = nil}", "{1 2}", "{if true then 1}", "{1",
                          // Hidden comments, and comments that end within braces.
                          "{if false};{endif}[other]", "M1 ; {1\n}[other]",
                          // Statements in comments that were run already.
                          "; {1; other}", "; {if true then other}{endif}", "; {e_retracted = 1 mm}", "; {1; \"a}"}) {
    CAPTURE(bad);
    CHECK(expand(bad).starts_with("error: "));
  }
  scenes::Random random(6);
  const std::string whole =
      "{if layer_height < 0.25}M1{elsif false}[layer_height]{else}M2{endif} ; {x}\nG1 X{1+2} <TEMP>\n{if "
      "true}\nM3\n{endif}{local a = (1, 2); a[0] = 3; if a[0] =~ /[0-9]+/ then a[1] endif}";
  for (int round = 0; round < 5000; ++round) {
    const auto out = expandTemplate(scenes::damaged(whole, random, 4, 8), kValues, "startGcode");
    CHECK((out.ok() || !out.error().message.empty()));
  }
}

TEST_CASE("PrusaSlicer evaluates the same expressions to the same values") {
  if (!test::installed("prusa-slicer", "expressions as PrusaSlicer has them")) return;
  const fs::path folder = fs::temp_directory_path() / "sillon_expressions";
  fs::create_directories(folder);
  std::ofstream(folder / "body.stl") << "solid a\n"
                                        "facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 9 0\nvertex 9 0 0\n"
                                        "endloop\nendfacet\n"
                                        "facet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 9 0 0\nvertex 0 0 9\n"
                                        "endloop\nendfacet\n"
                                        "facet normal -1 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 9\nvertex 0 9 0\n"
                                        "endloop\nendfacet\n"
                                        "facet normal 1 1 1\nouter loop\nvertex 9 0 0\nvertex 0 9 0\nvertex 0 0 9\n"
                                        "endloop\nendfacet\nendsolid a\n";
  std::string block = "G28";
  for (std::size_t k = 0; k < std::size(kCases); ++k) {
    std::string expression;  // as in a line of an .ini file
    for (const char c : std::string_view(kCases[k].expression)) expression += c == '\\' ? "\\\\" : std::string(1, c);
    const bool truth = std::string_view(kCases[k].value) == "true" || std::string_view(kCases[k].value) == "false";
    block += "\\nM117 case" + std::to_string(k);
    block += truth ? " {if " + expression + "}true{else}false{endif}" : " {(" + expression + ")}";
  }
  std::ofstream(folder / "settings.ini")
      << "start_gcode = " << block << "\nfirst_layer_temperature = 215\nfirst_layer_bed_temperature = 60\n"
      << "layer_height = 0.2\nnozzle_diameter = 0.4\nmax_print_height = 200\ntravel_speed = 130\nfilament_type = PETG\n"
      << "printer_notes = PRINTER_VENDOR_X PRINTER_MODEL_MK4\nskirts = 0\n";
  const fs::path out = folder / "out.gcode";
  const std::string command = "prusa-slicer --export-gcode --load '" + (folder / "settings.ini").string() + "' -o '" +
                              out.string() + "' '" + (folder / "body.stl").string() + "' >'" +
                              (folder / "log").string() + "' 2>&1";
  REQUIRE(std::system(command.c_str()) == 0);
  std::ifstream in(out);
  std::size_t found = 0;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("M117 case")) continue;
    const std::size_t space = line.find(' ', 9);
    const auto k = static_cast<std::size_t>(std::atoi(line.c_str() + 9));
    REQUIRE(k < std::size(kCases));
    CAPTURE(kCases[k].expression);
    CHECK(line.substr(space + 1) == kCases[k].value);
    ++found;
  }
  CHECK(found == std::size(kCases));
  fs::remove_all(folder);
}
