// Orders the runs of a line with ICU, and splits them by HarfBuzz's table of scripts.
#include <hb.h>
#include <unicode/ubidi.h>
#include <unicode/utf16.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <new>

#include "text/text_runs.hpp"

namespace sillon {
namespace {

/// Longest paragraph that is ordered at once [letters]; longer lines are split. The JavaScript library takes time that
/// grows with the square of the length, and both must give the same runs.
constexpr int kLongestParagraph = 4096;

/// Splits a run into parts of one script each, in the order of the line.
std::vector<TextRun> byScript(std::u16string_view line, TextRun whole) {
  std::vector<TextRun> parts{whole};
  hb_script_t known = HB_SCRIPT_COMMON;
  for (std::size_t at = whole.begin; at < whole.end;) {
    const std::size_t begin = at;
    UChar32 letter = 0;
    U16_NEXT(line.data(), at, whole.end, letter);
    const hb_script_t script = hb_unicode_script(hb_unicode_funcs_get_default(), static_cast<hb_codepoint_t>(letter));
    if (script == HB_SCRIPT_COMMON || script == HB_SCRIPT_INHERITED || script == HB_SCRIPT_UNKNOWN) continue;
    if (known != HB_SCRIPT_COMMON && script != known) {
      parts.back().end = begin;
      parts.push_back({begin, whole.end, whole.toLeft});
    }
    known = script;
  }
  return parts;
}

/// Splits a paragraph into runs of one direction, from left to right. \param whole  the paragraph.
std::vector<TextRun> byWay(std::u16string_view line, TextRun whole) {
  const std::unique_ptr<UBiDi, void (*)(UBiDi*)> order(ubidi_open(), &ubidi_close);
  UErrorCode status = U_ZERO_ERROR;
  ubidi_setPara(order.get(), line.data() + whole.begin, static_cast<std::int32_t>(whole.end - whole.begin),
                UBIDI_DEFAULT_LTR, nullptr, &status);
  const std::int32_t count = ubidi_countRuns(order.get(), &status);
  if (U_FAILURE(status) != 0) throw std::bad_alloc();  // only memory can run out
  std::vector<TextRun> ways;
  for (std::int32_t k = 0; k < count; ++k) {
    std::int32_t start = 0, length = 0;
    const bool toLeft = ubidi_getVisualRun(order.get(), k, &start, &length) == UBIDI_RTL;
    const std::size_t begin = whole.begin + start;
    const TextRun run{begin, begin + length, toLeft};
    // Adjacent runs of one direction, whose levels differ by two, are joined, so that kerning works across them.
    TextRun* const before = ways.empty() || ways.back().toLeft != toLeft ? nullptr : &ways.back();
    if (before != nullptr && (toLeft ? run.end == before->begin : run.begin == before->end)) {
      before->begin = std::min(before->begin, run.begin);
      before->end = std::max(before->end, run.end);
    } else {
      ways.push_back(run);
    }
  }
  return ways;
}

}  // namespace

std::vector<TextRun> textRuns(std::u16string_view line) {
  std::vector<TextRun> runs;
  for (TextRun paragraph; paragraph.begin < line.size(); paragraph.begin = paragraph.end) {
    U16_FWD_N(line.data(), paragraph.end, line.size(), kLongestParagraph);
    for (const TextRun& way : byWay(line, paragraph)) {
      std::vector<TextRun> parts = byScript(line, way);
      if (way.toLeft) std::reverse(parts.begin(), parts.end());
      runs.insert(runs.end(), parts.begin(), parts.end());
    }
  }
  return runs;
}

}  // namespace sillon
