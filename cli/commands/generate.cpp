// sillon generate: makes a plate and writes it as G-code, drawing, report and pictures.
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assemble.hpp"
#include "commands/commands.hpp"
#include "outputs.hpp"
#include "previews.hpp"
#include "progress.hpp"
#include "project_arguments.hpp"
#include "run.hpp"
#include "sillon/job/plate.hpp"
#include "words.hpp"

namespace sillon::cli {
namespace {

struct Arguments {
  std::vector<std::string> files;  ///< a scene or pictures
  ProjectArguments project;
  OutputPaths outputs;
  Placing placing = Placing::AsGiven;
  std::function<bool(const std::string&)> given;  ///< tells whether an option is given
  int threads = 1;
  bool quiet = false;
  bool listFiles = false;
};

/// Sorts the files: a scene must come first; pictures are shown under one lamp each, before those of --picture.
std::optional<Error> sortFiles(Arguments& arguments) {
  std::vector<std::string> pictures;
  for (const std::string& file : arguments.files) {
    if (looksLikePicture(file)) {
      pictures.push_back(file);
    } else if (&file == &arguments.files.front()) {
      arguments.project.scene = file;
    } else {
      return Error{ErrorCode::InvalidArgument,
                   "unexpected file \"" + file + "\"; only pictures may follow the first one"};
    }
  }
  for (const char* option : {"--directions", "--angle"}) {
    if (pictures.empty() || !arguments.given(option)) continue;
    return Error{ErrorCode::InvalidArgument, "\"" + pictures.front() +
                                                 "\" is a picture to show, which finds the directions: " + option +
                                                 " cannot be given beside it; leave one of them out"};
  }
  std::vector<std::string>& all = arguments.project.pictures.files;
  all.insert(all.begin(), pictures.begin(), pictures.end());
  return std::nullopt;
}

/// Makes the plate and all outputs in memory, before anything is written.
Result<Outcome> prepare(const Arguments& arguments, Project project, Job& job, RunContext& run) {
  ProgressBar bar(!arguments.quiet);
  run.onProgress([&bar](std::string_view stage, double fraction) { bar.show(stage, fraction); });
  const OutputPaths& outputs = arguments.outputs;
  PlateOptions options;
  options.placing = arguments.placing;
  if (!outputs.gcode.empty() && needsAcross(project.print)) options.path = PlatePath::Both;
  // Measuring takes time, so it is done only if the report, the header of the G-code or the summary shows the result.
  options.measure = !outputs.report.empty() || !outputs.gcode.empty() || !arguments.quiet;
  options.countDislocations = !outputs.report.empty();  // only the report shows it
  options.judgePictures = outputs.gcode.empty();
  // Shares of the progress, relative to the time for one path. A preview takes the same time for plates of any size.
  constexpr double kGcode = 0.35;
  constexpr double kPreview = 1.2;
  const double paths = pathsFor(project);
  const double writing = (outputs.gcode.empty() ? 0 : kGcode) + (outputs.preview.empty() ? 0 : kPreview);
  const double made = paths / (paths + writing);
  const ProgressShare whole(run, 0, 1);
  std::optional<ProgressShare> part(std::in_place, run, 0, made);
  Result<Plate> plate = makePlate(std::move(project), readInputFile, options, run);
  if (!plate) return plate.error();
  job.plate = std::move(plate).value();
  part.emplace(run, made, 1);
  run.beginStage("files", 0, 1);
  auto files = makeOutputs(job, outputs, run);
  run.onProgress({});
  if (!files) return files.error();
  std::string text = arguments.quiet ? "" : summary(job.plate, files.value());
  return Outcome{std::move(files).value(), std::move(text)};
}

/// Returns all files that are read for a plate, except the scene.
std::vector<std::string> filesBesideScene(const Arguments& arguments, const Project& project) {
  std::vector<std::string> files = inputFiles(project);
  for (const std::string* name : {&arguments.project.pictures.spoolsFile, &arguments.outputs.container}) {
    if (!name->empty()) files.push_back(*name);
  }
  return files;
}

/// Refuses, before the work begins, requests that cannot succeed.
std::optional<Error> checkPaths(const Arguments& arguments, const Project& project) {
  const OutputPaths& outputs = arguments.outputs;
  const std::size_t pictures = groundPictures(project.layers).size();
  const std::vector<std::string> names = outputNames(outputs, pictures);
  std::vector<std::string> inputs = filesBesideScene(arguments, project);
  if (!arguments.project.scene.empty()) inputs.push_back(arguments.project.scene);
  if (auto problem = checkOutputs(names, inputs, {outputs.preview})) return problem;
  if (auto problem = previewProblem(outputs.preview, outputs.previewWidth)) return problem;
  if (arguments.listFiles && !names.empty()) {
    return Error{ErrorCode::InvalidArgument,
                 "--list-files makes no plate for \"" + names[0] + "\"; it must be given without files to write"};
  }
  if (!outputs.container.empty() && outputs.gcode.empty()) {
    return Error{ErrorCode::InvalidArgument,
                 "--container is \"" + outputs.container + "\"; it must be given with --gcode"};
  }
  if (auto problem = packageProblem(outputs.gcode, project.printer.flavor, "generate", outputs.container)) {
    return problem;
  }
  if (!outputs.conflict.empty() && pictures < 2) {
    return Error{ErrorCode::InvalidArgument,
                 "--conflict is \"" + outputs.conflict + "\"; it must be given with two pictures or more"};
  }
  return std::nullopt;
}

int run(Arguments& arguments) {
  Run run(arguments.threads);
  if (const auto problem = sortFiles(arguments)) return fail(*problem);
  Job job;
  Result<std::string> date = runDate();
  if (!date) return fail(date.error());
  job.date = std::move(date).value();
  Result<Project> project = readProject(arguments.project);
  if (!project) return fail(project.error());
  job.pictureOptions = arguments.project.pictures;
  if (const auto problem = checkPaths(arguments, project.value())) return fail(*problem);
  if (arguments.listFiles) {
    const nlohmann::json files = filesBesideScene(arguments, project.value());
    return answer(files.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  }
  const Result<Outcome> made = prepare(arguments, std::move(project).value(), job, run.context());
  if (made && made.value().files.empty() && job.bodyRefused) return fail(*job.bodyRefused);
  const int code = commit(made, run);
  return code == 0 && job.bodyRefused ? fail(*job.bodyRefused) : code;
}

/// Adds the options about the print: copies, printer and place on the bed.
void addPrint(Options& options, Arguments& arguments) {
  std::vector<Change>& changes = arguments.project.changes;
  options.group("Print");
  options.change("--copies", "NxM", "plates in a row and in a column [1x1]", changes, [](const std::string& text) {
    const std::optional<Vec2> copies = parsePair(text, 'x');
    if (!copies) refuse("--copies", text, "NxM, two whole numbers");
    return [count = *copies](Project& project) {
      project.print.copies = count;
      return std::string();
    };
  });
  addPrinter(options, changes);
  options.change(
      "--place", "PLACE", "where the page lies on the bed [centre]", changes,
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
      },
      {{"X,Y", "its lower left corner, in mm"},
       {"centre", "in the middle of the bed"},
       {"rotate", "there, and turned by 90 degrees if only that fits"},
       {"fit", "also scaled down, if it does not fit otherwise"}});
}

/// Adds the options that name output files.
void addOutputs(Options& options, Arguments& arguments) {
  OutputPaths& outputs = arguments.outputs;
  options.group("Output");
  options.text("--gcode", "F", "G-code; packed if F ends in .gcode.3mf (Bambu Lab), .bgcode (Prusa) or .gz",
               outputs.gcode);
  options.text("--container", "F", "take everything but the G-code from this .gcode.3mf or .bgcode of your slicer",
               outputs.container);
  options.text("--svg", "F", "drawing of the toolpath", outputs.svg);
  options.text("--report", "F", "measures, as JSON", outputs.report);
  options.text("--preview", "F", "picture of directions and look, PNG; a loop of moving light if F ends in .webp",
               outputs.preview);
  options.previewWidth(outputs.previewWidth);
  options.text("--conflict", "F", "where several pictures take tones from each other, a PNG for each",
               outputs.conflict);
  options.text("--view", "F", "picture of directions for <sillon-view> on web pages, PNG", outputs.view);
  options.text("--body", "F", "base layers as a solid for a slicer: STL, or 3MF if F ends in .3mf", outputs.body);
  options.text("--project", "F", "everything needed to repeat the plate, JSON", outputs.project);
  options.flag("--list-files", "make nothing; print the files that the plate is made of, but for the scene, as JSON",
               arguments.listFiles);
}

Action add(Options& options) {
  const auto arguments = std::make_shared<Arguments>();
  options.files("FILES", "project or scene to begin with, or pictures to show, each under a lamp", arguments->files,
                false);
  std::vector<Change>& changes = arguments->project.changes;
  addShape(options, changes);
  addPictures(options, arguments->project.pictures);
  addToolpath(options, changes);
  addPrint(options, *arguments);
  addOutputs(options, *arguments);
  options.settings(changes, [](const Setting&) { return true; });
  options.group("Run");
  options.threads(arguments->threads);
  options.flag("--quiet", "show neither summary nor progress", arguments->quiet);
  arguments->given = options.given();
  return [arguments] { return run(*arguments); };
}

}  // namespace

const Command generateCommand{
    "generate",
    "make a toolpath and write it as G-code, drawing, report or picture",
    "[FILES]",
    "--shape --size --directions --angle --picture --lamp --spacing --perimeters --printer --filament --gcode "
    "--preview "
    "--project",
    "Examples:\n"
    "  sillon generate --shape disc --size 40 --angle 30 --gcode disc.gcode\n"
    "  sillon generate face.jpg --size 100 --gcode face.gcode --preview look.png\n"
    "  sillon generate --shape leaf.svg --directions veins.png --gcode leaf.gcode\n"
    "  sillon generate scene.json --spacing 0.8 --svg coarse.svg\n\n"
    "Options override the scene. Printer speeds, temperatures and the like live in the project file: --project F "
    "writes one with every field, sillon settings lists them all, including expert options.\n\n"
    "Exit codes: 0 done, 2 bad input, 3 cancelled, 1 internal error. No files are written unless everything succeeds.",
    add};

}  // namespace sillon::cli
