# Libraries by package manager; nothing is copied or downloaded. Debian: see ./dev; elsewhere: vcpkg.json.
if(NOT EMSCRIPTEN)
  find_package(Threads REQUIRED)
endif()

if(SILLON_TEXT)
  include(cmake/harfbuzz.cmake)
  include(cmake/sillonText.cmake)
endif()

# Header-only packages become SYSTEM interface targets, so that our warnings stay ours.
function(sillon_header_library target header)
  # Cross-compiling looks nowhere by itself; headers are the same for every machine.
  find_path(${target}_include NAMES ${header} PATH_SUFFIXES ${ARGN} REQUIRED NO_CMAKE_FIND_ROOT_PATH
            PATHS /usr/include /usr/local/include /opt/homebrew/include)
  set(folder ${${target}_include})
  if(CMAKE_CROSSCOMPILING)
    # The host's whole include folder would shadow the headers of the other system: only what is wanted is linked into ours.
    string(REGEX REPLACE "[./].*" "" name ${header})
    file(GLOB wanted ${folder}/${name}*)
    file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/include)
    foreach(path ${wanted})
      get_filename_component(link ${path} NAME)
      file(CREATE_LINK ${path} ${PROJECT_BINARY_DIR}/include/${link} SYMBOLIC)
    endforeach()
    set(folder ${PROJECT_BINARY_DIR}/include)
  endif()
  add_library(${target} INTERFACE)
  target_include_directories(${target} SYSTEM INTERFACE ${folder})
endfunction()

sillon_header_library(sillon_eigen Eigen/Core eigen3)
target_compile_definitions(sillon_eigen INTERFACE EIGEN_DONT_VECTORIZE)  # same bytes everywhere: sums keep their order
sillon_header_library(sillon_stb stb_image.h stb)  # Debian keeps it in include/stb
sillon_header_library(sillon_json nlohmann/json.hpp)
sillon_header_library(sillon_fast_float fast_float/fast_float.h)
sillon_header_library(sillon_rapidxml rapidxml/rapidxml.hpp)
if(SILLON_CLI)
  sillon_header_library(sillon_cli11 CLI/CLI.hpp)
endif()
if(SILLON_CLI AND SILLON_WEBP)
  include(cmake/webp.cmake)
endif()
if(SILLON_TESTS)
  sillon_header_library(sillon_doctest doctest/doctest.h)
endif()
