# The same bytes everywhere, from HarfBuzz too: no fused multiply-add. And sqrt is one instruction, whose value is the same.
if(MSVC)
  set(sillon_exact /fp:strict)
else()
  set(sillon_exact -ffp-contract=off -fno-math-errno)
endif()
# GCC's vectoriser multiplies and adds in one step, whatever -ffp-contract says, where the builder's flags allow the
# processor to (-march=native, x86-64-v3): some moves of G-code would end 0.001 mm beside those of other machines.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|i.86)$")
  set(sillon_unfused -mno-fma -mno-fma4 -mno-avx512f)
endif()
# Flags of every target of ours. Libraries come in as SYSTEM and see none of the warnings.
add_library(sillon_flags INTERFACE)
target_compile_features(sillon_flags INTERFACE cxx_std_20)
if(MSVC)
  target_compile_options(sillon_flags INTERFACE /W4 ${sillon_exact} /utf-8)
else()
  target_compile_options(sillon_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wconversion
    -Wno-sign-conversion # clang's -Wconversion holds it, GCC's does not: an index that is an int needs no cast
    ${sillon_exact}
    -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=)  # asserts name files: the same bytes and sizes wherever it is built
  # Version 12 takes its own std::string for what it is not, wherever texts are put together.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(sillon_flags INTERFACE -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
  endif()
  target_compile_options(sillon_flags INTERFACE ${sillon_unfused})
  if(SILLON_WERROR)
    target_compile_options(sillon_flags INTERFACE -Werror)
  endif()
endif()
if(EMSCRIPTEN)
  target_compile_options(sillon_flags INTERFACE
    -msimd128
    -mnontrapping-fptoint)  # without, each float to int costs a range check; every engine with SIMD has it
endif()
# What is compiled for threads links without them too, so the core is compiled once for both engines; except for what throws:
# its state is each thread's own there, and one for all here.
add_library(sillon_pthread INTERFACE)
if(EMSCRIPTEN)
  target_compile_options(sillon_pthread INTERFACE -pthread)
endif()
if(SILLON_SANITIZE)
  target_compile_options(sillon_flags INTERFACE -fsanitize=${SILLON_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(sillon_flags INTERFACE -fsanitize=${SILLON_SANITIZE})
endif()
# -O3 over CMake's default -O3 -DNDEBUG: asserts are cheap here and stay on, a broken invariant must not print a plate.
string(REPLACE "-DNDEBUG" "" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")

# The standard headers that most sources use, read once per target instead of once per source: a third of the time of a
# build. Sources include what they need all the same; the preset `clang`, which builds without, tells.
function(sillon_precompile target)
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <functional> <limits> <memory> <numeric> <optional> <string> <string_view>
    <utility> <variant> <vector> ${ARGN})
endfunction()
