// Any bytes as settings of a small plate's outline, layers and rim give a plate whose G-code the checker passes, or an
// error with a message.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "bytes.hpp"
#include "sillon/compose/compose.hpp"
#include "sillon/job/plate.hpp"
#include "sillon/settings/table.hpp"

namespace {

using namespace sillon;

void require(bool holds) {
  if (!holds) std::abort();
}

/// Returns a plausible length or angle, or anything in the setting's range.
double numberFor(const Setting& setting, fuzz::Bytes& bytes) {
  const int kind = bytes.byte() % 8;
  if (kind < 4) return std::clamp(30 * bytes.share(), setting.low, setting.high);
  if (kind == 4) return std::clamp(-30 * bytes.share(), setting.low, setting.high);
  if (kind == 5) return setting.low;
  if (kind == 6) return setting.high;
  return setting.low + (setting.high - setting.low) * bytes.share();
}

Vec2 pairFor(const Setting& setting, fuzz::Bytes& bytes) {
  const double x = numberFor(setting, bytes);
  return {x, numberFor(setting, bytes)};
}

/// Joins names of files and fonts, and letters that some fonts join, lack or write to the left.
std::string textFrom(fuzz::Bytes& bytes) {
  static const char* const kTexts[]{"picture",      "drawing.svg", "mask", "Nunito", "Caveat",   "A",    "i",
                                    "fi",           "8",           " ",    "\n",     "\xC3\x89", "\xFF", "\xD7\x90",
                                    "\xE5\xAD\x97", "https://x"};
  std::string text;
  for (int k = 1 + bytes.byte() % 4; k > 0; --k) text += kTexts[bytes.byte() % std::size(kTexts)];
  return text;
}

void change(const Setting& setting, const SettingsView& view, fuzz::Bytes& bytes) {
  const Field field = setting.field(view);
  const auto put = [&](auto at) {
    using Kind = decltype(at);
    if constexpr (std::is_same_v<Kind, double*>) {
      *at = numberFor(setting, bytes);
    } else if constexpr (std::is_same_v<Kind, int*>) {
      *at = static_cast<int>(numberFor(setting, bytes));
    } else if constexpr (std::is_same_v<Kind, std::optional<double>*>) {
      *at = numberFor(setting, bytes);
    } else if constexpr (std::is_same_v<Kind, Vec2*> || std::is_same_v<Kind, std::optional<Vec2>*>) {
      *at = pairFor(setting, bytes);
    } else if constexpr (std::is_same_v<Kind, std::string*>) {
      *at = textFrom(bytes);
    } else if constexpr (std::is_same_v<Kind, std::vector<RoundHole>*>) {
      const double x = 30 * bytes.share(), y = 30 * bytes.share();
      at->push_back({{x, y}, 8 * bytes.share()});
    } else if constexpr (std::is_same_v<Kind, std::uint64_t*>) {
      *at = bytes.byte();
    } else if constexpr (std::is_same_v<Kind, std::vector<LampPicture>*>) {
      at->push_back({"picture", std::nullopt});
      if (bytes.byte() % 2 == 1) at->back().lamp = Vec2{360 * bytes.share(), 1 + 89 * bytes.share()};
    } else if constexpr (std::is_same_v<Kind, std::vector<ColourAngle>*>) {
      at->push_back({bytes.byte() % 2 == 1 ? "#ff8000" : "#000000", 360 * bytes.share()});
    } else if constexpr (std::is_same_v<Kind, std::vector<Stroke>*>) {
      Stroke& stroke = at->emplace_back();
      stroke.tool = static_cast<StrokeTool>(bytes.byte() % 3);
      stroke.mode = static_cast<DirectionMode>(bytes.byte() % 4);
      stroke.radius = 0.1 + 8 * bytes.share();
      stroke.soft = bytes.share();
      for (int k = bytes.byte() % 8; k > 0; --k) {
        const double x = 40 * bytes.share() - 10;
        stroke.points.push_back({x, 40 * bytes.share() - 10});
      }
    } else if constexpr (std::is_same_v<Kind, bool*>) {
      *at = bytes.byte() % 2 == 1;
    } else if constexpr (std::is_same_v<Kind, ChoiceField>) {
      choose(field, bytes.byte() % splitWords(setting.choices).size());
    }
  };
  std::visit(put, field);
}

std::vector<const Setting*> settingsOf(bool (*wanted)(const Setting&)) {
  std::vector<const Setting*> found;
  for (const Setting& setting : settings()) {
    if (wanted(setting)) found.push_back(&setting);
  }
  return found;
}

Project projectFrom(fuzz::Bytes& bytes) {
  static const auto ofLayers = settingsOf([](const Setting& setting) { return setting.section == Section::Layers; });
  static const auto others = settingsOf([](const Setting& setting) {
    return setting.section == Section::Shape || std::string(setting.key).starts_with("rim");
  });
  constexpr std::size_t kMost = 4;
  Project project;
  project.builtin = BuiltinShape::Disc;
  project.builtinSize = {16, 0};
  for (int k = bytes.byte() % 16; k > 0; --k) change(*others[bytes.byte() % others.size()], viewOf(project), bytes);
  while (!bytes.empty() && project.layers.size() < kMost) {
    Layer layer;
    layer.maskFile = "picture";
    SettingsView view;
    view.layer = &layer;
    change(*ofLayers[0], view, bytes);  // its kind
    if (auto* words = layer.as<LayerWords>()) words->text = "A";
    if (auto* file = layer.as<LayerFile>()) file->file = "picture";
    if (auto* lit = layer.as<PictureLayer>()) lit->pictures = {{"picture", std::nullopt}};
    for (int k = bytes.byte() % 16; k > 0; --k) change(*ofLayers[bytes.byte() % ofLayers.size()], view, bytes);
    // Larger letters and drawings take seconds under sanitizers, to tell how thin they are.
    layer.size = {std::min(layer.size.x, 100.0), std::min(layer.size.y, 100.0)};
    if (auto* letters = layer.as<LayerLetters>()) letters->textSize = std::min(letters->textSize, 30.0);
    project.layers.push_back(layer);
  }
  // Larger plates would be fewer in the same time; a width of 0 is 80 mm.
  for (double* width : {&project.builtinSize.x, &project.pageWidth}) *width = *width == 0 ? 16 : std::min(*width, 20.0);
  project.builtinSize.y = std::min(project.builtinSize.y, 20.0);
  project.outlineOffset = std::min(project.outlineOffset, 5.0);
  project.print.rim = std::min(project.print.rim, 3);
  project.pictures.corrections = 1;
  project.toolpath.spacing = 1;
  project.printer.nozzle = 0.8;
  project.print.layerHeight = 0.3;
  project.print.base = 1;
  project.printer.screenSizes.clear();
  return project;
}

Result<InputFile> fileOf(const std::string& name) {
  if (name == "picture") {
    Image image{4, 3, 2, {}};
    for (std::size_t k = 0; k < 24; ++k) image.samples.push_back(static_cast<std::uint16_t>(k * 40503));
    return InputFile(image);
  }
  if (name == "drawing.svg") {
    return InputFile(
        "<svg xmlns='http://www.w3.org/2000/svg' width='12mm' height='9mm' viewBox='0 0 12 9'>"
        "<path d='M1 1h9v6h-3l-4 1zM3 3h3v2h-3z' fill-rule='evenodd'/></svg>");
  }
  return Error{ErrorCode::InvalidFile, "there is no file \"" + name + "\""};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const Project project = projectFrom(bytes);
  const ReadInput read = [](const std::string& name, const std::string& /*what*/) { return fileOf(name); };
  const RunContext run(1);
  PlateOptions options;
  options.measure = false;
  auto plate = makePlate(project, read, options, run);
  if (!plate) {
    require(!plate.error().message.empty());
    return 0;
  }
  const PlateInput& input = plate.value().input;
  const std::vector<PlacedLayer>& all = plate.value().composition.layers.placed;
  require(all.size() == project.layers.size());
  for (std::size_t k = 0; k < project.layers.size(); ++k) {
    const PlacedLayer& placed = all[k];
    const bool ground = &project.layers[k] == groundOf(project.layers);
    const bool drawn = project.layers[k].visible && !placed.problem && !ground;
    require(std::isfinite(placed.at.x) && std::isfinite(placed.at.y));
    require(!drawn || (placed.size.x > 0 && placed.size.y > 0));
    require(placed.thin >= 0 && placed.thin <= 1);
  }
  const auto texels =
      static_cast<std::size_t>(input.directions.width) * static_cast<std::size_t>(input.directions.height);
  require(texels > 0 && input.directions.angle.size() == texels);

  std::string text;
  const auto sink = [&](std::string_view piece) {
    text += piece;
    return true;
  };
  if (const auto error = writePlateGcode(plate.value(), {}, sink, run)) {
    require(!error->message.empty());
    return 0;
  }
  require(checkGcode(text, project.printer).errors() == 0);
  return 0;
}
