// Shapes lines with HarfBuzz. Engines in browsers use shape_line_elsewhere.cpp and wasm/src/text/text.ts instead, with
// the same results.
#include <hb-ot.h>
#include <hb.h>
#include <unicode/ustring.h>
#include <unicode/utf16.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/json.hpp"
#include "input/shaped_line.hpp"
#include "sillon/base/words.hpp"
#include "sillon/settings/table.hpp"
#include "sillon/text/text.hpp"
#include "text/fonts.hpp"
#include "text/letters.hpp"
#include "text/text_runs.hpp"
#include "text/unpack_font.hpp"

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
#if HB_VERSION_ATLEAST(11, 2, 0)
using PaintFuncs = Owned<hb_paint_funcs_t, hb_paint_funcs_destroy>;
#endif

/// Map from the points of a glyph to those of the letter of which it is a part.
struct Affine {
  double xx = 1, yx = 0, xy = 0, yy = 1, dx = 0, dy = 0;
};

Affine operator*(const Affine& a, const Affine& b) {
  return {a.xx * b.xx + a.xy * b.yx, a.yx * b.xx + a.yy * b.yx,        a.xx * b.xy + a.xy * b.yy,
          a.yx * b.xy + a.yy * b.yy, a.xx * b.dx + a.xy * b.dy + a.dx, a.yx * b.dx + a.yy * b.dy + a.dy};
}

/// Writer of path data.
struct Pen {
  std::string path;
  double scale = 1;
  hb_draw_funcs_t* writer = nullptr;
  std::vector<Affine> places{Affine{}};  ///< transforms of the nested parts, innermost last
};

Pen& penOf(void* data) { return *static_cast<Pen*>(data); }

void addNumbers(Pen& pen, char command, std::initializer_list<float> numbers) {
  const Affine& place = pen.places.back();
  pen.path += command;
  for (const float* at = numbers.begin(); at != numbers.end(); at += 2) {
    const double x = static_cast<double>(at[0]), y = static_cast<double>(at[1]);
    (pen.path += jsonNumber((place.xx * x + place.xy * y + place.dx) * pen.scale)) += ' ';
    (pen.path += jsonNumber((place.yx * x + place.yy * y + place.dy) * pen.scale)) += ' ';
  }
}

/// Makes the functions by which HarfBuzz writes an outline as path data.
DrawFuncs pathWriter() {
  DrawFuncs funcs(hb_draw_funcs_create());
  hb_draw_funcs_set_move_to_func(
      funcs.get(),
      [](hb_draw_funcs_t*, void* pen, hb_draw_state_t*, float x, float y, void*) {
        addNumbers(penOf(pen), 'M', {x, y});
      },
      nullptr, nullptr);
  hb_draw_funcs_set_line_to_func(
      funcs.get(),
      [](hb_draw_funcs_t*, void* pen, hb_draw_state_t*, float x, float y, void*) {
        addNumbers(penOf(pen), 'L', {x, y});
      },
      nullptr, nullptr);
  hb_draw_funcs_set_quadratic_to_func(
      funcs.get(),
      [](hb_draw_funcs_t*, void* pen, hb_draw_state_t*, float cx, float cy, float x, float y, void*) {
        addNumbers(penOf(pen), 'Q', {cx, cy, x, y});
      },
      nullptr, nullptr);
  hb_draw_funcs_set_cubic_to_func(
      funcs.get(),
      [](hb_draw_funcs_t*, void* pen, hb_draw_state_t*, float ax, float ay, float bx, float by, float x, float y,
         void*) {
        addNumbers(penOf(pen), 'C', {ax, ay, bx, by, x, y});
      },
      nullptr, nullptr);
  hb_draw_funcs_set_close_path_func(
      funcs.get(), [](hb_draw_funcs_t*, void* pen, hb_draw_state_t*, void*) { penOf(pen).path += 'Z'; }, nullptr,
      nullptr);
  return funcs;
}

#if HB_VERSION_ATLEAST(11, 2, 0)
/// Collects the parts that fonts in colour lay over one another; their union counts, because all get the same plastic.
PaintFuncs partsWriter() {
  PaintFuncs funcs(hb_paint_funcs_create());
  hb_paint_funcs_set_push_transform_func(
      funcs.get(),
      [](hb_paint_funcs_t*, void* data, float xx, float yx, float xy, float yy, float dx, float dy, void*) {
        std::vector<Affine>& places = penOf(data).places;
        places.push_back(places.back() * Affine{xx, yx, xy, yy, dx, dy});
      },
      nullptr, nullptr);
  hb_paint_funcs_set_pop_transform_func(
      funcs.get(),
      [](hb_paint_funcs_t*, void* data, void*) {
        if (penOf(data).places.size() > 1) penOf(data).places.pop_back();
      },
      nullptr, nullptr);
  hb_paint_funcs_set_push_clip_glyph_func(
      funcs.get(),
      [](hb_paint_funcs_t*, void* data, hb_codepoint_t glyph, hb_font_t* font, void*) {
        Pen& pen = penOf(data);
        if (pen.path.size() <= kMostPathBytes) hb_font_draw_glyph(font, glyph, pen.writer, &pen);
      },
      nullptr, nullptr);
  return funcs;
}
#endif

/// Decodes a line. Invalid bytes become U+FFFD; control characters and line separators become spaces.
std::u16string lettersOf(std::string_view line) {
  std::u16string letters(line.size(), u'\0');
  std::int32_t length = 0;
  UErrorCode status = U_ZERO_ERROR;
  const auto size = static_cast<std::int32_t>(line.size());
  u_strFromUTF8WithSub(letters.data(), size, &length, line.data(), size, 0xFFFD, nullptr, &status);
  letters.resize(length);
  for (char16_t& letter : letters) {
    const bool control = letter < 0x20 || (letter >= 0x7F && letter < 0xA0) || letter == 0x2028 || letter == 0x2029;
    if (control) letter = u' ';
  }
  return letters;
}

UChar32 codeAt(std::u16string_view letters, std::size_t place) {
  UChar32 code = 0;
  U16_GET(letters.data(), 0, place, letters.size(), code);
  return code;
}

std::string utf8Of(UChar32 code) {
  char bytes[4];
  std::int32_t length = 0;
  U8_APPEND_UNSAFE(bytes, length, code);
  return std::string(bytes, length);
}

hb_unicode_general_category_t categoryOf(UChar32 code) {
  return hb_unicode_general_category(hb_unicode_funcs_get_default(), static_cast<hb_codepoint_t>(code));
}

bool isSpace(UChar32 code) {
  const hb_unicode_general_category_t category = categoryOf(code);
  return category == HB_UNICODE_GENERAL_CATEGORY_SPACE_SEPARATOR;
}

/// Tells whether a letter is a joiner, a mark of direction or a variation selector: these change other letters, and
/// fonts need not have them.
bool isUnseen(UChar32 code) {
  const bool selects = (code >= 0xFE00 && code <= 0xFE0F) || (code >= 0xE0100 && code <= 0xE01EF) ||
                       (code >= 0x180B && code <= 0x180D) || code == 0x180F;
  return selects || categoryOf(code) == HB_UNICODE_GENERAL_CATEGORY_FORMAT;
}

/// Tells whether a letter must show ink. Marks need not be drawn, and some letters are blanks.
bool hasInk(UChar32 code) {
  const hb_unicode_general_category_t category = categoryOf(code);
  const bool mark = category == HB_UNICODE_GENERAL_CATEGORY_NON_SPACING_MARK ||
                    category == HB_UNICODE_GENERAL_CATEGORY_SPACING_MARK ||
                    category == HB_UNICODE_GENERAL_CATEGORY_ENCLOSING_MARK;
  const bool blank =
      code == 0x115F || code == 0x1160 || code == 0x2800 || code == 0x3164 || code == 0xFFA0 || code == 0x1D159;
  return !isSpace(code) && !isUnseen(code) && !mark && !blank;
}

/// Returns the height of H, because the height that a font states may be off by a third.
double capHeightOf(hb_font_t* font, double em) {
  hb_codepoint_t glyph = 0;
  hb_glyph_extents_t extents{};
  const bool drawn = hb_font_get_nominal_glyph(font, 'H', &glyph) != 0 &&
                     hb_font_get_glyph_extents(font, glyph, &extents) != 0 && extents.height < 0;
  return drawn ? -extents.height : kUsualCapHeight * em;
}

/// Reads the heights from which the base lines of drawings follow.
void measure(hb_font_t* font, ShapedLine& shaped) {
  hb_position_t height = 0;
  hb_font_extents_t extents{};
  if (hb_ot_metrics_get_position(font, HB_OT_METRICS_TAG_X_HEIGHT, &height) != 0) shaped.xHeight = height;
  if (hb_font_get_h_extents(font, &extents) == 0) return;
  shaped.ascent = extents.ascender;
  shaped.descent = -extents.descender;
}

/// A font; its bytes are owned elsewhere.
struct OpenFont {
  std::string name;
  Face face;
  Font font;
  double em = 0;
  double capHeight = 0;
  std::map<hb_codepoint_t, std::size_t> outlines;  ///< index in ShapedLine::outlines, by glyph
};

/// Opens a font. \param weight  0 for the font's own. \return nothing if the bytes are no font.
std::optional<OpenFont> opened(const std::string& name, std::string_view bytes, int weight = 0) {
  const Blob blob(
      hb_blob_create(bytes.data(), static_cast<unsigned>(bytes.size()), HB_MEMORY_MODE_READONLY, nullptr, nullptr));
  OpenFont open;
  open.name = name;
  open.face.reset(hb_face_create(blob.get(), 0));
  if (hb_face_get_glyph_count(open.face.get()) == 0) return std::nullopt;
  open.font.reset(hb_font_create(open.face.get()));
  const hb_variation_t variation{HB_TAG('w', 'g', 'h', 't'), static_cast<float>(weight)};
  if (weight > 0) hb_font_set_variations(open.font.get(), &variation, 1);
  open.em = hb_face_get_upem(open.face.get());
  open.capHeight = capHeightOf(open.font.get(), open.em);
  return open;
}

bool hasLetter(const OpenFont& font, UChar32 code) {
  hb_codepoint_t glyph = 0;
  return hb_font_get_nominal_glyph(font.font.get(), static_cast<hb_codepoint_t>(code), &glyph) != 0;
}

struct Glyph {
  hb_codepoint_t id = 0;
  std::size_t letter = 0;  ///< position of the first letter that the glyph stands for
  Vec2 offset;
  double advance = 0;
};

/// Glyphs that stand for the same letters.
struct Cluster {
  std::size_t first = 0, last = 0;  ///< first and last glyph
  std::size_t begin = 0, end = 0;   ///< range of letters
};

/// Groups glyphs by their letters. \param glyphs  glyphs of a run, from left to right.
std::vector<Cluster> clustersOf(const std::vector<Glyph>& glyphs, const TextRun& run) {
  std::vector<Cluster> clusters;
  for (std::size_t k = 0; k < glyphs.size(); ++k) {
    const std::size_t begin = glyphs[k].letter;
    if (!clusters.empty() && clusters.back().begin == begin) {
      clusters.back().last = k;
      continue;
    }
    Cluster cluster{k, k, begin, run.end};
    // The letters of a cluster end where those of the next cluster begin.
    if (!clusters.empty()) (run.toLeft ? cluster : clusters.back()).end = run.toLeft ? clusters.back().begin : begin;
    clusters.push_back(cluster);
  }
  return clusters;
}

/// Sets a line in its font; letters that the font lacks come from the first built-in font that has them.
class LineSetter {
 public:
  LineSetter(const std::string& line, OpenFont own) : letters_(lettersOf(line)) {
    shaped_.em = own.em;
    shaped_.capHeight = own.capHeight;
    measure(own.font.get(), shaped_);
    fonts_.push_back(std::move(own));
  }

  Result<ShapedLine> set() {
    for (const TextRun& run : textRuns(letters_)) {
      if (!setRun(run, 0)) return tooDetailed(fonts_.front().name);
    }
    return std::move(shaped_);
  }

 private:
  /// Returns the line's font (0) or a built-in fallback (1, 2, ...); null if there are no more.
  OpenFont* fontAt(std::size_t k) {
    while (k >= fonts_.size() && next_ < builtinFonts().size()) {
      const std::string name(builtinFonts()[next_++]);
      if (name != fonts_.front().name) fonts_.push_back(*opened(name, *builtinFont(name)));
    }
    return k < fonts_.size() ? &fonts_[k] : nullptr;
  }

  /// Shapes a run with a font; glyphs come from left to right.
  std::vector<Glyph> shape(const OpenFont& font, const TextRun& run) {
    hb_buffer_t* const buffer = buffer_.get();
    hb_buffer_reset(buffer);
    hb_buffer_add_utf16(buffer, reinterpret_cast<const std::uint16_t*>(letters_.data()),
                        static_cast<int>(letters_.size()), static_cast<unsigned>(run.begin),
                        static_cast<int>(run.end - run.begin));
    hb_buffer_set_direction(buffer, run.toLeft ? HB_DIRECTION_RTL : HB_DIRECTION_LTR);
    hb_buffer_set_language(buffer, hb_language_from_string("und", -1));  // the system's language would change results
    hb_buffer_set_flags(buffer, HB_BUFFER_FLAG_REMOVE_DEFAULT_IGNORABLES);
    hb_buffer_guess_segment_properties(buffer);
    hb_shape(font.font.get(), buffer, nullptr, 0);
    unsigned count = 0;
    const hb_glyph_info_t* infos = hb_buffer_get_glyph_infos(buffer, &count);
    const hb_glyph_position_t* places = hb_buffer_get_glyph_positions(buffer, &count);
    const double scale = scaleOf(font);
    std::vector<Glyph> glyphs;
    for (unsigned k = 0; k < count; ++k) {
      glyphs.push_back({infos[k].codepoint, infos[k].cluster,
                        Vec2{places[k].x_offset * scale, places[k].y_offset * scale}, places[k].x_advance * scale});
    }
    return glyphs;
  }

  /// Returns the scale that makes capitals of all fonts as high as those of the first font.
  [[nodiscard]] double scaleOf(const OpenFont& font) const {
    return &font == &fonts_.front() ? 1 : shaped_.capHeight / font.capHeight;
  }

  /// Finds or draws the outline of a glyph. \param outline  its index. \return false if there are too many curves.
  bool findOutline(OpenFont& font, hb_codepoint_t glyph, std::size_t& outline) {
    const auto [known, fresh] = font.outlines.try_emplace(glyph, shaped_.outlines.size());
    outline = known->second;
    if (!fresh) return true;
    Pen pen{{}, scaleOf(font), writer_.get()};
#if HB_VERSION_ATLEAST(11, 2, 0)
    if (hb_font_paint_glyph_or_fail(font.font.get(), glyph, parts_.get(), &pen, 0, HB_COLOR(0, 0, 0, 255)) == 0)
      hb_font_draw_glyph(font.font.get(), glyph, writer_.get(), &pen);
#elif HB_VERSION_ATLEAST(7, 0, 0)
    hb_font_draw_glyph(font.font.get(), glyph, writer_.get(), &pen);
#else
    hb_font_get_glyph_shape(font.font.get(), glyph, writer_.get(), &pen);
#endif
    length_ += pen.path.size();
    shaped_.outlines.push_back(std::move(pen.path));
    return length_ <= kMostPathBytes;
  }

  /// Sets a run. \param k  index of the font to begin with. \return false if there are too many curves.
  bool setRun(const TextRun& run, std::size_t k) {
    OpenFont& font = *fontAt(k);
    const std::vector<Glyph> glyphs = shape(font, run);
    const std::vector<Cluster> clusters = clustersOf(glyphs, run);
    for (std::size_t c = 0; c < clusters.size();) {
      TextRun lacking{run.end, run.begin, run.toLeft};
      std::size_t next = c;
      for (; next < clusters.size(); ++next) {
        bool has = false;
        if (!draws(font, glyphs, clusters[next], has)) return false;
        if (has) break;
        lacking.begin = std::min(lacking.begin, clusters[next].begin);
        lacking.end = std::max(lacking.end, clusters[next].end);
      }
      if (next > c && fontAt(k + 1) != nullptr) {
        if (!setRun(lacking, k + 1)) return false;
        c = next;
      }
      for (; c < next; ++c) tell(clusters[c], "");
      if (c == clusters.size()) break;
      if (k > 0) tell(clusters[c], font.name);
      for (std::size_t g = clusters[c].first; g <= clusters[c].last; ++g) {
        shaped_.letters.push_back({font.outlines.at(glyphs[g].id), glyphs[g].offset, glyphs[g].advance});
      }
      ++c;
    }
    return true;
  }

  /// Draws the outlines of a cluster.
  /// \param has  true if the font has these letters, with outlines where they need them.
  /// \return false if there are too many curves.
  bool draws(OpenFont& font, const std::vector<Glyph>& glyphs, const Cluster& cluster, bool& has) {
    bool ink = false;
    for (std::size_t g = cluster.first; g <= cluster.last; ++g) {
      if (glyphs[g].id == 0) return true;
      std::size_t outline = 0;
      if (!findOutline(font, glyphs[g].id, outline)) return false;
      ink = ink || !shaped_.outlines[outline].empty();
    }
    has = ink || !find(cluster, hasInk);
    return true;
  }

  /// Returns the first letter of a cluster for which `holds` is true.
  template <class Holds>
  std::optional<UChar32> find(const Cluster& cluster, const Holds& holds) const {
    for (std::size_t at = cluster.begin; at < cluster.end;) {
      const UChar32 code = codeAt(letters_, at);
      if (holds(code)) return code;
      at += U16_LENGTH(code);
    }
    return std::nullopt;
  }

  /// Reports a letter that comes from another font, or from none. Spaces are not reported.
  void tell(const Cluster& cluster, const std::string& font) {
    const OpenFont& own = fonts_.front();
    const auto absent =
        find(cluster, [&](UChar32 code) { return !isSpace(code) && !isUnseen(code) && !hasLetter(own, code); });
    const auto letter = absent ? absent : find(cluster, hasInk);
    if (letter) addLacked(shaped_.lacked, {utf8Of(*letter), font, !absent});
  }

  std::u16string letters_;
  std::deque<OpenFont> fonts_;
  std::size_t next_ = 0;  // index of the next built-in font to open
  Buffer buffer_{hb_buffer_create()};
  DrawFuncs writer_ = pathWriter();
#if HB_VERSION_ATLEAST(11, 2, 0)
  PaintFuncs parts_ = partsWriter();
#endif
  ShapedLine shaped_;
  std::size_t length_ = 0;  // size of all outlines [bytes]
};

}  // namespace

Result<ShapedLine> shapeLine(const ReadInput& read, const std::string& font, const std::string& line, int weight) {
  std::string file;
  std::optional<std::string_view> bytes = builtinFont(font);
  if (!bytes) {
    Result<InputFile> given = read(font, "font");
    if (!given) return isFontFile(font) ? given.error() : unknownFont(font);
    auto* content = std::get_if<std::string>(&given.value());
    if (content == nullptr) return noFont(font);
    std::optional<std::string> unpacked = unpackedFont(std::move(*content));
    if (!unpacked) return noFont(font);
    file = std::move(*unpacked);
    bytes = file;
  }
  std::optional<OpenFont> own = opened(font, *bytes, weight);
  if (!own) return noFont(font);
  return LineSetter(line, std::move(*own)).set();
}

}  // namespace sillon
