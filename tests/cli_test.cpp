// The command line as a shell sees it: exit codes, one sentence per mistake, files together or not at all.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "sillon/image_io.hpp"
#include "sillon/version.hpp"

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

std::string readAll(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

struct Run {
  int code = -1;
  std::string out;
  std::string err;
};

/// A folder of its own for one test, gone afterwards.
class Folder {
 public:
  Folder()
      : path_(fs::temp_directory_path() /
              ("sillon-cli-" + std::to_string(::getpid()) + "-" + std::to_string(count++))) {
    fs::create_directories(path_ / "work");
  }
  ~Folder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] fs::path at(const std::string& name) const { return path_ / "work" / name; }

  void write(const std::string& name, const std::string& bytes) const {
    fs::create_directories(at(name).parent_path());
    std::ofstream(at(name), std::ios::binary) << bytes;
  }

  /// A grey picture; \param grey  from column and row.
  template <class Grey>
  void picture(const std::string& name, int width, int height, Grey grey) const {
    std::vector<std::uint8_t> rgb;
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column)
        rgb.insert(rgb.end(), 3, static_cast<std::uint8_t>(grey(column, row)));
    }
    const std::vector<std::uint8_t> png = sillon::encodePng(width, height, rgb);
    write(name, std::string(png.begin(), png.end()));
  }

  [[nodiscard]] std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(path_ / "work")) names.insert(entry.path().string());
    return names;
  }

  /// Runs the program in the folder. \param environment  assignments before the command.
  [[nodiscard]] Run run(const std::string& arguments, const std::string& environment = "") const {
    const std::string command = "cd '" + (path_ / "work").string() + "' && " + environment + " '" SILLON_CLI "' " +
                                arguments + " >../out 2>../err </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readAll(path_ / "out"), readAll(path_ / "err")};
  }

 private:
  static inline int count = 0;
  fs::path path_;
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

constexpr const char* kDisc = "generate --shape disc --size 12 --spacing 0.8 --angle 30 --layer-height 0.2 ";

std::string bigEndian(std::uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16), static_cast<char>(value >> 8),
          static_cast<char>(value)};
}

std::string pngChunk(const std::string& body) {
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const char c : body) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xEDB88320u : 0);
  }
  return bigEndian(static_cast<std::uint32_t>(body.size() - 4)) + body + bigEndian(~crc);
}

/// A tiny file that claims to be a large picture.
std::string pngThatClaims(std::uint32_t width, std::uint32_t height) {
  const std::string header = "IHDR" + bigEndian(width) + bigEndian(height) + std::string("\x08\x00\x00\x00\x00", 5);
  return "\x89PNG\r\n\x1a\n" + pngChunk(header) + pngChunk("IDAT" + std::string(64, 'x')) + pngChunk("IEND");
}

/// Bad input: code 2, one sentence that holds `part`, nothing on stdout, nothing new in the folder.
void checkRefused(const Folder& folder, const std::string& arguments, const std::string& part) {
  const std::set<std::string> before = folder.files();
  const Run run = folder.run(arguments);
  CAPTURE(arguments);
  CAPTURE(run.err);
  CHECK(run.code == 2);
  CHECK(run.out == "");
  CHECK(run.err.rfind("sillon: ", 0) == 0);
  CHECK(run.err.find('\n') == run.err.size() - 1);
  CHECK(has(run.err, part));
  CHECK(folder.files() == before);
}

const std::string kOutputs =
    " --gcode a.gcode --svg a.svg --report a.json --preview a.png --view v.png --project b.json";

}  // namespace

TEST_CASE("help and version answer on stdout") {
  const Folder folder;
  Run run = folder.run("--version");
  CHECK(run.code == 0);
  CHECK(run.out == std::string("sillon ") + sillon::kVersion + "\n");
  run = folder.run("--help");
  CHECK(run.code == 0);
  CHECK(has(run.out, "generate"));
  run = folder.run("generate --help");
  CHECK(run.code == 0);
  CHECK(run.err == "");
  for (const char* word : {"--shape", "--lines", "--spacing MM", "[0.4]", "Advanced", "--border-pull", "Examples:"}) {
    CAPTURE(word);
    CHECK(has(run.out, word));
  }
}

TEST_CASE("printers and filaments are listed, and one of them begins a project") {
  const Folder folder;
  const Run list = folder.run("printers");
  CHECK(list.code == 0);
  CHECK(has(list.out, "\nprusa-mk4s "));
  CHECK(has(list.out, "230x230x300 round centred"));
  CHECK(has(folder.run("filaments").out, "\npetg "));
  const Run one = folder.run("printers creality-k1");
  CHECK(one.code == 0);
  folder.write("k1.json", one.out);
  const Run made = folder.run("generate k1.json --shape disc --size 12 --spacing 0.8 --filament petg --gcode a.gcode");
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
  const std::string gcode = readAll(folder.at("a.gcode"));
  CHECK(has(gcode, "\nSTART_PRINT EXTRUDER_TEMP=240 BED_TEMP=80\n"));
  CHECK(has(gcode, "\nEND_PRINT\n"));
  CHECK(has(gcode, "; thumbnail begin 320x320 "));
  REQUIRE(
      folder
          .run("generate --printer creality-k1 --shape disc --size 12 --spacing 0.8 --filament petg --gcode b.gcode",
               "SOURCE_DATE_EPOCH=0")
          .code == 0);
  REQUIRE(folder
              .run("generate k1.json --shape disc --size 12 --spacing 0.8 --filament petg --gcode a.gcode",
                   "SOURCE_DATE_EPOCH=0")
              .code == 0);
  CHECK(readAll(folder.at("a.gcode")) == readAll(folder.at("b.gcode")));
  checkRefused(folder, "printers k2", "printers is \"k2\", which is no printer");
}

TEST_CASE("check reads G-code as a printer would") {
  const Folder folder;
  REQUIRE(folder.run(std::string(kDisc) + "--gcode a.gcode").code == 0);
  const Run good = folder.run("check a.gcode");
  CHECK(good.code == 0);
  CHECK(has(good.out, "3 layers, for Generic\n"));
  CHECK(has(good.out, "\nno errors\n"));
  std::string text = readAll(folder.at("a.gcode"));
  text.erase(text.find("G28\n"), 4);
  folder.write("b.gcode", text);
  const Run bad = folder.run("check b.gcode --printer prusa-mini");
  CHECK(bad.code == 2);
  CHECK(has(bad.out, "error      homing: moves before it homes (G28) (line "));
  CHECK(has(bad.out, "error      bounds: a move over the bed's edge at (0, 220), 40 mm (line "));
  const Run json = folder.run("check b.gcode --json");
  CHECK(json.code == 2);
  const auto read = nlohmann::json::parse(json.out);
  CHECK(read["errors"].get<int>() > 0);
  CHECK(read["findings"][0]["rule"] == "homing");
  CHECK(read["layers"] == 3);
  checkRefused(folder, "check", "file is required");
  checkRefused(folder, "check none.gcode", "cannot be read");
  checkRefused(folder, "check a.gcode --printer mk4", "--printer is \"mk4\"");
}

TEST_CASE("a plate that does not fit is centred, turned or scaled if asked") {
  const Folder folder;
  const std::string wide = "generate --shape rect --size 24x12 --spacing 0.8 --skirt 0 --bed ";
  const Run refused = folder.run(wide + "14x30 --gcode a.gcode");
  CHECK(refused.code == 2);
  CHECK(has(refused.err, "it fits when it is turned by 90 degrees and centred"));
  CHECK(folder.run(wide + "14x30 --place centre --gcode a.gcode").code == 2);
  REQUIRE(folder.run(wide + "14x30 --place rotate --gcode a.gcode --project a.json").code == 0);
  CHECK(nlohmann::json::parse(readAll(folder.at("a.json")))["print"]["rotate"] == 90);
  CHECK(folder.run(wide + "20x20 --place rotate --gcode b.gcode").code == 2);
  REQUIRE(folder.run(wide + "20x20 --place fit --gcode b.gcode --project b.json").code == 0);
  const auto size = nlohmann::json::parse(readAll(folder.at("b.json")))["shape"]["size"];
  CHECK(std::abs(size[0].get<double>() - 24 * 0.83) < 1e-9);
  CHECK(std::abs(size[1].get<double>() - 12 * 0.83) < 1e-9);
  CHECK(folder.run(wide + "40x40 --place fit --gcode c.gcode").code == 0);
  checkRefused(folder, wide + "40x40 --place here --gcode d.gcode", "it must be X,Y in mm, centre, rotate or fit");
}

TEST_CASE("a name that ends in .gcode.3mf packs the G-code, and such files are read") {
  const Folder folder;
  REQUIRE(folder.run(std::string(kDisc) + "--printer prusa-mini --gcode a.gcode.3mf", "SOURCE_DATE_EPOCH=0").code == 0);
  REQUIRE(folder.run(std::string(kDisc) + "--printer prusa-mini --gcode a.gcode", "SOURCE_DATE_EPOCH=0").code == 0);
  const std::string zip = readAll(folder.at("a.gcode.3mf"));
  CHECK(zip.starts_with("PK"));
  CHECK(has(zip, readAll(folder.at("a.gcode"))));
  CHECK(folder.run("check a.gcode.3mf").out == folder.run("check a.gcode").out);
  CHECK(folder.run("import a.gcode.3mf").out == folder.run("import a.gcode").out);
  folder.write("b.gcode.3mf", zip.substr(0, zip.size() / 2));
  checkRefused(folder, "check b.gcode.3mf", "the .gcode.3mf is cut off");
}

TEST_CASE("the base is written as a solid, STL or 3MF by its name") {
  const Folder folder;
  REQUIRE(folder.run(std::string(kDisc) + "--body a.stl").code == 0);
  REQUIRE(folder.run(std::string(kDisc) + "--body a.3mf").code == 0);
  const std::string stl = readAll(folder.at("a.stl"));
  CHECK(stl.starts_with("base body by Sillon"));
  CHECK(stl.size() % 50 == 84 % 50);
  CHECK(readAll(folder.at("a.3mf")).starts_with("PK"));
  checkRefused(folder, std::string(kDisc) + "--base 0 --body b.stl", "base is 0; it must be at least 1");
}

TEST_CASE("a printer is imported from G-code and prints") {
  const Folder folder;
  REQUIRE(folder.run(std::string(kDisc) + "--printer prusa-mini --gcode donor.gcode").code == 0);
  const Run run = folder.run("import donor.gcode");
  CHECK(run.code == 0);
  CHECK(has(run.err, "sillon: not read: heights in the end block were left out"));
  folder.write("mine.json", run.out);
  const Run made = folder.run("generate mine.json --shape disc --size 12 --spacing 0.8 --gcode a.gcode");
  CAPTURE(made.err);
  CHECK(made.code == 0);
  CHECK(has(readAll(folder.at("a.gcode")), "\nM862.3 P \"MINI\"\n"));
  CHECK(folder.run("check a.gcode --printer prusa-mini").code == 0);
  folder.write("no.ini", "a = b\n");
  checkRefused(folder, "import no.ini", "no setting of a printer");
}

TEST_CASE("a small disc writes every file, and each is what it should be") {
  const Folder folder;
  const Run run = folder.run(kDisc + kOutputs, "SOURCE_DATE_EPOCH=1600000000");
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  CHECK(run.err == "");
  CHECK(has(run.out, "12.00 x 12.00 mm"));
  CHECK(has(run.out, "coverage"));
  CHECK(has(run.out, "a.gcode"));
  CHECK(folder.files().size() == 6);

  const std::string gcode = readAll(folder.at("a.gcode"));
  const std::string first =
      "; generated by Sillon " + std::string(sillon::kVersion) + " on 2020-09-13 at 12:26:40 UTC\n";
  CHECK(gcode.substr(0, first.size()) == first);
  CHECK(has(gcode, "; plate = 12.0x12.0 mm, spacing = 0.80"));
  CHECK(has(gcode, "; seed = 0, perimeters = 1\n"));
  CHECK(has(gcode, "crossings = 0"));

  const Json report = Json::parse(readAll(folder.at("a.json")), nullptr, false);
  REQUIRE(report.is_object());
  for (const char* key : {"grid",
                          "parts",
                          "cycles",
                          "toolpaths",
                          "lengthMm",
                          "alignment",
                          "alignmentInterior",
                          "alignmentConstrained",
                          "coverage",
                          "overlap",
                          "spill",
                          "uTurns",
                          "kinks",
                          "crossings",
                          "width",
                          "fillRatio",
                          "lostAreaMm2",
                          "longestJointMm",
                          "time",
                          "peakBytes",
                          "threads",
                          "digest"}) {
    CAPTURE(key);
    CHECK(report.contains(key));
  }
  CHECK(report["toolpaths"] == 1);
  CHECK(report["crossings"] == 0);
  CHECK(report["coverage"] > 80);
  CHECK(report["peakBytes"] > 1'000'000);
  CHECK(has(readAll(folder.at("a.svg")), "<svg"));
  CHECK(readAll(folder.at("a.png")).substr(1, 3) == "PNG");
  CHECK(Json::parse(readAll(folder.at("b.json")), nullptr, false)["shape"]["builtin"] == "disc");
}

TEST_CASE("two runs give equal bytes, with any number of threads, quiet or not") {
  const Folder folder;
  const std::string date = "SOURCE_DATE_EPOCH=0";
  REQUIRE(folder.run(kDisc + std::string("--threads 1 --gcode a.gcode --svg a.svg --preview a.png"), date).code == 0);
  const Run quiet =
      folder.run(kDisc + std::string("--threads 3 --quiet --gcode b.gcode --svg b.svg --preview b.png"), date);
  REQUIRE(quiet.code == 0);
  CHECK(quiet.out == "");
  CHECK(quiet.err == "");
  CHECK(readAll(folder.at("a.gcode")) == readAll(folder.at("b.gcode")));
  CHECK(readAll(folder.at("a.svg")) == readAll(folder.at("b.svg")));
  CHECK(readAll(folder.at("a.png")) == readAll(folder.at("b.png")));
  CHECK(has(readAll(folder.at("a.gcode")), "1970-01-01 at 00:00:00 UTC"));
}

TEST_CASE("a project written elsewhere repeats the plate") {
  const Folder folder;
  folder.picture("in/lines.png", 40, 20, [](int column, int) { return column * 6; });
  fs::create_directories(folder.at("out"));
  const std::string date = "SOURCE_DATE_EPOCH=0";
  REQUIRE(folder
              .run("generate --lines in/lines.png --size 16 --spacing 0.8 --perimeters soft --seed 5 "
                   "--project out/p.json --gcode a.gcode",
                   date)
              .code == 0);
  const Run again = folder.run("generate out/p.json --gcode b.gcode", date);
  CAPTURE(again.err);
  REQUIRE(again.code == 0);
  CHECK(readAll(folder.at("a.gcode")) == readAll(folder.at("b.gcode")));
  CHECK(has(readAll(folder.at("a.gcode")), "plate = 16.0x8.0 mm"));
  CHECK(Json::parse(readAll(folder.at("out/p.json")))["directions"]["file"] == "../in/lines.png");
}

TEST_CASE("options override the scene") {
  const Folder folder;
  folder.write("scene.json", R"({"nozzle_width": 0.4, "svg_path": "s.svg", "line_field_path": "l.png", "seed": 3})");
  folder.write("s.svg",
               R"(<svg xmlns="http://www.w3.org/2000/svg" width="12" height="8"><rect width="12" height="8"/></svg>)");
  folder.picture("l.png", 1, 1, [](int, int) { return 128; });
  REQUIRE(folder.run("generate scene.json --spacing 0.8 --perimeters none --report r.json --project p.json").code == 0);
  CHECK(Json::parse(readAll(folder.at("r.json")))["spacing"] == 0.8);
  Json project = Json::parse(readAll(folder.at("p.json")));
  CHECK(project["toolpath"]["seed"] == 3);
  CHECK(project["toolpath"]["perimeterMode"] == "none");
  CHECK(project["shape"]["file"] == "s.svg");
  CHECK(project["shape"]["unitless"] == "mm");

  REQUIRE(folder
              .run("generate scene.json --shape rounded --size 10x6 --radius 1 --angle -45 --spacing 0.8 "
                   "--project q.json")
              .code == 0);
  project = Json::parse(readAll(folder.at("q.json")));
  CHECK(project["shape"]["file"] == "");
  CHECK(project["shape"]["size"] == Json::array({10, 6}));
  CHECK(project["directions"]["file"] == "");
  CHECK(project["directions"]["angle"] == -45);
}

TEST_CASE("of an option given twice the last one counts") {
  const Folder folder;
  REQUIRE(folder.run(kDisc + std::string("--seed 3 --seed 4 --project p.json")).code == 0);
  CHECK(Json::parse(readAll(folder.at("p.json")))["toolpath"]["seed"] == 4);
}

TEST_CASE("odd but good input is accepted") {
  const Folder folder;
  folder.picture("one.png", 1, 1, [](int, int) { return 200; });
  folder.picture("mask.png", 30, 20, [](int column, int row) { return column > 4 && row > 3 && row < 16 ? 255 : 0; });
  folder.write("bow.svg", R"(<svg xmlns="http://www.w3.org/2000/svg" width="16mm" height="16mm" viewBox="0 0 16 16">)"
                          R"(<path d="M0 0 L16 16 L16 0 L0 16 Z"/></svg>)");
  for (const char* arguments :
       {"generate --lines one.png --size 10 --spacing 0.8 --svg a.svg",
        "generate --shape mask.png --size 20 --spacing 0.8 --svg a.svg",
        "generate --shape bow.svg --spacing 0.8 --svg a.svg",
        "generate --shape bow.svg --size 20 --spacing 1 --svg a.svg",
        "generate --shape rect --size 10x6 --spacing 0.8 --mode parallel --perimeters 2 --quiet"}) {
    CAPTURE(arguments);
    const Run run = folder.run(arguments);
    CAPTURE(run.err);
    CHECK(run.code == 0);
    CHECK(run.err == "");
  }
}

TEST_CASE("what is taken for granted of a file, or left out of it, is said") {
  const Folder folder;
  folder.write(
      "a.svg",
      R"(<svg viewBox="0 0 60 40"><rect width="60" height="40"/><text>a</text><image width="3" height="3"/></svg>)");
  folder.picture("l.png", 8, 8, [](int, int) { return 255; });
  const std::string coarse = " --spacing 2 --nozzle 1";
  const Run drawn = folder.run("generate --shape a.svg" + coarse);
  CHECK(has(drawn.out, "\nnote       the drawing is in pixels, each taken as 1/96 inch; --size sets its width\n"));
  CHECK(has(drawn.out, "\nnote       the drawing has 1 <text>, which is left out; convert it to paths in the program"));
  CHECK(has(drawn.out, "\nnote       the drawing has 1 <image>, which is left out"));
  CHECK_FALSE(has(folder.run("generate --shape a.svg --size 20" + coarse).out, "pixels"));
  CHECK(has(folder.run("generate --shape l.png" + coarse).out, "\nnote       no size is given, so it is 80 mm wide"));
  CHECK_FALSE(has(folder.run("generate --shape l.png --size 20" + coarse).out, "note"));
}

TEST_CASE("files that are not what they claim are refused") {
  const Folder folder;
  folder.write("empty", "");
  folder.write("text.png", "hello, this is no picture at all");
  folder.picture("good.png", 64, 64, [](int column, int row) { return (column * 7 + row * 13) & 255; });
  folder.write("cut.png", readAll(folder.at("good.png")).substr(0, 200));
  folder.write("wide.png", pngThatClaims(40000, 20000));
  folder.write("giant.png", pngThatClaims(2000000000, 2000000000));
  folder.picture("black.png", 1, 1, [](int, int) { return 0; });
  folder.write("flat.svg",
               R"(<svg xmlns="http://www.w3.org/2000/svg" width="10mm" height="10mm"><line x2="5" y2="5"/></svg>)");
  folder.write("broken.svg", "<svg width='10mm' height='10mm'><rect ");
  folder.write("typo.json", R"({"sillon": 1, "toolpath": {"spaceing": 0.4}})");
  folder.write("nojson.json", "{nozzle: 1}");
  folder.write("deep.json", std::string(100'000, '['));
  folder.write("nofile.json", R"({"nozzle_width": 0.4, "svg_path": "nowhere.svg"})");
  fs::create_directories(folder.at("folder"));

  checkRefused(folder, "generate missing.json" + kOutputs, "\"missing.json\" cannot be read");
  checkRefused(folder, "generate empty" + kOutputs, "\"empty\" is empty");
  checkRefused(folder, "generate folder" + kOutputs, "is a folder");
  checkRefused(folder, "generate typo.json" + kOutputs, "did you mean \"spacing\"?");
  checkRefused(folder, "generate nojson.json" + kOutputs, "line 1");
  checkRefused(folder, "generate deep.json" + kOutputs, "deeper than 64");
  checkRefused(folder, "generate nofile.json" + kOutputs, "nowhere.svg");
  checkRefused(folder, "generate --lines missing.png" + kOutputs, "missing.png");
  checkRefused(folder, "generate --lines empty" + kOutputs, "is empty");
  checkRefused(folder, "generate --lines text.png" + kOutputs, "text.png");
  checkRefused(folder, "generate --lines cut.png" + kOutputs, "cut.png");
  checkRefused(folder, "generate --lines giant.png" + kOutputs, "giant.png");
  checkRefused(folder, "generate --lines wide.png" + kOutputs, "40000");
  checkRefused(folder, "generate --modes cut.png --shape disc --size 9" + kOutputs, "cut.png");
  checkRefused(folder, "generate --shape wide.png --size 20" + kOutputs, "40000");
  checkRefused(folder, "generate --shape black.png --size 20" + kOutputs, "shape \"black.png\": The mask is empty");
  checkRefused(folder, "generate --shape text.png --size 20" + kOutputs, "text.png");
  checkRefused(folder, "generate --shape flat.svg" + kOutputs, "flat.svg");
  checkRefused(folder, "generate --shape broken.svg" + kOutputs, "broken.svg");
  checkRefused(folder, "generate --shape nowhere.svg" + kOutputs, "nowhere.svg");
}

TEST_CASE("values out of range are refused with their range") {
  const Folder folder;
  const std::string disc = "generate --shape disc --size 12 ";
  const auto refused = [&](const std::string& arguments, const std::string& part) {
    checkRefused(folder, disc + arguments + kOutputs, part);
  };
  refused("--spacing -0.4", "spacing is -0.4 mm");
  refused("--spacing nan", "--spacing is \"nan\"; it must be a number");
  refused("--spacing 0x1p-1", "it must be a number");
  refused("--spacing 1,5", "--spacing is \"1,5\"; it must be a number");
  refused("--spacing 1e9", "spacing is");
  refused("--spacing 1e-7", "spacing is above 0, below 0.000001 mm; it must be 0.05 to 20 mm");
  refused("--spacing 15", "spacing is 15 mm");  // wider than the disc
  refused("--angle inf", "--angle is \"inf\"");
  refused("--bridge -1", "bridge is -1 mm");
  refused("--seed -1", "--seed is \"-1\"");
  refused("--seed 99999999999999999999", "--seed is");
  refused("--layers 0", "print.layers is 0; it must be 1 to 1000");
  refused("--layers 1.5", "--layers is \"1.5\"; it must be a whole number\n");
  refused("--layers -99999999999", "--layers is");
  refused("--layer-height 9", "print.layerHeight is 9 mm");
  refused("--start-height -1", "print.startHeight is -1 mm; it must be 0 to 5000");
  refused("--flow -1", "print.flow is -1");
  refused("--nozzle 0", "printer.nozzle is 0 mm");
  refused("--perimeters some", "--perimeters is \"some\"; it must be none, soft or");
  refused("--perimeters 101", "--perimeters is \"101\"");
  refused("--mode diagonal", "parallel, orthogonal, smoothest or constrained");
  refused("--flavor smoothie", "marlin, klipper, reprap, prusa or bambu");
  refused("--base-pattern solid", "hatched, concentric or same");
  refused("--show below", "up, bed or both");
  refused("--copies 2", "NxM, two whole numbers");
  refused("--copies 2x2.5", "print.copies is [2, 2.5]; it must be two whole numbers");
  refused("--brim 51", "print.brim is 51");
  refused("--printer mk4", "--printer is \"mk4\", which is no printer");
  refused("--preset paper", "--preset is \"paper\", which is no recipe");
  refused("--filament abs", "--filament is \"abs\", which is no filament; known are petg, pla, pla-silk");
  refused("--bed 200", "--bed is \"200\"");
  refused("--bed 10x10", "bed");  // smaller than the plate
  refused("--place 300,300", "bed");
  refused("--threads 0", "--threads is \"0\"; it must be a whole number from 1 to 256");
  refused("--sweeps 0", "weeps");
  refused("--min-width nan", "--min-width");
  checkRefused(folder, "generate --shape disc --size -3" + kOutputs, "--size is \"-3\"");
  checkRefused(folder, "generate --shape disc --size nanxnan" + kOutputs, "--size is");
  checkRefused(folder, "generate --shape disc --size 10x20" + kOutputs, "--size is \"10x20\" for a disc");
  checkRefused(folder, "generate --shape rect --size 300x20 --spacing 1.2 --nozzle 1" + kOutputs, "bed");
}

TEST_CASE("command lines that make no sense are refused") {
  const Folder folder;
  folder.picture("l.png", 2, 2, [](int, int) { return 128; });
  folder.write("keep.json", R"({"sillon": 1})");
  checkRefused(folder, "", "subcommand");
  checkRefused(folder, "generate", "no shape");
  checkRefused(folder, "generate --angle 3", "no shape");
  checkRefused(folder, "generate --shape disc --spaceing 3" + kOutputs, "--spaceing");
  checkRefused(folder, "generate --shape disc --gcode", "--gcode");
  checkRefused(folder, "generate --shape disc --gcode --quiet", "--gcode");
  checkRefused(folder, "generate --lines l.png --angle 3" + kOutputs, "--lines");
  checkRefused(folder, "generate --shape disc --svg x --gcode x", "named for two outputs");
  checkRefused(folder, "generate --shape disc --svg x --gcode ./x", "named for two outputs");
  checkRefused(folder, "generate --shape disc --svg x --gcode ../work/x", "named for two outputs");
  checkRefused(folder, "generate --shape disc --gcode -", "the output \"-\" is no file");
  checkRefused(folder, "frobnicate", "\"frobnicate\" is no command; it must be generate, check, import, printers or");
  checkRefused(folder, "generate --lines l.png --gcode l.png", "also an input");
  checkRefused(folder, "generate keep.json --shape disc --size 9 --project keep.json", "also an input");
  CHECK(readAll(folder.at("keep.json")) == R"({"sillon": 1})");
}

TEST_CASE("a folder that takes no files stops the run before anything is written") {
  const Folder folder;
  folder.write("file", "x");
  fs::create_directories(folder.at("folder"));
  checkRefused(folder, kDisc + std::string("--svg a.svg --gcode nowhere/a.gcode"), "nowhere");
  checkRefused(folder, kDisc + std::string("--svg a.svg --gcode file/a.gcode"), "file");
  checkRefused(folder, kDisc + std::string("--svg a.svg --gcode folder"), "is a folder");
  checkRefused(folder, kDisc + std::string("--svg a.svg --gcode /dev/null"), "device");
  checkRefused(folder, kDisc + std::string("--svg a.svg --gcode ") + std::string(300, 'x'), "cannot be written: ");
  fs::permissions(folder.at("folder"), fs::perms::owner_read | fs::perms::owner_exec);
  if (::geteuid() == 0) {
    MESSAGE("root may write anywhere; the read-only folder is skipped");
  } else {
    checkRefused(folder, kDisc + std::string("--svg a.svg --gcode folder/a.gcode"), "folder");
  }
  fs::permissions(folder.at("folder"), fs::perms::owner_all);
}

TEST_CASE("a disk that fills up on the way leaves old files as they were and no new ones") {
  const Folder folder;
  folder.write("a.json", "old");
  // Files may grow to a few kB: the report fits, the picture does not.
  const Run run = folder.run(kDisc + std::string("--report a.json --preview a.png"), "trap '' XFSZ; ulimit -f 8;");
  CAPTURE(run.err);
  CHECK(run.code == 2);
  CHECK(has(run.err, "\"a.png\" cannot be written: "));
  CHECK(readAll(folder.at("a.json")) == "old");
  CHECK(folder.files().size() == 1);
}

TEST_CASE("an answer that is lost is a failure") {
  if (!fs::exists("/dev/full")) return;
  const Folder folder;
  REQUIRE(folder.run(std::string(kDisc) + "--gcode a.gcode").code == 0);
  for (const char* command : {"--help", "printers", "printers prusa-mini", "check a.gcode", "import a.gcode"}) {
    CAPTURE(command);
    const Run run = folder.run(command, R"(sh -c '"$0" "$@" >/dev/full')");
    CHECK(run.code == 2);
    CHECK(has(run.err, "sillon: stdout cannot be written: "));
  }
}

TEST_CASE("a date that is none is refused") {
  const Folder folder;
  for (const char* date :
       {"SOURCE_DATE_EPOCH=-5", "SOURCE_DATE_EPOCH=soon", "SOURCE_DATE_EPOCH=99999999999999999999"}) {
    const Run run = folder.run(kDisc + std::string("--gcode a.gcode"), date);
    CHECK(run.code == 2);
    CHECK(has(run.err, "SOURCE_DATE_EPOCH is"));
    CHECK(folder.files().empty());
  }
}

TEST_CASE("an output that was there is replaced, links stay links, and no temporary file remains") {
  const Folder folder;
  folder.write("real.svg", "old");
  fs::create_symlink("real.svg", folder.at("link.svg"));
  REQUIRE(folder.run(kDisc + std::string("--quiet --svg link.svg")).code == 0);
  CHECK(fs::is_symlink(folder.at("link.svg")));
  CHECK(has(readAll(folder.at("real.svg")), "<svg"));
  CHECK(folder.files().size() == 2);
}

TEST_CASE("Ctrl-C ends with code 3 and leaves nothing behind") {
  const Folder folder;
  const std::string gcode = folder.at("a.gcode").string();
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const int sink = ::open(folder.at("../err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::dup2(sink, STDERR_FILENO);
    ::dup2(sink, STDOUT_FILENO);
    ::execl(SILLON_CLI, "sillon", "generate", "--shape", "rect", "--size", "210x210", "--spacing", "0.3", "--gcode",
            gcode.c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  ::kill(child, SIGINT);
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 3);
  CHECK(folder.files().empty());
  const std::string err = readAll(folder.at("../err"));
  CHECK(err.rfind("sillon: ", 0) == 0);
  CHECK(err.find('\n') == err.size() - 1);
}
