#include "gcode/template.hpp"

#include <algorithm>

#include "base/decimal_text.hpp"
#include "base/lines.hpp"
#include "gcode/job.hpp"

namespace sillon {
namespace {

char closing(char opening) { return opening == '{' ? '}' : opening == '[' ? ']' : '>'; }

// The value of "name" or "name[k]"; null if there is none.
const std::string* find(std::string_view word, const std::vector<TemplateValue>& values) {
  std::size_t index = 0;
  if (word.size() > 3 && word.back() == ']' && word[word.size() - 3] == '[') {
    const char digit = word[word.size() - 2];
    if (digit < '0' || digit > '9') return nullptr;
    index = static_cast<std::size_t>(digit - '0');
    word.remove_suffix(3);
  }
  for (const TemplateValue& value : values) {
    if (std::find(value.names.begin(), value.names.end(), word) == value.names.end()) continue;
    return index < value.values.size() ? &value.values[index] : nullptr;
  }
  return nullptr;
}

// The end of the placeholder that opens at `begin`, its bracket included; npos if it stays open.
std::size_t endOf(std::string_view line, std::size_t begin) {
  const char close = closing(line[begin]);
  std::size_t end = line.find(close, begin + 1);
  // "[name[0]]" ends at the second bracket.
  if (close == ']' && end != std::string_view::npos &&
      line.substr(begin + 1, end - begin - 1).find('[') != std::string_view::npos) {
    end = line.find(close, end + 1);
  }
  return end == std::string_view::npos ? end : end + 1;
}

std::string printable(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (c == '\t' || c == '\r') c = ' ';
    if (c < ' ' || c > '~') c = '?';
  }
  return out;
}

}  // namespace

std::vector<TemplateValue> templateValues(const Printer& printer, const PrintParams& params, const Bounds& beads) {
  const auto pair = [](Vec2 v) { return std::vector<std::string>{fixed(v.x, 3), fixed(v.y, 3)}; };
  const auto whole = [](double value) { return std::vector<std::string>{fixed(value, 0)}; };
  const auto number = [](double value) { return std::vector<std::string>{decimal(value, 3)}; };
  const int layers = layerCount(params);
  return {
      {{"first_layer_temperature", "nozzle_temperature_initial_layer", "material_print_temperature_layer_0",
        "TOOLTEMP"},
       whole(printer.firstLayerNozzleTemperature)},
      {{"temperature", "nozzle_temperature", "material_print_temperature"}, whole(printer.nozzleTemperature)},
      {{"first_layer_bed_temperature", "bed_temperature", "bed_temperature_initial_layer",
        "bed_temperature_initial_layer_single", "hot_plate_temp_initial_layer", "material_bed_temperature",
        "material_bed_temperature_layer_0", "HBPTEMP"},
       whole(printer.bedTemperature)},
      {{"first_layer_print_min"}, pair(beads.min)},
      {{"first_layer_print_max"}, pair(beads.max)},
      {{"first_layer_print_size"}, pair(beads.size())},
      {{"layer_height"}, number(params.layerHeight)},
      {{"first_layer_height", "initial_layer_print_height", "layer_height_0"}, number(firstLayerHeight(params))},
      {{"max_layer_z"}, number(layerTop(params, layers - 1))},
      {{"total_layer_count"}, whole(layers)},
      {{"nozzle_diameter", "machine_nozzle_size"}, number(printer.nozzle)},
      {{"filament_diameter", "material_diameter"}, number(printer.filamentDiameter)},
      {{"filament_type", "material_type"}, {printer.filamentType}},
      {{"initial_tool", "initial_extruder", "current_extruder"}, {"0"}},
  };
}

Result<std::string> expandTemplate(std::string_view text, const std::vector<TemplateValue>& values,
                                   std::string_view block) {
  std::string out;
  int number = 0;
  while (!text.empty()) {
    const std::string_view whole = nextLine(text);
    const std::string_view line = trimmed(whole);
    // RepRapFirmware tells by the indentation what belongs to an "if".
    const std::string_view indentation = whole.substr(0, std::min(whole.find_first_not_of(" \t"), whole.size()));
    ++number;
    const std::size_t comment = std::min(line.find(';'), line.size());
    std::string_view code = line.substr(0, comment);
    std::string written(line.empty() ? std::string_view{} : indentation);
    for (;;) {
      const std::size_t open = code.find_first_of("{[<");
      written += code.substr(0, open);
      if (open == std::string_view::npos) break;
      const std::size_t end = endOf(code, open);
      const std::string_view placeholder = code.substr(open, end == std::string_view::npos ? end : end - open);
      const std::string* value = end == std::string_view::npos
                                     ? nullptr
                                     : find(trimmed(placeholder.substr(1, placeholder.size() - 2)), values);
      if (value == nullptr) {
        return Error{ErrorCode::InvalidArgument, std::string(block) + " has \"" + printable(placeholder.substr(0, 60)) +
                                                     "\" in line " + std::to_string(number) +
                                                     ", which stands for no value here; put the value itself there"};
      }
      written += *value;
      code.remove_prefix(end);
    }
    written += line.substr(comment);
    out += printable(written) + "\n";
  }
  while (out.size() > 1 && out.ends_with("\n\n")) out.pop_back();
  return out == "\n" ? std::string() : out;
}

}  // namespace sillon
