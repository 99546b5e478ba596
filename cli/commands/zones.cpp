// sillon zones: writes a body with zones of straight lines, for any slicer.
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assemble.hpp"
#include "commands/commands.hpp"
#include "files.hpp"
#include "project_arguments.hpp"
#include "run.hpp"
#include "sillon/job/plate.hpp"
#include "words.hpp"

namespace sillon::cli {
namespace {

struct Arguments {
  ProjectArguments project;
  std::string out;   ///< name of a .3mf
  std::string body;  ///< name of an STL; empty for a prism of the shape
  ZonesRequest request;
  int threads = 1;
};

Result<Outcome> makeZones(const Arguments& arguments, Project project, const RunContext& run) {
  if (!endsWith(arguments.out, ".3mf")) {
    return Error{ErrorCode::InvalidArgument, "--output is \"" + arguments.out + "\"; it must end in .3mf"};
  }
  std::vector<std::string> inputs = inputFiles(project);
  if (!arguments.body.empty()) inputs.push_back(arguments.body);
  if (const auto problem = checkOutputs({arguments.out}, inputs)) return *problem;

  ZonesRequest request = arguments.request;
  if (!arguments.body.empty()) {
    Result<std::string> bytes = readFile(arguments.body, "body", kMaxInputBytes);
    if (!bytes) return bytes.error();
    request.body = std::move(bytes).value();
  }
  Result<ZonesMade> made = sillon::makeZones(project, request, readInputFile, run);
  if (!made) return made.error();
  const DirectionZones& zones = made.value().zones;

  std::string out;
  for (const InputNote& note : made.value().notes) out += "note   " + note.message + "\n";
  for (const Warning& warning : made.value().warnings) out += "warning " + warning.message + "\n";
  if (const std::size_t open = made.value().openEdges; open > 0) {
    out += "warning the body has " + plural(open, "open edge") +
           "; slicers may find no layers in it, so repair it first\n";
  }
  char line[160];
  if (const int count = static_cast<int>(zones.zones.size()); count < arguments.request.params.most) {
    const bool narrow = zones.found > count;
    std::snprintf(line, sizeof line, narrow ? "others are narrower than %g mm (--least)" : "no more directions differ",
                  arguments.request.params.least);
    out += "note   " + plural(count, "zone") + " instead of " + std::to_string(arguments.request.params.most) + ": " +
           line + "\n";
  }
  for (const DirectionZone& zone : zones.zones) {
    std::snprintf(line, sizeof line, "zone   %6.1f degrees %9.1f mm2\n", zone.degrees, zone.areaMm2);
    out += line;
  }
  std::snprintf(line, sizeof line, "off    %.1f degrees on average from the directions that were given, in %zu steps\n",
                zones.error, zones.zones.size());
  return Outcome{{{arguments.out, std::move(made.value().package)}}, out + line};
}

int run(Arguments& arguments) {
  Run run(arguments.threads);
  Result<Project> project = readProject(arguments.project);
  if (!project) return fail(project.error());
  return commit(makeZones(arguments, std::move(project).value(), run.context()), run);
}

/// Tells whether a setting belongs to the shape, since zones need no toolpath.
bool isOfInput(const Setting& row) { return row.section == Section::Shape; }

Action add(Options& options) {
  const auto arguments = std::make_shared<Arguments>();
  options.file("SCENE.json", "project or scene to begin with", arguments->project.scene, false);
  addShape(options, arguments->project.changes);
  addPictures(options, arguments->project.pictures);
  options.group("Zones");
  options.text("-o,--output", "F.3mf", "file to write", arguments->out);
  options.require("--output");
  options.text("--body", "F.stl", "body whose top surfaces get the zones [a prism of the shape]", arguments->body);
  options.take("--face", "X,Y,Z", "corner and height of the top face whose outline the project's shape is [all tops]",
               [arguments](const std::string& text) {
                 const std::size_t last = text.rfind(',');
                 const std::optional<Vec2> corner = parsePair(text.substr(0, last), ',');
                 const std::optional<double> z = parseNumber(last == std::string::npos ? "" : text.substr(last + 1));
                 if (!corner || !z) refuse("--face", text, "three numbers in mm, as in 10,20,5");
                 arguments->request.face = {*corner, *z};
               });
  options.needs("--face", "--body");
  options.number("--height", "MM", "height of that prism [2]", arguments->request.height);
  for (const char* other : {"--height", "--shape", "--size"}) options.excludes("--body", other);
  options.number("--zones", "N", "most directions, 2 to 12 [6]", arguments->request.params.most);
  options.number("--least", "MM", "narrowest place of a zone, 0.5 to 100 [3]", arguments->request.params.least);
  options.number("--layer-height", "MM", "layer height that the slicer is told [0.2]", arguments->request.layerHeight);
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

}  // namespace sillon::cli
