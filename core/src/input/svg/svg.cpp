// Converts the geometry of SVG 1.1 and 2 to polygons: https://www.w3.org/TR/SVG2/. RapidXML reads the XML, fast_float
// the numbers.
#include "input/svg.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include <rapidxml/rapidxml.hpp>

#include "input/gzip.hpp"
#include "input/svg/svg_node.hpp"
#include "input/svg/svg_reader.hpp"

namespace sillon {
namespace {

using namespace svg;

constexpr std::size_t kMaxBytes = std::size_t{64} << 20;

// Puts the element into an error: "<path id="a"> in line 3: ".
Error inElement(Error error, const Node& node, std::string_view text, const char* buffer) {
  std::string element = "<" + std::string(elementName(node));
  if (const auto id = attribute(node, "id")) element += " id=" + quoted(*id);
  element += ">";
  // RapidXML's names point into the buffer it parsed, a copy of the text.
  const std::int64_t line = lineAt(text, node.name() - buffer);
  error.message.insert(0, element + " in line " + std::to_string(line) + ": ");
  error.values.emplace_back("element", std::move(element));
  error.values.emplace_back("elementLine", static_cast<double>(line));
  return error;
}

// Records the program that wrote the file if it counts other pixels than CSS does.
void tellMaker(std::string_view text, Shape& shape) {
  const auto has = [&](std::string_view part) { return text.find(part) != std::string_view::npos; };
  const bool inkscape = has("inkscape:version=\"0.4") || has("inkscape:version=\"0.91");
  if (!inkscape && !has("Adobe Illustrator")) return;
  shape.drawing.maker = inkscape ? "Inkscape" : "Illustrator";
  shape.drawing.makerWidth = std::round(shape.page.x * 960 / (inkscape ? 90 : 72)) / 10;
}

}  // namespace

Result<Shape> readSvg(std::string_view text, const SvgOptions& options) {
  Result<SvgPainting> painting = readSvgPainting(text, options);
  if (!painting) return painting.error();
  return std::move(painting).value().shape;
}

Result<SvgPainting> readSvgPainting(std::string_view text, const SvgOptions& options) {
  if (!(options.tolerance >= 1e-4 && options.tolerance <= 10)) {
    return outOfRange("tolerance", options.tolerance, 1e-4, 10, "mm");
  }
  if (options.width != 0 && !(options.width >= 1e-6 && options.width <= 1e5)) {
    return outOfRange("shape.size.x", options.width, 1e-6, 1e5, "mm");
  }
  if (text.size() > kMaxBytes) return fileTooLarge(text.size(), kMaxBytes);
  std::string unpacked, buffer, expanded, spaced;
  const auto document = std::make_unique<rapidxml::xml_document<>>();  // 64 KiB, too large for small stacks
  const Node* current = nullptr;
  try {
    if (isGzip(text)) {
      Result<std::string> plain = gunzipped(text, kMaxBytes);
      if (!plain) throw Refused{plain.error()};
      unpacked = std::move(plain).value();
      text = unpacked;
    }
    if (text.find('\0') != std::string_view::npos) refuse("SvgNotText");
    expanded = withEntities(text, kMaxBytes);
    if (!expanded.empty()) text = expanded;
    spaced = checkNesting(text);
    if (!spaced.empty()) text = spaced;
    buffer = text;
    document->parse<rapidxml::parse_validate_closing_tags>(buffer.data());
    Node* root = document->first_node();
    if (!root) refuse("SvgEmpty");
    resolveNamespaces(*root);
    SvgPainting painting = drawElements(*root, options, current);
    DrawingFacts& facts = painting.shape.drawing;
    if (text.find("<?xml-stylesheet") != std::string_view::npos && facts.unread.size() < kMostUnread) {
      facts.unread.emplace_back("<?xml-stylesheet?>");
    }
    if (facts.pixels) tellMaker(text, painting.shape);
    return painting;
  } catch (const Refused& found) {
    return current ? inElement(found.error, *current, text, buffer.data()) : found.error;
  } catch (const rapidxml::parse_error& error) {
    return notXml(text, toSize(error.where<char>() - buffer.data()));
  }
}

}  // namespace sillon
