// G-code as a stream of lines, commands and words. Every byte keeps its place, so that a file can be put together again
// from its lines. Knows no firmware: what commands do is in machine.hpp and commands.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/lines.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// One line and its place. The views live until the parser goes on.
struct GcodeLine {
  std::string_view text;    ///< without its end
  std::string_view end;     ///< "\n", "\r\n" or "\r"; empty at the end of a file
  std::size_t offset = 0;   ///< of its first byte
  std::int64_t number = 0;  ///< from 1
};

/// Cuts bytes into lines. LF, CR LF and CR end a line, as they do for firmwares; a line without an end is cut after 1
/// MiB, so that no file takes more memory than that.
class GcodeParser {
 public:
  /// Calls `take(const GcodeLine&)` for each line that ends within `bytes`; the rest waits for more.
  template <class Take>
  void feed(std::string_view bytes, Take&& take) {
    while (!bytes.empty()) {
      // Whether LF follows a CR at the end of what is here is not known yet.
      const bool split = !kept_.empty() && kept_.back() == '\r';
      const std::size_t end = split ? 0 : lineEnd(bytes);
      if (end == bytes.size() || (!split && bytes[end] == '\r' && end + 1 == bytes.size())) {
        kept_ += bytes;
        while (kept_.size() > kLongestLine) {
          const std::string piece = kept_.substr(0, kLongestLine);
          kept_.erase(0, kLongestLine);
          give(piece, {}, take);
        }
        return;
      }
      if (split) {
        const bool lineFeed = bytes[0] == '\n';
        const std::string line = std::move(kept_) + (lineFeed ? "\n" : "");
        kept_.clear();
        bytes.remove_prefix(lineFeed ? 1 : 0);
        const std::size_t ending = lineFeed ? 2 : 1;
        const std::string_view view = line;
        give(view.substr(0, view.size() - ending), view.substr(view.size() - ending), take);
        continue;
      }
      const std::size_t ending = bytes[end] == '\r' && bytes[end + 1] == '\n' ? 2 : 1;
      if (kept_.empty()) {
        give(bytes.substr(0, end), bytes.substr(end, ending), take);
      } else {
        const std::string line = std::move(kept_) + std::string(bytes.substr(0, end));
        kept_.clear();
        give(line, bytes.substr(end, ending), take);
      }
      bytes.remove_prefix(end + ending);
    }
  }

  /// The last line, if it has no end.
  template <class Take>
  void finish(Take&& take) {
    if (kept_.empty()) return;
    const std::string line = std::move(kept_);
    kept_.clear();
    const std::string_view view = line;
    const std::size_t ending = view.back() == '\r' ? 1 : 0;
    give(view.substr(0, view.size() - ending), view.substr(view.size() - ending), take);
  }

 private:
  static constexpr std::size_t kLongestLine = std::size_t{1} << 20;

  // find_first_of calls a function for each character: a tenth of a check. Of most lines one search finds the end.
  static std::size_t lineEnd(std::string_view bytes) {
    const std::string_view near = bytes.substr(0, 128);
    std::size_t end = near.find('\n');
    if (end != std::string_view::npos && near.substr(0, end).find('\r') == std::string_view::npos) return end;
    end = 0;
    while (end < bytes.size() && bytes[end] != '\n' && bytes[end] != '\r') ++end;
    return end;
  }

  template <class Take>
  void give(std::string_view text, std::string_view end, Take&& take) {
    take(GcodeLine{text, end, offset_, ++number_});
    offset_ += text.size() + end.size();
  }

  std::string kept_;
  std::size_t offset_ = 0;
  std::int64_t number_ = 0;
};

/// All lines of a text that is in memory.
template <class Take>
void forEachLine(std::string_view text, Take&& take) {
  GcodeParser parser;
  parser.feed(text, take);
  parser.finish(take);
}

/// The same of a large text: tells the run the share of its stage that is done. \return false: it was asked to stop.
template <class Take>
bool forEachLine(std::string_view text, const RunContext& run, Take&& take) {
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  GcodeParser parser;
  for (std::size_t at = 0; at < text.size(); at += kPiece) {
    if (run.poll()) return false;
    run.report(static_cast<double>(at) / static_cast<double>(text.size()));
    parser.feed(text.substr(at, kPiece), take);
  }
  parser.finish(take);
  return true;
}

/// What a firmware runs of a line, without comment, a host's line number and checksum; and the comment.
struct GcodeParts {
  std::string_view code;     ///< trimmed
  std::string_view comment;  ///< behind ';', trimmed
  bool numbered = false;     ///< N... before it
};
GcodeParts partsOf(std::string_view line);

/// The head of a command. G0 to M9999 and T are letters with a number; everything else is a name.
struct GcodeCommand {
  char letter = 0;        ///< upper case; 0: a name
  int code = -1;          ///< -1: no whole number from 0 to 9999 behind the letter
  int sub = 0;            ///< behind a point: 1 of G29.1
  std::string_view name;  ///< as written: "G29.1", "PRINT_START"
  std::string_view rest;  ///< as written

  [[nodiscard]] bool is(char wanted, int number) const { return letter == wanted && code == number && sub == 0; }
};
GcodeCommand commandOf(std::string_view code);

/// Letters with numbers, and what is odd about them.
struct GcodeWords {
  enum Fault { None, NotAWord, NoNumber, NotPlain, Twice };

  std::array<double, 26> values{};
  std::uint32_t given = 0;     ///< letters with a number
  std::uint32_t named = 0;     ///< letters with or without
  Fault fault = None;          ///< the first
  std::string_view faultText;  ///< where it stands
  bool lower = false;          ///< lower case letters
  bool crowded = false;        ///< words without spaces between them
  bool unusual = false;        ///< a number that firmwares read and the grammar of ours does not have: +1, .5

  [[nodiscard]] bool has(char letter) const { return (given >> (letter - 'A') & 1) != 0; }
  [[nodiscard]] double at(char letter, double otherwise = 0) const {
    return has(letter) ? values[letter - 'A'] : otherwise;
  }
  /// All of it can be read: a firmware would do with it what is read here.
  [[nodiscard]] bool readable() const { return fault != NotAWord && fault != NoNumber; }
};
GcodeWords wordsOf(std::string_view rest);

/// A move as our own files have it, which is most of any file: G0 or G1 and words with one space before each, a letter
/// and a plain number of at most 15 digits, at most 95 characters in all. What commandOf and wordsOf would find: with
/// it a check takes half the instructions. \return whether it is one; if not, `words` holds nothing of use.
bool readPlainMove(std::string_view line, GcodeWords& words);

/// The number that a text begins with, as firmwares read it: no exponent. \return characters read, 0 for none.
std::size_t readNumber(std::string_view text, double& value);

// Commands of each dialect: their purpose, and those that nobody should meet in a print.

inline constexpr double kMostLowered = 0.5;  ///< [mm] that offsets may lower a nozzle: more than any first layer
inline constexpr double kMostOffset = 10;    ///< [mm], to any other side

/// Names what a line of code does besides its moves, by the table of commands and by its values: heaters' targets,
/// offsets, limits, waits. Whether a finding is an error never depends on the flavour. \param hottestNozzle, hottestBed
/// [degrees Celsius] \param strict  also tells of macros and unknown commands.
std::vector<GcodeFinding> judgeCommand(std::string_view code, GcodeFlavor flavor, double hottestNozzle,
                                       double hottestBed, bool strict);

/// The code of the finding about a line that firmwares read in different ways, or null: what is not printable ASCII,
/// which Python takes for digits and Marlin leaves out; a backslash, which Marlin drops; a comment that begins within
/// quotes. Behind commands that take text, only the last may run another command.
const char* spellingFault(std::string_view line);

/// Tells whether a command levels or measures the bed, and so touches it here and there.
bool probesBed(const GcodeCommand& command);

/// Tells whether a command is a G28 that homes Z, alone or with others.
bool homesZ(const GcodeCommand& command);

// The grammar of the lines that are written here: what every firmware, host and viewer reads alike
// (docs/reference/gcode.md).

/// ["-"] ("0" | nonzero { digit }) ["." digit { digit }], but no "-0", "-0.000".
bool isPlainNumber(std::string_view text);

/// ("G"|"M"|"T") number { " " LETTER [number] }, no letter twice; or NAME { " " NAME "=" (number | NAME) }.
bool isPlainCommand(std::string_view text);

/// The code of the finding about a line without its end, or null: it must be printable ASCII; empty, a comment, or a
/// command of less than 96 characters that a comment may follow.
const char* lineFault(std::string_view line);

}  // namespace sillon
