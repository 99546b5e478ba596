#include "gcode/blocks.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/lines.hpp"
#include "base/numbers.hpp"
#include "base/refused.hpp"
#include "gcode_reader/parser.hpp"

namespace sillon {
namespace {

// Replaces tabs and carriage returns by blanks, and all other characters beyond printable ASCII by question marks.
std::string printable(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (c == '\t' || c == '\r') c = ' ';
    if (c < ' ' || c > '~') c = '?';
  }
  return out;
}

// The expansion of one block, character by character.
class Expansion {
 public:
  Expansion(std::string_view text, const std::vector<TemplateValue>& values, std::string_view block)
      : text_(text), values_(values), block_(block) {
    // The variable e_retracted holds one length for each of up to 16 tools; this program prints with the first tool
    // only.
    own_.push_back({{"e_retracted"}, std::vector<std::string>(16, "0"), false});
  }

  Result<std::string> all() {
    while (at_ < text_.size() && !error_) next();
    if (!error_ && !branches_.empty()) refuse(branches_.back().begin, "NoEndif");
    if (error_) return *error_;
    // A block that leaves the filament drawn back sets e_retracted, so that its slicer pushes it forward again. The
    // print begins primed, so the filament is pushed forward here. F1500 moves it at 25 mm/s.
    if (const std::string& pulled = own_[0].values[0]; pulled != "0") out_ += "\nG92 E0\nG1 E" + pulled + " F1500";
    return std::move(out_);
  }

 private:
  // An {if} that is open.
  struct Branch {
    std::size_t begin;
    bool shown;  ///< the current branch is shown
    bool done;   ///< a branch was shown already, or none can be
  };

  [[nodiscard]] bool shown() const { return branches_.empty() || branches_.back().shown; }

  void next() {
    const char c = text_[at_];
    if (c == '{') return braces();
    if (shown() && (c == '[' || (c == '<' && !comment_))) return brackets(c == '[' ? ']' : '>');
    copy();
  }

  // Copies the next character. Hidden branches keep their line breaks only.
  void copy() {
    if (shown() || text_[at_] == '\n') put(text_.substr(at_, 1));
    ++at_;
  }

  // Puts text out, and notes whether a comment goes on behind it. Hidden comments do not count, because text behind
  // them that is shown is a command.
  void put(std::string_view text) {
    out_ += text;
    if (const std::size_t last = text.find_last_of(";\n"); last != npos) comment_ = text[last] == ';';
  }

  // Handles a bracket that stands for no value: it is kept in a comment, skipped in a hidden branch, and an error
  // elsewhere.
  void leave() { shown() && !comment_ ? refuse(at_, "NoValue") : copy(); }

  // Expands [name] or <NAME>; "[name[0]]" ends at the second bracket.
  void brackets(char close) {
    std::size_t end = text_.find_first_of(std::string{close, '\n'}, at_ + 1);
    if (close == ']' && end != npos && text_.substr(at_ + 1, end - at_ - 1).find('[') != npos) {
      end = text_.find_first_of("]\n", end + 1);
    }
    end = std::min(end, text_.size());
    const bool closed = end < text_.size() && text_[end] == close;
    const auto value = closed ? evaluated(text_.substr(at_ + 1, end - at_ - 1), values_) : std::nullopt;
    if (!value) return leave();
    put(*value);
    at_ = end + 1;
  }

  // Expands {...}: statements between semicolons, and branches; one pair of braces may hold several. Once one of them
  // has been run, a fault behind it is refused even in a comment, because the braces can no longer be kept as they
  // were.
  void braces() {
    std::string_view rest = text_.substr(at_ + 1);
    if (rest.starts_with('}')) return leave();
    for (bool run = false;;) {
      const auto fault = [&] { run ? refuse(at_, "NoValue") : leave(); };
      rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n;"), rest.size()));
      if (rest.empty()) return fault();
      if (rest[0] == '}') break;
      const std::string_view head = branchWord(rest);
      rest.remove_prefix(head.size());
      if (!head.empty()) {
        branch(head, rest);
        if (error_) return;
        run = true;
      } else if (!shown()) {
        skip(rest);
      } else {
        const std::optional<std::string> value = statement(rest, values_, own_);
        run = run || (value && value->empty());  // an assignment
        if (!value || rest.empty() || !ends(rest)) return fault();
        put(*value);
        run = true;
      }
    }
    const std::size_t end = text_.size() - rest.size();
    for (; at_ <= end; ++at_) {
      if (text_[at_] == '\n') put("\n");  // line breaks stay, so that lines keep their numbers
    }
  }

  // Returns the branch keyword that a text begins with; empty if there is none.
  static std::string_view branchWord(std::string_view text) {
    const std::size_t size = std::min(text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789"), text.size());
    const std::string_view word = text.substr(0, size);
    const bool known = word == "if" || word == "then" || word == "elsif" || word == "else" || word == "endif";
    return known ? word : std::string_view();
  }

  // Tells whether a statement can end before this text.
  static bool ends(std::string_view text) {
    return text.empty() || text[0] == '}' || text[0] == ';' || !branchWord(text).empty();
  }

  // Skips a statement that is not run, up to the next statement or branch. Quoted texts and patterns may hold anything.
  static void skip(std::string_view& rest) {
    for (char before = ' '; !ends(rest);) {
      const char c = rest[0];
      std::size_t size = 1;
      if (c == '"' || (c == '/' && (before == '~' || before == ','))) {
        while (size < rest.size() && rest[size] != c) size += rest[size] == '\\' ? 2 : 1;
        ++size;
      } else if (c >= 'a' && c <= 'z') {
        size = rest.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789");
      }
      if (c > ' ') before = c;
      rest.remove_prefix(std::min(size, rest.size()));
    }
  }

  // Handles a branch keyword: if, then, elsif, else or endif.
  void branch(std::string_view head, std::string_view& rest) {
    if (head == "then") return;
    if (head == "if") {
      const bool around = shown();
      branches_.push_back({at_, false, !around});
      around ? choose(rest) : skip(rest);
      return;
    }
    if (branches_.empty()) return refuse(at_, "NoIf");
    Branch& now = branches_.back();
    if (head == "endif") {
      branches_.pop_back();
    } else if (now.done) {
      now.shown = false;
      if (head == "elsif") skip(rest);
    } else if (head == "else") {
      now.shown = now.done = true;
    } else {
      choose(rest);
    }
  }

  // Evaluates the condition of an if or elsif, and shows its branch if it holds.
  void choose(std::string_view& rest) {
    const std::optional<std::string> value = statement(rest, values_, own_);
    const bool yes = value == "true" || value == "1";
    if ((!yes && value != "false" && value != "0") || !ends(rest)) {
      return refuse(at_, "NotEvaluated");
    }
    branches_.back().shown = branches_.back().done = yes;
  }

  // Sets the error, with the line and the text that begins at `begin`.
  void refuse(std::size_t begin, Reason why) {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(begin), '\n');
    std::string_view whole = text_.substr(begin, text_.find_first_of("}]>\n", begin) - begin);
    if (begin + whole.size() < text_.size() && text_[begin + whole.size()] != '\n') {
      whole = text_.substr(begin, whole.size() + 1);
    }
    error_ = refusedArgument(why, {{"block", block_}, {"text", printable(whole.substr(0, 60))}, {"line", line}});
  }

  static constexpr std::size_t npos = std::string_view::npos;

  std::string_view text_;
  const std::vector<TemplateValue>& values_;
  std::string_view block_;
  std::size_t at_ = 0;
  bool comment_ = false;
  std::vector<Branch> branches_;
  std::vector<TemplateValue> own_;  // e_retracted, and the variables that the block sets: {local ...}
  std::string out_;
  std::optional<Error> error_;
};

}  // namespace

std::vector<TemplateValue> templateValues(const Printer& printer, const PrintParams& params, const Bounds& beads) {
  // A trailing false marks a value that is no integer, so that divisions of it keep their fraction.
  const auto pair = [](Vec2 v) { return std::vector<std::string>{fixed(v.x, 3), fixed(v.y, 3)}; };
  const auto whole = [](double value) { return std::vector<std::string>{fixed(value, 0)}; };
  const auto number = [](double value) { return std::vector<std::string>{decimal(value, 3)}; };
  const int layers = layerCount(params);
  std::vector<std::string> used(16, "false");  // one per tool
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
      {{"zhop"}, {"0"}, false},  // no lift at the beginning of a block
      {{"filament_max_volumetric_speed"}, number(printer.maxFlow), false},
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
    line.resize(line.find_last_not_of(" \t") + 1);  // npos + 1 is 0, for a line of blanks only
    // A faulty line stays as it was written, because printable() would hide its fault.
    lines.append(spellingFault(line) == nullptr ? printable(line) : line) += '\n';
  }
  while (lines.size() > 1 && lines.ends_with("\n\n")) lines.pop_back();
  return lines == "\n" ? std::string() : lines;
}

}  // namespace sillon
