#include "rebrush/blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/numbers.hpp"
#include "gcode_reader/parser.hpp"

namespace sillon {
namespace {

constexpr double kMinute = 60;  // [s]

// Reads a duration such as "1d 2h 3m 4s" [s]; none if the text has anything else.
std::optional<double> durationOf(std::string_view text) {
  double seconds = 0;
  bool any = false;
  while (!(text = trimmed(text)).empty()) {
    double value = 0;
    const std::size_t read = readNumber(text, value);
    if (read == 0 || read >= text.size() || value < 0) return std::nullopt;
    const std::size_t unit = std::string_view("smhd").find(text[read]);
    if (unit == std::string_view::npos) return std::nullopt;
    constexpr std::array<double, 4> kUnits{1, kMinute, 3600, 86400};
    seconds += value * kUnits[unit];
    text.remove_prefix(read + 1);
    any = true;
  }
  return any ? std::optional<double>(seconds) : std::nullopt;
}

// Writes a duration as slicers do: "1d 2h 3m 4s".
std::string durationText(double seconds) {
  const auto all = static_cast<std::int64_t>(std::llround(std::max(0.0, seconds)));
  const std::array<std::int64_t, 4> parts{all / 86400, all / 3600 % 24, all / 60 % 60, all % 60};
  std::string text;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (text.empty() && parts[k] == 0 && k < 3) continue;
    text += (text.empty() ? "" : " ") + std::to_string(parts[k]) + "dhms"[k];
  }
  return text;
}

/// Durations of the whole print in both modes for which slicers estimate it [s]; 0: unknown.
struct Whole {
  double normal = 0;
  double silent = 0;
};

constexpr std::string_view kNormal = "estimated printing time (normal mode) =";
constexpr std::string_view kSilent = "estimated printing time (silent mode) =";

// Reads the durations that a file gives.
Whole wholeOf(std::string_view gcode) {
  Whole whole;
  forEachLine(gcode, [&](const GcodeLine& line) {
    const std::string_view text = trimmed(line.text);
    if (text.starts_with(';')) {
      const std::string_view comment = trimmed(text.substr(1));
      if (comment.starts_with(kNormal)) whole.normal = durationOf(comment.substr(kNormal.size())).value_or(0);
      if (comment.starts_with(kSilent)) whole.silent = durationOf(comment.substr(kSilent.size())).value_or(0);
      const std::size_t total = comment.find("total estimated time:");
      if (total != std::string_view::npos && whole.normal == 0) {
        whole.normal = durationOf(comment.substr(total + 21)).value_or(0);
      }
    }
  });
  return whole;
}

// Adds `more` seconds to the duration behind a key.
void lengthen(std::string& line, std::string_view key, double more) {
  const std::size_t at = line.find(key);
  if (at == std::string::npos) return;
  std::size_t begin = at + key.size();
  while (begin < line.size() && line[begin] == ' ') ++begin;
  const std::size_t end = std::min(line.find_first_of(";\r\n", begin), line.size());
  const auto value = durationOf(std::string_view(line).substr(begin, end - begin));
  if (value) line.replace(begin, end - begin, durationText(*value + more));
}

// Adds `more` to the seconds behind a key with which the line begins; their number of decimals stays.
void lengthenSeconds(std::string& line, std::string_view key, double more) {
  if (!line.starts_with(key)) return;
  double value = 0;
  const std::string_view rest = std::string_view(line).substr(key.size());
  const std::size_t read = readNumber(rest, value);
  if (read == 0) return;
  const std::size_t point = rest.substr(0, read).find('.');
  const int digits = point == std::string_view::npos ? 0 : static_cast<int>(std::min<std::size_t>(read - point - 1, 6));
  line.replace(key.size(), read, fixed(std::max(0.0, value + more), digits));
}

// Goes through the file from its beginning, and rewrites the lines that contain times or progress.
class TimeRewriter {
 public:
  TimeRewriter(const Whole& whole, const std::vector<TimeChange>& changes) : whole_(whole), changes_(changes) {
    for (const TimeChange& change : changes) {
      all_ += change.seconds;
      if (change.firstLayer) first_ += change.seconds;
    }
  }

  /// Finds the lines of a text that change, and their new text. \param offset  place of the text in the file as it was
  /// [bytes]. \param edited  true if the text as a whole replaces the lines at that place.
  std::vector<Edit> changesOf(std::string_view text, std::size_t offset, bool edited) {
    std::vector<Edit> found;
    forEachLine(text, [&](const GcodeLine& line) {
      const std::size_t at = edited ? offset : offset + line.offset;
      for (; next_ < changes_.size() && changes_[next_].at <= at; ++next_) before_ += changes_[next_].seconds;
      if (!line.text.starts_with(';') && !line.text.starts_with("M73 ")) return;
      std::string fresh = changed(line.text);
      if (fresh != line.text) found.push_back({line.offset, line.offset + line.text.size(), std::move(fresh)});
    });
    return found;
  }

 private:
  // Rewrites a line if it contains a time.
  std::string changed(std::string_view line) {
    if (line.starts_with("M73 ")) return progress(line);
    std::string text(line);
    if (text.find("ime") == std::string::npos && text.find("TIME") == std::string::npos) return text;
    lengthen(text, "estimated first layer printing time (normal mode) =", first_);
    lengthen(text, "estimated first layer printing time (silent mode) =", first_);
    lengthen(text, kNormal, all_);
    lengthen(text, kSilent, all_);
    lengthen(text, "model printing time:", all_);
    lengthen(text, "total estimated time:", all_);
    lengthenSeconds(text, ";TIME:", all_);
    lengthenSeconds(text, ";PRINT.TIME:", all_);
    lengthenSeconds(text, ";TIME_ELAPSED:", before_);
    return text;
  }

  // Rewrites an M73. Percent done and minutes left are P and R in normal mode, Q and S in silent mode.
  std::string progress(std::string_view line) {
    std::string fresh;
    const std::size_t code = std::min(line.find(';'), line.size());
    for (std::size_t at = 0; at < line.size();) {
      const char letter = at > 0 && at < code && line[at - 1] == ' ' ? line[at] : ' ';
      double value = 0;
      const std::size_t read =
          std::string_view("PRQS").find(letter) == std::string_view::npos ? 0 : readNumber(line.substr(at + 1), value);
      fresh += line[at++];
      if (read == 0) continue;
      const std::string_view word = line.substr(at, read);
      at += read;
      const bool silent = letter == 'Q' || letter == 'S';
      const double known = silent ? whole_.silent : whole_.normal;
      if (letter == 'R' || letter == 'S') {
        fresh += fixed(std::max(0.0, value + std::round((all_ - before_) / kMinute)), 0);
      } else if (known > 0 && known + all_ > 0) {
        double& floor = least_[silent ? 1 : 0];
        floor = std::clamp(std::round(100 * (value / 100 * known + before_) / (known + all_)), floor, 100.0);
        fresh += fixed(floor, 0);
      } else {
        fresh += word;
      }
    }
    return fresh;
  }

  Whole whole_;
  const std::vector<TimeChange>& changes_;
  double all_ = 0;                     // time that all changes add [s]
  double first_ = 0;                   // time that those in the first layer add [s]
  double before_ = 0;                  // time that the changes before the current line add [s]
  std::size_t next_ = 0;               // index of the first change behind the current line
  std::array<double, 2> least_{0, 0};  // last progress of each mode [%]: progress never goes back
};

}  // namespace

std::int64_t changeTotals(std::string_view gcode, const std::vector<TimeChange>& changes, std::vector<Edit>& edits) {
  if (changes.empty()) return 0;
  TimeRewriter rewriter(wholeOf(gcode), changes);
  std::vector<Edit> out;
  std::int64_t told = 0;
  std::size_t at = 0;
  const auto keep = [&](std::size_t end) {
    for (Edit& edit : rewriter.changesOf(gcode.substr(at, end - at), at, false)) {
      out.push_back({edit.begin + at, edit.end + at, std::move(edit.text)});
      ++told;
    }
  };
  for (Edit& edit : edits) {
    keep(edit.begin);
    const std::vector<Edit> inside = rewriter.changesOf(edit.text, edit.begin, true);
    told += static_cast<std::int64_t>(inside.size());
    if (!inside.empty()) edit.text = withEdits(edit.text, inside);
    at = edit.end;
    out.push_back(std::move(edit));
  }
  keep(gcode.size());
  edits = std::move(out);
  return told;
}

}  // namespace sillon
