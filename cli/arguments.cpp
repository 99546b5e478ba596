#include "arguments.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "options.hpp"
#include "plate_options.hpp"
#include "presets.hpp"
#include "sillon/base/version.hpp"
#include "sillon/look/spools.hpp"
#include "sillon/settings/presets.hpp"
#include "sillon/settings/table.hpp"
#include "spools.hpp"
#include "words.hpp"

namespace cli {
namespace {

using sillon::Error;
using sillon::ErrorCode;
using sillon::ProfileKind;
using sillon::Section;
using sillon::Setting;

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

/// What a plate is made of, before there is a toolpath.
bool isOfInput(const Setting& row) {
  return row.section == Section::Shape || row.section == Section::Directions || row.section == Section::Modes;
}

/// How a printer prints, without what calibration plates choose themselves.
bool isOfCalibrations(const Setting& row) {
  if (row.section == Section::Printer) return true;
  const std::vector<std::string> own = sillon::splitWords(
      "layers base basePattern showSide constantFlow coast scarf copies copyGap startHeight rotate mirror strict "
      "place");
  return row.section == Section::Print && std::find(own.begin(), own.end(), row.key) == own.end();
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
    const auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "all of them with their values, as JSON");
    command->callback([&arguments, id, json, kind, name] {
      if (*json && !id->empty()) {
        throw CLI::ValidationError("--json is of the list; " + *id + " alone is JSON without it",
                                   CLI::ExitCodes::ValidationError);
      }
      arguments.answer = *json ? presetsJson(kind) : id->empty() ? presetTable(kind) : presetFile(kind, *id);
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
  import->add_option("file", arguments.import, "G-code, .ini, .json, .orca_printer, .3mf")
      ->option_text("FILE")
      ->required();
  import->add_option("--name", arguments.importName, "printer of a bundle [the active one]")->option_text("NAME");

  CLI::App* generate =
      app.add_subcommand("generate", "Make a toolpath and write it as G-code, drawing, report, picture");
  generate->footer(kExamples);
  generate->add_option("scene", arguments.scene, "project or scene file to begin with, or a picture to be seen")
      ->option_text("SCENE.json|PICTURE");
  std::vector<std::string> pictures;  // without an option in front
  generate->add_option("further", pictures, "more pictures, each to be seen under a lamp of its own")
      ->option_text("PICTURE...");
  Options options(*generate, arguments.changes);
  addShape(options);
  addPictures(*generate, arguments.pictures);
  addToolpath(options);
  addPrint(options, arguments);
  addOutputs(options, arguments);
  options.settings([](const Setting&) { return true; });

  CLI::App* zones = app.add_subcommand("zones", "Cut the directions into zones of straight lines, for any slicer");
  zones->add_option("scene", arguments.scene, "project or scene file to begin with")->option_text("SCENE.json");
  Options zoneOptions(*zones, arguments.changes);
  addShape(zoneOptions);
  addPictures(*zones, arguments.pictures);
  addZones(*zones, arguments.zones);
  zoneOptions.settings(isOfInput);

  CLI::App* calibrate =
      app.add_subcommand("calibrate", "Small prints that teach a printer's and a filament's settings, and reading one");
  addCalibrate(*calibrate, arguments.calibrate);
  calibrate->add_option("project", arguments.scene, "project file to begin with; of read, the photograph")
      ->option_text("PROJECT.json|PHOTO");
  calibrate->add_option("further", arguments.calibrate.further, "of read, more photographs of the same coupon")
      ->option_text("PHOTO...");
  addSpools(*calibrate, arguments.pictures, "Calibration");
  Options calibrateOptions(*calibrate, arguments.changes);
  addPrinter(calibrateOptions);
  calibrateOptions.settings(isOfCalibrations);

  addThreads(*generate, arguments.threads);
  generate->get_option("--threads")->group("Run");
  generate->add_flag("--quiet", arguments.quiet, "no summary, no progress")->group("Run");
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) requireValues(*command);

  try {
    app.parse(argc, argv);
    arguments.command = app.get_subcommands().front()->get_name();
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
    const std::vector<CLI::App*> given = app.get_subcommands();
    const std::string command = given.empty() ? "" : " " + given.front()->get_name();
    return Error{ErrorCode::InvalidArgument, oneSentence(error.what()) + "; see sillon" + command + " --help"};
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
    pictures.insert(pictures.begin(), arguments.scene);
    arguments.scene.clear();
  }
  for (const std::string& picture : pictures) {
    if (!looksLikePicture(picture)) {
      return Error{ErrorCode::InvalidArgument,
                   "\"" + picture + "\" is one file too many; behind the first only pictures can follow"};
    }
    for (const char* given : {"--directions", "--angle"}) {
      if (generate->count(given) == 0) continue;
      return Error{ErrorCode::InvalidArgument, "\"" + picture +
                                                   "\" is a picture to be seen, which finds the directions: " + given +
                                                   " cannot be given beside it; leave one of them out"};
    }
  }
  arguments.pictures.files.insert(arguments.pictures.files.begin(), pictures.begin(), pictures.end());
  return arguments;
}

}  // namespace cli
