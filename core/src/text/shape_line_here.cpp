// Shapes lines by HarfBuzz. Engines in browsers have shape_line_elsewhere.cpp instead.
#include <hb-ot.h>
#include <hb.h>
#include <unicode/ustring.h>
#include <unicode/utf16.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "base/json.hpp"
#include "sillon/base/words.hpp"
#include "sillon/text/text.hpp"
#include "text/fonts.hpp"
#include "text/letters.hpp"
#include "text/text_runs.hpp"

namespace sillon {
namespace {

template <class T, void (*Destroy)(T*)>
struct Release {
  void operator()(T* object) const { Destroy(object); }
};
template <class T, void (*Destroy)(T*)>
using Owned = std::unique_ptr<T, Release<T, Destroy>>;

using Blob = Owned<hb_blob_t, hb_blob_destroy>;
using Face = Owned<hb_face_t, hb_face_destroy>;
using Font = Owned<hb_font_t, hb_font_destroy>;
using Buffer = Owned<hb_buffer_t, hb_buffer_destroy>;
using DrawFuncs = Owned<hb_draw_funcs_t, hb_draw_funcs_destroy>;

std::string& pathOf(void* data) { return *static_cast<std::string*>(data); }

void addNumbers(std::string& path, char command, std::initializer_list<float> numbers) {
  path += command;
  for (const float number : numbers) (path += jsonNumber(static_cast<double>(number))) += ' ';
}

DrawFuncs pathWriter() {
  DrawFuncs funcs(hb_draw_funcs_create());
  hb_draw_funcs_set_move_to_func(
      funcs.get(),
      [](hb_draw_funcs_t*, void* path, hb_draw_state_t*, float x, float y, void*) {
        addNumbers(pathOf(path), 'M', {x, y});
      },
      nullptr, nullptr);
  hb_draw_funcs_set_line_to_func(
      funcs.get(),
      [](hb_draw_funcs_t*, void* path, hb_draw_state_t*, float x, float y, void*) {
        addNumbers(pathOf(path), 'L', {x, y});
      },
      nullptr, nullptr);
  hb_draw_funcs_set_quadratic_to_func(
      funcs.get(),
      [](hb_draw_funcs_t*, void* path, hb_draw_state_t*, float cx, float cy, float x, float y, void*) {
        addNumbers(pathOf(path), 'Q', {cx, cy, x, y});
      },
      nullptr, nullptr);
  hb_draw_funcs_set_cubic_to_func(
      funcs.get(),
      [](hb_draw_funcs_t*, void* path, hb_draw_state_t*, float ax, float ay, float bx, float by, float x, float y,
         void*) {
        addNumbers(pathOf(path), 'C', {ax, ay, bx, by, x, y});
      },
      nullptr, nullptr);
  hb_draw_funcs_set_close_path_func(
      funcs.get(), [](hb_draw_funcs_t*, void* path, hb_draw_state_t*, void*) { pathOf(path) += 'Z'; }, nullptr,
      nullptr);
  return funcs;
}

/// The letters of a line. Broken bytes are U+FFFD, control characters and separators of lines are spaces.
std::u16string lettersOf(std::string_view line) {
  std::u16string letters(line.size(), u'\0');
  std::int32_t length = 0;
  UErrorCode status = U_ZERO_ERROR;
  const auto size = static_cast<std::int32_t>(line.size());
  u_strFromUTF8WithSub(letters.data(), size, &length, line.data(), size, 0xFFFD, nullptr, &status);
  letters.resize(static_cast<std::size_t>(length));
  for (char16_t& letter : letters) {
    const bool control = letter < 0x20 || (letter >= 0x7F && letter < 0xA0) || letter == 0x2028 || letter == 0x2029;
    if (control) letter = u' ';
  }
  return letters;
}

/// The character that begins at a place, in UTF-8.
std::string letterAt(std::u16string_view letters, std::size_t place) {
  UChar32 code = 0;
  U16_GET(letters.data(), 0, place, letters.size(), code);
  char bytes[4];
  std::int32_t length = 0;
  const auto one = static_cast<UChar32>(code);
  UBool failed = 0;
  U8_APPEND(bytes, length, 4, one, failed);
  return {bytes, static_cast<std::size_t>(length)};
}

/// Height of H, since what fonts tell of it may be a third off.
double capHeightOf(hb_font_t* font, double em) {
  hb_codepoint_t glyph = 0;
  hb_glyph_extents_t extents{};
  const bool drawn = hb_font_get_nominal_glyph(font, 'H', &glyph) != 0 &&
                     hb_font_get_glyph_extents(font, glyph, &extents) != 0 && extents.height < 0;
  return drawn ? -extents.height : kUsualCapHeight * em;
}

/// The heights that set the base lines of drawings.
void measure(hb_font_t* font, ShapedLine& shaped) {
  hb_position_t height = 0;
  hb_font_extents_t extents{};
  if (hb_ot_metrics_get_position(font, HB_OT_METRICS_TAG_X_HEIGHT, &height) != 0) shaped.xHeight = height;
  if (hb_font_get_h_extents(font, &extents) == 0) return;
  shaped.ascent = extents.ascender;
  shaped.descent = -extents.descender;
}

}  // namespace

Result<ShapedLine> shapeLine(const ReadInput& read, const std::string& font, const std::string& line) {
  std::string file;
  std::optional<std::string_view> bytes = builtinFont(font);
  if (!bytes) {
    Result<InputFile> given = read(font, "font");
    if (!given) return given.error();
    auto* content = std::get_if<std::string>(&given.value());
    if (content == nullptr) return noFont(font);
    file = std::move(*content);
    bytes = file;
  }
  const Blob blob(
      hb_blob_create(bytes->data(), static_cast<unsigned>(bytes->size()), HB_MEMORY_MODE_READONLY, nullptr, nullptr));
  const Face face(hb_face_create(blob.get(), 0));
  if (hb_face_get_glyph_count(face.get()) == 0) return noFont(font);
  const Font shaper(hb_font_create(face.get()));

  ShapedLine shaped;
  shaped.em = hb_face_get_upem(face.get());
  shaped.capHeight = capHeightOf(shaper.get(), shaped.em);
  measure(shaper.get(), shaped);

  const std::u16string letters = lettersOf(line);
  const Buffer buffer(hb_buffer_create());
  const DrawFuncs writer = pathWriter();
  std::map<hb_codepoint_t, std::size_t> known;
  std::size_t length = 0;
  for (const TextRun& run : textRuns(letters)) {
    hb_buffer_reset(buffer.get());
    hb_buffer_add_utf16(buffer.get(), reinterpret_cast<const std::uint16_t*>(letters.data()),
                        static_cast<int>(letters.size()), static_cast<unsigned>(run.begin),
                        static_cast<int>(run.end - run.begin));
    hb_buffer_set_direction(buffer.get(), run.toLeft ? HB_DIRECTION_RTL : HB_DIRECTION_LTR);
    hb_buffer_set_language(buffer.get(), hb_language_from_string("und", -1));  // not that of the system
    hb_buffer_guess_segment_properties(buffer.get());
    hb_shape(shaper.get(), buffer.get(), nullptr, 0);
    unsigned count = 0;
    const hb_glyph_info_t* infos = hb_buffer_get_glyph_infos(buffer.get(), &count);
    const hb_glyph_position_t* places = hb_buffer_get_glyph_positions(buffer.get(), &count);
    for (unsigned k = 0; k < count; ++k) {
      if (infos[k].codepoint == 0) return missingLetter(font, letterAt(letters, infos[k].cluster));
      const auto [outline, fresh] = known.try_emplace(infos[k].codepoint, shaped.outlines.size());
      if (fresh) {
        std::string path;
#if HB_VERSION_ATLEAST(7, 0, 0)
        hb_font_draw_glyph(shaper.get(), infos[k].codepoint, writer.get(), &path);
#else
        hb_font_get_glyph_shape(shaper.get(), infos[k].codepoint, writer.get(), &path);
#endif
        length += path.size();
        if (length > kMostPathBytes) return tooDetailed(font);
        shaped.outlines.push_back(std::move(path));
      }
      shaped.letters.push_back({outline->second,
                                {static_cast<double>(places[k].x_offset), static_cast<double>(places[k].y_offset)},
                                static_cast<double>(places[k].x_advance)});
    }
  }
  return shaped;
}

}  // namespace sillon
