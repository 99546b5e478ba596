// The command line as a shell sees it: exit codes, one sentence per mistake, files together or not at all.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef SILLON_WEBP
#include <webp/demux.h>
#endif

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "export/zip.hpp"
#include "sillon/base/words.hpp"
#include "sillon/calibrate/calibrate.hpp"
#include "sillon/export/export.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/report/warning.hpp"
#include "support/about.hpp"
#include "support/coupon_photo.hpp"
#include "support/report_keys.hpp"

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

// A printer that reads .gcode.3mf, with a start block such as its own slicer writes. \param filament  from 0
std::string bambuProject(int filament) {
  const std::string n = std::to_string(filament);
  return R"({"sillon": 1, "printer": {"flavor": "bambu", "startGcode": "G28\nM190 S60\nM620 S)" + n + R"(A\nT)" + n +
         R"(\nM621 S)" + n + R"(A\nM109 S220\n"}})";
}

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
  CHECK(folder.run("").out == run.out);
  CHECK(folder.run("").code == 0);
  run = folder.run("generate --help");
  CHECK(run.code == 0);
  CHECK(run.err == "");
  for (const char* word : {"--shape", "--directions", "--spacing MM", "[0.4]", "Examples:"}) {
    CAPTURE(word);
    CHECK(has(run.out, word));
  }
  CHECK_FALSE(has(run.out, "--max-width"));
  CHECK(has(folder.run("generate --help-all").out, "--max-width"));
}

TEST_CASE("help of every command is short, complete on demand, and fits the line") {
  const Folder folder;
  const std::string general = folder.run("--help").out;
  const std::size_t begin = general.find("Commands:\n");
  REQUIRE(begin != std::string::npos);
  std::istringstream lines(general.substr(begin + 10, general.find("\n\n", begin) - begin - 10));
  int commands = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.size() < 3 || line[2] == ' ') continue;  // a text that goes on
    const std::string name = line.substr(2, line.find(' ', 2) - 2);
    CAPTURE(name);
    ++commands;
    const std::string few = folder.run(name + " --help").out;
    const std::string all = folder.run(name + " --help-all").out;
    const auto count = [](const std::string& text) {
      int options = 0;
      for (std::size_t at = text.find("\n  -"); at != std::string::npos; at = text.find("\n  -", at + 1)) ++options;
      return options;
    };
    CHECK(count(few) <= 15);
    CHECK(count(all) >= count(few));
    CHECK(has(few, "usage: sillon " + name));
    CHECK(has(few, name + " --help-all shows") == (count(all) > count(few)));
    for (const char* columns : {"", "COLUMNS=60 ", "COLUMNS=100 "}) {
      const std::size_t most = *columns == '\0' ? 80 : columns[8] == '6' ? 60 : 100;
      std::istringstream rows(folder.run(name + " --help-all", columns).out);
      for (std::string row; std::getline(rows, row);) {
        CAPTURE(row);
        const bool whole = row.find_first_of(' ', row.find_first_not_of(' ')) == std::string::npos;  // one long word
        const bool example = has(row, "  sillon ");
        CHECK((row.size() <= most || whole || (example && most == 60)));
      }
    }
    // Texts begin with small letters, but for abbreviations, names and headings.
    std::istringstream rows(all);
    for (std::string row; std::getline(rows, row);) {
      if (row.rfind("  -", 0) != 0) continue;
      const std::size_t text = row.find("  ", 3);
      if (text == std::string::npos) continue;
      const std::size_t at = row.find_first_not_of(' ', text);
      CAPTURE(row);
      const bool lower = std::isupper(static_cast<unsigned char>(row[at])) == 0;
      CHECK((lower || std::islower(static_cast<unsigned char>(row[at + 1])) == 0));
    }
  }
  CHECK(commands >= 12);
}

TEST_CASE("a word that is near a command or an option is answered with it") {
  const Folder folder;
  checkRefused(folder, "generat --shape disc", "did you mean generate?");
  checkRefused(folder, "setings", "did you mean settings?");
  checkRefused(folder, "generate --spcaing 3",
               "--spcaing is not an option of sillon generate; did you mean --spacing?");
  checkRefused(folder, "check a.gcode b.gcode", "\"b.gcode\" is unexpected; see sillon check --help");
  CHECK_FALSE(has(folder.run("frobnicate").err, "did you mean"));
}

TEST_CASE("options of experts stand in the whole help alone, and work") {
  const Folder folder;
  const std::string help = folder.run("generate --help").out;
  const std::string all = folder.run("generate --help-all").out;
  for (const char* expert : {"--kernel-radius", "--border-weight", "--sweeps"}) {
    CAPTURE(expert);
    CHECK_FALSE(has(help, expert));
    CHECK(has(all, expert));
  }
  const std::string plate = "generate --shape disc --size 10 --spacing 1 --quiet --project p.json";
  CHECK(folder.run(plate).err == "");
  const std::string usual = readAll(folder.at("p.json"));
  CHECK(folder.run(plate + " --kernel-radius 0.8").err == "");
  CHECK(readAll(folder.at("p.json")) != usual);
}

TEST_CASE("the table of settings is listed as text and as JSON") {
  const Folder folder;
  const Run text = folder.run("settings");
  CHECK(text.code == 0);
  CHECK(has(text.out, "\ntoolpath.kernelRadius"));
  CHECK(has(text.out, "(--kernel-radius)"));
  const Json json = Json::parse(folder.run("settings --json").out, nullptr, false);
  REQUIRE(json.is_object());
  CHECK(json["settings"].size() > 80);
  CHECK(json["facts"]["evenSpeed"] == 20);
  CHECK(json["facts"]["calibrationKinds"].size() == 7);
}

TEST_CASE("a spool is said to show pictures faintly below the contrast that programs are told") {
  const Folder folder;
  const double weak = Json::parse(folder.run("spools --json").out)["weakContrast"];
  folder.picture("l.png", 8, 8, [](int column, int row) { return 30 * column + row; });
  int said = 0;
  for (const char* size : {"0.07", "0.08", "0.09", "0.1"}) {
    const std::string out = folder
                                .run(
                                    "generate --picture l.png --size 16 --spacing 0.8 --lamp 60 --svg a.svg --spool "
                                    "goldPla --lamp-size " +
                                    std::string(size))
                                .out;
    const std::size_t at = out.find("shows white only ");
    if (at == std::string::npos) continue;
    ++said;
    CHECK(std::stod(out.substr(at + 17)) <= weak);
  }
  CHECK(said > 0);
  CHECK(said < 4);
}

TEST_CASE("the sentences of warnings, notes, findings and refusals are listed by their codes") {
  const Folder folder;
  CHECK(has(folder.run("words").out, "\n  SkirtLeftOut: the skirt does not fit the bed and was left out"));
  const Json kinds = Json::parse(folder.run("words --json").out, nullptr, false);
  REQUIRE(kinds.size() == 8);
  CHECK(kinds["warnings"].size() == static_cast<std::size_t>(sillon::WarningCode::WidthHeld) + 1);
  CHECK(kinds["findings"]["too-hot"] == "hotter than {limit} degrees: {degrees}");
  for (const auto& [kind, sentences] : kinds.items()) {
    for (const auto& [code, text] : sentences.items()) {
      const auto codeNow = code;  // clang 14 captures no structured binding
      CAPTURE(codeNow);
      const std::string sentence = text;
      CHECK((!code.empty() && !sentence.empty() && sentence.back() != '.'));
      const auto plain = [](char c) { return c >= ' ' && c <= '~'; };
      CHECK(std::all_of(sentence.begin(), sentence.end(), plain));
    }
  }
}

TEST_CASE("spools are listed with what they show under lamps") {
  const Folder folder;
  const Run text = folder.run("spools");
  CHECK(text.code == 0);
  CHECK(has(text.out, "\nbluePla      #184ea8"));
  const Json json = Json::parse(folder.run("spools --json").out);
  REQUIRE(json["spools"].size() == 5);
  CHECK(json["profileSlope"] == 0.3);
  for (const Json& spool : json["spools"]) {
    for (const char* lamp : {"bulb", "softbox", "window"}) {
      const Json& light = spool["light"][lamp];
      REQUIRE(light.size() == 36);
      CHECK(light[30] == 1);                                                      // across the lamp at 60 degrees
      CHECK(light[12] < 0.9);                                                     // along it
      CHECK(std::abs(light[29].get<double>() - light[31].get<double>()) < 1e-5);  // the same on both sides
    }
  }
}

TEST_CASE("a spool of one's own is listed, solved for and shown like the measured ones") {
  const Folder folder;
  // Blue PLA by another name and in another colour.
  folder.write("mine.json", R"({"version": 1, "spools": {"mySilk": {"colour": [1, 2, 3], "source": "a photograph",
    "fine": {"nozzleSide": [2.36, 17.32], "bedSide": [2.56, 13.54]}}}})");
  const Run text = folder.run("spools --spools mine.json");
  CHECK(text.code == 0);
  const auto lineOf = [&](const std::string& key) {
    const std::size_t at = text.out.find("\n" + key) + 1;
    return text.out.substr(at, text.out.find('\n', at) - at);
  };
  CHECK(has(lineOf("mySilk"), "#010203"));
  CHECK(lineOf("mySilk").substr(24) == lineOf("bluePla").substr(24));  // the same slopes show the same
  const Json json = Json::parse(folder.run("spools --json --spools mine.json").out);
  REQUIRE(json["spools"].size() == 6);
  CHECK(json["spools"][5]["key"] == "mySilk");
  CHECK(json["spools"][5]["wide"] == json["spools"][5]["fine"]);
  CHECK(json["spools"][5]["light"] == json["spools"][0]["light"]);

  folder.picture("l.png", 8, 8, [](int column, int row) { return 30 * column + row; });
  const std::string plate = "generate --picture l.png --size 16 --spacing 0.8 --lamp 60 --svg ";
  REQUIRE(folder.run(plate + "blue.svg").code == 0);
  REQUIRE(folder.run(plate + "own.svg --spools mine.json --spool mySilk --project own.json").code == 0);
  REQUIRE(folder.run(plate + "gold.svg --spool goldPla").code == 0);
  CHECK(readAll(folder.at("own.svg")) == readAll(folder.at("blue.svg")));
  CHECK(readAll(folder.at("gold.svg")) != readAll(folder.at("blue.svg")));
  // The project keeps the slopes; a spool that is asked for over it wins.
  CHECK(Json::parse(readAll(folder.at("own.json")))["pictures"]["slopes"] == Json({2.36, 17.32}));
  REQUIRE(folder.run("generate own.json --spool goldPla --svg again.svg").code == 0);
  CHECK(readAll(folder.at("again.svg")) == readAll(folder.at("gold.svg")));

  REQUIRE(folder.run("calibrate fan -o a.gcode --preview own.png --preview-width 64 --spools mine.json --spool mySilk")
              .code == 0);
  REQUIRE(folder.run("calibrate fan -o a.gcode --preview blue.png --preview-width 64").code == 0);
  CHECK(readAll(folder.at("own.png")) != readAll(folder.at("blue.png")));  // its colour is another

  folder.write("bad.json", R"({"version": 1, "spools": {"bluePla": {}}})");
  checkRefused(folder, "spools --spools bad.json",
               "\"bad.json\": spools[\"bluePla\"] is one that comes with the program");
  checkRefused(folder, "spools --spools nothing.json", "nothing.json");
  checkRefused(folder, plate + "a.svg --spools mine.json", "no --spool is given; it must name one");
  checkRefused(folder, plate + "a.svg --spools mine.json --spool hers", "goldPla, greyPla, redPetg, mySilk");
  checkRefused(folder, plate + "mine.json --spools mine.json --spool mySilk", "also an input");
}

TEST_CASE("printers and filaments are listed, and one of them begins a project") {
  const Folder folder;
  const Run list = folder.run("printers");
  CHECK(list.code == 0);
  CHECK(has(list.out, "\nprusa-mk4s "));
  CHECK(has(list.out, "230x230x300 round centred"));
  CHECK(has(list.out, "220x220x250                0.4    255/100   plain\n"));  // Ender-3 V2
  CHECK(has(folder.run("filaments").out, "\npetg "));
  const Run one = folder.run("printers creality-k1");
  CHECK(one.code == 0);
  const Json all = Json::parse(folder.run("printers --json").out);
  CHECK(all["printers"].size() + 1 == static_cast<std::size_t>(std::count(list.out.begin(), list.out.end(), '\n')));
  const auto same = std::find_if(all["printers"].begin(), all["printers"].end(),
                                 [](const Json& printer) { return printer["id"] == "creality-k1"; });
  REQUIRE(same != all["printers"].end());
  CHECK((*same)["maker"] == "Creality");
  CHECK((*same)["printer"] == Json::parse(one.out)["printer"]);
  CHECK(Json::parse(folder.run("filaments --json").out)["filaments"][0]["id"] == "petg");
  checkRefused(folder, "printers creality-k1 --json", "--json applies to the list");
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
  checkRefused(folder, "printers k2", "printers: \"k2\" is unknown for printer.profile");
  folder.write("hot.json", R"({"sillon": 1, "printer": {"profile": "creality-ender-3", "nozzleTemperature": 300}})");
  for (const char* command :
       {"generate hot.json --shape disc --size 12 --gcode a.gcode", "calibrate speed hot.json -o b.gcode"}) {
    checkRefused(folder, command, "printer.nozzleTemperature is 300 degrees Celsius; it must be 170 to 255, or");
  }
}

TEST_CASE("a project that PowerShell has written is read") {
  const Folder folder;
  const std::u16string text =
      u"{\"sillon\": 1, \"shape\": {\"builtin\": \"disc\", \"size\": [12, 0]}, "
      u"\"toolpath\": {\"spacing\": 0.8}, \"printer\": {\"name\": \"\u00fc\u20ac\U0001F600\"}}\r\n";
  std::string bytes = "\xFF\xFE";
  for (const char16_t unit : text) bytes += {static_cast<char>(unit & 0xFF), static_cast<char>(unit >> 8)};
  folder.write("mine.json", bytes);
  const Run made = folder.run("generate mine.json --svg a.svg --project b.json");
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
  CHECK(Json::parse(readAll(folder.at("b.json")))["printer"]["name"] == "\xC3\xBC\xE2\x82\xAC\xF0\x9F\x98\x80");
  folder.write("cut.json", bytes.substr(0, 41));
  checkRefused(folder, "generate cut.json --svg a.svg", "scene \"cut.json\"");
}

TEST_CASE("what a killed run has left goes with the next one, and nothing else") {
  const Folder folder;
  const std::string left = ".sillon-12345678901234567890.tmp";
  const std::set<std::string> kept = {".sillon-1.tmp", ".sillon-mine.tmp", ".sillon-.tmp", "sillon-12.tmp",
                                      ".sillon-12.txt"};
  folder.write(left, "half");
  for (const std::string& name : kept) folder.write(name, "kept");
  const auto old = fs::file_time_type::clock::now() - std::chrono::hours(2);
  fs::last_write_time(folder.at(left), old);
  for (const std::string& name : kept) {
    if (name != ".sillon-1.tmp") fs::last_write_time(folder.at(name), old);  // that one is of a run that goes on
  }
  REQUIRE(folder.run(std::string(kDisc) + "--gcode a.gcode").code == 0);
  CHECK_FALSE(fs::exists(folder.at(left)));
  for (const std::string& name : kept) CHECK(fs::exists(folder.at(name)));
}

TEST_CASE("check reads G-code as a printer would") {
  const Folder folder;
  REQUIRE(folder.run(std::string(kDisc) + "--gcode a.gcode").code == 0);
  const Run good = folder.run("check a.gcode");
  CHECK(good.code == 0);
  CHECK(has(good.out, "3 layers, for Generic\n"));
  CHECK(has(good.out,
            "\nunchecked  flow, speed: the file does not tell the machine's limits; --printer does\nno errors\n"));
  const Run known = folder.run("check a.gcode --printer prusa-mini");
  CHECK(has(known.out, "\nmost "));
  CHECK(!has(known.out, "unchecked"));
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
  fs::resize_file(folder.at("b.gcode"), (std::uintmax_t{1} << 30) + 1);
  checkRefused(folder, "check b.gcode", "is larger than 1024 MiB");
  checkRefused(folder, "check", "file is required");
  checkRefused(folder, "check none.gcode", "cannot be read");
  checkRefused(folder, "check a.gcode --printer mk4", "--printer: \"mk4\"");
}

/// A block of 12 x 12 mm in three layers, as PrusaSlicer would write it.
std::string slicedBlock() {
  std::ostringstream out;
  out << "; generated by PrusaSlicer 2.7.0 on 2026-01-01\n; HEADER_BLOCK_START\nM190 S60\nG28\nM109 "
         "S215\nG21\nG90\nM83\n";
  for (int layer = 1; layer <= 3; ++layer) {
    out << ";LAYER_CHANGE\n;Z:" << 0.2 * layer << "\n;HEIGHT:0.2\nM73 P" << 30 * layer << " R" << 4 - layer << "\nG1 Z"
        << 0.2 * layer << " F7200\nG1 X50 Y50 F7800\n;TYPE:Perimeter\n;WIDTH:0.45\nG1 F1800\n"
        << "G1 X62 Y50 E0.4\nG1 X62 Y62 E0.4\nG1 X50 Y62 E0.4\nG1 X50 Y50 E0.4\nG1 E-2 F2400\nG1 X50.4 Y50.4 F7800\n"
        << "G1 E2 F2400\n;TYPE:" << (layer == 3 ? "Top solid infill" : "Solid infill") << "\n;WIDTH:0.443\nG1 F900\n";
    for (int row = 0; row < 28; ++row) {
      const double y = 50.4 + 0.4 * row;
      out << "G1 X" << (row % 2 == 0 ? 61.6 : 50.4) << " Y" << y << " E0.37252\n";
      if (row < 27) out << "G1 X" << (row % 2 == 0 ? 61.6 : 50.4) << " Y" << y + 0.4 << " E0.0133\n";
    }
    out << "G1 E-2 F2400\nG1 X40 Y40 F7800\n";
  }
  out << "M107\nG1 Z20 F600\nM104 S0\nM140 S0\nM84\n; filament used [mm] = 33.10\n"
      << "; estimated printing time (normal mode) = 3m 0s\n; filament_diameter = 1.75\n; nozzle_diameter = 0.4\n";
  return out.str();
}

/// All keys of a JSON value, however deep.
void addKeys(const Json& json, std::set<std::string>& keys) {
  for (const auto& [key, value] : json.items()) {
    if (json.is_object()) keys.insert(key);
    if (value.is_structured()) addKeys(value, keys);
  }
}

TEST_CASE("every key that programs get of rebrush and of spools is documented") {
  const Folder folder;
  folder.write("part.gcode", slicedBlock());
  const std::string docs = readAll(fs::path(SILLON_SOURCE_DIR) / "docs/reference/report.md");
  std::set<std::string> keys;
  addKeys(Json::parse(folder.run("rebrush part.gcode --list --json").out), keys);
  CHECK(folder.run("rebrush part.gcode --angle 30 -o new.gcode --report r.json").code == 0);
  addKeys(Json::parse(readAll(folder.at("r.json"))), keys);
  addKeys(Json::parse(folder.run("spools --json").out), keys);
  CHECK(keys.size() > 35);
  for (const std::string& key : keys) {
    CAPTURE(key);
    CHECK(has(docs, "`" + key + "`"));
  }
}

TEST_CASE("rebrush lists and replaces tops, and writes the kind of file that it reads") {
  const Folder folder;
  const std::string text = slicedBlock();
  folder.write("part.gcode", text);
  const Run list = folder.run("rebrush part.gcode --list");
  CHECK(list.code == 0);
  CHECK(has(list.out, "top    layer 3"));
  CHECK(Json::parse(folder.run("rebrush part.gcode --list --json").out)["surfaces"].size() == 2);

  // By its number in the list.
  CHECK(has(list.out, "   2 top    layer 3"));
  CHECK(folder.run("rebrush part.gcode --angle 30 --only 2 -o one.gcode").code == 0);

  const Run done = folder.run("rebrush part.gcode --angle 30 -o new.gcode --report r.json --preview p.png");
  CAPTURE(done.err);
  REQUIRE(done.code == 0);
  CHECK(has(done.out, "replaced"));
  const std::string brushed = readAll(folder.at("new.gcode"));
  CHECK(brushed != text);
  CHECK(readAll(folder.at("one.gcode")) == brushed);
  CHECK(brushed.substr(0, text.find(";LAYER_CHANGE")) == text.substr(0, text.find(";LAYER_CHANGE")));
  CHECK(readAll(folder.at("part.gcode")) == text);
  CHECK(readAll(folder.at("p.png")).starts_with("\x89PNG"));
  const Json report = Json::parse(readAll(folder.at("r.json")));
  CHECK(report["surfaces"][0]["replaced"] == true);
  CHECK(report["surfaces"][0]["coverage"] > 98.0);
  CHECK(report["surfaces"][0]["beyond"] < 0.05);
  CHECK(report.contains("seconds"));

  const std::string package = sillon::packGcode(text).value();
  const std::string binary = sillon::packBinaryGcode(text).value();
  const std::string gzip = sillon::gzipGcode(text).value();
  const std::pair<const char*, std::string> kinds[] = {
      {"part.gcode.3mf", package}, {"part.bgcode", binary}, {"part.gcode.gz", gzip}};
  for (const auto& one : kinds) {
    const auto& name = one.first;
    const auto& bytes = one.second;
    CAPTURE(name);
    folder.write(name, bytes);
    const std::string out = "new_" + std::string(name);
    const Run packed = folder.run("rebrush " + std::string(name) + " --angle 30 -o " + out);
    CAPTURE(packed.err);
    REQUIRE(packed.code == 0);
    const auto container = sillon::readGcodeContainer(readAll(folder.at(out))).value();
    CHECK(container.kind == sillon::readGcodeContainer(bytes).value().kind);
    const std::string now = sillon::unpackGcode(readAll(folder.at(out))).value();
    // The same beads as in the plain file; and with the slicer's text again, the slicer's file.
    const std::size_t top = brushed.find(";TYPE:Top"), end = brushed.find("M107");
    CHECK(now.find(brushed.substr(top, end - top)) != std::string::npos);
    CHECK(sillon::writeGcodeContainer(container, sillon::unpackGcode(bytes).value()).value() == bytes);
    // Its text alone may be had, another package not.
    CHECK(folder.run("rebrush " + std::string(name) + " --angle 30 -o text.gcode").code == 0);
    CHECK(readAll(folder.at("text.gcode")) == now);
    const Run other = folder.run("rebrush " + std::string(name) + " --angle 30 -o " +
                                 (std::string(name) == "part.bgcode" ? "other.gcode.3mf" : "other.bgcode"));
    CHECK(other.code == 2);
    CHECK(has(other.err, "another kind of file"));
    // In place.
    CHECK(folder.run("rebrush " + std::string(name) + " --angle 30").code == 0);
    CHECK(readAll(folder.at(name)) == readAll(folder.at(out)));
  }
  folder.write("part.gcode.3mf", package);
  for (const char* text : {"NEW.GCODE", "new.nc", "new"}) {
    CAPTURE(std::string(text));
    CHECK(folder.run("rebrush part.gcode.3mf --angle 30 -o " + std::string(text)).code == 0);
    CHECK(readAll(folder.at(text)) == brushed);
  }
  CHECK(folder.run("rebrush part.gcode --angle 30 -o NEW.BGCODE").code == 2);
  CHECK(folder.run("rebrush part.gcode --angle 30 -o packed.gcode.gz").code == 0);
  CHECK(sillon::unpackGcode(readAll(folder.at("packed.gcode.gz"))).value() == brushed);
}

TEST_CASE("rebrush shows pictures, and leaves files as they are where it refuses") {
  const Folder folder;
  const std::string text = slicedBlock();
  folder.write("part.gcode", text);
  folder.picture("half.png", 40, 40, [](int column, int) { return column < 20 ? 20 : 230; });
  const Run done = folder.run("rebrush part.gcode --picture half.png --lamp 0,35 -o new.gcode --report r.json");
  CAPTURE(done.err);
  REQUIRE(done.code == 0);
  CHECK(has(done.out, "under a lamp at 0 degrees, 35 high"));
  const Json picture = Json::parse(readAll(folder.at("r.json")))["surfaces"][0]["pictures"][0];
  CHECK(picture["r"] > 0.6);
  CHECK(picture["lamp"][0] == 0.0);

  // A spool of one's own with the slopes of gold PLA gives what gold PLA gives.
  folder.write("mine.json", R"({"version": 1, "spools": {"mySilk": {"colour": [1, 2, 3],
    "fine": {"nozzleSide": [8.93, 15.6], "bedSide": [2.43, 9.72]}}}})");
  const std::string lit = "rebrush part.gcode --picture half.png --lamp 0,35 ";
  CHECK(folder.run(lit + "-o own.gcode --spools mine.json --spool mySilk").code == 0);
  CHECK(folder.run(lit + "-o gold.gcode --spool goldPla").code == 0);
  CHECK(readAll(folder.at("own.gcode")) == readAll(folder.at("gold.gcode")));
  CHECK(readAll(folder.at("own.gcode")) != readAll(folder.at("new.gcode")));
  // A project's layers are laid, and those of the line on top of them.
  folder.write("laid.json", R"({"sillon": 1, "toolpath": {"perimeterMode": "soft"}, "layers": [
    {"kind": "direction"}, {"kind": "picture", "pictures": [{"file": "half.png", "lamp": [0, 35]}], "size": [8, 8]}]})");
  const Run laid = folder.run("rebrush part.gcode --project laid.json -o laid.gcode --report laid-report.json");
  CAPTURE(laid.err);
  REQUIRE(laid.code == 0);
  const Json above = Json::parse(readAll(folder.at("laid-report.json")))["surfaces"][0]["pictures"];
  REQUIRE(above.size() == 1);
  CHECK(above[0]["layer"] == 2);
  CHECK_FALSE(above[0].contains("leftOut"));
  CHECK(picture["layer"] == 1);
  CHECK(picture["leftOut"] < 0.03);  // the face is no square
  REQUIRE(
      folder
          .run(R"(rebrush part.gcode --project laid.json --layer '{"kind": "direction", "angle": 45, "size": [4, 4]}' )"
               "-o more.gcode")
          .code == 0);
  CHECK(readAll(folder.at("more.gcode")) != readAll(folder.at("laid.gcode")));
  for (const char* mode : {"parallel", "orthogonal"}) {
    REQUIRE(folder.run("rebrush part.gcode --mode " + std::string(mode) + " -o " + mode + ".gcode").code == 0);
    CHECK(readAll(folder.at(std::string(mode) + ".gcode")) != readAll(folder.at("new.gcode")));
  }
  CHECK(readAll(folder.at("parallel.gcode")) != readAll(folder.at("orthogonal.gcode")));
  // Squeezed in, a wide picture shows what is cut off it otherwise.
  folder.picture("wide.png", 60, 20,
                 [](int column, int) { return column < 20 || (column >= 30 && column < 40) ? 230 : 20; });
  const std::string wide = "rebrush part.gcode --picture wide.png --lamp 0,35 ";
  for (const char* how : {"", "--proportions keep", "--proportions stretch"}) {
    const auto done = folder.run(wide + how + " -o wide" + std::to_string(std::string(how).size()) + ".gcode");
    REQUIRE(done.code == 0);
    CHECK(has(done.out, "of it is cut off") == (std::string(how) != "--proportions stretch"));
  }
  CHECK(readAll(folder.at("wide0.gcode")) == readAll(folder.at("wide18.gcode")));
  CHECK(readAll(folder.at("wide0.gcode")) != readAll(folder.at("wide21.gcode")));

  const auto files = folder.files();
  const std::pair<const char*, const char*> refused[] = {
      {"part.gcode --picture half.png --lamp x", "it must be AZ or AZ,EL"},
      {"part.gcode --picture half.png --angle 3", "--angle"},
      {"part.gcode --project half.png", "scene \"half.png\""},
      {"part.gcode --project laid.json -o laid.json", "also an input"},
      {"part.gcode --mode diagonal", "parallel, orthogonal, smoothest or constrained"},
      {"part.gcode --modes half.png --mode parallel", "--modes excludes --mode"},
      {"part.gcode --picture nowhere.png", "cannot be read"},
      {"part.gcode --picture half.png --fit bed", "fit is bed, but the file does not give its bed"},
      {"part.gcode --fit sideways", "must be face, object, bed or all"},
      {"part.gcode --surfaces bottom --perimeters many", "must be none, soft or a whole number from 0 to 100"},
      {"part.gcode --angle 3 -o part.gcode --report part.gcode", "two outputs"},
      {"part.gcode --angle 3 --report part.gcode", "two outputs"},
      {"part.gcode --json", "--json requires --list"},
      {"part.gcode --list -o other.gcode", "--list excludes --output"},
      {"part.gcode --directions half.png --angle 3", "--directions excludes --angle"},
      {"part.gcode -o ''", "--output is \"\"; it must be followed by its value"},
      {"''", "file is \"\"; it must be a name"},
      {"part.gcode --angle 0x10", "--angle is \"0x10\"; it must be a number"},
      {"part.gcode --threads 0", "--threads is \"0\"; it must be a whole number from 1 to 256"},
      {"part.gcode --preview-width 1e3", "--preview-width is \"1e3\"; it must be a whole number"},
      {"part.gcode --angle 3 -o more.gcode --report part.gcode", "also an input"},
      {"part.gcode --modes half.png --preview half.png", "also an input"},
      {"part.gcode --surfaces both --angle 3 --preview p.png --report p-2.png", "two outputs"},
      {"half.png", "does not mark its surfaces"},
      {"part.gcode --only 0", "the first is 1"},
      {"part.gcode --only 2,a", "--only is \"a\"; it must be a number that --list shows"},
      {"part.gcode --only 7", "surface 7 is chosen; the file has 2"},
  };
  for (const auto& one : refused) {
    const auto& arguments = one.first;
    const auto& message = one.second;
    CAPTURE(arguments);
    const Run run = folder.run("rebrush " + std::string(arguments));
    CHECK(run.code == 2);
    CAPTURE(run.err);
    CHECK(has(run.err, message));
  }
  CHECK(folder.files() == files);
  CHECK(readAll(folder.at("part.gcode")) == text);
}

TEST_CASE("zones of straight lines are written on a prism or on a body of one's own") {
  const Folder folder;
  // Grey tells the angle: 64 is 180 * 64 / 255 - 90 = -44.8 degrees, 191 is 44.8.
  folder.picture("two.png", 40, 40, [](int column, int) { return column < 20 ? 64 : 191; });
  folder.write("text.svg",
               "<svg xmlns='http://www.w3.org/2000/svg' width='9mm' height='9mm'><rect width='9' "
               "height='9'/><flowRoot>a</flowRoot></svg>");
  const Run told = folder.run("zones --shape text.svg --angle 30 -o told.3mf");
  CHECK(has(told.out, "note   text in the drawing is left out (1 <text>)"));
  CHECK(has(told.out, "off    0.0 degrees on average"));
  folder.write("off.svg",
               "<svg xmlns='http://www.w3.org/2000/svg' width='9mm' height='9mm' viewBox='0 0 9 9'><rect width='19' "
               "height='9'/></svg>");
  CHECK(has(folder.run("zones --shape off.svg --angle 30 -o told.3mf").out, "lie off its page"));
  const Run done = folder.run("zones --shape rect --size 30x20 --directions two.png -o new.3mf");
  CAPTURE(done.err);
  REQUIRE(done.code == 0);
  CHECK(has(done.out, "44.8 degrees"));
  CHECK(has(done.out, "135.2 degrees"));
  CHECK(readAll(folder.at("new.3mf")).starts_with("PK"));
  // What is read is read as generate reads it: grey is now 180 * 64 / 255 degrees.
  CHECK(has(
      folder.run("zones --shape rounded --radius 5 --size 30x20 --directions two.png --encoding rotation -o r.3mf").out,
      "45.2 degrees"));

  folder.write("plate.json", "{}");
  CHECK(folder.run("generate --shape disc --size 20 --body body.stl --base 4 --spacing 0.8 --gcode plate.gcode").code ==
        0);
  const Run body = folder.run("zones --body body.stl --angle 30 --zones 3 -o body.3mf");
  CAPTURE(body.err);
  REQUIRE(body.code == 0);
  CHECK(has(body.out, "30.0 degrees"));
  CHECK_FALSE(has(body.out, "open edge"));
  // Without its last triangle.
  std::string open = readAll(folder.at("body.stl"));
  const std::size_t triangles = (open.size() - 84) / 50 - 1;
  for (int k = 0; k < 4; ++k) open[80 + static_cast<std::size_t>(k)] = static_cast<char>(triangles >> 8 * k);
  folder.write("open.stl", open.substr(0, 84 + 50 * triangles));
  CHECK(has(folder.run("zones --body open.stl --angle 30 -o body.3mf").out, "the body has 3 open edges"));

  // Letters lie on the body's top, across what is below them.
  const Run letters = folder.run(
      R"(zones --body body.stl --angle 30 --layer '{"kind": "text", "text": "I", "textSize": 12}' --least 1 -o i.3mf)");
  CAPTURE(letters.err);
  REQUIRE(letters.code == 0);
  CHECK(has(letters.out, "zone     30.0 degrees"));
  CHECK(has(letters.out, "zone    120.0 degrees"));

  // On one face of it the project's shape lies, and nothing else gets zones.
  folder.write("face.json", R"({"sillon": 1, "shape": {"builtin": "rectangle", "size": [8, 4]}})");
  const Run face = folder.run("zones face.json --angle 20 --body body.stl --face 4,6,1 -o face.3mf");
  CAPTURE(face.err);
  REQUIRE(face.code == 0);
  CHECK(has(face.out, "zone     20.0 degrees"));

  const auto files = folder.files();
  const std::pair<const char*, const char*> refused[] = {
      {"--shape disc --angle 3 --face 1,2,3 -o a.3mf", "--face"},
      {"--body body.stl --angle 3 --face 1,2 -o a.3mf", "three numbers in mm, as in 10,20,5"},
      {"--body body.stl --angle 3 --face 1 -o a.3mf", "three numbers in mm, as in 10,20,5"},
      {R"(--body body.stl --layer '{"kind": "text", "text": "I", "mode": "smoothest"}' -o a.3mf)",
       "the mode must be constrained"},
      {"--shape disc --angle 3 --zones 1 -o a.3mf", "zones is 1; it must be 2 to 12"},
      {"--shape disc --angle 3 -o a.stl", "it must end in .3mf"},
      {"--body two.png --angle 3 -o a.3mf", "the STL is cut off, or another kind of file"},
      {"--shape disc --angle 3 --layer-height 9 -o a.3mf", "layerHeight is 9 mm"},
      {"--shape disc --angle 3 --height 0 -o a.3mf", "height is 0 mm"},
      {"--shape disc --angle 3", "--output"},
      {"--shape disc --angle 3 --mode orthogonal -o a.3mf", "the mode must be constrained"},
      {"--shape disc --angle 3 --modes two.png -o a.3mf", "the mode must be constrained"},
      {"--body body.stl --angle 3 -o nowhere/a.3mf", "is not a folder"},
  };
  for (const auto& one : refused) {
    const auto& arguments = one.first;
    const auto& message = one.second;
    CAPTURE(arguments);
    const Run run = folder.run("zones " + std::string(arguments));
    CHECK(run.code == 2);
    CAPTURE(run.err);
    CHECK(has(run.err, message));
  }
  CHECK(folder.files() == files);
}

TEST_CASE("a calibration print is written with its table, for people and for programs") {
  const Folder folder;
  const std::string day = "SOURCE_DATE_EPOCH=0";
  const Run done = folder.run("calibrate flow --nozzle 0.8 --layer-height 0.4 -o flow.gcode --preview flow.png", day);
  CAPTURE(done.err);
  REQUIRE(done.code == 0);
  CHECK(has(done.out, ".88      0.88"));
  CHECK(has(done.out, "set      print.flow in the project to the best value\n"));
  CHECK(readAll(folder.at("flow.png")).starts_with("\x89PNG"));
  const std::string gcode = readAll(folder.at("flow.gcode"));
  CHECK(has(gcode, "; calibration: flow\n"));
  CHECK(has(gcode, "; thumbnail begin 32x32"));
  CHECK(folder.run("check flow.gcode").code == 0);

  const Run json = folder.run("calibrate flow --nozzle 0.8 --layer-height 0.4 -o again.gcode --json", day);
  REQUIRE(json.code == 0);
  CHECK(readAll(folder.at("again.gcode")) == gcode);
  const Json told = Json::parse(json.out);
  CHECK(told["kind"] == "flow");
  CHECK(told["values"].size() == 7);
  CHECK(told["values"][1]["value"] == 0.9);
  CHECK(told["findings"].empty());
  CHECK(told["warnings"].is_array());
  CHECK(told["seconds"] > 60);

  // The project's printer, with options over it.
  folder.write("mine.json", R"({"sillon": 1, "printer": {"flavor": "klipper", "pressureAdvance": 0.06,
    "setPressureAdvance": true}})");
  checkRefused(folder, "calibrate speed mine.json -o speed.gcode.3mf",
               "go on with \"sillon calibrate speed mine.json ... -o speed.gcode.3mf\"");
  folder.write("bambu.json", bambuProject(2));
  CHECK(folder.run("calibrate speed bambu.json --from 20 --to 40 -o speed.gcode.3mf").code == 0);
  const Run own = folder.run("calibrate speed mine.json --from 20 --to 40 -o speed.gcode");
  CAPTURE(own.err);
  REQUIRE(own.code == 0);
  CHECK(has(own.out, "pressure advance is 0.06 after the print"));
  CHECK(readAll(folder.at("speed.gcode.3mf")).starts_with("PK"));
  CHECK(folder.run("check speed.gcode.3mf").code == 0);

  const Run swatch = folder.run("calibrate swatch -o card.gcode");
  CHECK(has(swatch.out, "keep     the card with the spool\n"));
  CHECK(!has(swatch.out, "pictures.spool"));

  folder.picture("l.png", 2, 2, [](int, int) { return 128; });
  checkRefused(folder, "calibrate gloss -o a.gcode", "kind is \"gloss\"; it must be flow, speed, fan,");
  checkRefused(folder, "calibrate flow", "--output");
  checkRefused(folder, "calibrate", "kind");
  checkRefused(folder, "calibrate flow --from x -o a.gcode", "--from");
  checkRefused(folder, "calibrate flow --from 2 --to 3 -o a.gcode", "flow is 2; it must be 0.5 to 1.5");
  checkRefused(folder, "calibrate flow --spool tin -o a.gcode",
               "--spool is \"tin\"; it must be one of bluePla, clearPetg,");
  checkRefused(folder, "calibrate flow --bed 30x30 -o a.gcode", "over the edge of the bed");
  checkRefused(folder, "calibrate flow l.png -o a.gcode", "is a picture; calibrate takes a project file");
  checkRefused(folder, "calibrate flow --rotate 90 -o a.gcode", "--rotate");
  checkRefused(folder, "calibrate flow -o nowhere/a.gcode", "is not a folder");
  checkRefused(folder, "calibrate flow mine.json -o mine.json", "also an input");
  checkRefused(folder, "calibrate flow --printer bambu-p1s -o a.gcode", "startGcode is empty");
}

TEST_CASE("a photograph of a coupon is read, for people, for programs and as a spool that is used at once") {
  const Folder folder;
  const auto coupon = sillon::makeCalibration({sillon::CalibrationKind::Coupon, {}, {}, {}}, sillon::RunContext(1));
  REQUIRE(coupon.ok());
  const photo::Truth truth = photo::good();
  const std::vector<std::uint8_t> bytes = photo::taken(coupon.value(), truth);
  folder.write("photo.jpg", std::string(bytes.begin(), bytes.end()));

  const Run told = folder.run("calibrate read photo.jpg --lamp-elevation 45 --name mySilk -o mine.json");
  CAPTURE(told.err);
  REQUIRE(told.code == 0);
  CHECK(has(told.out, "is the lowest that closes the surface"));
  CHECK(has(told.out, "spool    mySilk; wrote mine.json; use it with --spools mine.json --spool mySilk\n"));
  CHECK(has(folder.run("spools --spools mine.json").out, "mySilk"));
  CHECK(folder.run("calibrate directions --spools mine.json --spool mySilk -o star.gcode").code == 0);

  const Run json = folder.run("calibrate read photo.jpg --lamp-elevation 45 --name mySilk --json");
  REQUIRE(json.code == 0);
  const Json read = Json::parse(json.out);
  CHECK(read["spool"] == "mySilk");
  const Run unkept = folder.run("calibrate read photo.jpg --lamp-elevation 45 --name mySilk");
  CHECK(has(unkept.out, "spool    mySilk; keep it with -o FILE, and use it with --spools FILE --spool mySilk\n"));
  CHECK(std::abs(read["across"]["value"].get<double>() / truth.slopes.across - 1) < 0.1);
  CHECK(std::abs(read["flow"]["value"].get<double>() - 1) < 0.015);
  CHECK(std::abs(read["lamp"]["azimuth"]["value"].get<double>() - truth.lamp.azimuth) < 3);
  const Json spool = Json::parse(readAll(folder.at("mine.json")))["spools"]["mySilk"];
  CHECK(std::abs(spool["fine"]["nozzleSide"][0].get<double>() - read["along"]["value"].get<double>()) < 0.011);

  folder.picture("grey.png", 300, 300, [](int, int) { return 128; });
  checkRefused(folder, "calibrate read grey.png -o out.json", "\"grey.png\": the photograph shows no coupon");
  CHECK(!fs::exists(folder.at("out.json")));
  // Several: what cannot be read is told, and does not matter.
  const Run several = folder.run("calibrate read photo.jpg grey.png photo.jpg --lamp-elevation 45 --json");
  REQUIRE(several.code == 0);
  const Json together = Json::parse(several.out);
  CHECK(together["photographs"] == 2);
  REQUIRE(together["refused"].size() == 1);
  CHECK(has(together["refused"][0].get<std::string>(), "grey.png"));
  CHECK(together["across"]["value"] == read["across"]["value"]);
  CHECK(together["across"]["error"] == read["across"]["error"]);  // the same one twice tells no more
  CHECK(together["lamps"] == 1);
  CHECK(has(folder.run("calibrate read photo.jpg photo.jpg --lamp-elevation 45").out, "the lamp stands in 1 place"));
  checkRefused(folder, "calibrate read photo.jpg --lamp-elevation 20",
               "\"photo.jpg\": lamp elevation is 20 degrees, and the photograph shows the lamp at 45");
  checkRefused(folder, "calibrate read photo.jpg none.jpg", "none.jpg");
  checkRefused(folder, "calibrate read grey.png grey.png", "\"grey.png\": the photograph shows no coupon");
  folder.write("plain.json", R"({"sillon": 1})");
  checkRefused(folder, "calibrate flow plain.json more.json -o a.gcode", "unexpected file \"more.json\"");
  checkRefused(folder, "calibrate read", "no photograph is given");
  checkRefused(folder, "calibrate read nothing.jpg", "nothing.jpg");
  checkRefused(folder, "calibrate read photo.jpg --lamp-size moon", "--lamp-size is \"moon\"; it must be bulb,");
  checkRefused(folder, "calibrate read photo.jpg --lamp-elevation 5", "lampElevation is 5");
  checkRefused(folder, "calibrate read photo.jpg --name 'a b'", "\"a b\"");
  checkRefused(folder, "calibrate read photo.jpg -o photo.jpg", "also an input");
  checkRefused(folder, "calibrate read photo.jpg --preview p.png", "--preview shows a print");
  checkRefused(folder, "calibrate flow --lamp-size bulb -o a.gcode", "belong to a photograph");
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
  folder.write("bambu.json", bambuProject(2));
  const std::string disc = std::string(kDisc) + "bambu.json ";
  REQUIRE(folder.run(disc + "--gcode a.gcode.3mf", "SOURCE_DATE_EPOCH=0").code == 0);
  REQUIRE(folder.run(disc + "--gcode a.gcode", "SOURCE_DATE_EPOCH=0").code == 0);
  const std::string zip = readAll(folder.at("a.gcode.3mf"));
  CHECK(zip.starts_with("PK"));
  CHECK(has(zip, readAll(folder.at("a.gcode"))));
  CHECK(has(zip, "<filament id=\"3\" "));
  CHECK(folder.run("check a.gcode.3mf").out == folder.run("check a.gcode").out);
  CHECK(folder.run("import a.gcode.3mf").out == folder.run("import a.gcode").out);
  // Printers that read none get none; no work is done for it.
  for (const char* other : {"", "--printer prusa-mini "}) {
    checkRefused(
        folder, std::string(kDisc) + other + "--gcode no.gcode.3mf",
        "\"no.gcode.3mf\" is for a Bambu Lab printer, but the project's printer is not; take the printer from a "
        "file of your slicer, \"sillon import your.gcode.3mf > mine.json\", and go on with \"sillon generate "
        "mine.json ... --gcode no.gcode.3mf --container your.gcode.3mf\"");
  }
  // The slicer's package keeps the number of its filament; G-code for another is not put into it.
  folder.write("first.json", bambuProject(0));
  CHECK(folder.run(disc + "--gcode in.gcode.3mf --container a.gcode.3mf").code == 0);
  checkRefused(folder, std::string(kDisc) + "first.json --gcode out.gcode.3mf --container a.gcode.3mf",
               "the .gcode.3mf is for filament 3, but the G-code for filament 1");
  folder.write("b.gcode.3mf", zip.substr(0, zip.size() / 2));
  checkRefused(folder, "check b.gcode.3mf", "the .gcode.3mf is cut off");
  sillon::Zip two;
  for (const char* plate : {"Metadata/plate_1.gcode", "Metadata/plate_2.gcode"})
    two.add(plate, readAll(folder.at("a.gcode")));
  folder.write("two.gcode.3mf", two.finish());
  checkRefused(folder, "check two.gcode.3mf", "it holds 2 plates; export them one by one");
  checkRefused(folder, "rebrush two.gcode.3mf -o new.gcode.3mf", "it holds 2 plates; export them one by one");
  // Endings count in any case; what would be taken for another kind of file is not written.
  REQUIRE(folder.run(disc + "--gcode c.GCODE.3MF", "SOURCE_DATE_EPOCH=0").code == 0);
  CHECK(readAll(folder.at("c.GCODE.3MF")) == zip);
  REQUIRE(folder.run(disc + "--gcode d.gcode.gz", "SOURCE_DATE_EPOCH=0").code == 0);
  CHECK(readAll(folder.at("d.gcode.gz")).starts_with("\x1f\x8b"));
  CHECK(folder.run("check d.gcode.gz").out == folder.run("check a.gcode").out);
  checkRefused(folder, std::string(kDisc) + "--gcode e.3mf", "G-code in a 3MF must end in .gcode.3mf");
  checkRefused(folder, "calibrate flow -o e.3mf", "G-code in a 3MF must end in .gcode.3mf");
}

TEST_CASE("the base is written as a solid, STL or 3MF by its name") {
  const Folder folder;
  REQUIRE(folder.run(std::string(kDisc) + "--body a.stl").code == 0);
  REQUIRE(folder.run(std::string(kDisc) + "--body a.3mf").code == 0);
  const std::string stl = readAll(folder.at("a.stl"));
  CHECK(stl.starts_with("base body by Sillon"));
  CHECK(stl.size() % 50 == 84 % 50);
  CHECK(readAll(folder.at("a.3mf")).starts_with("PK"));
  checkRefused(folder, std::string(kDisc) + "--base 0 --body b.stl", "print.base is 0; it must be at least 1");
}

namespace {

// By ulimit -v, which only Linux obeys.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__linux__)
constexpr bool kCanLimitMemory = false;
#elif defined(__has_feature)
constexpr bool kCanLimitMemory = !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer);
#else
constexpr bool kCanLimitMemory = true;
#endif

}  // namespace

TEST_CASE("a body that cannot be made does not take the G-code with it") {
  const Folder folder;
  folder.write("old.stl", "what was there");
  const Run run = folder.run(std::string(kDisc) + "--base 0 --gcode a.gcode --report a.json --body old.stl");
  CHECK(run.code == 2);
  CHECK(run.err ==
        "sillon: \"old.stl\" is not written: print.base is 0; it must be at least 1 for a body of the base layers\n");
  CHECK(has(run.out, "wrote      a.gcode"));
  CHECK(!has(run.out, "wrote      old.stl"));
  CHECK(readAll(folder.at("old.stl")) == "what was there");
  CHECK(folder.run("check a.gcode").code == 0);
  const Json noted = Json::parse(readAll(folder.at("a.json")));
  CHECK(noted["warnings"].is_array());
  CHECK(noted["print"]["seconds"] > 1);
  CHECK(noted["print"]["filamentMm"] > 1);
  CHECK(noted["print"]["grams"] > 0);
  CHECK(folder.files().size() == 3);
}

TEST_CASE("a plate that the memory does not hold is refused before work begins, and both ways out work") {
  if (!kCanLimitMemory) {
    MESSAGE("memory cannot be limited here, or a sanitizer needs all of it; the plate for little of it is skipped");
    return;
  }
  const Folder folder;
  const std::string plate = "generate --shape rect --threads 1 --quiet --svg a.svg --angle 30 ";
  const std::string little = "ulimit -v 300000;";
  const Run run = folder.run(plate + "--size 1000x400 --spacing 0.4", little);
  CHECK(run.code == 2);
  CHECK(has(run.err, "10.1 million cells at spacing 0.4 mm; at most "));
  CHECK(has(run.err, " GB of memory: use a spacing of at least "));
  CHECK(folder.files().empty());
  const auto after = [&](const std::string& words) {
    return std::stod(run.err.substr(run.err.find(words) + words.size()));
  };
  const double spacing = after("use a spacing of at least ");
  const double percent = after("or a size of at most ");
  CHECK(spacing > 0.4);
  CHECK(percent < 100);
  CHECK(folder.run(plate + "--size 1000x400 --spacing " + std::to_string(1.1 * spacing), little).code == 0);
  const double scale = 0.9 * percent / 100;
  const std::string smaller = std::to_string(1000 * scale) + "x" + std::to_string(400 * scale);
  CHECK(folder.run(plate + "--spacing 0.4 --size " + smaller, little).code == 0);
  const Run kept = folder.run(plate + "--size 1000x400 --spacing 0.4 --keep-thin", little);
  CHECK(kept.code == 2);
  CHECK(has(kept.err, " GB of memory: use a spacing of at least "));
  folder.write("fine.json", R"({"sillon": 1, "toolpath": {"spacing": 0.1}})");
  const Run swatch = folder.run("calibrate swatch fine.json -o swatch.gcode", "ulimit -v 200000;");
  CHECK(swatch.code == 2);
  CHECK(has(swatch.err, " GB of memory: use a spacing of at least "));
}

TEST_CASE("pressure advance follows the options for printer, filament and nozzle") {
  const Folder folder;
  const auto advance = [&](const std::string& options) {
    const Run run = folder.run("generate " + options + " --shape disc --size 12 --spacing 0.8 --gcode a.gcode");
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    const std::string text = readAll(folder.at("a.gcode"));
    const std::size_t at = text.find("\nM572 S") + 7;
    return at < 7 ? 0.0 : std::stod(text.substr(at, text.find('\n', at) - at));
  };
  CHECK(advance("--printer prusa-mk4s") == 0.036);
  CHECK(advance("--printer prusa-mk4s --filament petg") == 0.053);
  CHECK(advance("--filament petg --printer prusa-mk4s --nozzle 0.6") == 0.032);
  CHECK(advance("--printer prusa-mk4s --nozzle 0.7") == 0);
  CHECK(advance("--printer prusa-core-one") == 0.036);
  folder.write("own.json", R"({"sillon": 1, "printer": {"profile": "prusa-mk4s", "pressureAdvance": 0.044}})");
  CHECK(advance("own.json --filament petg") == 0.044);
  folder.write("mine.json", R"({"sillon": 1, "printer": {"profile": "prusa-mk4s"}})");
  CHECK(advance("mine.json --filament petg") == 0.053);
}

TEST_CASE("another printer keeps the nozzle, the speed and the fan that a scene chose for its oriented layers") {
  const Folder folder;
  folder.write("own.json", R"({"sillon": 1, "printer": {"profile": "creality-ender-3", "speed": 70, "nozzle": 0.6,
                               "showSpeed": 33, "showFan": 40}})");
  const Run run = folder.run(
      "generate own.json --printer prusa-mk4s --shape disc --size 30 --spacing 0.8 "
      "--gcode a.gcode --project a.json");
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  const Json printer = Json::parse(readAll(folder.at("a.json")))["printer"];
  CHECK(printer["nozzle"] == 0.6);
  CHECK(printer["showSpeed"] == 33);
  CHECK(printer["showFan"] == 40);
  CHECK(printer["speed"] == 50);  // the machine's
  CHECK(has(readAll(folder.at("a.gcode")), " F1980\n"));
}

TEST_CASE("a printer is imported from G-code and prints") {
  const Folder folder;
  REQUIRE(folder.run(std::string(kDisc) + "--printer prusa-mini --gcode donor.gcode").code == 0);
  const Run run = folder.run("import donor.gcode");
  CHECK(run.code == 0);
  CHECK(has(run.err, "sillon: note: heights in the end block were left out"));
  folder.write("mine.json", run.out);
  const Run made = folder.run("generate mine.json --shape disc --size 12 --spacing 0.8 --gcode a.gcode");
  CAPTURE(made.err);
  CHECK(made.code == 0);
  CHECK(has(readAll(folder.at("a.gcode")), "\nM862.3 P \"MINI\"\n"));
  CHECK(folder.run("check a.gcode --printer prusa-mini").code == 0);
  REQUIRE(folder.run(std::string(kDisc) + "--printer prusa-mini --gcode donor.gcode.gz").code == 0);
  CHECK(folder.run("import donor.gcode.gz").out == run.out);
  folder.write("no.ini", "a = b\n");
  checkRefused(folder, "import no.ini", "no setting of a printer");
}

TEST_CASE("what a start block leaves behind is told once, by its place in the block") {
  const Folder folder;
  folder.write(
      "mine.json",
      R"({"sillon": 1, "shape": {"builtin": "disc", "size": [12, 12]}, "layers": [{"kind": "direction", "angle": 30}],
    "print": {"layers": 1, "base": 0}, "printer": {"startGcode": "G28\nM190 S60\nM109 S210\nM211 S0"}})");
  const Run run = folder.run("generate mine.json --gcode out.gcode");
  REQUIRE(run.code == 0);
  CHECK(has(run.out, "line 4 of the start G-code: M211 outlives the print"));
  CHECK(run.out.find("outlives") == run.out.rfind("outlives"));
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
  checkReportKeys(report);
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

#ifdef SILLON_WEBP
namespace {

struct MovingPicture {
  int width = 0;
  int height = 0;
  std::uint32_t loops = 0;          // 0: without end
  std::vector<std::string> frames;  // RGBA
  std::vector<int> ends;            // of each frame [ms]
};

MovingPicture readWebp(const std::string& bytes) {
  const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
  const std::unique_ptr<WebPAnimDecoder, void (*)(WebPAnimDecoder*)> decoder(WebPAnimDecoderNew(&data, nullptr),
                                                                             &WebPAnimDecoderDelete);
  MovingPicture read;
  WebPAnimInfo info;
  if (decoder == nullptr || WebPAnimDecoderGetInfo(decoder.get(), &info) == 0) return read;
  read.width = static_cast<int>(info.canvas_width);
  read.height = static_cast<int>(info.canvas_height);
  read.loops = info.loop_count;
  while (WebPAnimDecoderHasMoreFrames(decoder.get()) != 0) {
    std::uint8_t* rgba = nullptr;
    int end = 0;
    if (WebPAnimDecoderGetNext(decoder.get(), &rgba, &end) == 0) return {};
    const std::size_t size = std::size_t{4} * info.canvas_width * info.canvas_height;
    read.frames.emplace_back(reinterpret_cast<const char*>(rgba), size);
    read.ends.push_back(end);
  }
  return read;
}

/// Mean difference of the bytes of two frames.
double between(const std::string& a, const std::string& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    sum += std::abs(static_cast<int>(static_cast<std::uint8_t>(a[k])) - static_cast<std::uint8_t>(b[k]));
  }
  return sum / static_cast<double>(a.size());
}

}  // namespace

TEST_CASE("a preview that ends in .webp is a loop of moving light") {
  const Folder folder;
  const std::string disc = std::string(kDisc) + "--preview-width 160 ";
  REQUIRE(folder.run(disc + "--threads 1 --preview a.webp").code == 0);
  REQUIRE(folder.run(disc + "--threads 3 --preview b.webp").code == 0);
  CHECK(readAll(folder.at("a.webp")) == readAll(folder.at("b.webp")));
  const MovingPicture read = readWebp(readAll(folder.at("a.webp")));
  CHECK(read.width == 160);
  CHECK(read.height == 160);
  CHECK(read.loops == 0);
  REQUIRE(read.frames.size() == 36);
  CHECK(read.ends.back() == 3600);
  double farthest = 0;
  for (std::size_t k = 1; k < read.frames.size(); ++k) {
    farthest = std::max(farthest, between(read.frames[k - 1], read.frames[k]));
  }
  CHECK(farthest > 1);
  CHECK(between(read.frames.back(), read.frames.front()) <= farthest);  // no jump where it begins anew
  CHECK(between(read.frames[0], read.frames[9]) > farthest);            // a quarter of a turn changes more than a step
  REQUIRE(folder.run(std::string(kDisc) + "--preview usual.webp").code == 0);
  CHECK(readWebp(readAll(folder.at("usual.webp"))).width == 560);
}

TEST_CASE("of several pictures one loop holds each lamp in turn") {
  const Folder folder;
  folder.picture("ramp.png", 40, 30, [](int column, int row) { return 4 * column + 2 * row; });
  folder.picture("fall.png", 40, 30, [](int column, int row) { return 220 - 4 * column - row; });
  const std::string both = "generate ramp.png fall.png --size 20 --lamp 20 --lamp 110,60 --preview-width 120 ";
  REQUIRE(folder.run(both + "--preview look.webp").code == 0);
  CHECK(!fs::exists(folder.at("look-2.webp")));
  const MovingPicture read = readWebp(readAll(folder.at("look.webp")));
  REQUIRE(read.frames.size() == 14);
  CHECK(read.width == 120);
  CHECK(read.height == 90);
  CHECK(read.ends[0] == 1200);
  CHECK(read.ends[1] == 1260);
  CHECK(read.ends[7] == 1560 + 1200);
  CHECK(between(read.frames[0], read.frames[7]) > 5);
}

TEST_CASE("calibrations and surfaces of sliced files move, too") {
  const Folder folder;
  REQUIRE(folder.run("calibrate fan -o a.gcode --preview fan.webp --preview-width 64").code == 0);
  CHECK(readWebp(readAll(folder.at("fan.webp"))).frames.size() == 36);
  folder.write("part.gcode", slicedBlock());
  REQUIRE(folder.run("rebrush part.gcode --angle 30 -o b.gcode --preview top.webp --preview-width 64").code == 0);
  CHECK(readWebp(readAll(folder.at("top.webp"))).frames.size() == 36);
}

TEST_CASE("a moving picture is refused where none can be made") {
  const Folder folder;
  const std::string disc(kDisc);
  checkRefused(folder, disc + "--preview a.webp --preview-width 1600",
               "--preview-width is 1600; for a moving picture it must be 16 to 1024");
  checkRefused(folder, disc + "--svg a.webp", "pictures are written as .png, and --preview also as .webp, which moves");
  checkRefused(folder, disc + "--preview a.gif", "is named like a picture that is not written");
  checkRefused(folder, disc + "--preview none/a.webp", "none\" is not a folder");
}
#endif

TEST_CASE("a project written elsewhere repeats the plate") {
  const Folder folder;
  folder.picture("in/lines.png", 40, 20, [](int column, int) { return column * 6; });
  fs::create_directories(folder.at("out"));
  const std::string date = "SOURCE_DATE_EPOCH=0";
  REQUIRE(folder
              .run("generate --directions in/lines.png --size 16 --spacing 0.8 --perimeters soft --seed 5 "
                   "--project out/p.json --gcode a.gcode",
                   date)
              .code == 0);
  const Run again = folder.run("generate out/p.json --gcode b.gcode", date);
  CAPTURE(again.err);
  REQUIRE(again.code == 0);
  CHECK(readAll(folder.at("a.gcode")) == readAll(folder.at("b.gcode")));
  CHECK(has(readAll(folder.at("a.gcode")), "plate = 16.0x8.0 mm"));
  CHECK(Json::parse(readAll(folder.at("out/p.json")))["layers"] ==
        Json::parse(R"([{"kind": "map", "file": "../in/lines.png"}])"));
}

TEST_CASE("the files of a plate are listed, and nothing is made") {
  Folder folder;
  folder.write("in/p.json",
               R"({"sillon": 1, "shape": {"file": "a.svg"},
               "layers": [{"kind": "map", "file": "sub/d.png", "modeFile": "/m.png"},
                          {"kind": "picture", "pictures": [{"file": "p.png"}, {"file": "sub/q.png"}], "size": [9, 9]},
                          {"kind": "text", "text": "A", "textSize": 9, "font": "own.ttf", "mask": "inside", "maskFile": "k.svg"},
                          {"kind": "text", "text": "A", "textSize": 9, "font": "Caveat"},
                          {"kind": "drawing", "file": "../e.svg", "size": [9, 9]}]})");
  // None of them is there.
  const Run listed = folder.run("generate in/p.json --list-files");
  CAPTURE(listed.err);
  CHECK(listed.code == 0);
  CHECK(listed.out ==
        R"(["in/a.svg","in/sub/d.png","/m.png","in/p.png","in/sub/q.png","in/own.ttf","in/k.svg","in/../e.svg"])"
        "\n");
  // Options and their files, too.
  folder.picture("face.png", 8, 8, [](int, int) { return 200; });
  CHECK(folder.run("generate face.png --modes m.png --shape disc --list-files").out == R"(["face.png","m.png"])"
                                                                                       "\n");
  CHECK(folder.run("generate --shape disc --list-files").out == "[]\n");
  checkRefused(folder, "generate in/p.json --list-files --svg p.svg",
               "--list-files makes no plate for \"p.svg\"; it must be given without files to write");
}

TEST_CASE("a picture is shown under the lamp that is asked for, and judged from the G-code") {
  const Folder folder;
  folder.picture("disc.png", 60, 40, [](int column, int row) {
    return (column - 30) * (column - 30) + (row - 20) * (row - 20) < 150 ? 230 : 20;
  });
  const std::string plate = " --size 24 --spacing 0.4 --layer-height 0.2 --threads 1 ";
  const std::string date = "SOURCE_DATE_EPOCH=0";
  const Run given = folder.run(
      "generate --picture disc.png --lamp 75,50" + plate + "--gcode a.gcode --report a.json --project a.project.json",
      date);
  CAPTURE(given.err);
  REQUIRE(given.code == 0);
  CHECK(has(given.out, "disc.png under a lamp at 75 degrees, 50 high: r 0.9"));
  const Json picture = Json::parse(readAll(folder.at("a.json")))["pictures"][0];
  CHECK(picture["file"] == "disc.png");
  CHECK(picture["lamp"] == Json::array({75, 50}));
  CHECK(picture["r"] > 0.9);  // a positive: the negative has r < 0
  CHECK(picture["ssim"] > 0.5);
  CHECK(picture["contrast"] > 5);
  CHECK(picture["others"] == Json::array());
  CHECK(picture["from"] == "gcode");
  CHECK(has(readAll(folder.at("a.gcode")), "plate = 24.0x16.0 mm"));

  // The project holds all of it, under keys of its own.
  const Json project = Json::parse(readAll(folder.at("a.project.json")));
  CHECK(project["layers"] ==
        Json::parse(R"([{"kind": "picture", "pictures": [{"file": "disc.png", "lamp": [75, 50]}]}])"));
  CHECK(project["toolpath"]["perimeterMode"] == "none");
  REQUIRE(folder.run("generate a.project.json --threads 1 --gcode b.gcode", date).code == 0);
  CHECK(readAll(folder.at("a.gcode")) == readAll(folder.at("b.gcode")));
  // Options move its lamps, or put other pictures in their place.
  CHECK(has(folder.run("generate a.project.json --lamp 20").out, "a lamp at 20 degrees, 45 high: r 0.9"));
  const Run two = folder.run("generate a.project.json --picture disc.png --lamp 10 --picture disc.png --report c.json");
  CAPTURE(two.err);
  CHECK(has(two.out, "at 10 degrees, 45 high: r"));
  CHECK(has(two.out, "45 high (chosen): r"));
  const Json both = Json::parse(readAll(folder.at("c.json")))["pictures"];
  REQUIRE(both.size() == 2);
  const Run torn = folder.run("generate a.project.json --picture disc.png --picture disc.png --conflict torn.png");
  CHECK(has(torn.out, "wrote      torn.png ("));
  CHECK(has(torn.out, "wrote      torn-2.png ("));
  CHECK(both[1]["others"].size() == 1);
  CHECK(both[1]["from"] == "toolpath");
}

TEST_CASE("a picture alone is shown under a lamp that is chosen and said") {
  const Folder folder;
  folder.picture("ramp.png", 40, 30, [](int column, int row) { return 4 * column + 2 * row; });
  const Run run = folder.run("generate ramp.png --size 20 --preview look.png --report r.json");
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  CHECK(has(run.out, "ramp.png under a lamp at "));
  CHECK(has(run.out, " (chosen): r 0."));
  CHECK(Json::parse(readAll(folder.at("r.json")))["pictures"][0]["r"] > 0.85);
}

TEST_CASE("pictures may stand one behind the other, and what of them cannot be seen is told") {
  const Folder folder;
  folder.picture("ramp.png", 40, 30, [](int column, int row) { return 4 * column + 2 * row; });
  folder.picture("grey.png", 40, 30, [](int, int) { return 128; });
  folder.picture("checks.png", 200, 150,
                 [](int column, int row) { return 255 * (37 * (column / 3) * (row / 3) % 11 % 2); });
  const std::string coarse = " --size 20 --spacing 0.8 --corrections 0 --report r.json";
  const Run run = folder.run("generate ramp.png grey.png" + coarse);
  CAPTURE(run.err);
  REQUIRE(run.code == 0);
  const std::size_t ramp = run.out.find("picture    ramp.png"), grey = run.out.find("picture    grey.png");
  CHECK(ramp < grey);
  CHECK(grey < run.out.size());
  CHECK(has(run.out, "\nwarning    picture 2 has one tone on this plate, so nothing can be seen in it; use"));
  CHECK(has(readAll(folder.at("r.json")), R"("code":"PictureOneTone","values":{"picture":2.0})"));

  const Run lost = folder.run("generate checks.png" + coarse);
  REQUIRE(lost.code == 0);
  CHECK(has(lost.out, "\nwarning    picture 1 is hard to recognise in the beads (r "));
  const Json report = Json::parse(readAll(folder.at("r.json")));
  CHECK(report["warnings"][0]["code"] == "PictureLost");
  CHECK(report["warnings"][0]["values"]["r"] < 0.7);
  CHECK_FALSE(has(folder.run("generate ramp.png" + coarse).out, "warning"));

  folder.write("scene.json", R"({"sillon": 1})");
  checkRefused(folder, "generate ramp.png scene.json" + kOutputs, "unexpected file \"scene.json\"");
}

TEST_CASE("pictures and lamps that cannot be are refused, with the way out") {
  const Folder folder;
  folder.picture("tiny.png", 4, 4, [](int column, int row) { return 60 * (column ^ row); });
  folder.write("text.png", "hello, this is no picture at all");
  const auto lit = [&folder](const char* name, const std::string& pictures, const std::string& more = "") {
    folder.write(name, R"({"sillon": 1, "layers": [{"kind": "picture", "pictures": )" + pictures + more + "}]}");
  };
  lit("both.json", R"([{"file": "tiny.png"}])", R"(, "file": "tiny.png")");
  lit("key.json", R"([{"file": "tiny.png", "light": [1, 2]}])");
  lit("bare.json", R"(["tiny.png"])");
  lit("low.json", R"([{"file": "tiny.png", "lamp": [60, 0]}])");
  const std::string one = "generate --picture tiny.png ";
  checkRefused(folder, one + "--lamp north" + kOutputs, "--lamp is \"north\"; it must be AZ or AZ,EL");
  checkRefused(folder, one + "--lamp 60,91" + kOutputs, "elevation from 1 to 90");
  checkRefused(folder, one + "--lamp 361" + kOutputs, "azimuth from -360 to 360");
  checkRefused(folder, one + "--lamp 60,90" + kOutputs, "choose a lower or a smaller lamp");
  checkRefused(folder, one + "--lamp 1 --lamp 2" + kOutputs, "--lamp is given 2 times for 1 picture;");
  checkRefused(folder, one + "--conflict torn.png" + kOutputs, "it must be given with two pictures or more");
  checkRefused(folder, one + "--lamp-size sun" + kOutputs, "it must be bulb, softbox, window or a slope from 0 to 2");
  checkRefused(folder, one + "--spool copper" + kOutputs,
               "it must be one of bluePla, clearPetg, goldPla, greyPla, redPetg");
  checkRefused(folder, one + "--proportions crop" + kOutputs, "it must be one of keep, stretch");
  folder.picture("wide.png", 40, 10, [](int column, int) { return 6 * column; });
  const std::string square = "generate --picture wide.png --shape rectangle --size 12x12 --lamp 60 --svg w.svg ";
  CHECK(has(folder.run(square).out, "75 % of it is cut off"));
  CHECK(!has(folder.run(square + "--proportions stretch").out, "cut off"));
  checkRefused(folder, one + "--smoothness 0" + kOutputs, "pictures.smoothness is 0; it must be 0.001 to 10");
  checkRefused(folder, one + "--local-contrast 3" + kOutputs, "pictures.localContrast is 3; it must be 0 to 2");
  checkRefused(folder, one + "--directions tiny.png" + kOutputs, "excludes");
  folder.write("logo.svg", "\n<svg xmlns='http://www.w3.org/2000/svg'/>");
  folder.write("moving.gif", std::string("GIF89a\x01\0\x01\0", 10));
  checkRefused(folder, "generate logo.svg" + kOutputs,
               "scene \"logo.svg\" is a drawing and not a project; give it as --shape");
  checkRefused(folder, "generate moving.gif" + kOutputs,
               "moving.gif is a GIF file; pictures must be PNG, JPEG, BMP or TGA");
  // A picture by how it begins, also a large one, and behind another.
  folder.write("large", std::string(4, '\0') + "ftypheic" + std::string(2 << 20, 'x'));
  checkRefused(folder, "generate tiny.png large" + kOutputs, "large is a HEIC/AVIF file");
  folder.write("tiny.jfif", readAll(folder.at("tiny.png")));
  CHECK(folder.run("generate tiny.jfif --size 10 --spacing 1 --svg named.svg").code == 0);
  folder.write("noise.bin", std::string(64, '\x01'));
  checkRefused(folder, "generate noise.bin" + kOutputs, "neither a project nor a picture that can be read");
  checkRefused(folder, "generate tiny.png --directions tiny.png" + kOutputs, "--directions cannot be given beside it");
  folder.write("scene.json", R"({"sillon": 1})");
  checkRefused(folder, "generate scene.json tiny.png --angle 3" + kOutputs, "--angle cannot be given beside it");
  checkRefused(folder, "generate tiny.png --angle 3" + kOutputs, "--angle cannot be given beside it");
  checkRefused(folder, "generate --picture text.png" + kOutputs, "text.png");
  checkRefused(folder, "generate --picture none.png" + kOutputs, "\"none.png\" cannot be read");
  checkRefused(folder, one + one.substr(9) + one.substr(9) + one.substr(9) + one.substr(9) + kOutputs,
               "layers[0].pictures has 5 entries; it may have up to 4");
  checkRefused(folder, "generate both.json" + kOutputs, "layers[0].file is not for the kind \"picture\"");
  checkRefused(folder, "generate key.json" + kOutputs, "unknown key \"layers[0].pictures[0].light\"");
  checkRefused(folder, "generate bare.json" + kOutputs,
               "layers[0].pictures[0] is of the JSON type string; it must be an object");
  checkRefused(folder, "generate low.json" + kOutputs, "layers[0].pictures[0].lamp.y is 0 degrees; it must be 1 to 90");
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
  CHECK(project["layers"] == Json::parse(R"([{"kind": "direction", "angle": -45}])"));
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
       {"generate --directions one.png --size 10 --spacing 0.8 --svg a.svg",
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
      R"(<svg viewBox="0 0 60 40"><rect width="60" height="40"/><path d="M9 9h9v9z" fill="#fff"/><flowRoot>a</flowRoot><text y="9" font-family="Arial">b</text><image width="3" height="3"/></svg>)");
  folder.picture("l.png", 8, 8, [](int, int) { return 255; });
  const std::string coarse = " --spacing 2 --nozzle 1";
  const Run drawn = folder.run("generate --shape a.svg" + coarse);
  CHECK(has(drawn.out, "\nnote       the drawing is in pixels, each taken as 1/96 inch; shape.pageWidth (--size)"));
  CHECK(has(drawn.out, "\nnote       text in the drawing is left out (1 <text>); convert it to paths in the program"));
  CHECK(has(drawn.out, "\nnote       text in the drawing is set in a built-in font instead of its own"));
  CHECK(has(drawn.out, "\nnote       pictures in the drawing are left out (1 <image>)"));
  CHECK(has(drawn.out, "\nnote       the drawing has several colours, all printed as one solid"));
  CHECK_FALSE(has(folder.run("generate --shape a.svg --size 20" + coarse).out, "pixels"));
  CHECK(has(folder.run("generate --shape l.png" + coarse).out, "\nnote       no size is given, so it is 80 mm wide"));
  CHECK_FALSE(has(folder.run("generate --shape l.png --size 20" + coarse).out, "note"));
}

TEST_CASE("what a drawing shows is printed; what of it is cut off or not painted is a warning") {
  const Folder folder;
  const std::string head = R"(<svg width="20mm" height="20mm" viewBox="0 0 20 20">)";
  folder.write("off.svg", head + R"(<rect width="10" height="10"/><rect x="15" y="5" width="10" height="4"/></svg>)");
  folder.write("none.svg", head + R"(<rect width="10" height="10" fill="none"/></svg>)");
  folder.write("line.svg",
               head + R"(<rect x="5" y="5" width="10" height="10" fill="none" stroke="red" stroke-width="2"/></svg>)");
  folder.write("two.svg",
               head + R"(<rect width="10" height="10"/><rect x="10" width="5" height="10" opacity=".4"/></svg>)");
  const std::string coarse = " --spacing 1 --nozzle 0.8";
  const std::string tones = "50 mm2 of the drawing are painted at half opacity or less and printed like the rest";
  CHECK(has(folder.run("generate --shape two.svg --report r.json" + coarse).out, "\nwarning    " + tones));
  CHECK(has(readAll(folder.at("r.json")), R"("code":"DrawingFaint","values":{"area":50.0})"));
  CHECK(has(folder.run("shape two.svg").out, "\n  note: " + tones));
  const std::string cut = "20 mm2 of the drawing lie off its page and are cut off";
  CHECK(has(folder.run("generate --shape off.svg --report r.json" + coarse).out, "\nwarning    " + cut));
  CHECK(has(readAll(folder.at("r.json")), R"("code":"DrawingOffPage","values":{"area":20.0})"));
  CHECK(has(folder.run("generate --shape none.svg" + coarse).out, "\nwarning    nothing in the drawing is painted"));
  folder.write("css.svg", head + R"_(<rect width="10" height="10" style="filter:grayscale()"/></svg>)_");
  CHECK(has(folder.run("generate --shape css.svg --report r.json" + coarse).out,
            "\nwarning    these parts of the drawing are not read: <filter>; compare"));
  CHECK(has(readAll(folder.at("r.json")), R"("code":"DrawingUnread","values":{"what":"<filter>"})"));
  CHECK(has(folder.run("generate --shape line.svg" + coarse).out, "\nnote       nothing in the drawing is filled"));
  CHECK_FALSE(has(folder.run("generate --shape line.svg --paint ignore" + coarse).out, "nothing in the drawing"));

  const Run shapes = folder.run("shape off.svg none.svg line.svg");
  CHECK(shapes.code == 0);
  CHECK(has(shapes.out, "off.svg\n  page 20.00 x 20.00 mm, area 120.00 mm2\n  note: " + cut));
  CHECK(has(shapes.out, "line.svg\n  page 20.00 x 20.00 mm, area 80.00 mm2\n"));
  CHECK(has(folder.run("shape line.svg --paint ignore --size 40 --json").out, R"("page":[40.0,40.0],"areaMm2":400.0)"));
  const Run missing = folder.run("shape line.svg nowhere.svg");
  CHECK(missing.code == 2);
  CHECK(has(missing.out, "nowhere.svg\n  error: the shape \"nowhere.svg\" cannot be read"));
  checkRefused(folder, "shape line.svg --size 0", "--size is \"0\"; it must be a width in mm");
  checkRefused(folder, "shape line.svg --paint no", "--paint is \"no\"; it must be shown or ignore");
  checkRefused(folder, "generate --shape line.svg --paint no", "shown or ignore");
}

TEST_CASE("what is narrower than a bead is said, with the size at which it would print, and where it is") {
  const Folder folder;
  // A plate with a bar of 10 x 0.5 mm beside it: at a spacing of 1 mm it is lost, at twice the size it is not.
  folder.write("bar.svg",
               R"(<svg width="20mm" height="20mm" viewBox="0 0 20 20"><rect x="1" y="1" width="10" height="10"/>
    <rect x="14" y="4" width=".5" height="10"/></svg>)");
  const Run run = folder.run("generate --shape bar.svg --spacing 1 --nozzle 0.8 --report r.json");
  CHECK(has(run.out,
            "mm2 are narrower than a bead and stay empty (places: 1); 100 % of that would print at a page width"));
  const std::string report = readAll(folder.at("r.json"));
  CHECK(has(report, R"("code":"DetailLost","values":{"area":)"));
  const std::size_t at = report.find(R"("lostPlaces": [[14.)");
  REQUIRE(at != std::string::npos);
  const std::size_t size = run.out.find("page width of ");
  REQUIRE(size != std::string::npos);
  const double millimetres = std::stod(run.out.substr(size + 14));
  CHECK(millimetres >= 40);
  CHECK(millimetres <= 50);
  CHECK_FALSE(has(folder
                      .run("generate --shape bar.svg --spacing 1 --nozzle 0.8 --size " +
                           std::to_string(static_cast<int>(millimetres)))
                      .out,
                  "narrower"));
  // A bar of 0.7 beads is kept on demand, the same whatever the number of threads.
  folder.write("thin.svg",
               R"(<svg width="20mm" height="20mm" viewBox="0 0 20 20"><rect x="1" y="1" width="10" height="10"/>
    <rect x="14" y="4" width=".7" height="10"/></svg>)");
  const std::string thin = "generate --shape thin.svg --spacing 1 --nozzle 0.8 --keep-thin --bridge 0 ";
  const Run kept = folder.run(thin + "--threads 1 --report k.json --svg one.svg --project p.json");
  CHECK(has(kept.out, "kept       "));
  CHECK(has(kept.out, " mm2 in 1 place narrower than a bead, widened to one\n"));
  CHECK(!has(kept.out, "stay empty"));
  const Json measures = Json::parse(readAll(folder.at("k.json")));
  CHECK(measures["toolpaths"] == 2);
  CHECK(measures["keptPlaces"].size() == 1);
  CHECK(measures["keptPlaces"][0][0] == about(14.35, 0.01));
  CHECK(measures["keptAreaMm2"] == about(7, 0.1));
  CHECK(measures["lostAreaMm2"] == 0);
  CHECK(folder.run("generate p.json --threads 2 --svg two.svg").code == 0);
  CHECK(readAll(folder.at("one.svg")) == readAll(folder.at("two.svg")));
  CHECK_FALSE(has(folder.run(kDisc).out, "narrower"));
}

TEST_CASE("solids that only a hairline joins are printed apart, and the place is told") {
  const Folder folder;
  folder.write("apart.svg", R"(<svg width="24mm" height="20mm" viewBox="0 0 24 20">
    <path d="M1 8h6v6h-6zM17 8h6v6h-6zM10 3h4v17h-4zM3.95 8V.95h16.1V8h-.1V1.05H4.05V8z"/></svg>)");
  const Run run = folder.run("generate --shape apart.svg --spacing 0.4 --nozzle 0.4 --report r.json");
  CHECK(has(run.out,
            "warning    toolpaths that lie apart from the rest of their part: 1, around X 20, Y 9 mm; what joins "
            "them is too thin for a bead"));
  const Json report = Json::parse(readAll(folder.at("r.json")));
  CHECK(report["parts"] == 2);
  CHECK(report["unjoined"] == 1);
  REQUIRE(report["apart"].size() == 1);
  CHECK(report["apart"][0][0] == about(20, 0.1));
  CHECK(report["apart"][0][1] == about(9, 0.1));
  CHECK(report["warnings"][0]["code"] == "PrintedApart");
  CHECK_FALSE(has(folder.run(kDisc).out, "lie apart"));
}

TEST_CASE("a published scene finds its files from the root of its repository, and is read by its outlines") {
  const Folder folder;
  folder.write(
      "data/svg/s.svg",
      R"(<svg width="20" height="20"><rect x="5" y="5" width="10" height="10" fill="none" stroke="red"/></svg>)");
  folder.picture("data/png/l.png", 8, 8, [](int, int) { return 99; });
  const std::string files = R"("svg_path": "data/svg/s.svg", "line_field_path": "data/png/l.png"})";
  folder.write("scenes/paper/s.json", R"({"nozzle_width": 1, "shell_count": 0, )" + files);
  const Run run = folder.run("generate scenes/paper/s.json --project whole.json --report r.json");
  CHECK(run.code == 0);
  CHECK(has(run.out, "plate      20.00 x 20.00 mm"));
  CHECK(has(readAll(folder.at("whole.json")), R"("paint": "ignore")"));
  CHECK(has(readAll(folder.at("whole.json")), R"("file": "data/svg/s.svg")"));
  CHECK_FALSE(has(run.out, "nothing in the drawing"));
  CHECK(Json::parse(readAll(folder.at("whole.json")))["layers"] ==
        Json::parse(R"([{"kind": "map", "file": "data/png/l.png"}])"));
  // Modes, with and without directions.
  folder.picture("data/png/m.png", 2, 1, [](int column, int) { return 170 * column; });
  const std::string modes = R"("line_mode_field_path": "data/png/m.png", )";
  folder.write("scenes/paper/m.json", R"({"nozzle_width": 1, )" + modes + files);
  folder.write("scenes/paper/n.json", R"({"nozzle_width": 1, )" + modes + R"("svg_path": "data/svg/s.svg"})");
  for (const auto& [name, layers] :
       {std::pair{"m", R"([{"kind": "map", "file": "data/png/l.png", "modeFile": "data/png/m.png"}])"},
        {"n", R"([{"kind": "direction", "modeFile": "data/png/m.png"}])"}}) {
    const Run moded =
        folder.run("generate scenes/paper/" + std::string(name) + ".json --project whole.json --svg a.svg");
    CAPTURE(moded.err);
    REQUIRE(moded.code == 0);
    CHECK(Json::parse(readAll(folder.at("whole.json")))["layers"] == Json::parse(layers));
  }
  // Beside the scene comes first; a project is not looked for elsewhere; other shells are asked for in vain.
  folder.write("scenes/paper/data/svg/s.svg", R"(<svg width="30" height="30"><rect width="9" height="9"/></svg>)");
  CHECK(has(folder.run("generate scenes/paper/s.json").out, "plate      30.00 x 30.00 mm"));
  folder.write("scenes/p.json", R"({"sillon": 1, "shape": {"file": "data/svg/s.svg"}})");
  checkRefused(folder, "generate scenes/p.json", "cannot be read");
  folder.write("scenes/paper/two.json", R"({"nozzle_width": 1, "shell_count": 2, )" + files);
  checkRefused(folder, "generate scenes/paper/two.json", "shell_count is 2; it must be 0");
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
  checkRefused(folder, "generate typo.json" + kOutputs, "similar names: \"spacing\"");
  checkRefused(folder, "generate nojson.json" + kOutputs, "line 1");
  checkRefused(folder, "generate deep.json" + kOutputs, "deeper than 64");
  checkRefused(folder, "generate nofile.json" + kOutputs, "nowhere.svg");
  checkRefused(folder, "generate --directions missing.png" + kOutputs, "missing.png");
  checkRefused(folder, "generate --directions empty" + kOutputs, "is empty");
  checkRefused(folder, "generate --directions text.png" + kOutputs, "text.png");
  checkRefused(folder, "generate --directions cut.png" + kOutputs, "cut.png");
  checkRefused(folder, "generate --directions giant.png" + kOutputs, "giant.png");
  checkRefused(folder, "generate --directions wide.png" + kOutputs, "40000");
  checkRefused(folder, "generate --modes cut.png --shape disc --size 9" + kOutputs, "cut.png");
  checkRefused(folder, "generate --shape wide.png --size 20" + kOutputs, "40000");
  checkRefused(folder, "generate --shape black.png --size 20" + kOutputs, "shape \"black.png\": the mask is empty");
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
  refused("--spacing 1e-7", "toolpath.spacing is 1e-07 mm; it must be 0.05 to 20");
  refused("--spacing 15", "at a toolpath.spacing of 15 mm");  // wider than the disc
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
  refused("--base-pattern solid", "hatched, concentric, same or across");
  refused("--show below", "up, bed or both");
  refused("--copies 2", "NxM, two whole numbers");
  refused("--copies 2x2.5", "print.copies is [2, 2.5]; it must be two whole numbers");
  refused("--brim 51", "print.brim is 51");
  refused("--printer mk4", "--printer: \"mk4\" is unknown for printer.profile");
  refused("--preset paper", "--preset: \"paper\" is unknown for toolpath.preset");
  refused("--filament abs", "--filament: \"abs\" is unknown for printer.filament; known are petg, pla, pla-silk");
  refused("--bed 200", "--bed is \"200\"");
  refused("--bed 10x10", "bed");  // smaller than the plate
  refused("--place 300,300", "bed");
  refused("--threads 0", "--threads is \"0\"; it must be a whole number from 1 to 256");
  refused("--sweeps 0", "toolpath.sweepsPerLevel is 0; it must be 1 to 1000");
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
  checkRefused(folder, "--quiet", "no command is given; see sillon --help");
  checkRefused(folder, "generate", "no shape");
  checkRefused(folder, "generate --angle 3", "no shape");
  checkRefused(folder, "generate --shape disc --spaceing 3" + kOutputs, "--spaceing");
  checkRefused(folder, "generate --shape disc --gcode", "--gcode");
  checkRefused(folder, "generate --shape disc --gcode --quiet", "--gcode");
  checkRefused(folder, "generate --directions l.png --angle 3" + kOutputs, "--directions");
  checkRefused(folder, "generate --shape disc --svg x --gcode x", "named for two outputs");
  checkRefused(folder, "generate --shape disc --svg x --gcode ./x", "named for two outputs");
  checkRefused(folder, "generate --shape disc --svg x --gcode ../work/x", "named for two outputs");
  checkRefused(folder, "generate --shape disc --gcode -", "the output \"-\" is not a file");
  checkRefused(folder, "generate --shape disc --gcode /dev/stdout", "the output \"/dev/stdout\" is not a file");
  checkRefused(folder, "generate --shape disc --preview a.JPG",
               "\"a.JPG\" is named like a picture that is not written");
  checkRefused(folder, "zones -o a.3mf --frob", "--frob is not an option of sillon zones; did you mean --face?");
  checkRefused(
      folder, "frobnicate",
      "\"frobnicate\" is not a command; it must be generate, rebrush, zones, calibrate, check, import, shape,");
  checkRefused(folder, "generate --directions l.png --gcode l.png", "also an input");
  checkRefused(folder, "generate --shape disc --container keep.json --gcode keep.json", "also an input");
  checkRefused(folder, "generate --shape disc --container keep.json --svg x", "it must be given with --gcode");
  folder.write("part.gcode.3mf", sillon::packGcode(slicedBlock()).value());
  checkRefused(folder, "generate --shape disc --size 9 --container part.gcode.3mf --gcode a.gcode.3mf",
               "is for a Bambu Lab printer, but the project's printer is not");
  checkRefused(folder, "generate --picture l.png --smoothness ' 1' --svg x",
               "--smoothness is \" 1\"; it must be a number");
  checkRefused(folder, "generate --picture l.png --local-contrast 0,5 --svg x", "it must be a number");
  checkRefused(folder, "zones --shape disc -o ''", "--output is \"\"");
  checkRefused(folder, "zones --body l.png --shape disc -o z.3mf", "--shape excludes --body");
  checkRefused(folder, "zones --shape disc --height inf -o z.3mf", "--height is \"inf\"; it must be a number");
  checkRefused(folder, "zones --shape disc --height 6000 -o z.3mf", "it must be 0.05 to 5000 mm");
  checkRefused(folder, "check ''", "file is \"\"");
  checkRefused(folder, "import ''", "file is \"\"");
  checkRefused(folder, "generate keep.json --shape disc --size 9 --project keep.json", "also an input");
  CHECK(readAll(folder.at("keep.json")) == R"({"sillon": 1})");
}

TEST_CASE("of an option that is given twice the last counts, whatever the command") {
  const Folder folder;
  CHECK(folder.run("generate --shape disc --size 9 --spool redPetg --spool bluePla --gcode a.gcode").code == 0);
  CHECK(folder.run("zones --shape disc --size 30 --angle 3 --zones 99 --zones 2 -o a.3mf -o b.3MF").code == 0);
  CHECK(fs::exists(folder.at("b.3MF")));
  CHECK_FALSE(fs::exists(folder.at("a.3mf")));
}

TEST_CASE("directions on the command line take the place of a project's pictures") {
  const Folder folder;
  folder.picture("half.png", 40, 40, [](int column, int) { return column < 20 ? 20 : 230; });
  REQUIRE(folder.run("generate --picture half.png --shape disc --size 20 --project lit.json").code == 0);
  CHECK(folder.run("generate lit.json --angle 30 --svg a.svg").code == 0);
  CHECK(folder.run("generate lit.json --angle 80 --svg b.svg").code == 0);
  CHECK(readAll(folder.at("a.svg")) != readAll(folder.at("b.svg")));
  // Whatever lies above stays, and a mode picture; where no layer fills the plate, one is laid under all others.
  folder.write("sign.json", R"({"sillon": 1, "shape": {"builtin": "disc", "size": [20, 0]}, "layers": [
    {"kind": "direction", "modeFile": "half.png"}, {"kind": "border"}]})");
  const auto layersOf = [&folder](const std::string& options) {
    REQUIRE(folder.run("generate sign.json " + options + " --project out.json").code == 0);
    return Json::parse(readAll(folder.at("out.json")))["layers"];
  };
  const Json border = {{"kind", "border"}};
  CHECK(layersOf("--directions half.png --encoding rotation") ==
        Json::array(
            {{{"kind", "map"}, {"file", "half.png"}, {"encoding", "rotation"}, {"modeFile", "half.png"}}, border}));
  CHECK(
      layersOf("--picture half.png --lamp 20") ==
      Json::array(
          {{{"kind", "picture"}, {"pictures", {{{"file", "half.png"}, {"lamp", {20, 45}}}}}, {"modeFile", "half.png"}},
           border}));
  CHECK(layersOf("--mode smoothest") == Json::array({{{"kind", "direction"}, {"mode", "smoothest"}}, border}));
  folder.write("sign.json",
               R"({"sillon": 1, "shape": {"builtin": "disc", "size": [20, 0]}, "layers": [{"kind": "border"}]})");
  CHECK(layersOf("--angle 30") == Json::array({{{"kind", "direction"}, {"angle", 30}}, border}));
  CHECK(layersOf("") == Json::array({border}));
}

TEST_CASE("what is written in the place of a file has its permissions, and links stay links") {
  const Folder folder;
  folder.write("part.gcode", slicedBlock());
  const auto own = fs::perms::owner_read | fs::perms::owner_write;
  fs::permissions(folder.at("part.gcode"), own);
  CHECK(folder.run("rebrush part.gcode --angle 30 -o ./part.gcode").code == 0);
  CHECK(fs::status(folder.at("part.gcode")).permissions() == own);
  fs::create_symlink("later.svg", folder.at("link.svg"));
  CHECK(folder.run("generate --shape disc --size 9 --svg link.svg").code == 0);
  CHECK(fs::is_symlink(folder.at("link.svg")));
  CHECK(fs::is_regular_file(folder.at("later.svg")));
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
  const Run run = folder.run(kDisc + std::string("--report a.json --preview a.png"), "ulimit -f 8;");
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
  // The print is there, the table for programs is not.
  const Run table = folder.run("calibrate flow -o flow.gcode --json", R"(sh -c '"$0" "$@" >/dev/full')");
  CHECK(table.code == 2);
  CHECK(has(table.err, "sillon: stdout cannot be written: "));
  CHECK(fs::exists(folder.at("flow.gcode")));
}

TEST_CASE("a reader that has gone away changes neither files nor the exit code") {
  const std::string commands[] = {std::string(kDisc) + "--gcode a.gcode",
                                  "calibrate width --printer prusa-mini -o a.gcode",
                                  "zones --shape disc --size 12 --angle 30 -o a.3mf"};
  for (const std::string& command : commands) {
    CAPTURE(command);
    const Folder folder;
    CHECK(folder.run(command, R"(bash -c '"$0" "$@" | true; exit "${PIPESTATUS[0]}"')").code == 0);
    CHECK(folder.files().size() == 1);
    if (fs::exists("/dev/full")) CHECK(folder.run(command, R"(sh -c '"$0" "$@" >/dev/full')").code == 0);
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

TEST_CASE("the first Ctrl-C ends with code 3 and leaves nothing behind, also while a pipe keeps the program waiting") {
  const std::string svg = R"(<svg width="40mm" height="40mm" viewBox="0 0 40 40"><path d="M0 0H40V40H0Z"/></svg>)";
  for (const bool whole : {false, true}) {
    CAPTURE(whole);
    const Folder folder;
    const std::string gcode = folder.at("a.gcode").string();
    // The program opens its shape after it began to listen for signals, and waits there for us: no race to win.
    const std::string shape = folder.at("shape.svg").string();
    REQUIRE(::mkfifo(shape.c_str(), 0600) == 0);
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      const int sink = ::open(folder.at("../err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
      ::dup2(sink, STDERR_FILENO);
      ::dup2(sink, STDOUT_FILENO);
      ::execl(SILLON_CLI, "sillon", "generate", "--shape", shape.c_str(), "--threads", "1", "--gcode", gcode.c_str(),
              static_cast<char*>(nullptr));
      ::_exit(127);
    }
    int writer = -1;
    while (writer < 0 && ::waitpid(child, nullptr, WNOHANG) == 0) {
      writer = ::open(shape.c_str(), O_WRONLY | O_NONBLOCK);
    }
    REQUIRE(writer >= 0);
    const std::string part = whole ? svg : svg.substr(0, 20);
    CHECK(::write(writer, part.data(), part.size()) == static_cast<ssize_t>(part.size()));
#if defined(__linux__)
    // It has read what there is, and waits for more.
    const auto waits = [&] {
      int unread = -1;
      ::ioctl(writer, FIONREAD, &unread);
      const std::string stat = readAll("/proc/" + std::to_string(child) + "/stat");
      return unread == 0 && stat.find(") S ") != std::string::npos;
    };
    while (!waits() && ::waitpid(child, nullptr, WNOHANG) == 0) {
    }
    ::kill(child, SIGINT);
#else
    ::kill(child, SIGINT);
    ::close(writer);
#endif
    int status = 0;
    ::waitpid(child, &status, 0);
#if defined(__linux__)
    ::close(writer);
#endif
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 3);
    CHECK(folder.files() == std::set<std::string>{shape});
    const std::string err = readAll(folder.at("../err"));
    CHECK(err == "sillon: cancelled; nothing was written\n");
  }
}

TEST_CASE("layers on the line add up, on top of those of a project") {
  const Folder folder;
  const std::string plate = "generate --shape rounded --size 40x16 --spacing 0.8 --quiet ";
  REQUIRE(folder
              .run(plate +
                   R"(--layer '{"kind": "pattern"}' --layer '{"kind": "text", "text": "AN, NA", "textSize": 6}')" +
                   R"( --layer '{"kind": "border", "angle": 20}' --project p.json)")
              .code == 0);
  const Json layers = Json::parse(readAll(folder.at("p.json")))["layers"];
  REQUIRE(layers.size() == 3);
  CHECK(layers[0]["kind"] == "pattern");
  CHECK(layers[1]["text"] == "AN, NA");
  CHECK_FALSE(layers[1].contains("fill"));  // across, as the kind is told to be by default
  CHECK(layers[2]["fill"] == "angle");      // as an angle was given
  CHECK(
      folder
          .run(
              R"(generate p.json --quiet --layer '{"kind": "direction"}' --layer '{"kind": "border"}' --project q.json)")
          .code == 0);
  const Json more = Json::parse(readAll(folder.at("q.json")))["layers"];
  REQUIRE(more.size() == 5);
  CHECK(more[1] == layers[1]);
  CHECK(more[3]["kind"] == "direction");
  CHECK(more[4]["kind"] == "border");

  const Run zones =
      folder.run(R"(zones --shape rect --size 30 --layer '{"kind": "direction", "angle": 45, "size": [10, 10]}' )"
                 R"(--layer '{"kind": "direction", "angle": 90, "size": [10, 10], "at": [8, 8]}' -o z.3mf)");
  CHECK(zones.code == 0);
  CHECK(has(zones.out, "  45.0 degrees"));
  CHECK(has(zones.out, "  90.0 degrees"));
  const Run wrong =
      folder.run(R"(generate --shape disc --layer '{"kind": "border"}' --layer '{"kind": "star"}' --svg a.svg)");
  CHECK(wrong.code != 0);
  CHECK(has(wrong.err, "--layer: layers[0].kind is \"star\""));
}

TEST_CASE("letters that nobody asks another fill of are seen, and those that are not seen are told") {
  const Folder folder;
  const std::string plate = "generate --shape rounded --size 40x16 --spacing 0.8 ";
  const auto svg = [&](const std::string& options) {
    const Run run = folder.run(plate + options + " --svg a.svg");
    CHECK(run.code == 0);
    return std::pair(readAll(folder.at("a.svg")), run.out + run.err);
  };
  const auto [plain, silent] = svg("");
  const auto [drawn, nothing] = svg(R"(--layer '{"kind": "text", "text": "ANNA"}')");
  CHECK(drawn != plain);
  CHECK_FALSE(has(nothing, "layer 1"));
  const auto [alike, told] = svg(R"(--layer '{"kind": "text", "text": "ANNA", "textSize": 7, "angle": 0}')");
  CHECK(alike == plain);
  CHECK(has(told, "100 % of layer 1 lie within 15 degrees of what is below"));
  const auto [beside, wide] = svg(R"(--layer '{"kind": "text", "text": "ANNA & ALEXANDRA"}' --report r.json)");
  CHECK(has(wide, "of layer 1 lie beside the plate"));
  const Json report = Json::parse(readAll(folder.at("r.json")));
  CHECK(report["layers"][0]["layer"] == 1);
  CHECK(report["layers"][0]["beside"] > 0.3);
  CHECK(report["warnings"][0]["code"] == "LayerBeside");
  CHECK(report["warnings"][0]["values"]["layer"] == 1);
  CHECK(has(
      folder
          .run(
              R"(zones --shape rect --size 30 --layer '{"kind": "text", "text": "ANNA ANNA", "textSize": 12}' -o z.3mf)")
          .out,
      "of layer 1 lie beside the plate"));
}

TEST_CASE("shapes for things: built-in ones, corners, offsets, holes and a rim") {
  const Folder folder;
  const Run made = folder.run(
      "generate --shape hexagon --size 24x20 --radius 2 --corners chamfer --offset 1 --hole 13,11,4.5 --hole=3,11,1 "
      "--rim 2 --rim-width 0.8 --spacing 0.8 --quiet --project p.json --gcode a.gcode");
  CHECK(made.code == 0);
  CHECK(made.err == "");
  const Json project = Json::parse(readAll(folder.at("p.json")));
  CHECK(project["shape"]["builtin"] == "hexagon");
  CHECK(project["shape"]["corners"] == "chamfer");
  CHECK(project["shape"]["offset"] == 1);
  CHECK(project["shape"]["holes"] ==
        Json::array({{{"x", 13}, {"y", 11}, {"diameter", 4.5}}, {{"x", 3}, {"y", 11}, {"diameter", 1}}}));
  CHECK(project["print"]["rim"] == 2);
  CHECK(has(readAll(folder.at("a.gcode")), ";TYPE:Perimeter"));
  CHECK(folder.run("check a.gcode").code == 0);
  // A hole on the line takes the place of the project's; another shape has none of them.
  CHECK(folder.run("generate p.json --hole 12,12,3 --quiet --project q.json").code == 0);
  CHECK(Json::parse(readAll(folder.at("q.json")))["shape"]["holes"].size() == 1);
  CHECK(folder.run("generate p.json --shape star --points 6 --size 20 --quiet --project s.json").code == 0);
  const Json star = Json::parse(readAll(folder.at("s.json")));
  CHECK(star["shape"]["points"] == 6);
  CHECK(star["shape"]["holes"].empty());
  for (const char* shape : {"heart", "shield", "ring --inner 8", "tag --inner 4"}) {
    CAPTURE(shape);
    CHECK(folder.run(std::string("generate --quiet --spacing 0.8 --size 20 --svg a.svg --shape ") + shape).code == 0);
  }
  const auto refused = [&](const std::string& options, const char* part) {
    const Run run = folder.run("generate --shape disc --size 20 --spacing 0.8 --svg b.svg " + options);
    CAPTURE(run.err);
    CHECK(run.code != 0);
    CHECK(has(run.err, part));
  };
  refused("--hole 1,1", "--hole is \"1,1\"; it must be X,Y,DIAMETER");
  refused("--hole 50,10,4", "hole 1 at 50, 10 mm");
  refused("--hole 10,10,0.1", "shape.holes[0].diameter is 0.1 mm; it must be 0.5 to 10000");
  refused("--offset 60", "shape.offset is 60 mm; it must be -20 to 50");
  refused("--offset -15", "an offset of -15 mm leaves nothing of the shape");
  refused("--shape ring --size 20 --inner 25", "shape.inner is 25 mm");
  refused("--shape ring --size 20x10", "for a ring; it must be one number there");
  refused("--rim 2 --show bed --gcode b.gcode", "print.rim is 2, but what shows lies on the bed");
}
