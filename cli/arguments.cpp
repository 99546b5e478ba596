#include "arguments.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "presets.hpp"
#include "sillon/base/version.hpp"
#include "sillon/look/spools.hpp"
#include "sillon/settings/presets.hpp"
#include "sillon/settings/table.hpp"
#include "spools.hpp"
#include "threads.hpp"

namespace cli {
namespace {

using sillon::BuiltinShape;
using sillon::ChoiceField;
using sillon::Error;
using sillon::ErrorCode;
using sillon::Field;
using sillon::Level;
using sillon::PerimeterMode;
using sillon::ProfileKind;
using sillon::Project;
using sillon::Section;
using sillon::Setting;
using sillon::SettingType;
using sillon::Vec2;

constexpr const char* kExamples =
    "Examples:\n"
    "  sillon generate --shape disc --size 40 --angle 30 --gcode coaster.gcode\n"
    "  sillon generate --directions waves.png --size 120 --gcode waves.gcode --preview waves_look.png\n"
    "  sillon generate --shape leaf.svg --directions veins.png --perimeters soft --gcode leaf.gcode --report "
    "leaf.json\n"
    "  sillon generate scene.json --spacing 0.8 --svg coarse.svg\n"
    "\n"
    "Options override the scene. Printer speeds, temperatures and the rest live in the project file:\n"
    "--project F writes one with every field; sillon settings lists them all, with the options of experts.\n"
    "Exit codes: 0 done, 2 bad input, 3 cancelled, 1 a fault of the program. Nothing is written unless all is done.";

/// Throws what CLI11 reports as a parse error.
[[noreturn]] void refuse(const std::string& option, const std::string& text, const std::string& wanted) {
  throw CLI::ValidationError(option + " is \"" + text + "\"; it must be " + wanted, CLI::ExitCodes::ValidationError);
}

/// A finite decimal number and nothing else: no nan, no inf, no hex, no trailing words.
std::optional<double> parseNumber(const std::string& text) {
  if (text.empty() || text.find_first_not_of("+-.0123456789eE") != std::string::npos) return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);  // "C" locale: the program never sets another
  if (end != text.c_str() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

void parseInto(const std::string& option, const std::string& text, double& out) {
  const std::optional<double> value = parseNumber(text);
  if (!value) refuse(option, text, "a number");
  out = *value;
}

void parseInto(const std::string& option, const std::string& text, std::optional<double>& out) {
  out.emplace();
  parseInto(option, text, *out);
}

template <class Integer>
requires std::is_integral_v<Integer>
void parseInto(const std::string& option, const std::string& text, Integer& out) {
  constexpr auto kHigh = std::numeric_limits<Integer>::max();
  const bool negative = !text.empty() && text[0] == '-';
  const std::string digits = text.substr(negative ? 1 : 0);
  errno = 0;
  const std::uint64_t magnitude = std::strtoull(digits.c_str(), nullptr, 10);
  const bool whole = !digits.empty() && digits.find_first_not_of("0123456789") == std::string::npos && errno == 0;
  const bool fits = negative ? std::is_signed_v<Integer> && magnitude <= static_cast<std::uint64_t>(kHigh)
                             : magnitude <= static_cast<std::uint64_t>(kHigh);
  if (!whole || !fits) {
    // What the option itself takes is checked with the whole project; only a seed may be all that fits.
    const bool seed = std::is_unsigned_v<Integer>;
    refuse(option, text, seed ? "a whole number from 0 to " + std::to_string(kHigh) : std::string("a whole number"));
  }
  out = static_cast<Integer>(negative ? Integer{0} - static_cast<Integer>(magnitude) : static_cast<Integer>(magnitude));
}

/// Two numbers with a separator between them: "120x80", "10,20".
std::optional<Vec2> parsePair(const std::string& text, char separator) {
  const std::size_t middle = text.find(separator);
  if (middle == std::string::npos) return std::nullopt;
  const std::optional<double> x = parseNumber(text.substr(0, middle));
  const std::optional<double> y = parseNumber(text.substr(middle + 1));
  if (!x || !y) return std::nullopt;
  return Vec2{*x, *y};
}

/// How a value is called in help: "MM", "N", "up|bed|both".
std::string valueName(const Setting& row) {
  const std::string_view unit = row.unit;
  if (row.type == SettingType::Choice) {
    std::string words = row.choices;
    std::replace(words.begin(), words.end(), ' ', '|');
    return words;
  }
  if (row.type == SettingType::Pair || row.type == SettingType::IntegerPair) return "X,Y";
  if (row.type == SettingType::Integer) return "N";
  if (row.type != SettingType::Number) return "TEXT";
  return unit == "mm" ? "MM" : unit == "degrees" ? "DEG" : unit == "spacings" ? "TAU" : "F";
}

/// Puts a word of the command line into a field, by the kind of field; throws by refuse().
struct SetField {
  const Setting& row;
  const Field field;
  const std::string& option;
  const std::string& text;

  void operator()(std::monostate /*not there*/) const {}
  void operator()(std::string* out) const { *out = text; }
  void operator()(bool* /*choice*/) const { choice(); }
  void operator()(Vec2* out) const {
    const std::optional<Vec2> pair = parsePair(text, ',');
    if (!pair) refuse(option, text, "X,Y, two numbers");
    *out = *pair;
  }
  void operator()(std::optional<Vec2>* out) const { (*this)(&out->emplace()); }
  void operator()(const ChoiceField& /*out*/) const { choice(); }
  void operator()(std::vector<sillon::LampPicture>* /*has options of its own*/) const {}
  template <class Number>
  void operator()(Number* out) const {
    parseInto(option, text, *out);
  }

  void choice() const {
    const std::vector<std::string> words = sillon::splitWords(row.choices);
    const auto found = std::find(words.begin(), words.end(), text);
    if (found != words.end()) return sillon::choose(field, static_cast<std::size_t>(found - words.begin()));
    std::string wanted;
    for (std::size_t k = 0; k < words.size(); ++k) {
      wanted += (k == 0 ? "" : k + 1 == words.size() ? " or " : ", ") + words[k];
    }
    refuse(option, text, wanted);
  }
};

/// Puts options on the command line; each becomes a change of the project.
class Options {
 public:
  Options(CLI::App& app, Arguments& arguments) : app_(app), arguments_(arguments) {}

  void group(std::string name) { group_ = std::move(name); }

  /// An option with a word of its own meaning. \param read  text to change; throws by refuse().
  CLI::Option* word(const std::string& name, const char* unit, const std::string& help,
                    std::function<std::function<std::string(Project&)>(const std::string&)> read) {
    return app_
        .add_option_function<std::string>(
            name,
            [this, name, read](const std::string& text) {
              needValue(name, text);
              arguments_.changes.push_back(read(text));
            },
            help)
        ->option_text(unit)
        ->take_last()
        ->group(group_);
  }

  /// An option for one row of the table of settings; what is wrong with its value is found with the whole project.
  void setting(const Setting& row) {
    const std::string name = row.option;
    if (row.type == SettingType::Flag) {
      app_.add_flag_callback(
              name,
              [this, &row] {
                arguments_.changes.emplace_back([&row](Project& project) {
                  *std::get<bool*>(row.field(viewOf(project))) = true;
                  return std::string();
                });
              },
              row.help)
          ->group(group_);
      return;
    }
    Project defaults;
    const std::string standard = sillon::settingText(row, defaults);
    word(name, valueName(row).c_str(), std::string(row.help) + (standard.empty() ? "" : " [" + standard + "]"),
         [&row, name](const std::string& text) {
           Project scratch;
           std::visit(SetField{row, row.field(viewOf(scratch)), name, text}, row.field(viewOf(scratch)));
           return [&row, name, text](Project& project) {
             const Field field = row.field(viewOf(project));
             std::visit(SetField{row, field, name, text}, field);
             return std::string();
           };
         });
  }

  void output(const std::string& name, const std::string& help, std::string& path) {
    app_.add_option_function<std::string>(
            name,
            [&path, name](const std::string& text) {
              needValue(name, text);
              path = text;
            },
            help)
        ->option_text("F")
        ->take_last()
        ->group(group_);
  }

 private:
  /// "--gcode --quiet" has forgotten a name; it does not mean a file called --quiet.
  static void needValue(const std::string& name, const std::string& text) {
    if (text.empty() || text.rfind("--", 0) == 0) refuse(name, text, "followed by its value");
  }

  CLI::App& app_;
  Arguments& arguments_;
  std::string group_;
};

std::string setShape(Project& project, const std::string& text) {
  constexpr std::array<std::pair<const char*, BuiltinShape>, 4> kBuiltins{{{"rect", BuiltinShape::Rectangle},
                                                                           {"rectangle", BuiltinShape::Rectangle},
                                                                           {"rounded", BuiltinShape::RoundedRectangle},
                                                                           {"disc", BuiltinShape::Disc}}};
  project.shapeFile = text;
  project.builtin = BuiltinShape::None;
  project.builtinSize = {};
  project.pageWidth = 0;
  project.unitlessIsMm = false;
  project.ignorePaint = false;
  for (const auto& [name, builtin] : kBuiltins) {
    if (text != name) continue;
    project.shapeFile.clear();
    project.builtin = builtin;
  }
  return "";
}

/// \param size  y is 0 where only a width was given.
std::string setSize(Project& project, Vec2 size, const std::string& text) {
  const bool square = project.builtin == BuiltinShape::Disc && size.y == size.x;
  if (size.y != 0 && !square && (!project.shapeFile.empty() || project.builtin == BuiltinShape::Disc)) {
    const std::string what = project.shapeFile.empty() ? "a disc" : "a shape from a file";
    return "--size is \"" + text + "\" for " + what + "; it must be one number there, the width in mm";
  }
  if (project.shapeFile.empty()) {
    project.builtinSize = square ? Vec2{size.x, 0} : size;
  } else {
    project.pageWidth = size.x;
  }
  return "";
}

void addShape(Options& options) {
  options.group("Shape and directions");
  options.word("--shape", "F|rect|rounded|disc", "SVG file, mask picture (bright is inside) or built-in shape",
               [](const std::string& text) { return [text](Project& project) { return setShape(project, text); }; });
  options.word("--size", "MM|WxH", "page width, or width and height of rect and rounded [as drawn, else 80]",
               [](const std::string& text) {
                 const std::optional<double> width = parseNumber(text);
                 const std::optional<Vec2> both = parsePair(text, 'x');
                 const Vec2 size = both ? *both : Vec2{width.value_or(0), 0};
                 if (!(size.x > 0) || (both && !(size.y > 0)) || size.x > 10000 || size.y > 10000) {
                   refuse("--size", text, "a width or WxH in mm, each more than 0 and at most 10000");
                 }
                 return [size, text](Project& project) { return setSize(project, size, text); };
               });
  CLI::Option* directions =
      options.word("--directions", "F", "picture of the bead directions; alone it makes a rectangle of its proportions",
                   [](const std::string& text) {
                     return [text](Project& project) {
                       project.directionFile = text;
                       return std::string();
                     };
                   });
  options
      .word("--angle", "DEG", "one bead direction everywhere, counter-clockwise from the right [0]",
            [](const std::string& text) {
              double angle = 0;
              parseInto("--angle", text, angle);
              return [angle](Project& project) {
                project.directionFile.clear();
                project.angle = angle;
                return std::string();
              };
            })
      ->excludes(directions);
  CLI::Option* modes = options.word("--modes", "F", "picture of the direction modes", [](const std::string& text) {
    return [text](Project& project) {
      project.modeFile = text;
      return std::string();
    };
  });
  options
      .word("--mode", "parallel|orthogonal|smoothest|constrained", "one mode everywhere [constrained]",
            [](const std::string& text) {
              const Setting& row = *sillon::findSetting(Section::Modes, "mode");
              Project scratch;
              SetField{row, row.field(viewOf(scratch)), "--mode", text}.choice();
              return [mode = scratch.mode](Project& project) {
                project.modeFile.clear();
                project.mode = mode;
                return std::string();
              };
            })
      ->excludes(modes);
}

void addToolpath(Options& options) {
  options.group("Toolpath");
  std::string names;
  for (const std::string& id : sillon::presets()) names += (names.empty() ? "" : "|") + id;
  options.word("--preset", "NAME", "named set of values: " + names + " [standard]", [](const std::string& text) {
    return [text](Project& project) {
      const std::string wrong = sillon::applyPreset(text, project.toolpath);
      return wrong.empty() ? wrong : "--preset: " + wrong;
    };
  });
  options.word("--perimeters", "none|soft|N", "how beads meet the border: N follow it, or as directions allow [1]",
               [](const std::string& text) {
                 PerimeterMode mode = PerimeterMode::Count;
                 int count = 0;
                 if (text == "soft") {
                   mode = PerimeterMode::Soft;
                 } else if (text != "none") {
                   const std::optional<double> value = parseNumber(text);
                   if (!value || *value != std::floor(*value) || *value < 0 || *value > 100) {
                     refuse("--perimeters", text, "none, soft or a whole number from 0 to 100");
                   }
                   count = static_cast<int>(*value);
                 }
                 if (mode == PerimeterMode::Count && count == 0) mode = PerimeterMode::None;
                 return [mode, count](Project& project) {
                   project.toolpath.perimeterMode = mode;
                   if (mode == PerimeterMode::Count) project.toolpath.perimeters = count;
                   return std::string();
                 };
               });
}

/// The printer, its filament and its bed.
void addPrinter(Options& options) {
  options.group("Print");
  options.word("--printer", "ID", "a printer that sillon printers lists", [](const std::string& text) {
    return [text](Project& project) {
      project.printerProfile = text;
      // The plate was made for its nozzle, and its look for a speed and a fan: no profile knows them.
      sillon::Printer printer;
      printer.nozzle = project.printer.nozzle;
      printer.showSpeed = project.printer.showSpeed;
      printer.showFan = project.printer.showFan;
      project.printer = printer;
      if (const std::string wrong = applyProfile(ProfileKind::Printer, text, project.printer); !wrong.empty()) {
        return "--printer: " + wrong;
      }
      return project.filamentProfile.empty()
                 ? std::string()
                 : applyProfile(ProfileKind::Filament, project.filamentProfile, project.printer);
    };
  });
  options.word("--filament", "ID", "a filament that sillon filaments lists", [](const std::string& text) {
    return [text](Project& project) {
      project.filamentProfile = text;
      const std::string wrong = applyProfile(ProfileKind::Filament, text, project.printer);
      return wrong.empty() ? wrong : "--filament: " + wrong;
    };
  });
  options.word("--bed", "WxH", "size of the bed in mm [220x220]", [](const std::string& text) {
    const std::optional<Vec2> size = parsePair(text, 'x');
    if (!size || !(size->x > 0 && size->y > 0)) refuse("--bed", text, "WxH in mm, each more than 0");
    return [bed = *size](Project& project) {
      project.printer.bedMax = project.printer.bedMin + bed;
      return std::string();
    };
  });
}

void addPrint(Options& options, Arguments& arguments) {
  options.group("Print");
  options.word("--copies", "NxM", "plates in a row and in a column [1x1]", [](const std::string& text) {
    const std::optional<Vec2> copies = parsePair(text, 'x');
    if (!copies) refuse("--copies", text, "NxM, two whole numbers");
    return [count = *copies](Project& project) {
      project.print.copies = count;
      return std::string();
    };
  });
  addPrinter(options);
  options.word(
      "--place", "X,Y|centre|rotate|fit",
      "lower left corner of the page on the bed; centred; and turned if only that fits; and scaled down [centre]",
      [&arguments](const std::string& text) {
        const std::optional<Vec2> place = parsePair(text, ',');
        if (!place && text != "centre" && text != "rotate" && text != "fit") {
          refuse("--place", text, "X,Y in mm, centre, rotate or fit");
        }
        arguments.placing = text == "fit" ? Placing::Fit : text == "rotate" ? Placing::Rotate : Placing::AsGiven;
        return [place](Project& project) {
          project.print.place = place;
          return std::string();
        };
      });
}

void addOutputs(Options& options, Arguments& arguments) {
  options.group("Output");
  options.output("--gcode", "G-code for the printer; packed if F ends in .gcode.3mf (Bambu Lab) or .bgcode (Prusa)",
                 arguments.outputs.gcode);
  options.output("--container", "a slicer's .gcode.3mf or .bgcode F, whose other parts the G-code's file keeps",
                 arguments.outputs.container);
  options.output("--svg", "drawing of the toolpath", arguments.outputs.svg);
  options.output("--report", "measures as JSON", arguments.outputs.report);
  options.output("--preview", "picture of directions and look, PNG", arguments.outputs.preview);
  options.word("--preview-width", "PX", "width of each of the picture's two panels [1600]",
               [&arguments](const std::string& text) {
                 int& width = arguments.outputs.previewWidth;
                 parseInto("--preview-width", text, width);
                 if (width < 16 || width > 16384) refuse("--preview-width", text, "16 to 16384 pixels");
                 return [](Project&) { return std::string(); };
               });
  options.output("--conflict", "where several pictures take tones from each other, PNG for each",
                 arguments.outputs.conflict);
  options.output("--view", "picture of directions for <sillon-view> on web pages, PNG", arguments.outputs.view);
  options.output("--body", "base layers as a solid for a slicer, STL, or 3MF if F ends in .3mf",
                 arguments.outputs.body);
  options.output("--project", "everything needed to repeat the plate, JSON", arguments.outputs.project);
}

/// Where help shows the settings of a section.
const char* groupOf(Section section) {
  return section == Section::Toolpath                               ? "Toolpath"
         : section == Section::Pictures                             ? "Pictures"
         : section == Section::Print || section == Section::Printer ? "Print"
                                                                    : "Shape and directions";
}

/// The table's options, but for those with a syntax of their own, which are there already.
/// \param wanted  whether a setting is one of the command's.
void addSettings(Options& options, CLI::App& app, const std::function<bool(const Setting&)>& wanted) {
  for (const Setting& row : sillon::settings()) {
    if (!wanted(row)) continue;
    if (*row.option == '\0' || app.get_option_no_throw(row.option) != nullptr) continue;
    options.group(row.level == Level::Expert ? "" : groupOf(row.section));  // no group: not in help
    options.setting(row);
  }
}

/// How a printer prints, without what calibration plates choose themselves.
bool isOfCalibrations(const Setting& row) {
  if (row.section == Section::Printer) return true;
  const std::vector<std::string> own = sillon::splitWords(
      "layers base basePattern showSide constantFlow coast scarf copies copyGap startHeight rotate mirror strict "
      "place");
  return row.section == Section::Print && std::find(own.begin(), own.end(), row.key) == own.end();
}

/// The command line with today's names of options.
std::vector<std::string> withTodaysNames(int argc, const char* const* argv) {
  std::map<std::string, std::string> today;
  for (const Setting& row : sillon::settings()) {
    for (const std::string& old : sillon::splitWords(row.oldOptions)) today[old] = row.option;
  }
  std::vector<std::string> words(argv, argv + argc);
  for (std::size_t k = 1; k < words.size() && words[k] != "--"; ++k) {
    const std::size_t end = std::min(words[k].find('='), words[k].size());
    const auto found = today.find(words[k].substr(0, end));
    if (found != today.end()) words[k].replace(0, end, found->second);
  }
  return words;
}

/// sillon settings: the table, for people or for programs.
void addSettingsList(CLI::App& app, Arguments& arguments) {
  CLI::App* command = app.add_subcommand("settings", "List the settings of project files, with ranges and defaults");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "the same as JSON");
  command->callback([&arguments, json] { arguments.answer = *json ? sillon::settingsJson() : settingsTable(); });
}

/// sillon printers and sillon filaments: a table, or one profile as a project file.
void addPresetLists(CLI::App& app, Arguments& arguments) {
  const auto add = [&](const char* name, const char* help, ProfileKind kind) {
    CLI::App* command = app.add_subcommand(name, help);
    const auto id = std::make_shared<std::string>();
    command->add_option("id", *id, "write this one as a project file")->option_text("ID");
    command->callback([&arguments, id, kind, name] {
      arguments.answer = id->empty() ? presetTable(kind) : presetFile(kind, *id);
      if (arguments.answer.empty()) {
        sillon::Printer printer;
        throw CLI::ValidationError(std::string(name) + ": " + applyProfile(kind, *id, printer),
                                   CLI::ExitCodes::ValidationError);
      }
    });
  };
  add("printers", "List the printers that come with the program", ProfileKind::Printer);
  add("filaments", "List the filaments", ProfileKind::Filament);
}

/// sillon spools: what filaments look like, for people or for programs.
void addSpoolList(CLI::App& app, Arguments& arguments) {
  CLI::App* command = app.add_subcommand("spools", "List the measured spools, and what they show under lamps");
  const auto json = std::make_shared<bool>(false);
  const auto own = std::make_shared<PictureOptions>();
  command->add_flag("--json", *json, "with slopes and light by direction, as JSON");
  command->add_option("--spools", own->spoolsFile, "file of your own spools, listed behind them")
      ->option_text("F.json");
  command->callback([&arguments, json, own] {
    if (const std::optional<Error> problem = readOwnSpools(*own)) {
      throw CLI::ValidationError(problem->message, CLI::ExitCodes::ValidationError);
    }
    std::vector<sillon::Spool> all = sillon::spools();
    all.insert(all.end(), own->ownSpools.begin(), own->ownSpools.end());
    arguments.answer = *json ? spoolJson(all) : spoolTable(all);
  });
}

void addCheck(CLI::App& app, Arguments& arguments) {
  CLI::App* check = app.add_subcommand("check", "Read any G-code as a printer would and say what would go wrong");
  check->add_option("file", arguments.check, "the file")->option_text("FILE.gcode")->required();
  check
      ->add_option_function<std::string>(
          "--printer",
          [&arguments](const std::string& id) {
            const std::string wrong = applyProfile(ProfileKind::Printer, id, arguments.checkPrinter.emplace());
            if (!wrong.empty()) throw CLI::ValidationError("--printer: " + wrong, CLI::ExitCodes::ValidationError);
          },
          "whose bed and limits count [as the file's own settings say]")
      ->option_text("ID");
  check->add_flag("--json", arguments.checkJson, "the same as JSON");
}

void addShapeFacts(CLI::App& app, ShapeArguments& arguments) {
  CLI::App* shape = app.add_subcommand("shape", "Page and area of drawings and masks as they are read");
  shape->add_option("file", arguments.files, "SVG or mask picture")->option_text("FILE...")->required();
  shape
      ->add_option_function<std::string>(
          "--size",
          [&arguments](const std::string& text) {
            arguments.width = parseNumber(text);
            if (!(arguments.width.value_or(0) > 0) || *arguments.width > 10000) {
              refuse("--size", text, "a width in mm, more than 0 and at most 10000");
            }
          },
          "page width [as drawn, masks 80]")
      ->option_text("MM");
  shape
      ->add_option_function<std::string>(
          "--paint",
          [&arguments](const std::string& text) {
            if (text != "shown" && text != "ignore") refuse("--paint", text, "shown or ignore");
            arguments.ignorePaint = text == "ignore";
          },
          "what a drawing shows, or all its outlines [shown]")
      ->option_text("shown|ignore");
  shape->add_flag("--json", arguments.json, "one line of JSON for each file");
}

/// First line of a message of CLI11, without the full stop that some end in.
std::string oneSentence(std::string text) {
  text = text.substr(0, text.find('\n'));
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  return text;
}

}  // namespace

sillon::Result<Arguments> readArguments(int argc, const char* const* argv) {
  Arguments arguments;
  CLI::App app{"Turns a picture and a shape into one continuous dense oriented toolpath and G-code.", "sillon"};
  app.get_formatter()->column_width(38);
  app.set_version_flag("--version", std::string("sillon ") + sillon::kVersion);
  app.require_subcommand(1);
  app.footer("See sillon generate --help.");
  addPresetLists(app, arguments);
  addSettingsList(app, arguments);
  addSpoolList(app, arguments);
  addCheck(app, arguments);
  addRebrush(app, arguments.rebrush);
  addShapeFacts(app, arguments.shape);
  CLI::App* import =
      app.add_subcommand("import", "Take a printer from G-code of your own slicer, its settings or a project");
  import->add_option("file", arguments.import, "G-code, .ini, .json")->option_text("FILE")->required();
  import->add_option("--name", arguments.importName, "printer of a bundle [the active one]")->option_text("NAME");

  CLI::App* generate =
      app.add_subcommand("generate", "Make a toolpath and write it as G-code, drawing, report, picture");
  generate->footer(kExamples);
  generate->add_option("scene", arguments.scene, "project or scene file to begin with, or a picture to be seen")
      ->option_text("SCENE.json|PICTURE");
  Options options(*generate, arguments);
  addShape(options);
  addPictures(*generate, arguments.pictures);
  addToolpath(options);
  addPrint(options, arguments);
  addOutputs(options, arguments);
  addSettings(options, *generate, [](const Setting&) { return true; });

  CLI::App* zones = app.add_subcommand("zones", "Cut the directions into zones of straight lines, for any slicer");
  zones->add_option("scene", arguments.scene, "project or scene file to begin with")->option_text("SCENE.json");
  Options zoneOptions(*zones, arguments);
  addShape(zoneOptions);
  addPictures(*zones, arguments.pictures);
  addZones(*zones, arguments.zones);

  CLI::App* calibrate =
      app.add_subcommand("calibrate", "Small prints that teach a printer's and a filament's settings, and reading one");
  addCalibrate(*calibrate, arguments.calibrate);
  calibrate->add_option("project", arguments.scene, "project file to begin with; of read, the photograph")
      ->option_text("PROJECT.json|PHOTO");
  calibrate->add_option("further", arguments.calibrate.further, "of read, more photographs of the same coupon")
      ->option_text("PHOTO...");
  addSpools(*calibrate, arguments.pictures, "Calibration");
  Options calibrateOptions(*calibrate, arguments);
  addPrinter(calibrateOptions);
  addSettings(calibrateOptions, *calibrate, isOfCalibrations);

  arguments.threads = threadsOfMachine();
  generate
      ->add_option_function<std::string>(
          "--threads",
          [&arguments](const std::string& text) {
            const std::optional<double> value = parseNumber(text);
            if (!value || *value != std::floor(*value) || *value < 1 || *value > 256) {
              refuse("--threads", text, "a whole number from 1 to 256");
            }
            arguments.threads = static_cast<int>(*value);
          },
          "how many may work; never changes the result [all]")
      ->option_text("N")
      ->take_last()
      ->group("Run");
  generate->add_flag("--quiet", arguments.quiet, "no summary, no progress")->group("Run");

  try {
    const std::vector<std::string> words = withTodaysNames(argc, argv);
    std::vector<const char*> pointers;
    for (const std::string& word : words) pointers.push_back(word.c_str());
    app.parse(argc, pointers.data());
  } catch (const CLI::CallForHelp&) {
    CLI::App* asked = generate->parsed() ? generate : &app;
    arguments.answer = asked->help(generate->parsed() ? "sillon" : "");
  } catch (const CLI::CallForVersion& version) {
    arguments.answer = std::string(version.what()) + "\n";
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string text = error.what();
    return Error{ErrorCode::InvalidArgument,
                 text.substr(0, text.find(':')) + " has no value; it must be followed by one"};
  } catch (const CLI::ExtrasError& error) {
    return Error{ErrorCode::InvalidArgument, oneSentence(error.what()) + "; see sillon generate --help"};
  } catch (const CLI::RequiredError& error) {
    if (argc > 1 && app.get_subcommands().empty() && argv[1][0] != '-') {
      return Error{ErrorCode::InvalidArgument,
                   "\"" + std::string(argv[1]) +
                       "\" is not a command; it must be generate, check, rebrush, shape, zones, import, printers, "
                       "filaments, spools, calibrate or settings"};
    }
    return Error{ErrorCode::InvalidArgument, oneSentence(error.what()) + "; see sillon --help"};
  } catch (const CLI::ParseError& error) {
    return Error{ErrorCode::InvalidArgument, oneSentence(error.what())};
  }
  if (looksLikePicture(arguments.scene)) {
    arguments.pictures.files.insert(arguments.pictures.files.begin(), arguments.scene);
    arguments.scene.clear();
  }
  return arguments;
}

}  // namespace cli
