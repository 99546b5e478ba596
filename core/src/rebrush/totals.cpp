#include "rebrush/totals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/decimal_text.hpp"
#include "gcode_reader/parser.hpp"

namespace sillon {
namespace {

constexpr double kCornerSpeed = 8;  // square corner velocity [mm/s]: Marlin's usual jerk
constexpr double kMinute = 60;      // [s]

// One straight stretch of motion.
struct Stretch {
  Vec2 direction;
  double length = 0;
  double speed = 0;
  double acceleration = 0;
};

double cornerSpeed(const Stretch& a, const Stretch& b) {
  if (a.direction == Vec2{} || b.direction == Vec2{}) return 0;
  const double half = std::sqrt(std::max(0.0, (1 + dot(a.direction, b.direction)) / 2));  // 1: straight on
  if (half > 0.999999) return std::min(a.speed, b.speed);
  const double deviation = kCornerSpeed * kCornerSpeed * (std::sqrt(2.0) - 1);
  return std::min({a.speed, b.speed, std::sqrt(deviation * half / (1 - half))});
}

double secondsOf(const std::vector<Stretch>& path) {
  const std::size_t count = path.size();
  std::vector<double> entry(count + 1, 0);
  for (std::size_t k = 1; k < count; ++k) entry[k] = cornerSpeed(path[k - 1], path[k]);
  const auto reach = [](double from, const Stretch& s) {
    return std::sqrt(from * from + 2 * s.acceleration * s.length);
  };
  for (std::size_t k = count; k-- > 0;) entry[k] = std::min(entry[k], reach(entry[k + 1], path[k]));
  for (std::size_t k = 0; k < count; ++k) entry[k + 1] = std::min(entry[k + 1], reach(entry[k], path[k]));
  double seconds = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Stretch& s = path[k];
    const double in = entry[k];
    const double out = entry[k + 1];
    const double top = std::min(s.speed, std::sqrt(s.acceleration * s.length + (in * in + out * out) / 2));
    const double ramps = (2 * top * top - in * in - out * out) / (2 * s.acceleration);
    seconds += (2 * top - in - out) / s.acceleration + std::max(0.0, s.length - ramps) / top;
  }
  return seconds;
}

// "1d 2h 3m 4s" and nothing else.
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

/// Whole durations of the file by the two modes that slicers tell, 0: unknown.
struct Whole {
  double normal = 0;
  double silent = 0;
};

constexpr std::string_view kNormal = "estimated printing time (normal mode) =";
constexpr std::string_view kSilent = "estimated printing time (silent mode) =";

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

}  // namespace

double accelerationOf(std::string_view code) {
  if (!code.starts_with('M') && !code.starts_with('S')) return 0;  // most lines are moves
  double value = 0;
  if (code.starts_with("SET_VELOCITY_LIMIT")) {
    const std::size_t at = code.find("ACCEL=");
    if (at == std::string_view::npos || (at > 0 && code[at - 1] != ' ')) return 0;
    return readNumber(code.substr(at + 6), value) > 0 && value > 0 ? value : 0;
  }
  const GcodeCommand command = commandOf(code);
  if (!command.is('M', 204)) return 0;
  const GcodeWords words = wordsOf(command.rest);
  if (!words.readable()) return 0;
  value = words.has('S') ? words.at('S') : words.at('P');
  return value > 0 ? value : 0;
}

double secondsOfMoves(std::string_view text, const MachineState& before, double acceleration) {
  MachineState machine = before;
  double seconds = 0;
  std::vector<Stretch> path;
  const auto stop = [&] {
    seconds += secondsOf(path);
    path.clear();
  };
  forEachLine(text, [&](const GcodeLine& line) {
    const GcodeParts parts = partsOf(line.text);
    if (parts.code.empty()) return;
    const GcodeCommand command = commandOf(parts.code);
    if (const double other = accelerationOf(parts.code); other > 0) acceleration = other;
    const auto move = runCommand(machine, command, readsWords(command) ? wordsOf(command.rest) : GcodeWords{});
    if (!move || !(machine.speed > 0)) return;
    const double rise = std::abs(move->z - move->zFrom);
    const double size = move->length > 0 ? move->length : std::max(rise, std::abs(move->e));
    if (!(size > 0)) return;
    Stretch stretch;
    stretch.length = size;
    stretch.speed = machine.speed;
    stretch.acceleration = acceleration;
    if (move->length > 0 && rise == 0 && length(move->to - move->from) > 0) {
      stretch.direction = 1 / length(move->to - move->from) * (move->to - move->from);
    } else {
      stop();
    }
    path.push_back(stretch);
    if (stretch.direction == Vec2{}) stop();
  });
  stop();
  return seconds;
}

std::int64_t changeTotals(std::string_view gcode, const std::vector<TimeChange>& changes, std::vector<Edit>& edits) {
  if (changes.empty()) return 0;
  double all = 0;
  double first = 0;
  for (const TimeChange& change : changes) {
    all += change.seconds;
    if (change.firstLayer) first += change.seconds;
  }
  const Whole whole = wholeOf(gcode);
  double before = 0;  // of the changes that are behind us
  std::size_t next = 0;
  std::array<double, 2> least{0, 0};  // progress never goes back

  const auto duration = [&](std::string& line, std::string_view key, double more) {
    const std::size_t at = line.find(key);
    if (at == std::string::npos) return;
    std::size_t begin = at + key.size();
    while (begin < line.size() && line[begin] == ' ') ++begin;
    const std::size_t end = std::min(line.find_first_of(";\r\n", begin), line.size());
    const auto value = durationOf(std::string_view(line).substr(begin, end - begin));
    if (value) line.replace(begin, end - begin, durationText(*value + more));
  };
  const auto seconds = [&](std::string& line, std::string_view key, double more) {
    if (!line.starts_with(key)) return;
    double value = 0;
    const std::string_view rest = std::string_view(line).substr(key.size());
    const std::size_t read = readNumber(rest, value);
    if (read == 0) return;
    const std::size_t point = rest.substr(0, read).find('.');
    const int digits =
        point == std::string_view::npos ? 0 : static_cast<int>(std::min<std::size_t>(read - point - 1, 6));
    line.replace(key.size(), read, fixed(std::max(0.0, value + more), digits));
  };
  const auto progress = [&](std::string_view line) {
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
      const double known = silent ? whole.silent : whole.normal;
      if (letter == 'R' || letter == 'S') {
        fresh += fixed(std::max(0.0, value + std::round((all - before) / kMinute)), 0);
      } else if (known > 0 && known + all > 0) {
        double& floor = least[silent ? 1 : 0];
        floor = std::clamp(std::round(100 * (value / 100 * known + before) / (known + all)), floor, 100.0);
        fresh += fixed(floor, 0);
      } else {
        fresh += word;
      }
    }
    return fresh;
  };
  // The line as it becomes, if another.
  const auto changed = [&](std::string_view line) -> std::optional<std::string> {
    const bool comment = line.starts_with(';');
    if (!comment && !line.starts_with("M73 ")) return std::nullopt;
    std::string text(line);
    if (!comment) {
      text = progress(line);
    } else if (text.find("ime") != std::string::npos || text.find("TIME") != std::string::npos) {
      duration(text, "estimated first layer printing time (normal mode) =", first);
      duration(text, "estimated first layer printing time (silent mode) =", first);
      duration(text, kNormal, all);
      duration(text, kSilent, all);
      duration(text, "model printing time:", all);
      duration(text, "total estimated time:", all);
      seconds(text, ";TIME:", all);
      seconds(text, ";PRINT.TIME:", all);
      seconds(text, ";TIME_ELAPSED:", before);
    }
    return text == line ? std::nullopt : std::optional(std::move(text));
  };
  // What changes of one part of the file, at its place there.
  const auto changesOf = [&](std::string_view text, std::size_t offset, bool edited) {
    std::vector<Edit> found;
    forEachLine(text, [&](const GcodeLine& line) {
      const std::size_t at = edited ? offset : offset + line.offset;
      for (; next < changes.size() && changes[next].at <= at; ++next) before += changes[next].seconds;
      if (auto fresh = changed(line.text)) {
        found.push_back({line.offset, line.offset + line.text.size(), std::move(*fresh)});
      }
    });
    return found;
  };
  std::vector<Edit> out;
  std::int64_t told = 0;
  std::size_t at = 0;
  const auto keep = [&](std::size_t end) {
    for (Edit& edit : changesOf(gcode.substr(at, end - at), at, false)) {
      out.push_back({edit.begin + at, edit.end + at, std::move(edit.text)});
      ++told;
    }
  };
  for (Edit& edit : edits) {
    keep(edit.begin);
    const std::vector<Edit> inside = changesOf(edit.text, edit.begin, true);
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
