// The order of runs against Unicode's own test of the bidirectional algorithm, and closed forms of scripts.
#include "text/text_runs.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

using namespace sillon;

namespace {

/// Path in Debian's package unicode-data.
constexpr const char* kBidiTest = "/usr/share/unicode/BidiCharacterTest.txt";

std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ';');) fields.push_back(field);
  fields.resize(5);
  return fields;
}

std::vector<std::string> wordsOf(const std::string& field) {
  std::istringstream in(field);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

}  // namespace

TEST_CASE("letters stand in the order of Unicode's own test of the bidirectional algorithm") {
  std::ifstream file(kBidiTest);
  if (!file) {
    MESSAGE("skipped: there is no " << std::string(kBidiTest) << "; Debian's package unicode-data has it");
    return;
  }
  int tried = 0, apart = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    const std::vector<std::string> fields = fieldsOf(line);
    // A mark in front makes the direction that the line is given the one that its first strong letter tells.
    std::u16string text(1, fields[2] == "0" ? u'\u200E' : u'\u200F');
    for (const std::string& code : wordsOf(fields[0])) text += static_cast<char16_t>(std::stoul(code, nullptr, 16));
    const std::vector<std::string> levels = wordsOf(fields[3]);
    std::string order, expected;
    bool ways = true;
    for (const TextRun& run : textRuns(text)) {
      for (std::size_t k = 0; k < run.end - run.begin; ++k) {
        const std::size_t at = run.toLeft ? run.end - 1 - k : run.begin + k;
        if (at == 0 || levels[at - 1] == "x") continue;  // formatting, which is not seen
        order += std::to_string(at - 1) + ' ';
        ways = ways && run.toLeft == (std::stoi(levels[at - 1]) % 2 == 1);
      }
    }
    for (const std::string& at : wordsOf(fields[4])) expected += at + ' ';
    if (order != expected || !ways) {
      ++apart;
    }
    ++tried;
  }
  CHECK(tried > 90000);
  // ICU 72 has another order where a mark stands behind a bracket, an embedding ends between brackets or touches an
  // isolate, and 64 brackets are open.
  CHECK(apart <= 30);
}

TEST_CASE("a line that runs both ways is split where its sense or its script changes") {
  const auto runs = [](std::u16string_view line) { return textRuns(line); };
  CHECK(runs(u"").empty());
  CHECK(runs(u"Anna (12)") == std::vector<TextRun>{{0, 9, false}});
  CHECK(runs(u"\u05d0 12") == std::vector<TextRun>{{2, 4, false}, {0, 2, true}});
  CHECK(runs(u"\u05d0 Anna") == std::vector<TextRun>{{2, 6, false}, {0, 2, true}});
  CHECK(runs(u"Anna \u05d0\u05d1!") == std::vector<TextRun>{{0, 5, false}, {5, 7, true}, {7, 8, false}});
  // Signs belong to the script before them, and two scripts of one sense are two runs.
  CHECK(runs(u"A, \u0394.") == std::vector<TextRun>{{0, 3, false}, {3, 5, false}});
  CHECK(runs(u"\u05d0 \u0627") == std::vector<TextRun>{{2, 3, true}, {0, 2, true}});
  // Letters of two units: one that runs left, and a sign.
  CHECK(runs(u"\U00010900 \U0001F600 A") == std::vector<TextRun>{{6, 7, false}, {0, 6, true}});
  // Long lines are several paragraphs.
  CHECK(runs(std::u16string(4096, u'\u05d0') + u"\u05d1") == std::vector<TextRun>{{0, 4096, true}, {4096, 4097, true}});
}
