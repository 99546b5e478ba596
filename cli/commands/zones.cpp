// sillon zones: a body with zones of straight lines, for any slicer.
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "assemble.hpp"
#include "commands/commands.hpp"
#include "files.hpp"
#include "project_arguments.hpp"
#include "run.hpp"
#include "sillon/export/zones.hpp"
#include "sillon/pictures/pictures.hpp"
#include "sillon/report/input_note.hpp"
#include "sillon/report/warning.hpp"
#include "words.hpp"

namespace cli {
namespace {

using sillon::Error;
using sillon::ErrorCode;
using sillon::Result;

struct Arguments {
  ProjectArguments project;
  std::string out;    ///< a .3mf
  std::string body;   ///< STL; empty: a prism of the shape
  double height = 2;  ///< of that prism [mm]
  sillon::ZoneParams params;
  double layerHeight = 0.2;  ///< [mm]
  int threads = 1;
};

Result<Outcome> makeZones(const Arguments& arguments, sillon::Project project, const sillon::RunContext& run) {
  if (!endsWith(arguments.out, ".3mf")) {
    return Error{ErrorCode::InvalidArgument, "--output is \"" + arguments.out + "\"; it must end in .3mf"};
  }
  if (!project.modeFile.empty() || project.mode != sillon::DirectionMode::Constrained) {
    return Error{
        ErrorCode::InvalidArgument,
        "zones show directions as they are given, so the mode must be constrained; --mode constrained sets it"};
  }
  std::vector<std::string> inputs = inputFiles(project);
  if (!arguments.body.empty()) inputs.push_back(arguments.body);
  if (const auto problem = checkOutputs({arguments.out}, inputs)) return *problem;

  sillon::Mesh body;
  sillon::Shape seen;
  sillon::Vec2 corner;
  if (!arguments.body.empty()) {
    const Result<std::string> bytes = readFile(arguments.body, "body", kMaxInputBytes);
    if (!bytes) return bytes.error();
    Result<sillon::Mesh> read = sillon::readStl(bytes.value());
    if (!read) return Error{read.error().code, "\"" + arguments.body + "\": " + read.error().message};
    body = std::move(read).value();
    Result<sillon::Shape> outline = sillon::silhouetteOf(body, corner);
    if (!outline) return Error{outline.error().code, "\"" + arguments.body + "\": " + outline.error().message};
    seen = std::move(outline).value();
    // The page is the body's box.
    project.shapeFile.clear();
    project.builtin = sillon::BuiltinShape::Rectangle;
    project.builtinSize = seen.page;
  }
  Result<sillon::PlateInput> input = assemblePlate(project, run);
  if (!input) return input.error();
  const auto pictures = sillon::solvePictures(project, readInputFile, input.value(), run);
  if (!pictures) return pictures.error();
  const auto layers = sillon::makeLayers(project, input.value().shape, readInputFile, run);
  if (!layers) return layers.error();
  const auto seenLayers = sillon::seeLayers(project, layers.value().placed, layers.value(), input.value().directions);
  sillon::layOver(layers.value(), input.value());
  if (arguments.body.empty()) {
    seen = input.value().shape;
    Result<sillon::Mesh> prism = sillon::prismOf(seen, arguments.height);
    if (!prism) return prism.error();
    body = std::move(prism).value();
    corner = 0.5 * (project.printer.bedMin + project.printer.bedMax - seen.page);
    for (auto& point : body.points) {
      point[0] += corner.x;
      point[1] += corner.y;
    }
  }
  const Result<sillon::DirectionZones> zones =
      sillon::directionZones(seen, input.value().directions, arguments.params, run);
  if (!zones) return zones.error();
  Result<std::string> package = sillon::zones3mf(body, zones.value(), corner, arguments.layerHeight);
  if (!package) return package.error();

  std::string out;
  if (arguments.body.empty()) {
    for (const sillon::InputNote& note : sillon::inputNotes(project, seen.drawing)) {
      out += "note   " + note.message + "\n";
    }
    for (const sillon::Warning& warning : sillon::drawingWarnings(seen.drawing)) {
      out += "warning " + warning.message + "\n";
    }
  }
  for (std::size_t k = 0; k < project.layers.size(); ++k) {
    for (const sillon::DrawingFacts& drawing : layers.value().placed[k].drawings) {
      for (const sillon::InputNote& note : sillon::layerNotes(drawing, k + 1)) out += "note   " + note.message + "\n";
      for (const sillon::Warning& warning : sillon::drawingWarnings(drawing, k + 1)) {
        out += "warning " + warning.message + "\n";
      }
    }
  }
  for (const sillon::Warning& warning : sillon::letterWarnings(layers.value().placed)) {
    out += "warning " + warning.message + "\n";
  }
  for (const sillon::Warning& warning : sillon::layerWarnings(seenLayers, seen.page, project.toolpath.spacing)) {
    out += "warning " + warning.message + "\n";
  }
  if (const std::size_t open = sillon::openEdges(body); open > 0) {
    out += "warning the body has " + plural(open, "open edge") +
           "; slicers may find no layers in it, so repair it first\n";
  }
  char line[160];
  if (const std::size_t count = zones.value().zones.size(); count < static_cast<std::size_t>(arguments.params.most)) {
    const bool narrow = static_cast<std::size_t>(zones.value().found) > count;
    std::snprintf(line, sizeof line, narrow ? "others are narrower than %g mm (--least)" : "no more directions differ",
                  arguments.params.least);
    out +=
        "note   " + plural(count, "zone") + " instead of " + std::to_string(arguments.params.most) + ": " + line + "\n";
  }
  for (const sillon::DirectionZone& zone : zones.value().zones) {
    std::snprintf(line, sizeof line, "zone   %6.1f degrees %9.1f mm2\n", zone.degrees, zone.areaMm2);
    out += line;
  }
  std::snprintf(line, sizeof line, "off    %.1f degrees on average from the directions that were given\n",
                zones.value().error);
  return Outcome{{{arguments.out, std::move(package).value()}}, out + line};
}

int run(Arguments& arguments) {
  Run run(arguments.threads);
  Result<sillon::Project> project = readProject(arguments.project);
  if (!project) return fail(project.error());
  return commit(makeZones(arguments, std::move(project).value(), run.context()), run);
}

/// Settings of the shape and the directions, before there is a toolpath.
bool isOfInput(const sillon::Setting& row) {
  using sillon::Section;
  return row.section == Section::Shape || row.section == Section::Directions || row.section == Section::Modes;
}

Action add(Options& options) {
  const auto arguments = std::make_shared<Arguments>();
  options.file("SCENE.json", "project or scene to begin with", arguments->project.scene, false);
  addShape(options, arguments->project.changes);
  addPictures(options, arguments->project.pictures);
  options.group("Zones");
  options.text("-o,--output", "F.3mf", "file to write", arguments->out);
  options.require("--output");
  options.text("--body", "F.stl", "body whose top surfaces get the zones [a prism of the shape]", arguments->body);
  options.number("--height", "MM", "height of that prism [2]", arguments->height);
  for (const char* other : {"--height", "--shape", "--size"}) options.excludes("--body", other);
  options.number("--zones", "N", "most directions, 2 to 12 [6]", arguments->params.most);
  options.number("--least", "MM", "narrowest place of a zone, 0.5 to 100 [3]", arguments->params.least);
  options.number("--layer-height", "MM", "layer height that the slicer is told [0.2]", arguments->layerHeight);
  options.settings(arguments->project.changes, isOfInput);
  options.group("Run");
  options.threads(arguments->threads);
  return [arguments] { return run(*arguments); };
}

}  // namespace

const Command zonesCommand{
    "zones",
    "cut the directions into zones of straight lines, for any slicer",
    "[SCENE.json]",
    "--output --body --shape --size --directions --angle --picture --lamp --zones --layer-height",
    "Examples:\n"
    "  sillon zones --shape badge.svg --directions waves.png -o badge.3mf\n"
    "  sillon zones --body part.stl --picture face.png --lamp 60 -o part.3mf\n\n"
    "Open the file in PrusaSlicer, OrcaSlicer or Bambu Studio, choose the printer and slice.",
    add};

}  // namespace cli
