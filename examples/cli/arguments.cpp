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
#include <memory>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>

#include "presets.hpp"
#include "sillon/presets.hpp"
#include "sillon/version.hpp"

namespace cli {
namespace {

using sillon::BasePattern;
using sillon::BuiltinShape;
using sillon::DirectionEncoding;
using sillon::DirectionMode;
using sillon::Error;
using sillon::ErrorCode;
using sillon::GcodeFlavor;
using sillon::MapFilter;
using sillon::PerimeterMode;
using sillon::PhaseTransport;
using sillon::PresetKind;
using sillon::Project;
using sillon::ShowSide;
using sillon::Vec2;

constexpr const char* kExamples =
    "Examples:\n"
    "  sillon generate --shape disc --size 40 --angle 30 --gcode coaster.gcode\n"
    "  sillon generate --lines waves.png --size 120 --gcode waves.gcode --preview waves_look.png\n"
    "  sillon generate --shape leaf.svg --lines veins.png --perimeters soft --gcode leaf.gcode --report leaf.json\n"
    "  sillon generate scene.json --spacing 0.8 --svg coarse.svg\n"
    "\n"
    "Options override the scene. Printer speeds, temperatures and the rest live in the project file:\n"
    "--project F writes one with every field, docs/project.md explains them.\n"
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

std::string shown(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}
std::string shown(const std::optional<double>& value) { return value ? shown(*value) : "one spacing"; }
template <class Integer>
requires std::is_integral_v<Integer> std::string shown(Integer value) { return std::to_string(value); }

template <class T>
using Choices = std::vector<std::pair<std::string, T>>;

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

  /// An option for one number of the project. \param field  from a project to its number.
  template <class Field>
  CLI::Option* number(const std::string& name, const char* unit, const std::string& help, Field field) {
    using Value = std::decay_t<decltype(field(std::declval<Project&>()))>;
    Project defaults;
    return word(name, unit, help + " [" + shown(field(defaults)) + "]", [name, field](const std::string& text) {
      Value value{};
      parseInto(name, text, value);
      return [value, field](Project& project) {
        field(project) = value;
        return std::string();
      };
    });
  }

  /// An option without a value, which sets a flag of the project. \param field  from a project to its flag.
  void flag(const std::string& name, const std::string& help, bool& (*field)(Project&)) {
    app_.add_flag_callback(
            name,
            [this, field] {
              arguments_.changes.emplace_back([field](Project& project) {
                field(project) = true;
                return std::string();
              });
            },
            help)
        ->group(group_);
  }

  /// An option for one of a few words. \param set  what a word does.
  template <class T>
  CLI::Option* choice(const std::string& name, const std::string& help, const Choices<T>& choices,
                      std::function<void(Project&, T)> set) {
    std::string wanted;
    std::string unit;
    for (std::size_t k = 0; k < choices.size(); ++k) {
      wanted += (k == 0 ? "" : k + 1 == choices.size() ? " or " : ", ") + choices[k].first;
      unit += (k == 0 ? "" : "|") + choices[k].first;
    }
    return word(name, unit.c_str(), help, [name, choices, wanted, set](const std::string& text) {
      for (const auto& [word, value] : choices) {
        const T chosen = value;
        if (text == word) {
          return std::function<std::string(Project&)>([set, chosen](Project& project) {
            set(project, chosen);
            return std::string();
          });
        }
      }
      refuse(name, text, wanted);
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
  options.number(
      "--radius", "MM", "corner radius of --shape rounded", [](Project & p) -> auto& { return p.builtinRadius; });
  CLI::Option* lines =
      options.word("--lines", "F", "picture of the bead directions; alone it makes a rectangle of its proportions",
                   [](const std::string& text) {
                     return [text](Project& project) {
                       project.directionFile = text;
                       return std::string();
                     };
                   });
  options.choice<DirectionEncoding>("--lines-as", "how the picture tells directions [angle]",
                                    {{"angle", DirectionEncoding::Angle},
                                     {"rotation", DirectionEncoding::Rotation},
                                     {"tangent", DirectionEncoding::Tangent}},
                                    [](Project& project, DirectionEncoding encoding) { project.encoding = encoding; });
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
      ->excludes(lines);
  CLI::Option* modes = options.word("--modes", "F", "picture of the direction modes", [](const std::string& text) {
    return [text](Project& project) {
      project.modeFile = text;
      return std::string();
    };
  });
  options
      .choice<DirectionMode>("--mode", "one mode everywhere [constrained]",
                             {{"parallel", DirectionMode::Parallel},
                              {"orthogonal", DirectionMode::Orthogonal},
                              {"smoothest", DirectionMode::Smoothest},
                              {"constrained", DirectionMode::Constrained}},
                             [](Project& project, DirectionMode mode) {
                               project.modeFile.clear();
                               project.mode = mode;
                             })
      ->excludes(modes);
}

void addToolpath(Options& options) {
  options.group("Toolpath");
  std::string names;
  for (const std::string& id : sillon::recipes()) names += (names.empty() ? "" : "|") + id;
  options.word("--preset", "NAME", "way to make it: " + names + " [standard]", [](const std::string& text) {
    return [text](Project& project) {
      const std::string wrong = sillon::applyRecipe(text, project.toolpath);
      return wrong.empty() ? wrong : "--preset " + wrong;
    };
  });
  options.number(
      "--spacing", "MM", "distance between neighbouring beads",
      [](Project & p) -> auto& { return p.toolpath.spacing; });
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
  options.number(
      "--bridge", "MM", "solids nearer than this become one part",
      [](Project & p) -> auto& { return p.toolpath.bridge; });
  options.number(
      "--seed", "N", "0 is regular; others give other plates of like quality",
      [](Project & p) -> auto& { return p.toolpath.seed; });
}

void addPrint(Options& options, Arguments& arguments) {
  options.group("Print");
  options.number(
      "--layers", "N", "oriented layers", [](Project & p) -> auto& { return p.print.layers; });
  options.number(
      "--base", "N", "plain layers below", [](Project & p) -> auto& { return p.print.base; });
  options.choice<BasePattern>(
      "--base-pattern", "how the base layers are filled [hatched]",
      {{"hatched", BasePattern::Hatched}, {"concentric", BasePattern::Concentric}, {"same", BasePattern::Same}},
      [](Project& project, BasePattern pattern) { project.print.basePattern = pattern; });
  options.choice<ShowSide>("--show", "which side shows the lines [up]",
                           {{"up", ShowSide::Up}, {"bed", ShowSide::Bed}, {"both", ShowSide::Both}},
                           [](Project& project, ShowSide side) { project.print.showSide = side; });
  options.word("--copies", "NxM", "plates in a row and in a column [1x1]", [](const std::string& text) {
    const std::optional<Vec2> copies = parsePair(text, 'x');
    if (!copies) refuse("--copies", text, "NxM, two whole numbers");
    return [count = *copies](Project& project) {
      project.print.copies = count;
      return std::string();
    };
  });
  options.number(
      "--brim", "N", "loops that touch the plate", [](Project & p) -> auto& { return p.print.brim; });
  options.number(
      "--skirt", "N", "loops around the plate", [](Project & p) -> auto& { return p.print.skirt; });
  options.number(
      "--layer-height", "MM", "height of a layer", [](Project & p) -> auto& { return p.print.layerHeight; });
  options.number(
      "--start-height", "MM", "layers lie above a print of this height on the bed [0]",
      [](Project & p) -> auto& { return p.print.startHeight; });
  options.number(
      "--flow", "F", "flow of the oriented layers", [](Project & p) -> auto& { return p.print.flow; });
  options.word("--printer", "ID", "a printer that sillon printers lists", [](const std::string& text) {
    return [text](Project& project) {
      project.printerPreset = text;
      project.printer = {};
      if (const std::string wrong = applyPreset(PresetKind::Printer, text, project.printer); !wrong.empty()) {
        return "--printer " + wrong;
      }
      return project.filamentPreset.empty()
                 ? std::string()
                 : applyPreset(PresetKind::Filament, project.filamentPreset, project.printer);
    };
  });
  options.word("--filament", "ID", "a filament that sillon filaments lists", [](const std::string& text) {
    return [text](Project& project) {
      project.filamentPreset = text;
      const std::string wrong = applyPreset(PresetKind::Filament, text, project.printer);
      return wrong.empty() ? wrong : "--filament " + wrong;
    };
  });
  options.choice<GcodeFlavor>("--flavor", "dialect of the G-code [marlin]",
                              {{"marlin", GcodeFlavor::Marlin},
                               {"klipper", GcodeFlavor::Klipper},
                               {"reprap", GcodeFlavor::RepRap},
                               {"prusa", GcodeFlavor::PrusaBuddy},
                               {"bambu", GcodeFlavor::Bambu}},
                              [](Project& project, GcodeFlavor flavor) { project.printer.flavor = flavor; });
  options.number(
      "--nozzle", "MM", "nozzle diameter", [](Project & p) -> auto& { return p.printer.nozzle; });
  options.word("--bed", "WxH", "size of the bed in mm [220x220]", [](const std::string& text) {
    const std::optional<Vec2> size = parsePair(text, 'x');
    if (!size || !(size->x > 0 && size->y > 0)) refuse("--bed", text, "WxH in mm, each more than 0");
    return [bed = *size](Project& project) {
      project.printer.bedMax = project.printer.bedMin + bed;
      return std::string();
    };
  });
  options.number(
      "--rotate", "DEG", "turns the plate on the bed, counter-clockwise",
      [](Project & p) -> auto& { return p.print.rotate; });
  options.flag("--mirror", "left to right, before turning", [](Project& p) -> bool& { return p.print.mirror; });
  options.flag("--strict", "refuse a path that crosses itself or leaves the shape",
               [](Project& p) -> bool& { return p.print.strict; });
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
  options.output("--gcode", "G-code for the printer; packed for Bambu's if F ends in .gcode.3mf",
                 arguments.outputs.gcode);
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
  options.output("--view", "picture of directions for <sillon-view> on web pages, PNG", arguments.outputs.view);
  options.output("--body", "base layers as a solid for a slicer, STL, or 3MF if F ends in .3mf",
                 arguments.outputs.body);
  options.output("--project", "everything needed to repeat the plate, JSON", arguments.outputs.project);
}

void addAdvanced(Options& options) {
  options.group("Advanced");
  options.choice<MapFilter>("--map-filter", "how texels of the direction picture are read [average]",
                            {{"average", MapFilter::Average}, {"nearest", MapFilter::Nearest}},
                            [](Project& project, MapFilter filter) { project.toolpath.mapFilter = filter; });
  options.choice<PhaseTransport>(
      "--phase-transport", "how a neighbour's wave is carried over [midpoint]",
      {{"midpoint", PhaseTransport::Midpoint}, {"neighbour", PhaseTransport::Neighbour}},
      [](Project& project, PhaseTransport transport) { project.toolpath.phaseTransport = transport; });
  options.number(
      "--jitter", "TAU", "how far a seed moves the sample points",
      [](Project & p) -> auto& { return p.toolpath.jitter; });
  options.number(
      "--sweeps", "N", "smoothing sweeps on each level",
      [](Project & p) -> auto& { return p.toolpath.sweepsPerLevel; });
  options.number(
      "--spacing-bend", "F", "how far beads may lie closer or wider where that saves U-turns",
      [](Project & p) -> auto& { return p.toolpath.spacingBend; });
  options.number(
      "--line-give", "DEG", "how far beads may run off the lines where that saves U-turns",
      [](Project & p) -> auto& { return p.toolpath.lineGive; });
  options.number(
      "--wave-reach", "TAU", "over which the waves of cells are averaged",
      [](Project & p) -> auto& { return p.toolpath.waveReach; });
  options.number(
      "--border-pull", "F", "weight of the border's wave, --perimeters soft",
      [](Project & p) -> auto& { return p.toolpath.borderPull; });
  options.number(
      "--stitch-alignment", "F", "cost of misaligned length in stitches",
      [](Project & p) -> auto& { return p.toolpath.stitchAlignment; });
  options.number(
      "--relaxation-rounds", "N", "rounds of spacing relaxation",
      [](Project & p) -> auto& { return p.toolpath.relaxationRounds; });
  options.number(
      "--relaxation-strength", "F", "move towards the wider side per round",
      [](Project & p) -> auto& { return p.toolpath.relaxationStrength; });
  options.number(
      "--relaxation-smoothing", "F", "pull to the neighbours' middle per round",
      [](Project & p) -> auto& { return p.toolpath.relaxationSmoothing; });
  options.number(
      "--width-balance", "F", "0: the nearer neighbour bounds a bead, 1: the room between both does",
      [](Project & p) -> auto& { return p.toolpath.widthBalance; });
  options.number(
      "--bead-overlap", "F", "how far beads may overlap, in spacings",
      [](Project & p) -> auto& { return p.toolpath.beadOverlap; });
  options.number(
      "--min-width", "F", "narrowest bead in spacings", [](Project & p) -> auto& { return p.toolpath.minWidth; });
  options.number(
      "--max-width", "F", "widest bead in spacings", [](Project & p) -> auto& { return p.toolpath.maxWidth; });
  options.number(
      "--simplify", "MM", "largest change by leaving out points",
      [](Project & p) -> auto& { return p.toolpath.simplifyTolerance; });
}

/// sillon printers and sillon filaments: a table, or one preset as a project file.
void addPresetLists(CLI::App& app, Arguments& arguments) {
  const auto add = [&](const char* name, const char* help, PresetKind kind) {
    CLI::App* command = app.add_subcommand(name, help);
    const auto id = std::make_shared<std::string>();
    command->add_option("id", *id, "write this one as a project file")->option_text("ID");
    command->callback([&arguments, id, kind, name] {
      arguments.answer = id->empty() ? presetTable(kind) : presetFile(kind, *id);
      if (arguments.answer.empty()) {
        sillon::Printer printer;
        throw CLI::ValidationError(std::string(name) + " " + applyPreset(kind, *id, printer),
                                   CLI::ExitCodes::ValidationError);
      }
    });
  };
  add("printers", "List the printers that come with the program", PresetKind::Printer);
  add("filaments", "List the filaments", PresetKind::Filament);
}

void addCheck(CLI::App& app, Arguments& arguments) {
  CLI::App* check = app.add_subcommand("check", "Read any G-code as a printer would and say what would go wrong");
  check->add_option("file", arguments.check, "the file")->option_text("FILE.gcode")->required();
  check
      ->add_option_function<std::string>(
          "--printer",
          [&arguments](const std::string& id) {
            const std::string wrong = applyPreset(PresetKind::Printer, id, arguments.checkPrinter.emplace());
            if (!wrong.empty()) throw CLI::ValidationError("--printer " + wrong, CLI::ExitCodes::ValidationError);
          },
          "whose bed and limits count [as the file's own settings say]")
      ->option_text("ID");
  check->add_flag("--json", arguments.checkJson, "the same as JSON");
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
  addCheck(app, arguments);
  CLI::App* import =
      app.add_subcommand("import", "Take a printer from G-code of your own slicer, its settings or a project");
  import->add_option("file", arguments.import, "G-code, .ini, .json")->option_text("FILE")->required();
  import->add_option("--name", arguments.importName, "printer of a bundle [the active one]")->option_text("NAME");

  CLI::App* generate =
      app.add_subcommand("generate", "Make a toolpath and write it as G-code, drawing, report, picture");
  generate->footer(kExamples);
  generate->add_option("scene", arguments.scene, "project or scene file to begin with")->option_text("SCENE.json");
  Options options(*generate, arguments);
  addShape(options);
  addToolpath(options);
  addPrint(options, arguments);
  addOutputs(options, arguments);
  addAdvanced(options);

  arguments.threads = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 256);
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
    app.parse(argc, argv);
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
      return Error{ErrorCode::InvalidArgument, "\"" + std::string(argv[1]) +
                                                   "\" is no command; it must be generate, check, import, printers or "
                                                   "filaments"};
    }
    return Error{ErrorCode::InvalidArgument, oneSentence(error.what()) + "; see sillon --help"};
  } catch (const CLI::ParseError& error) {
    return Error{ErrorCode::InvalidArgument, oneSentence(error.what())};
  }
  return arguments;
}

}  // namespace cli
