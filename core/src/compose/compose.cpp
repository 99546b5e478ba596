#include "sillon/compose/compose.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string_view>
#include <utility>

#include "base/exact_math.hpp"
#include "compose/background.hpp"
#include "compose/content.hpp"
#include "compose/ink.hpp"
#include "compose/placement.hpp"
#include "compose/redraw.hpp"
#include "compose/region.hpp"
#include "compose/visible.hpp"
#include "geometry/shape_points.hpp"
#include "input/stored_angle.hpp"
#include "pictures/parts.hpp"
#include "report/told.hpp"

namespace sillon {
namespace {

/// Adds the layer's number to an error: the message counts from 0, as in the project file, and the value from 1.
Error ofLayer(std::size_t number, const Error& error) {
  if (error.code == ErrorCode::Cancelled) return error;
  Error told = error;
  told.message = "layers[" + std::to_string(number) + "]: " + error.message;
  told.values.insert(told.values.begin(), {"layer", static_cast<double>(number + 1)});
  return told;
}

/// Content and place of a layer that has been read.
struct ReadLayer {
  LayerContent content;
  Placement place;
};

Result<ReadLayer> readLayer(const Project& project, std::size_t number, const Shape& shape, const ReadInput& read) {
  const Layer& layer = project.layers[number];
  Result<LayerContent> content = readContent(layer, shape.page, number == 0, read);
  if (!content) return content.error();
  const Placement place(layer, layer.at.value_or(shape.page * 0.5), content.value().size);
  return ReadLayer{std::move(content).value(), place};
}

/// Collects the facts about a placed layer.
/// \param spacing  spacing of the beads, by which letters are tested for thin places; 0 skips the test when a stack is
/// redrawn, because redrawLayers keeps the earlier result.
PlacedLayer placedLayer(const Layer& told, const ReadLayer& layer, double spacing) {
  PlacedLayer placed{layer.place.middle(), layer.place.size(), 0, {}, {}};
  const auto tell = [&](DrawingFacts facts) {
    placed.lacked.insert(placed.lacked.end(), facts.lacked.begin(), facts.lacked.end());
    facts.lacked.clear();  // reported separately, in placed.lacked
    placed.drawings.push_back(std::move(facts));
  };
  const auto withoutColours = [](DrawingFacts facts) {
    facts.severalColours = false;
    return facts;
  };
  if (layer.content.shape) tell(layer.content.shape->drawing);
  if (layer.content.picture) tell(withoutColours(layer.content.painted));  // a picture shows all its colours
  if (layer.content.mask) tell(withoutColours(layer.content.mask->drawing));
  if (spacing > 0 && outlined(told)) {
    Shape shape = *layer.content.shape;
    const Vec2 scale{placed.size.x / shape.page.x, placed.size.y / shape.page.y};
    movePoints(shape, [scale](Vec2 point) { return Vec2{point.x * scale.x, point.y * scale.y}; });
    shape.page = placed.size;
    placed.thin = thinShare(shape, spacing);
  }
  return placed;
}

/// Returns the box of a layer that is not drawn.
PlacedLayer boxOf(const Layer& layer, const Shape& shape, std::optional<Error> problem = {}) {
  return {layer.at.value_or(shape.page * 0.5), layer.size, 0, std::move(problem), {}};
}

bool lacksLetter(const Error& error) {
  const std::string_view why = error.reason;
  return why == "MissingLetter" || why == "PictureLetter";
}

int texelsOn(double side, double spacing) {
  return std::clamp(static_cast<int>(std::ceil(side / spacing * kTexelsPerBead)), 1, kMostTexels);
}

/// Inputs of a stack besides its project.
struct StackRun {
  const ReadInput& read;
  std::optional<Lamp> lamp;  ///< lamp for pictures that name none
  /// Stack whose pictures are solved anew; null: pictures are solved for the first time
  const LayerStack* before = nullptr;
};

/// Reads, places and draws all visible layers above the ground. Layers with letters that no font has are left out.
Result<LayerStack> makeLayers(const Project& project, const Shape& shape, const StackRun& with, const RunContext& run) {
  LayerStack stack;
  const double spacing = project.toolpath.spacing;
  const Layer* const ground = groundOf(project.layers);
  for (std::size_t k = 0; k < project.layers.size(); ++k) {
    const Layer& layer = project.layers[k];
    if (!layer.visible || &layer == ground) {
      stack.placed.push_back(boxOf(layer, shape));
      continue;
    }
    const Result<ReadLayer> known = readLayer(project, k, shape, with.read);
    if (!known && lacksLetter(known.error())) {
      stack.placed.push_back(boxOf(layer, shape, ofLayer(k, known.error())));
      continue;
    }
    if (!known) return ofLayer(k, known.error());
    stack.placed.push_back(placedLayer(layer, known.value(), with.before == nullptr ? spacing : 0));
    if (stack.width == 0) {
      stack.width = texelsOn(shape.page.x, spacing);
      stack.height = texelsOn(shape.page.y, spacing);
      stack.texels.resize(cellCount(stack.width, stack.height));
      markPlate({project, shape, stack.width, stack.height}, stack);
    }
    if (with.before != nullptr && with.before->pictures.contains(k)) stack.pictures[k] = with.before->pictures.at(k);
    const auto& [content, place] = known.value();
    const LayerPlate plate{project, shape, stack.width, stack.height, with.lamp};
    if (auto error = drawLayer(k, content, place, plate, stack, run)) return ofLayer(k, *error);
  }
  return stack;
}

/// Returns the lamp of the ground's pictures, under which pictures of layers show at the same time; nothing if there
/// are none.
std::optional<Lamp> lampOf(const PlatePictures& pictures) {
  return !pictures.shown.empty() ? std::optional(pictures.shown[0].lamp) : std::nullopt;
}

/// Makes warnings about layers that are left out, and about letters that come from other fonts or from none.
std::vector<Warning> letterWarnings(const std::vector<PlacedLayer>& placed) {
  std::vector<Warning> warnings;
  for (std::size_t k = 0; k < placed.size(); ++k) {
    const auto number = static_cast<double>(k + 1);
    if (const auto& problem = placed[k].problem) {
      const bool picture = std::string_view(problem->reason) == "PictureLetter";
      warnings.push_back({picture ? WarningCode::LayerOnlyPicture : WarningCode::LayerLeftOut,
                          {{"layer", number}, {"letter", problem->values.back().text}}});
    }
    std::vector<Warning> more = letterWarnings(placed[k].lacked, k + 1);
    warnings.insert(warnings.end(), more.begin(), more.end());
  }
  return warnings;
}

}  // namespace

Result<Composition> compose(const Project& project, PlateInput ground, const ComposeOptions& options,
                            const RunContext& run) {
  Composition made{std::move(ground), {}, {}};
  auto pictures = solvePictures(project, options.read, made.ground, run, options.kept, options.onTrial);
  if (!pictures) return pictures.error();
  made.pictures = std::move(pictures).value();
  auto layers = makeLayers(project, made.ground.shape, {options.read, lampOf(made.pictures)}, run);
  if (!layers) return layers.error();
  made.layers = std::move(layers).value();
  return made;
}

std::optional<Error> redrawLayers(const Project& project, Composition& made, const ReadInput& read,
                                  const RunContext& run) {
  auto layers = makeLayers(project, made.ground.shape, {read, lampOf(made.pictures), &made.layers}, run);
  if (!layers) return layers.error();
  layers.value().placed = std::move(made.layers.placed);  // keeps the facts about thin letters
  made.layers = std::move(layers).value();
  return std::nullopt;
}

std::vector<PlacedLayer> placeLayers(const Project& project, const Shape& shape, const ReadInput& read) {
  std::vector<PlacedLayer> placed;
  for (std::size_t k = 0; k < project.layers.size(); ++k) {
    const Layer& layer = project.layers[k];
    const Result<ReadLayer> known = readLayer(project, k, shape, read);
    placed.push_back(known ? placedLayer(layer, known.value(), project.toolpath.spacing)
                           : boxOf(layer, shape, ofLayer(k, known.error())));
  }
  return placed;
}

LayersTold toldOf(const std::vector<PlacedLayer>& placed, const std::vector<SeenLayer>& seen, Vec2 page,
                  double spacing) {
  LayersTold told;
  const auto add = [](auto& list, auto more) {
    list.insert(list.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  for (std::size_t k = 0; k < placed.size(); ++k) {
    for (const DrawingFacts& drawing : placed[k].drawings) {
      add(told.notes, layerNotes(drawing, k + 1));
      add(told.warnings, drawingWarnings(drawing, k + 1));
    }
  }
  add(told.warnings, letterWarnings(placed));
  add(told.warnings, layerWarnings(seen, page, spacing));
  return told;
}

PlateInput Composition::laid() const {
  PlateInput input = ground;
  input.showsPictures = input.showsPictures || !layers.pictures.empty();
  if (layers.width == 0) return input;
  const Background background(ground.directions, layers.width, layers.height);
  const auto texels = layers.texels.size();
  DirectionMap directions{layers.width, layers.height, std::vector<std::uint16_t>(texels)};
  ModeMap modes{layers.width, layers.height, std::vector<DirectionMode>(texels)};
  const auto below = [](int k, int from, int to) { return static_cast<int>((k + 0.5) * to / from); };
  for (int y = 0; y < layers.height; ++y) {
    for (int x = 0; x < layers.width; ++x) {
      const auto k = indexOf(x, y, layers.width);
      const LayerStack::Texel& texel = layers.texels[k];
      const int column = below(x, layers.width, ground.modes.width);
      const int row = below(y, layers.height, ground.modes.height);
      modes.mode[k] = texel.mode.value_or(ground.modes.mode[indexOf(column, row, ground.modes.width)]);
      if (texel.cover == 0) {
        directions.angle[k] = background.angleAt(x, y);
        continue;
      }
      // Lines are added as vectors of twice their angle, because a line turned by 180 degrees is the same line.
      Vec2 line = wide(texel.line);
      if (texel.through != 0) {
        const exact::SinCos turn = exact::sinCos(2 * angleOf(background.angleAt(x, y)));
        line = line + Vec2{turn.cos, turn.sin} * static_cast<double>(texel.through);
      }
      directions.angle[k] = storedAngle(exact::atan2(line.y, line.x) / (2 * std::numbers::pi));
    }
  }
  input.directions = std::move(directions);
  input.modes = std::move(modes);
  return input;
}

}  // namespace sillon
