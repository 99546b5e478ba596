# HarfBuzz out of its own sources, as a part of the library: what is released needs no library beside it, and shapes letters as
# the version in npm's harfbuzzjs does. Without sources sillonText.cmake looks for the system's.
set(SILLON_HARFBUZZ "" CACHE PATH "Sources of HarfBuzz (./dev fetches them), which become part of the library; empty: the system's is linked")
set(SILLON_HARFBUZZ_INSIDE OFF)
if(SILLON_HARFBUZZ)
  set(SILLON_HARFBUZZ_INSIDE ON)
  set(amalgam ${SILLON_HARFBUZZ}/src/harfbuzz.cc)
  if(NOT EXISTS ${amalgam})
    message(FATAL_ERROR "SILLON_HARFBUZZ is \"${SILLON_HARFBUZZ}\", which holds no src/harfbuzz.cc; ./dev build fetches the sources, "
                        "-DSILLON_HARFBUZZ= takes the system's HarfBuzz")
  endif()
  add_library(sillon_harfbuzz OBJECT ${amalgam})
  target_compile_features(sillon_harfbuzz PRIVATE cxx_std_17)
  target_compile_options(sillon_harfbuzz PRIVATE ${sillon_exact} ${sillon_unfused})
  # harfbuzzjs does without these, and fonts that have them would else look different here. Its smaller tables and its lack of
  # locks change no letter, and are left alone.
  target_compile_definitions(sillon_harfbuzz PRIVATE
    HB_EXPERIMENTAL_API HB_USE_INTERNAL_QSORT HB_NO_AAT HB_NO_LEGACY HB_NO_BEYOND_64K HB_NO_VERTICAL HB_NO_HINTING HB_NO_BITMAP
    HB_NO_SVG HB_NO_UCD_UNASSIGNED)
  # A library that depends on neither the environment, nor the locale, nor files, and ends no program by an assert; and what
  # nothing here asks for.
  target_compile_definitions(sillon_harfbuzz PRIVATE
    NDEBUG HB_NO_GETENV HB_NO_SETLOCALE HB_NO_OPEN HB_NO_MMAP HB_NO_ERRNO HB_DISABLE_DEPRECATED HB_NO_BUFFER_MESSAGE
    HB_NO_BUFFER_SERIALIZE HB_NO_BUFFER_VERIFY HB_NO_FACE_COLLECT_UNICODES HB_NO_LAYOUT_COLLECT_GLYPHS
    HB_NO_LAYOUT_FEATURE_PARAMS HB_NO_MATH HB_NO_META HB_NO_NAME HB_NO_OT_FETCH HB_NO_OT_FONT_GLYPH_NAMES HB_NO_STYLE)
  if(MSVC)
    target_compile_options(sillon_harfbuzz PRIVATE /bigobj /utf-8)
  else()
    # -O3 takes compilers twice as long, and no plate has letters enough to notice. It throws nothing and catches nothing.
    target_compile_options(sillon_harfbuzz PRIVATE $<$<CONFIG:Release>:-O1> -fno-exceptions -w)
  endif()
  # Whoever uses the library may have a HarfBuzz beside it: ours shows itself to nobody but us.
  set_target_properties(sillon_harfbuzz PROPERTIES
    POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endif()
