// sillon shape: tells how a drawing or a mask is read, without making a plate.
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "assemble.hpp"
#include "commands/commands.hpp"
#include "run.hpp"
#include "sillon/geometry/shape.hpp"
#include "sillon/project/project.hpp"
#include "sillon/report/warning.hpp"
#include "words.hpp"

namespace sillon::cli {
namespace {

struct Arguments {
  std::vector<std::string> files;
  std::optional<double> width;  ///< width of the page [mm]; unset: as drawn
  bool ignorePaint = false;
  bool json = false;
  bool outline = false;
};

using Json = nlohmann::ordered_json;

struct Description {
  Vec2 page;
  double area = 0;
  Json notes = Json::array();  ///< code and message of each note
  std::string outline;         ///< path data, if asked for
};

/// Returns the path data of SVG, in mm from the page's upper left corner, to be filled by nonzero winding.
std::string pathOf(const Shape& shape) {
  std::string path;
  for (const FilledPath& part : shape.paths) {
    for (const Ring& ring : part.rings) {
      for (const Vec2& p : ring) {
        char text[64];
        std::snprintf(text, sizeof text, "%c%.3f %.3f", &p == ring.data() ? 'M' : 'L', p.x, shape.page.y - p.y);
        path += text;
      }
      path += 'Z';
    }
  }
  return path;
}

/// Reads a file as the shape of a plate and collects its facts.
Result<Description> describe(const std::string& file, const Arguments& arguments) {
  Project project;
  project.shapeFile = file;
  project.pageWidth = arguments.width.value_or(0);
  project.ignorePaint = arguments.ignorePaint;
  const auto input = assemblePlate(project);
  if (!input) return input.error();
  const auto outline = resolveOutline(input.value().shape);
  if (!outline) return outline.error();
  const DrawingFacts& drawing = input.value().shape.drawing;
  Description out;
  out.page = input.value().shape.page;
  out.area = outline.value().area;
  if (arguments.outline) {
    const auto body = unitedOnGrid(input.value().shape);
    if (!body) return body.error();
    out.outline = pathOf(body.value());
  }
  for (const InputNote& note : inputNotes(project, drawing)) {
    out.notes.push_back({{"code", note.code}, {"message", note.message}});
  }
  for (const Warning& warning : drawingWarnings(drawing)) {
    out.notes.push_back({{"code", warningName(warning.code)}, {"message", warning.message}});
  }
  return out;
}

std::string line(const std::string& file, const Result<Description>& read) {
  if (!read) return file + "\n  error: " + read.error().message + "\n";
  char text[128];
  std::snprintf(text, sizeof text, "\n  page %.2f x %.2f mm, area %.2f mm2\n", read.value().page.x, read.value().page.y,
                read.value().area);
  std::string out = file + text;
  for (const Json& note : read.value().notes) out += "  note: " + note["message"].get<std::string>() + "\n";
  return out;
}

Json jsonOf(const std::string& file, const Result<Description>& read) {
  if (!read) return {{"file", file}, {"error", read.error().message}};
  const Description& shape = read.value();
  Json json{{"file", file}, {"page", {shape.page.x, shape.page.y}}, {"areaMm2", shape.area}, {"notes", shape.notes}};
  if (!shape.outline.empty()) json["outline"] = shape.outline;
  return json;
}

/// Describes the files one after the other, even if some of them fail.
int run(const Arguments& arguments) {
  bool failed = false;
  std::string text;
  for (const std::string& file : arguments.files) {
    const auto read = describe(file, arguments);
    failed = failed || !read;
    text += arguments.json ? jsonOf(file, read).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"
                           : line(file, read);
  }
  return answer(text, failed ? 2 : 0);
}

Action add(Options& options) {
  const auto arguments = std::make_shared<Arguments>();
  options.files("FILE...", "SVG drawings or mask pictures", arguments->files, true);
  options.group("Options");
  options.take("--size", "MM", "page width [as drawn, masks 80]", [arguments](const std::string& text) {
    arguments->width = parseNumber(text);
    if (!(arguments->width.value_or(0) > 0) || *arguments->width > 10000) {
      refuse("--size", text, "a width in mm, more than 0 and at most 10000");
    }
  });
  options.choice<bool>("--paint", "shown|ignore", "read a drawing as it appears, or all its outlines [shown]",
                       {{"shown", false}, {"ignore", true}},
                       [arguments](bool ignore) { arguments->ignorePaint = ignore; });
  options.flag("--json", "print one line of JSON for each file", arguments->json);
  options.flag("--outline", "with --json: add the outline, as path data of SVG in mm", arguments->outline);
  return [arguments] { return run(*arguments); };
}

}  // namespace

const Command shapeCommand{"shape",
                           "show how a drawing or mask is read: page, area, notes",
                           "FILE...",
                           "--size --paint --json --outline",
                           "Examples:\n"
                           "  sillon shape badge.svg --size 60",
                           add};

}  // namespace sillon::cli
