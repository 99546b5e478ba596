// What slicers reckon in their start and end blocks: {first_layer_temperature[0] - 60}, {if max_layer_z < 100}.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sillon {

/// A placeholder's names, one per program that people know them from, and its values: {name} is the first, {name[k]}
/// the k-th.
struct TemplateValue {
  std::vector<std::string_view> names;
  std::vector<std::string> values;
  bool whole = true;  ///< counts, temperatures: where no point is written, two of them are divided without a rest
};

/// The value of `name`, `name[k]` or `name_k`, and whether it is a whole one.
struct FoundValue {
  std::string text;
  bool whole = true;
};
/// \return nothing: there is none.
std::optional<FoundValue> templateValue(std::string_view name, std::size_t index,
                                        const std::vector<TemplateValue>& values);

/// The value of an expression as PrusaSlicer, OrcaSlicer and Bambu Studio write them: numbers, "texts", names with and
/// without an index, + - * / %, comparisons, =~ with a literal text between .* and .*, and, or, not, a ? b : c, min,
/// max, round, int, digits, zdigits, random (the least). Nothing: a name that has no value here, or what is no
/// expression.
std::optional<std::string> evaluated(std::string_view expression, const std::vector<TemplateValue>& values);

}  // namespace sillon
