#include "gcode/blocks.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/lines.hpp"
#include "base/numbers.hpp"
#include "gcode/job.hpp"
#include "gcode_reader/parser.hpp"

namespace sillon {
namespace {

std::string printable(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (c == '\t' || c == '\r') c = ' ';
    if (c < ' ' || c > '~') c = '?';
  }
  return out;
}

class Expansion {
 public:
  Expansion(std::string_view text, const std::vector<TemplateValue>& values, std::string_view block)
      : text_(text), values_(values), block_(block) {}

  Result<std::string> all() {
    while (at_ < text_.size() && !error_) next();
    if (!error_ && !branches_.empty()) refuse(branches_.back().begin, "has no {endif}");
    if (error_) return *error_;
    return std::move(out_);
  }

 private:
  // An {if}.
  struct Branch {
    std::size_t begin;
    bool shown;  ///< this part of it
    bool done;   ///< one of its parts was shown, or none can be
  };

  [[nodiscard]] bool shown() const { return branches_.empty() || branches_.back().shown; }

  void next() {
    const char c = text_[at_];
    if (c == '\n') comment_ = false;
    if (c == ';') comment_ = true;
    if (c == '{') return braces();
    if (c == '[' || (c == '<' && !comment_)) return brackets(c == '[' ? ']' : '>');
    if (shown() || c == '\n') out_ += c;
    ++at_;
  }

  void put(std::string_view value) {
    if (shown()) out_ += value;
  }

  // What stands for no value: as it is in a comment, and an error elsewhere.
  void leave(std::size_t end) {
    if (!shown()) {
      at_ = end;
    } else if (comment_) {
      out_ += text_[at_++];
    } else {
      refuse(at_, "stands for no value here; put the value itself there");
    }
  }

  // "[name[0]]" ends at the second bracket.
  void brackets(char close) {
    std::size_t end = text_.find_first_of(std::string{close, '\n'}, at_ + 1);
    if (close == ']' && end != npos && text_.substr(at_ + 1, end - at_ - 1).find('[') != npos) {
      end = text_.find_first_of("]\n", end + 1);
    }
    end = std::min(end, text_.size());
    const bool closed = end < text_.size() && text_[end] == close;
    const auto value = closed ? evaluated(text_.substr(at_ + 1, end - at_ - 1), values_) : std::nullopt;
    if (!value) return leave(end + (closed ? 1 : 0));
    put(*value);
    at_ = end + 1;
  }

  void braces() {
    std::size_t end = at_ + 1;
    for (bool quoted = false; end < text_.size() && (quoted || text_[end] != '}'); ++end) {
      if (text_[end] == '"') quoted = !quoted;
    }
    if (end == text_.size()) {
      if (comment_) return leave(at_ + 1);
      return refuse(at_, "stands for no value here; put the value itself there");
    }
    const std::string_view inside = trimmed(text_.substr(at_ + 1, end - at_ - 1));
    const std::size_t word = std::min(inside.find_first_not_of("abcdefghijklmnopqrstuvwxyz"), inside.size());
    const std::string_view head = inside.substr(0, word);
    if (head == "if" || head == "elsif" || head == "else" || head == "endif") {
      branch(head, inside.substr(word));
    } else {
      const std::optional<std::string> value = shown() ? evaluated(inside, values_) : std::string();
      if (!value) return leave(end + 1);
      put(*value);
    }
    if (error_) return;
    for (; at_ <= end; ++at_) {
      if (text_[at_] == '\n') out_ += '\n';  // so that lines keep their numbers
    }
  }

  void branch(std::string_view head, std::string_view condition) {
    if (head == "if") {
      const bool around = shown();
      branches_.push_back({at_, false, !around});
      if (around) choose(condition);
      return;
    }
    if (branches_.empty()) return refuse(at_, "has no {if} before it");
    Branch& now = branches_.back();
    if (head == "endif") {
      branches_.pop_back();
    } else if (now.done) {
      now.shown = false;
    } else if (head == "else") {
      now.shown = now.done = true;
    } else {
      choose(condition);
    }
  }

  void choose(std::string_view condition) {
    const std::optional<std::string> value = evaluated(condition, values_);
    const bool yes = value == "true" || value == "1";
    if (!yes && value != "false" && value != "0") {
      return refuse(at_, "cannot be evaluated here; keep only the branch that applies");
    }
    branches_.back().shown = branches_.back().done = yes;
  }

  void refuse(std::size_t begin, const char* why) {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(begin), '\n');
    std::string_view whole = text_.substr(begin, text_.find_first_of("}]>\n", begin) - begin);
    if (begin + whole.size() < text_.size() && text_[begin + whole.size()] != '\n') {
      whole = text_.substr(begin, whole.size() + 1);
    }
    error_ = Error{ErrorCode::InvalidArgument, std::string(block_) + " has \"" + printable(whole.substr(0, 60)) +
                                                   "\" in line " + std::to_string(line) + ", which " + why};
  }

  static constexpr std::size_t npos = std::string_view::npos;

  std::string_view text_;
  const std::vector<TemplateValue>& values_;
  std::string_view block_;
  std::size_t at_ = 0;
  bool comment_ = false;
  std::vector<Branch> branches_;
  std::string out_;
  std::optional<Error> error_;
};

}  // namespace

std::vector<TemplateValue> templateValues(const Printer& printer, const PrintParams& params, const Bounds& beads) {
  const auto pair = [](Vec2 v) { return std::vector<std::string>{fixed(v.x, 3), fixed(v.y, 3)}; };
  const auto whole = [](double value) { return std::vector<std::string>{fixed(value, 0)}; };
  const auto number = [](double value) { return std::vector<std::string>{decimal(value, 3)}; };
  const int layers = layerCount(params);
  std::vector<std::string> used(16, "false");  // by tool
  used[0] = "true";
  return {
      {{"first_layer_temperature", "nozzle_temperature_initial_layer", "material_print_temperature_layer_0",
        "TOOLTEMP"},
       whole(printer.firstLayerNozzleTemperature)},
      {{"temperature", "nozzle_temperature", "material_print_temperature"}, whole(printer.nozzleTemperature)},
      {{"first_layer_bed_temperature", "bed_temperature", "bed_temperature_initial_layer",
        "bed_temperature_initial_layer_single", "hot_plate_temp_initial_layer", "material_bed_temperature",
        "material_bed_temperature_layer_0", "HBPTEMP"},
       whole(printer.bedTemperature)},
      {{"first_layer_print_min"}, pair(beads.min), false},
      {{"first_layer_print_max"}, pair(beads.max), false},
      {{"first_layer_print_size"}, pair(beads.size()), false},
      {{"layer_height"}, number(params.layerHeight), false},
      {{"first_layer_height", "initial_layer_print_height", "layer_height_0"}, number(firstLayerHeight(params)), false},
      {{"max_layer_z", "layer_z"}, number(layerTop(params, layers - 1)), false},
      {{"total_layer_count"}, whole(layers)},
      {{"nozzle_diameter", "machine_nozzle_size"}, number(printer.nozzle), false},
      {{"filament_diameter", "material_diameter"}, number(printer.filamentDiameter), false},
      {{"filament_type", "material_type"}, {printer.filamentType}},
      {{"initial_tool", "initial_extruder", "current_extruder", "initial_no_support_extruder"}, {"0"}},
      {{"num_extruders"}, {"1"}},
      {{"is_extruder_used"}, used},
      {{"total_toolchanges"}, {"0"}},
      {{"has_wipe_tower", "has_single_extruder_multi_material_priming"}, {"false"}},
      {{"print_settings_id", "print_preset"}, {""}},
      {{"input_filename", "input_filename_base"}, {"plate"}},
      {{"max_print_height", "printable_height"}, number(printer.maxZ), false},
      {{"print_bed_min"}, pair(printer.bedMin), false},
      {{"print_bed_max"}, pair(printer.bedMax), false},
      {{"print_bed_size"}, pair(printer.bedMax - printer.bedMin), false},
      {{"travel_speed"}, number(printer.travelSpeed), false},
      {{"z_offset"}, number(printer.zOffset), false},
  };
}

Result<std::string> expandTemplate(std::string_view text, const std::vector<TemplateValue>& values,
                                   std::string_view block) {
  Result<std::string> out = Expansion(text, values, block).all();
  if (!out) return out;
  std::string lines;
  for (std::string_view rest = out.value(); !rest.empty();) {
    std::string line(nextLine(rest));
    std::replace(line.begin(), line.end(), '\r', ' ');
    line.resize(line.find_last_not_of(" \t") + 1);  // npos + 1 is 0
    // A faulty line stays as it was written: printable() would hide what is wrong with it.
    lines.append(spellingFault(line) == nullptr ? printable(line) : line) += '\n';
  }
  while (lines.size() > 1 && lines.ends_with("\n\n")) lines.pop_back();
  return lines == "\n" ? std::string() : lines;
}

}  // namespace sillon
