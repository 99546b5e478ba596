// sillon rebrush: replaces the beads of top surfaces in a sliced file.
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assemble.hpp"
#include "commands/commands.hpp"
#include "files.hpp"
#include "pictures.hpp"
#include "previews.hpp"
#include "project_arguments.hpp"
#include "run.hpp"
#include "sillon/export/export.hpp"
#include "sillon/input/image_io.hpp"
#include "sillon/look/appearance.hpp"
#include "sillon/rebrush/rebrush.hpp"
#include "sillon/settings/table.hpp"
#include "words.hpp"

namespace sillon::cli {
namespace {

struct Arguments {
  std::string file;
  std::string out;  ///< empty to change the file in place
  std::string report;
  std::string preview;   ///< PNG or WebP of each replaced surface
  int previewWidth = 0;  ///< see previewFiles()
  bool list = false;
  bool json = false;
  ProjectArguments project;  ///< project whose layers are laid on the surfaces
  RebrushOptions options;
  int threads = 1;
};

const char* sideName(const SlicedSurface& surface) { return surface.side == SurfaceSide::Top ? "top" : "bottom"; }

/// Formats the surfaces of a file for the terminal.
std::string listText(const SlicedFile& file) {
  char line[256];
  std::snprintf(line, sizeof line, "%s, %d layers, %lld lines, %zu surfaces\n", file.program.c_str(), file.layers,
                static_cast<long long>(file.lines), file.surfaces.size());
  std::string out = line;
  for (std::size_t k = 0; k < file.surfaces.size(); ++k) {
    const SlicedSurface& surface = file.surfaces[k];
    std::snprintf(line, sizeof line,
                  "%4zu %-6s layer %-4d z %-7.2f %9.2f mm2, beads %.2f x %.2f mm at %.0f mm/s, lines %lld to %lld",
                  k + 1, sideName(surface), surface.layer, surface.z, surface.areaMm2, surface.width, surface.height,
                  surface.speed, static_cast<long long>(surface.firstLine), static_cast<long long>(surface.lastLine));
    out += line;
    if (!surface.object.empty()) out += ", of " + surface.object;
    if (surface.left != LeftBecause::None) out += ", left: " + std::string(surfaceReason(surface.left));
    out += "\n";
  }
  return out;
}

/// Formats a surface as JSON.
nlohmann::ordered_json surfaceJson(const SlicedSurface& surface) {
  const auto place = [](Vec2 p) { return nlohmann::ordered_json{p.x, p.y}; };
  return {{"side", sideName(surface)},
          {"layer", surface.layer},
          {"z", surface.z},
          {"height", surface.height},
          {"object", surface.object},
          {"tool", surface.tool},
          {"areaMm2", surface.areaMm2},
          {"width", surface.width},
          {"spacing", surface.spacing},
          {"volumeMm3", surface.volumeMm3},
          {"speed", surface.speed},
          {"entry", place(surface.entry)},
          {"exit", place(surface.exit)},
          {"firstLine", surface.firstLine},
          {"lastLine", surface.lastLine},
          {"left", surface.left == LeftBecause::None ? nlohmann::ordered_json()
                                                     : nlohmann::ordered_json(surfaceReason(surface.left))},
          {"reason", surfaceReasonName(surface.left)}};
}

std::string dumped(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

nlohmann::ordered_json fileJson(const SlicedFile& file) {
  return {{"program", file.program},
          {"slicer", slicerName(file.slicer)},
          {"layers", file.layers},
          {"lines", file.lines},
          {"nozzle", file.nozzle}};
}

std::string listJson(const SlicedFile& file) {
  nlohmann::ordered_json json = fileJson(file);
  json["surfaces"] = nlohmann::ordered_json::array();
  for (const SlicedSurface& surface : file.surfaces) json["surfaces"].push_back(surfaceJson(surface));
  return dumped(json);
}

/// Formats the pictures of a replaced surface as JSON.
nlohmann::ordered_json picturesJson(const RebrushedSurface& made) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < made.pictures.size(); ++k) {
    const auto& [layer, file, lamp, measures] = made.pictures[k];
    list.push_back({{"layer", layer},
                    {"lamp", {lamp.azimuth, lamp.elevation}},
                    {"r", measures.r},
                    {"ssim", measures.ssim},
                    {"contrast", measures.contrast}});
    if (k < made.leftOut.size()) list.back()["leftOut"] = made.leftOut[k];
  }
  return list;
}

std::string reportJson(const Rebrushed& done) {
  nlohmann::ordered_json json = fileJson(done.file);
  json["seconds"] = done.seconds;
  json["totals"] = done.totals;
  json["surfaces"] = nlohmann::ordered_json::array();
  for (const RebrushedSurface& made : done.surfaces) {
    nlohmann::ordered_json entry = surfaceJson(done.file.surfaces[made.surface]);
    entry["left"] = made.replaced ? nlohmann::ordered_json() : nlohmann::ordered_json(made.why);
    entry["reason"] = surfaceReasonName(made.because);
    entry["replaced"] = made.replaced;
    if (made.replaced) {
      entry["newVolumeMm3"] = made.volumeMm3;
      entry["alignment"] = made.alignment;
      entry["coverage"] = made.coverage;
      entry["spill"] = made.spill;
      entry["beyond"] = made.beyond;
      entry["moves"] = made.moves;
      entry["seconds"] = made.seconds;
      if (!made.pictures.empty()) entry["pictures"] = picturesJson(made);
    }
    json["surfaces"].push_back(std::move(entry));
  }
  return dumped(json);
}

/// Formats the results for the terminal, one line for each surface.
std::string summaryText(const Rebrushed& done) {
  std::string out;
  for (const RebrushedSurface& made : done.surfaces) {
    const SlicedSurface& surface = done.file.surfaces[made.surface];
    char line[200];
    if (made.replaced) {
      std::snprintf(line, sizeof line, "%-6s layer %-4d %9.2f mm2 replaced, coverage %.1f %%, alignment %.3f\n",
                    sideName(surface), surface.layer, surface.areaMm2, made.coverage, made.alignment);
      out += line;
      for (std::size_t k = 0; k < made.pictures.size(); ++k) {
        std::snprintf(line, sizeof line, "       picture %zu under a lamp at %.0f degrees, %.0f high: r %.3f\n", k + 1,
                      made.pictures[k].lamp.azimuth, made.pictures[k].lamp.elevation, made.pictures[k].measures.r);
        out += line;
        const std::string note = k < made.leftOut.size() ? cutOffNote(made.leftOut[k]) : "";
        if (!note.empty()) out += "       note: " + note + "\n";
      }
    } else {
      std::snprintf(line, sizeof line, "%-6s layer %-4d %9.2f mm2 left: ", sideName(surface), surface.layer,
                    surface.areaMm2);
      out += line + made.why + "\n";
    }
  }
  char line[200];
  std::snprintf(line, sizeof line, "time   %+lld s as estimated; %s of the file changed for it\n",
                std::llround(done.seconds), plural(done.totals, "line").c_str());
  out += line;
  return out;
}

/// Reads and unpacks a file. It passes the bytes on, so that files of 200 MB are not in memory twice.
Result<GcodeContainer> readContainer(const std::string& path) {
  Result<std::string> bytes = readFile(path, "G-code", kMaxGcodeBytes);
  if (!bytes) return bytes.error();
  return readGcodeContainer(std::move(bytes).value());
}

/// Packs the new text into the kind of file that the old one is, or returns it as plain text. Apart from gzip, nothing
/// is packed anew: only its slicer knows what else a printer wants in a package.
Result<std::string> packed(const GcodeContainer& container, std::string gcode, const std::string& out) {
  using Kind = GcodeContainerKind;
  const Kind wanted = endsWith(out, ".3mf")                               ? Kind::Package3mf
                      : endsWith(out, ".bgcode") || endsWith(out, ".bgc") ? Kind::Binary
                      : endsWith(out, ".gz")                              ? Kind::Gzip
                                                                          : Kind::Text;
  if (wanted == container.kind) return writeGcodeContainer(container, std::move(gcode));
  if (wanted == Kind::Text) return gcode;
  if (wanted == Kind::Gzip && container.kind == Kind::Text) return gzipGcode(gcode);
  return Error{
      ErrorCode::InvalidArgument,
      "\"" + out +
          "\" would be another kind of file than the slicer wrote; give it the same ending, or .gcode for its text"};
}

LookParams lookOf(const Spool& spool, const Rebrushed& done, const RebrushedSurface& made) {
  LookParams look;
  const SlicedSurface& surface = done.file.surfaces[made.surface];
  look.colour = spool.colour;
  look.roughness = sillon::roughnessOf(spool, done.file.nozzle, surface.side == SurfaceSide::Bottom);
  if (!made.pictures.empty()) {
    look.lamp = made.pictures.front().lamp;
    // Bottoms are drawn as they lie, seen through the plate.
    if (surface.side == SurfaceSide::Bottom) look.lamp.azimuth = 180 - look.lamp.azimuth;
    look.eyeDistance = 0;  // the directions were solved for an eye at infinity
  }
  return look;
}

/// Lists the surfaces of a file, or replaces them and makes all outputs.
Result<Outcome> brush(Arguments& arguments, const RunContext& run) {
  const auto named = [&](const Error& error) {
    return Error{error.code, "\"" + arguments.file + "\": " + error.message};
  };
  const Result<GcodeContainer> container = readContainer(arguments.file);
  if (!container) {
    // Errors of readFile() name the file already.
    const Error& error = container.error();
    return error.message.find(arguments.file) == std::string::npos ? named(error) : error;
  }
  const std::string& gcode = container.value().gcode;
  if (arguments.list) {
    const Result<SlicedFile> file = readSlicedFile(gcode, run);
    if (!file) return named(file.error());
    return Outcome{{}, arguments.json ? listJson(file.value()) : listText(file.value()), true};
  }
  if (container.value().plates > 1) return severalPlates(arguments.file, container.value().plates);
  Result<Project> project = readProject(arguments.project);
  if (!project) return project.error();
  RebrushOptions options = arguments.options;
  options.project = project.value();
  options.read = readInputFile;
  options.ownSpool = ownSpool(arguments.project.pictures);
  const std::string& out = arguments.out.empty() ? arguments.file : arguments.out;
  std::vector<std::string> outputs{out};
  for (const std::string* name : {&arguments.report, &arguments.preview}) {
    if (!name->empty()) outputs.push_back(*name);
  }
  std::vector<std::string> inputs = inputFiles(options.project);
  if (!sameFile(out, arguments.file)) inputs.push_back(arguments.file);
  for (const std::string* name : {&arguments.project.scene, &arguments.project.pictures.spoolsFile}) {
    if (!name->empty()) inputs.push_back(*name);
  }
  std::vector<std::string> previews{arguments.preview};
  if (const auto problem = checkOutputs(outputs, inputs, previews)) return *problem;
  if (const auto problem = previewProblem(arguments.preview, arguments.previewWidth)) return *problem;
  Result<Rebrushed> done = rebrush(gcode, options, run);
  if (!done) return named(done.error());
  std::vector<OutputFile> files;
  std::string brushed = withEdits(gcode, done.value().edits);
  // A file that is changed in place stays of its kind, whatever its name.
  Result<std::string> file = arguments.out.empty() ? writeGcodeContainer(container.value(), std::move(brushed))
                                                   : packed(container.value(), std::move(brushed), out);
  if (!file) return file.error();
  files.push_back({out, std::move(file).value()});
  std::size_t drawn = 0;
  const Spool& shown = options.ownSpool != nullptr ? *options.ownSpool : spoolOf(options.project.pictures.spool);
  for (const RebrushedSurface& made : done.value().surfaces) {
    if (arguments.preview.empty() || !made.replaced) continue;
    const Vec2 page = done.value().file.surfaces[made.surface].region.page;
    auto preview = previewFiles(previewName(arguments.preview, drawn++), made.toolpath, page,
                                {lookOf(shown, done.value(), made)}, arguments.previewWidth, run);
    if (!preview) return preview.error();
    files.push_back(std::move(preview).value().front());
    if (drawn == 1) continue;
    for (std::vector<std::string>* names : {&outputs, &previews}) names->push_back(files.back().path);
    if (const auto problem = checkOutputs(outputs, inputs, previews)) return *problem;
  }
  if (!arguments.report.empty()) files.push_back({arguments.report, reportJson(done.value())});
  return Outcome{std::move(files), summaryText(done.value())};
}

int run(Arguments& arguments) {
  Run run(arguments.threads);
  return commit(brush(arguments, run.context()), run);
}

/// Adds the options that choose surfaces.
void addSurfaces(Options& options, Arguments& arguments) {
  options.group("Surfaces");
  options.flag("--list", "show the surfaces, write nothing", arguments.list);
  options.flag("--json", "show the list as JSON", arguments.json);
  options.choice<int>("--surfaces", "top|bottom|both", "surfaces to replace; bottoms lie on the bed [top]",
                      {{"top", 1}, {"bottom", 2}, {"both", 3}}, [&arguments](int which) {
                        arguments.options.tops = (which & 1) != 0;
                        arguments.options.bottoms = (which & 2) != 0;
                      });
  options.list(
      "--only", "N,N...", "these surfaces alone, by their numbers in --list",
      [&arguments](const std::string& word) {
        const std::optional<double> number = parseNumber(word);
        if (!number || !(*number >= 1 && *number <= 1e6) || *number != std::floor(*number)) {
          refuse("--only", word, "a number that --list shows; the first is 1");
        }
        arguments.options.only.push_back(sillon::toSize(*number) - 1);
      },
      ',');
}

/// Adds the options about the layers that are laid on the surfaces.
void addLaid(Options& options, Arguments& arguments) {
  ProjectArguments& project = arguments.project;
  project.besidePictures = PerimeterMode::Soft;
  options.group("Layers");
  options.text("--project", "F.json", "project whose layers are laid on the surfaces", project.scene);
  addLayers(options, project.changes);
  options.choice<PictureFit>(
      "--fit", "face|object|bed|all", "lay them on each face, each object, the bed, or the box around all [face]",
      {{"face", PictureFit::Face}, {"object", PictureFit::Object}, {"bed", PictureFit::Bed}, {"all", PictureFit::All}},
      [&arguments](PictureFit fit) { arguments.options.fit = fit; });
  addPerimeters(options, project.changes);
}

Action add(Options& options) {
  const auto arguments = std::make_shared<Arguments>();
  options.file("FILE.gcode", "file of PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio or Cura", arguments->file,
               true);
  addSurfaces(options, *arguments);
  addLaid(options, *arguments);
  addPictures(options, arguments->project.pictures);
  options.group("Output");
  options.text("-o,--output", "F", "new file [the file itself]", arguments->out);
  options.text("--report", "F", "what became of each surface, JSON", arguments->report);
  options.text("--preview", "F",
               "picture of each new surface, PNG: its directions, and its look; or .webp, a loop of moving light",
               arguments->preview);
  options.previewWidth(arguments->previewWidth);
  options.group("Run");
  options.threads(arguments->threads);
  options.needs("--json", "--list");
  for (const char* output : {"--output", "--report", "--preview"}) options.excludes("--list", output);
  return [arguments] { return run(*arguments); };
}

}  // namespace

const Command rebrushCommand{
    "rebrush",
    "replace the beads of top surfaces in a file from your slicer",
    "FILE.gcode",
    "--list --surfaces --only --angle --directions --layer --fit --perimeters --picture --lamp --output --report "
    "--preview",
    "Examples:\n"
    "  sillon rebrush part.gcode --list\n"
    "  sillon rebrush part.gcode --angle 30 -o part_brushed.gcode\n"
    "  sillon rebrush part.gcode --picture face.png --lamp 60 -o part_face.gcode\n\n"
    "Without -o the file itself is changed, as slicers expect of post-processing scripts.\n\n"
    "Exit codes: 0 done, 2 refused, 3 cancelled, 1 internal error. No files are written unless everything succeeds.",
    add};

}  // namespace sillon::cli
