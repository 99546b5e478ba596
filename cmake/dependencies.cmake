# Libraries by package manager; nothing is copied or downloaded. Debian: see ./dev; elsewhere: vcpkg.json.
find_package(Threads REQUIRED)

# Header-only packages become SYSTEM interface targets, so that our warnings stay ours.
function(sillon_header_library target header)
  find_path(${target}_include NAMES ${header} PATH_SUFFIXES ${ARGN} REQUIRED)
  add_library(${target} INTERFACE)
  target_include_directories(${target} SYSTEM INTERFACE ${${target}_include})
endfunction()

sillon_header_library(sillon_eigen Eigen/Core eigen3)
sillon_header_library(sillon_stb stb_image.h stb)  # Debian keeps it in include/stb
sillon_header_library(sillon_json nlohmann/json.hpp)
sillon_header_library(sillon_fast_float fast_float/fast_float.h)
sillon_header_library(sillon_rapidxml rapidxml/rapidxml.hpp)
if(SILLON_EXAMPLES)
  sillon_header_library(sillon_cli11 CLI/CLI.hpp)
endif()
if(SILLON_TESTS)
  sillon_header_library(sillon_doctest doctest/doctest.h)
endif()
