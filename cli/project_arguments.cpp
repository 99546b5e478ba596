#include "project_arguments.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "assemble.hpp"
#include "sillon/settings/presets.hpp"
#include "sillon/settings/table.hpp"
#include "words.hpp"

namespace sillon::cli {
namespace {

/// Returns the names of built-in shapes in the order of the enumerators; the first is "none".
std::vector<std::string> builtinNames() { return splitWords(findSetting(Section::Shape, "builtin")->choices); }

/// Replaces the shape by a built-in one or a file, and resets the size, the holes and the way of reading.
std::string setShape(Project& project, const std::string& text) {
  project.shapeFile = text;
  project.builtin = BuiltinShape::None;
  project.builtinSize = {};
  project.pageWidth = 0;
  project.unitlessIsMm = false;
  project.ignorePaint = false;
  project.holes.clear();
  const std::vector<std::string> names = builtinNames();
  const auto found = std::find(names.begin() + 1, names.end(), text == "rect" ? "rectangle" : text);
  if (found == names.end()) return "";
  project.shapeFile.clear();
  project.builtin = static_cast<BuiltinShape>(found - names.begin());
  return "";
}

/// Returns the names of shapes for the help, three to a row.
std::vector<ValueHelp> shapeValues() {
  std::vector<ValueHelp> values{{"F", "SVG file, or mask picture: bright is inside"}};
  const std::vector<std::string> names = builtinNames();
  for (std::size_t k = 1; k < names.size(); k += 3) {
    std::string row = k == 1 ? "rect" : names[k];
    for (std::size_t next = k + 1; next < std::min(k + 3, names.size()); ++next) row += ", " + names[next];
    values.push_back({row, k == 1 ? "built-in shapes" : "more of them"});
  }
  return values;
}

RoundHole holeOf(const std::string& text) {
  const std::size_t last = text.rfind(',');
  const std::optional<Vec2> centre = parsePair(text.substr(0, last), ',');
  const std::optional<double> diameter = last == std::string::npos ? std::nullopt : parseNumber(text.substr(last + 1));
  if (!centre || !diameter) refuse("--hole", text, "X,Y,DIAMETER, three numbers in mm");
  return {*centre, *diameter};
}

/// Adds --hole, which may be repeated; together the holes replace those of the project.
void addHoles(Options& options, std::vector<Change>& changes) {
  const auto holes = std::make_shared<std::vector<RoundHole>>();
  options.list("--hole", "X,Y,D", "round hole: its middle from the page's lower left corner, and its diameter, in mm",
               [holes, &changes](const std::string& text) {
                 holes->push_back(holeOf(text));
                 if (holes->size() > 1) return;
                 changes.emplace_back([holes](Project& project) {
                   project.holes = *holes;
                   return std::string();
                 });
               });
}

/// Sets the size of the shape. \param size  y is 0 if only a width was given.
std::string setSize(Project& project, Vec2 size, const std::string& text) {
  const bool round = isRound(project.builtin);
  const bool square = round && size.y == size.x;
  if (size.y != 0 && !square && (!project.shapeFile.empty() || round)) {
    const std::string what = !project.shapeFile.empty()              ? "a shape from a file"
                             : project.builtin == BuiltinShape::Disc ? "a disc"
                                                                     : "a ring";
    return "--size is \"" + text + "\" for " + what + "; it must be one number there, the width in mm";
  }
  if (project.shapeFile.empty()) {
    project.builtinSize = square ? Vec2{size.x, 0} : size;
  } else {
    project.pageWidth = size.x;
  }
  return "";
}

/// Returns the lowest layer that fills the page; if there is none, one is added below all others.
Layer& lowestOf(Project& project) {
  if (groundOf(project.layers) == nullptr) project.layers.emplace(project.layers.begin());
  return project.layers[0];
}

/// Returns the lowest layer as a map.
MapLayer& lowestMap(Project& project) {
  Layer& lowest = lowestOf(project);
  if (lowest.kind() != LayerKind::Map) lowest.contents = MapLayer();
  return *lowest.as<MapLayer>();
}

/// Adds an option for a setting of one layer. \param find  returns that layer of a project.
void layerSetting(Options& options, const char* key, std::vector<Change>& changes,
                  const std::function<Layer&(Project&)>& find) {
  const Setting& row = *findSetting(Section::Layers, key);
  const SettingWords words = wordsOf(row);
  const std::string option = words.option;
  const std::vector<std::string> choices = splitWords(row.choices);
  options.change(option, "HOW", std::string(words.help) + ": " + listed(choices), changes,
                 [=, &row](const std::string& text) {
                   const auto found = std::find(choices.begin(), choices.end(), text);
                   if (found == choices.end()) refuse(option, text, listed(choices));
                   const std::size_t number = found - choices.begin();
                   return [number, find, &row](Project& project) {
                     SettingsView view;
                     view.layer = &find(project);
                     sillon::choose(row.field(view), number);
                     return std::string();
                   };
                 });
}

/// Adds the options about the lowest layer: its directions and its mode.
void addLowest(Options& options, std::vector<Change>& changes) {
  options.change("--directions", "F", "picture of the bead directions; alone it makes a rectangle of its proportions",
                 changes, [](const std::string& text) {
                   return [text](Project& project) {
                     lowestMap(project).file = text;
                     return std::string();
                   };
                 });
  layerSetting(options, "encoding", changes, [](Project& project) -> Layer& {
    lowestMap(project);
    return project.layers[0];
  });
  options.change("--angle", "DEG", "one bead direction everywhere, counter-clockwise from the right [0]", changes,
                 [](const std::string& text) {
                   DirectionLayer one;
                   parseInto("--angle", text, one.angle);
                   return [one](Project& project) {
                     lowestOf(project).contents = one;
                     return std::string();
                   };
                 });
  options.excludes("--angle", "--directions");
  options.change("--modes", "F", "picture of the direction modes", changes, [](const std::string& text) {
    return [text](Project& project) {
      lowestOf(project).modeFile = text;
      return std::string();
    };
  });
  layerSetting(options, "mode", changes, [](Project& project) -> Layer& {
    Layer& lowest = lowestOf(project);
    lowest.modeFile.clear();
    return lowest;
  });
  options.excludes("--mode", "--modes");
}

}  // namespace

Result<Project> readProject(ProjectArguments& arguments) {
  if (const std::optional<Error> problem = readOwnSpools(arguments.pictures)) return *problem;
  Project project;
  if (!arguments.pictures.files.empty()) project.toolpath.perimeterMode = arguments.besidePictures;
  if (!arguments.scene.empty()) {
    Result<Project> scene = loadProject(arguments.scene);
    if (!scene) return scene.error();
    project = std::move(scene).value();
  }
  if (const std::vector<std::string>& files = arguments.pictures.files; !files.empty()) {
    PictureLayer pictures;
    for (const std::string& file : files) pictures.pictures.push_back({file, std::nullopt});
    lowestOf(project).contents = pictures;
  }
  const Project given = project;
  for (const auto& change : arguments.changes) {
    if (std::string problem = change(project); !problem.empty()) {
      return Error{ErrorCode::InvalidArgument, std::move(problem)};
    }
  }
  followAdvance(given, project);
  if (std::string problem = applyPictures(arguments.pictures, project); !problem.empty()) {
    return Error{ErrorCode::InvalidArgument, std::move(problem)};
  }
  if (auto wrong = invalidSettings(project)) return *std::move(wrong);
  return project;
}

void addShape(Options& options, std::vector<Change>& changes) {
  options.group("Shape and directions");
  options.change(
      "--shape", "SHAPE", "what the plate is cut to", changes,
      [](const std::string& text) { return [text](Project& project) { return setShape(project, text); }; },
      shapeValues());
  options.change("--size", "MM|WxH", "page width, or width and height of a built-in shape [as drawn, else 80]", changes,
                 [](const std::string& text) {
                   const std::optional<double> width = parseNumber(text);
                   const std::optional<Vec2> both = parsePair(text, 'x');
                   const Vec2 size = both ? *both : Vec2{width.value_or(0), 0};
                   if (!(size.x > 0) || (both && !(size.y > 0)) || size.x > 10000 || size.y > 10000) {
                     refuse("--size", text, "a width or WxH in mm, each more than 0 and at most 10000");
                   }
                   return [size, text](Project& project) { return setSize(project, size, text); };
                 });
  addHoles(options, changes);
  addLayers(options, changes);
}

void addLayers(Options& options, std::vector<Change>& changes) {
  addLowest(options, changes);
  options.list(
      "--layer", "JSON",
      "one more layer on top, as in a project's list; repeat for more: '{\"kind\": \"text\", \"text\": \"ANNA\"}'",
      [&changes](const std::string& text) {
        changes.emplace_back([text](Project& project) {
          const auto read = sillon::readProject("{\"sillon\": 1, \"layers\": [" + text + "]}");
          if (!read) return "--layer: " + read.error().message;
          const auto& layers = read.value().layers;
          project.layers.insert(project.layers.end(), layers.begin(), layers.end());
          return std::string();
        });
      });
}

void addPerimeters(Options& options, std::vector<Change>& changes) {
  options.change("--perimeters", "none|soft|N", "how beads meet the border [1]", changes,
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
                 },
                 {{"none", "they end there"},
                  {"soft", "they follow it where the directions allow"},
                  {"N", "N of them follow it"}});
}

void addToolpath(Options& options, std::vector<Change>& changes) {
  options.group("Toolpath");
  options.change("--preset", "NAME", "named set of values: " + listed(presets()) + " [standard]", changes,
                 [](const std::string& text) {
                   return [text](Project& project) {
                     const auto wrong = applyPreset(text, project.toolpath);
                     return wrong ? "--preset: " + wrong->message : std::string();
                   };
                 });
  addPerimeters(options, changes);
}

void addPrinter(Options& options, std::vector<Change>& changes) {
  options.group("Print");
  options.change("--printer", "ID", "printer that sillon printers lists", changes, [](const std::string& text) {
    return [text](Project& project) {
      project.printerProfile = text;
      // No profile knows these: the plate was made for the nozzle, and its look for a speed and a fan.
      Printer printer;
      printer.nozzle = project.printer.nozzle;
      printer.showSpeed = project.printer.showSpeed;
      printer.showFan = project.printer.showFan;
      project.printer = printer;
      if (const auto wrong = applyProfile(ProfileKind::Printer, text, project.printer)) {
        return "--printer: " + wrong->message;
      }
      if (project.filamentProfile.empty()) return std::string();
      const auto wrong = applyProfile(ProfileKind::Filament, project.filamentProfile, project.printer);
      return wrong ? wrong->message : std::string();
    };
  });
  options.change("--filament", "ID", "filament that sillon filaments lists", changes, [](const std::string& text) {
    return [text](Project& project) {
      project.filamentProfile = text;
      const auto wrong = applyProfile(ProfileKind::Filament, text, project.printer);
      return wrong ? "--filament: " + wrong->message : std::string();
    };
  });
  options.change("--bed", "WxH", "size of the bed in mm [220x220]", changes, [](const std::string& text) {
    const std::optional<Vec2> size = parsePair(text, 'x');
    if (!size || !(size->x > 0 && size->y > 0)) refuse("--bed", text, "WxH in mm, each more than 0");
    return [bed = *size](Project& project) {
      project.printer.bedMax = project.printer.bedMin + bed;
      return std::string();
    };
  });
}

}  // namespace sillon::cli
