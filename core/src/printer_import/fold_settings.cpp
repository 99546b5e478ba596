#include "printer_import/slicer_files.hpp"

#include <algorithm>
#include <utility>

#include "base/numbers.hpp"
#include "gcode_reader/parser.hpp"

namespace sillon {
namespace {

constexpr int kMostNested = 4;                            // depth of blocks within blocks, at most
constexpr std::size_t kMostBytes = std::size_t{1} << 18;  // bytes that a block may grow to
constexpr int kMostBlocks = 200;                          // blocks that are put into one, at most
constexpr std::size_t npos = std::string_view::npos;

bool isName(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; }

// PrusaSlicer's defaults for settings that blocks ask for and a file may leave out. Chambers are not heated, since a
// printer's settings alone do not tell their temperature.
constexpr std::pair<std::string_view, std::string_view> kDefaults[] = {
    {"chamber_temperature", "0"},
    {"overall_chamber_temperature", "0"},
    {"chamber_temperatures", "0"},
    {"activate_chamber_temp_control", "0"},
    {"chamber_minimal_temperature", "0"},
    {"filament_abrasive", "0"},
    {"nozzle_high_flow", "0"},
    {"filament_multitool_ramming", "0"},
    {"idle_temperature", "nil"},
    {"standby_temperature_delta", "-5"},
    {"retract_length_toolchange", "10"},
    {"parking_pos_retraction", "92"},
    {"extra_loading_move", "-2"},
    {"max_fan_speed", "100"},
    {"filament_notes", ""},
    {"printer_notes", ""},
    {"filament_settings_id", ""},
    {"printer_settings_id", ""},
    {"physical_printer_preset", ""},
    {"printer_preset", ""},
    {"start_filament_gcode", ""},
    {"end_filament_gcode", ""},
};

// Replaces all occurrences of a text, until the result is too long.
void replaceAll(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != npos && text.size() < kMostBytes; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
}

// Value of a setting as a literal of an expression; empty: it cannot be one.
std::string literalOf(std::string_view name, const std::string& value) {
  double number = 0;
  if (value == "nil") return value;
  if (!value.empty() && readNumber(value, number) == value.size()) {
    const bool whole =
        value.find('.') != std::string::npos || name.find("temperature") != npos || value == "0" || value == "1";
    return whole ? value : value + ".0";
  }
  if (value.find_first_of("\"\\") != std::string::npos || value.ends_with('%')) return {};
  std::string text = "\"";
  text += value;
  std::replace(text.begin(), text.end(), '\n', ' ');  // notes, which expressions only search for words
  text += '"';
  return text;
}

// Replaces Orca's names for the mesh below a plate with expressions of the plate: the mesh covers the plate and a
// margin around it, within the reach of the probe. Bicubic interpolation needs at least four points a side.
std::string withMesh(std::string_view block, const SlicerSettings& settings) {
  const auto number = [&](const char* key, std::size_t index, double otherwise) {
    const auto found = settings.find(key);
    if (found == settings.end()) return otherwise;
    std::string text = found->second;
    std::replace(text.begin(), text.end(), 'x', ',');  // points are written as 0x0
    return firstNumber(itemOf(text, index)).value_or(otherwise);
  };
  constexpr double kFar = 99999;  // no limit, as Orca writes it
  constexpr double kMargin = 5;   // [mm], if the file states none
  std::string out(block);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::string index = axis == 0 ? "[0]" : "[1]";
    const std::string margin = decimal(number("adaptive_bed_mesh_margin", 0, kMargin), 3);
    const std::string low = decimal(number("bed_mesh_min", axis, -kFar), 3);
    const std::string high = decimal(number("bed_mesh_max", axis, kFar), 3);
    const std::pair<std::string, std::string> words[] = {
        {"adaptive_bed_mesh_min" + index,
         "max(max(first_layer_print_min" + index + " - " + margin + ", " + low + "), print_bed_min" + index + ")"},
        {"adaptive_bed_mesh_max" + index,
         "min(min(first_layer_print_max" + index + " + " + margin + ", " + high + "), print_bed_max" + index + ")"},
        {"bed_mesh_probe_count" + index, "(first_layer_print_size" + index + " > 150 ? 6 : 4)"},
    };
    for (const auto& [name, expression] : words) replaceAll(out, name, expression);
  }
  replaceAll(out, "[bed_mesh_algo]", "bicubic");
  replaceAll(out, "{bed_mesh_algo}", "bicubic");
  return out;
}

// Puts settings, and the blocks among them, into a block.
class Folding {
 public:
  Folding(const SlicerSettings& settings, const std::vector<TemplateValue>& job) : settings_(settings), job_(job) {}

  // The block with values in the place of names. \param depth  number of blocks that it lies within.
  std::string folded(std::string_view block, int depth) {
    std::string out;
    while (!block.empty() && out.size() < kMostBytes) {
      const std::size_t open = block.find_first_of("{[");
      out += block.substr(0, open);
      if (open == npos) break;
      block.remove_prefix(open);
      const bool braces = block[0] == '{';
      std::size_t close = block.find_first_of(braces ? "}" : "]\n");
      if (!braces && close != npos && block.substr(1, close - 1).find('[') != npos) {
        close = block.find_first_of("]\n", close + 1);
      }
      if (close == npos || block[close] == '\n') {
        out += block[0];
        block.remove_prefix(1);
        continue;
      }
      const std::string_view inside = block.substr(1, close - 1);
      const std::string_view whole = block.substr(0, close + 1);
      block.remove_prefix(close + 1);
      std::string_view rest = trimmed(inside);
      const std::optional<std::string> alone = valueAt(rest);
      if (alone && rest.empty() && *alone != "nil") {
        out += depth < kMostNested && ++blocks_ < kMostBlocks ? folded(*alone, depth + 1) : *alone;
      } else if (braces) {
        out.append("{").append(expression(inside)).append("}");
      } else {
        out += whole;
      }
    }
    return out;
  }

 private:
  // Value of the setting that the text begins with; takes its name and index off the text. Nothing if the name is not
  // known, or the job has a value for it.
  [[nodiscard]] std::optional<std::string> valueAt(std::string_view& text) const {
    std::size_t size = 0;
    while (size < text.size() && isName(text[size])) ++size;
    const std::string_view name = text.substr(0, size);
    if (name.empty() || templateValue(name, 0, job_)) return std::nullopt;
    const auto told = settings_.find(name);
    const auto* const known = std::find_if(std::begin(kDefaults), std::end(kDefaults),
                                           [&](const auto& entry) { return entry.first == name; });
    if (told == settings_.end() && known == std::end(kDefaults)) return std::nullopt;
    const std::string_view value = told != settings_.end() ? std::string_view(told->second) : known->second;
    std::string_view rest = text.substr(size);
    std::size_t index = 0;
    if (rest.starts_with('[')) {
      const std::size_t close = rest.find(']');
      const std::string_view inside = trimmed(rest.substr(1, close == npos ? npos : close - 1));
      const auto first = templateValue(inside, 0, job_);  // such as initial_tool
      double number = 0;
      if (close == npos || (readNumber(inside, number) != inside.size() && !(first && first->text == "0"))) {
        return std::nullopt;
      }
      index = toSize(std::clamp(number, 0.0, 100.0));
      rest.remove_prefix(close + 1);
    }
    text = rest;
    return name.ends_with("gcode") ? unescaped(value) : itemOf(value, index);
  }

  // The expression with literals in the place of its settings.
  [[nodiscard]] std::string expression(std::string_view inside) const {
    std::string out;
    while (!inside.empty()) {
      const char c = inside[0];
      std::size_t size = 1;
      if (c == '"' || (c == '/' && out.find_last_not_of(' ') != npos && out[out.find_last_not_of(' ')] == '~')) {
        size = std::min(inside.find(c, 1), inside.size() - 1) + 1;  // skips a text or a pattern
      } else if (isName(c)) {
        while (size < inside.size() && isName(inside[size])) ++size;
        const std::string_view name = inside.substr(0, size);
        std::string_view rest = inside;
        const std::optional<std::string> value = valueAt(rest);
        const std::string literal = value ? literalOf(name, *value) : std::string();
        if (!literal.empty()) {
          out += literal;
          inside = rest;
          continue;
        }
      }
      out += inside.substr(0, size);
      inside.remove_prefix(size);
    }
    return out;
  }

  const SlicerSettings& settings_;
  const std::vector<TemplateValue>& job_;
  int blocks_ = 0;  // blocks that were put in
};

}  // namespace

std::string withSettings(std::string_view block, const SlicerSettings& settings,
                         const std::vector<TemplateValue>& job) {
  return Folding(settings, job).folded(withMesh(block, settings), 0);
}

}  // namespace sillon
