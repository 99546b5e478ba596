// Takes lines that JavaScript has shaped (wasm/src/text/text.ts) with the same library. With HarfBuzz, engines in
// browsers would be a fifth larger, and most plates have no text.
#include <cstddef>

#include "base/json.hpp"
#include "input/shaped_line.hpp"
#include "sillon/base/words.hpp"
#include "sillon/text/text.hpp"
#include "text/letters.hpp"

namespace sillon {

Result<ShapedLine> shapeLine(const ReadInput& read, const std::string& font, const std::string& line, int weight) {
  const Result<InputFile> given = read(nameOfLine(font, weight, line), "shaped line");
  if (!given) return given.error();
  const auto* text = std::get_if<std::string>(&given.value());
  const Json json = text != nullptr ? parseJson(*text) : Json();
  if (!json.is_object() || json.contains("noFont")) return noFont(font);
  if (json.contains("unknownFont")) return unknownFont(font);
  if (json.contains("tooDetailed")) return tooDetailed(font);
  ShapedLine shaped;
  shaped.em = json["em"].get<double>();
  shaped.capHeight = json["capHeight"].get<double>();
  shaped.xHeight = json["xHeight"].get<double>();
  shaped.ascent = json["ascent"].get<double>();
  shaped.descent = json["descent"].get<double>();
  for (const Json& letter : json["letters"]) {
    shaped.letters.push_back(
        {letter[0].get<std::size_t>(), {letter[1].get<double>(), letter[2].get<double>()}, letter[3].get<double>()});
  }
  for (const Json& letter : json["lacked"]) {
    shaped.lacked.push_back({letter[0].get<std::string>(), letter[1].get<std::string>(), letter[2].get<bool>()});
  }
  for (const Json& outline : json["outlines"]) shaped.outlines.push_back(outline.get<std::string>());
  return shaped;
}

}  // namespace sillon
