# Flags of every target of ours. Libraries come in as SYSTEM and see none of the warnings.
add_library(sillon_flags INTERFACE)
if(MSVC)
  target_compile_options(sillon_flags INTERFACE /W4 /fp:strict /utf-8)
else()
  target_compile_options(sillon_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wconversion
    -ffp-contract=off   # same bytes everywhere: no fused multiply-add
    -fno-math-errno)    # sqrt becomes one instruction; its value does not change
  if(SILLON_WERROR)
    target_compile_options(sillon_flags INTERFACE -Werror)
  endif()
endif()
if(EMSCRIPTEN)
  target_compile_options(sillon_flags INTERFACE
    -msimd128
    -mnontrapping-fptoint)  # without, each float to int costs a range check; every engine with SIMD has it
  if(SILLON_WASM_THREADS)
    target_compile_options(sillon_flags INTERFACE -pthread)
    target_link_options(sillon_flags INTERFACE -pthread)
  endif()
endif()
if(SILLON_SANITIZE)
  target_compile_options(sillon_flags INTERFACE -fsanitize=${SILLON_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(sillon_flags INTERFACE -fsanitize=${SILLON_SANITIZE})
endif()
# -O3 over CMake's default -O3 -DNDEBUG: asserts are cheap here and stay on, a broken invariant must not print a plate.
string(REPLACE "-DNDEBUG" "" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
