#include "plate_options.hpp"

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "sillon/settings/presets.hpp"
#include "sillon/settings/table.hpp"
#include "words.hpp"

namespace cli {

using sillon::BuiltinShape;
using sillon::PerimeterMode;
using sillon::Placing;
using sillon::ProfileKind;
using sillon::Project;
using sillon::Section;
using sillon::Setting;
using sillon::Vec2;

namespace {

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

}  // namespace

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
                       project.pictures.files.clear();
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
                project.pictures.files.clear();
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
              setField(row, scratch, "--mode", text);
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
  options.output("--gcode",
                 "G-code for the printer; packed if F ends in .gcode.3mf (Bambu Lab), .bgcode (Prusa) or .gz",
                 arguments.outputs.gcode);
  options.output("--container", "a slicer's .gcode.3mf or .bgcode F, whose other parts the G-code's file keeps",
                 arguments.outputs.container);
  options.output("--svg", "drawing of the toolpath", arguments.outputs.svg);
  options.output("--report", "measures as JSON", arguments.outputs.report);
  options.output("--preview", "picture of directions and look, PNG", arguments.outputs.preview);
  options.previewWidth("width of each of the picture's two panels [1600]", arguments.outputs.previewWidth);
  options.output("--conflict", "where several pictures take tones from each other, PNG for each",
                 arguments.outputs.conflict);
  options.output("--view", "picture of directions for <sillon-view> on web pages, PNG", arguments.outputs.view);
  options.output("--body", "base layers as a solid for a slicer, STL, or 3MF if F ends in .3mf",
                 arguments.outputs.body);
  options.output("--project", "everything needed to repeat the plate, JSON", arguments.outputs.project);
}

}  // namespace cli
