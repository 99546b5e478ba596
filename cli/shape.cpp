#include "shape.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "assemble.hpp"
#include "sillon/geometry/outline.hpp"
#include "sillon/project/plate_input.hpp"
#include "sillon/report/input_note.hpp"
#include "sillon/report/warning.hpp"

namespace cli {
namespace {

using Json = nlohmann::ordered_json;

struct Description {
  sillon::Vec2 page;
  double area = 0;
  std::vector<std::string> notes;
};

sillon::Result<Description> describe(const std::string& file, const ShapeArguments& arguments) {
  sillon::Project project;
  project.shapeFile = file;
  project.pageWidth = arguments.width.value_or(0);
  project.ignorePaint = arguments.ignorePaint;
  const auto input = assemblePlate(project);
  if (!input) return input.error();
  const auto outline = sillon::resolveOutline(input.value().shape);
  if (!outline) return outline.error();
  Description out{input.value().shape.page, outline.value().area, {}};
  for (const sillon::InputNote& note : sillon::inputNotes(project, input.value().shape.drawing)) {
    out.notes.push_back(note.message);
  }
  for (const sillon::Warning& warning : sillon::drawingWarnings(input.value().shape.drawing)) {
    out.notes.push_back(warning.message);
  }
  return out;
}

std::string line(const std::string& file, const sillon::Result<Description>& read) {
  if (!read) return file + "\n  error: " + read.error().message + "\n";
  char text[128];
  std::snprintf(text, sizeof text, "\n  page %.2f x %.2f mm, area %.2f mm2\n", read.value().page.x, read.value().page.y,
                read.value().area);
  std::string out = file + text;
  for (const std::string& note : read.value().notes) out += "  note: " + note + "\n";
  return out;
}

Json jsonOf(const std::string& file, const sillon::Result<Description>& read) {
  if (!read) return {{"file", file}, {"error", read.error().message}};
  const Description& shape = read.value();
  return {{"file", file}, {"page", {shape.page.x, shape.page.y}}, {"areaMm2", shape.area}, {"notes", shape.notes}};
}

}  // namespace

ShapeAnswer describeShapes(const ShapeArguments& arguments) {
  ShapeAnswer answer;
  for (const std::string& file : arguments.files) {
    const auto read = describe(file, arguments);
    answer.failed = answer.failed || !read;
    answer.text += arguments.json ? jsonOf(file, read).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"
                                  : line(file, read);
  }
  return answer;
}

}  // namespace cli
