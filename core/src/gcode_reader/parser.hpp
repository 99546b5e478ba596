// G-code as a stream of lines, commands and words. Every byte keeps its place, so that a file can be put together again
// from its lines. Reading is the same for all firmwares; machine.hpp and commands.cpp know the effects of commands.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "base/lines.hpp"
#include "sillon/base/run_context.hpp"
#include "sillon/gcode_reader/check.hpp"
#include "sillon/settings/project.hpp"

namespace sillon {

/// One line and its place. The views are valid until the parser goes on.
struct GcodeLine {
  std::string_view text;    ///< line without its end
  std::string_view end;     ///< "\n", "\r\n" or "\r"; empty at the end of a file
  std::size_t offset = 0;   ///< offset of its first byte in the file
  std::int64_t number = 0;  ///< number of the line, from 1
};

/// Cuts bytes into lines. LF, CR LF and CR end a line, as they do for firmwares; a line without an end is cut after 1
/// MiB, so that no file takes more memory than that.
class GcodeParser {
 public:
  /// Calls `take(const GcodeLine&)` for each line that ends within `bytes`, and keeps the rest for the next call.
  template <class Take>
  void feed(std::string_view bytes, Take&& take) {
    while (!bytes.empty()) {
      // A CR at the end of `bytes` may belong to a CR LF, which only the next bytes show.
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

  /// Takes the last line, if the file does not end with an end of line.
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

  // Finds the end of a line, mostly with one search for LF. find_first_of would take a tenth of a check's time, since
  // it calls a function for each character.
  static std::size_t lineEnd(std::string_view bytes) {
    const std::string_view near = bytes.substr(0, 128);
    std::size_t end = near.find('\n');
    if (end != std::string_view::npos && near.substr(0, end).find('\r') == std::string_view::npos) return end;
    end = 0;
    while (end < bytes.size() && bytes[end] != '\n' && bytes[end] != '\r') ++end;
    return end;
  }

  // Passes a line on with its place and number.
  template <class Take>
  void give(std::string_view text, std::string_view end, Take&& take) {
    take(GcodeLine{text, end, offset_, ++number_});
    offset_ += text.size() + end.size();
  }

  std::string kept_;
  std::size_t offset_ = 0;
  std::int64_t number_ = 0;
};

/// Calls `take(const GcodeLine&)` for all lines of a text that is in memory.
template <class Take>
void forEachLine(std::string_view text, Take&& take) {
  GcodeParser parser;
  parser.feed(text, take);
  parser.finish(take);
}

/// Does the same for a large text, and reports to `run` which share is done. \return false: the run was asked to stop.
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

/// Parts of a line: the code that a firmware runs, without a host's line number and checksum, and the comment.
struct GcodeParts {
  std::string_view code;     ///< trimmed
  std::string_view comment;  ///< text behind ';', trimmed
  bool numbered = false;     ///< a line number stands before the code
};
/// Cuts a line into its parts.
GcodeParts partsOf(std::string_view line);

/// A command without its words. G, M and T with a number are read as letter and number; everything else is a name.
struct GcodeCommand {
  char letter = 0;        ///< G, M or T; 0: the command is a name
  int code = -1;          ///< number behind the letter; -1: none from 0 to 9999
  int sub = 0;            ///< number behind a point, such as 1 in G29.1
  std::string_view name;  ///< head as written: "G29.1", "PRINT_START"
  std::string_view rest;  ///< text behind the head, as written

  [[nodiscard]] bool is(char wanted, int number) const { return letter == wanted && code == number && sub == 0; }
  [[nodiscard]] bool isAny(char wanted, std::initializer_list<int> numbers) const {
    return letter == wanted && sub == 0 && std::find(numbers.begin(), numbers.end(), code) != numbers.end();
  }
};
/// Reads the head of a line's code.
GcodeCommand commandOf(std::string_view code);

/// Letters with numbers, and what is wrong or odd about them.
struct GcodeWords {
  enum Fault { None, NotAWord, NoNumber, NotPlain, Twice };

  std::array<double, 26> values{};
  std::uint32_t given = 0;     ///< letters with a number, A as bit 0
  std::uint32_t named = 0;     ///< letters with or without a number
  Fault fault = None;          ///< first fault; one that makes the words unreadable replaces another
  std::string_view faultText;  ///< text with the fault
  bool lower = false;          ///< lower case letters
  bool crowded = false;        ///< words without spaces between them
  bool unusual = false;        ///< a number that firmwares read, but our own grammar excludes: +1, .5

  [[nodiscard]] bool has(char letter) const { return (given >> (letter - 'A') & 1) != 0; }
  [[nodiscard]] double at(char letter, double otherwise = 0) const {
    return has(letter) ? values[letter - 'A'] : otherwise;
  }
  /// Tells whether all words could be read as a firmware reads them.
  [[nodiscard]] bool readable() const { return fault != NotAWord && fault != NoNumber; }
};
/// Reads the words behind a command's head.
GcodeWords wordsOf(std::string_view rest);

/// Reads a plain move, as most lines of any file are: G0 or G1, then words with one space before each, a letter and a
/// plain number of at most 15 digits, at most 95 characters in all. The words are those of commandOf and wordsOf, but a
/// check takes half the instructions. \return false: it is no plain move, and `words` holds nothing of use.
bool readPlainMove(std::string_view line, GcodeWords& words);

/// Reads the number that a text begins with, as firmwares do: without an exponent. \return characters read; 0: none.
std::size_t readNumber(std::string_view text, double& value);

// Commands of each dialect: their effects, and those that do not belong in a print.

inline constexpr double kMostLowered = 0.5;  ///< [mm], most that offsets may lower a nozzle: more than any first layer
inline constexpr double kMostOffset = 10;    ///< [mm], most that offsets may shift to any other side

/// Judges a line of code, except for its moves, by the table of commands and by its values: targets of heaters,
/// offsets, limits, waits. The flavour never decides whether a finding is an error. \param hottestNozzle, hottestBed
/// limits [degrees Celsius]. \param strict  also finds macros and unknown commands.
std::vector<GcodeFinding> judgeCommand(std::string_view code, GcodeFlavor flavor, double hottestNozzle,
                                       double hottestBed, bool strict);

/// Code of the finding about a line that firmwares read in different ways, or null. Such lines have characters that are
/// not printable ASCII, which Python takes for digits and Marlin leaves out; a backslash, which Marlin drops; or a
/// comment that begins within quotes. Behind commands that take text, only the last of these may run another command.
const char* spellingFault(std::string_view line);

/// Tells whether a command levels or measures the bed, and so touches it here and there.
bool probesBed(const GcodeCommand& command);

/// Tells whether a command is a G28 that homes Z, alone or with others.
bool homesZ(const GcodeCommand& command);

// The grammar of the lines that are written here, which every firmware, host and viewer reads alike
// (docs/reference/gcode.md).

/// Tells whether a text is ["-"] ("0" | nonzero { digit }) ["." digit { digit }], but no "-0", "-0.000".
bool isPlainNumber(std::string_view text);

/// Tells whether a text is ("G"|"M"|"T") number { " " LETTER [number] }, no letter twice; or NAME { " " NAME "="
/// (number | NAME) }.
bool isPlainCommand(std::string_view text);

/// Code of the finding about a line of ours, given without its end, or null. It must be printable ASCII, and empty, a
/// comment, or a command of less than 96 characters that a comment may follow.
const char* lineFault(std::string_view line);

}  // namespace sillon
