# The target sillon::text: HarfBuzz, which shapes letters, and libqrcodegen, which makes QR codes. Packages of vcpkg bring CMake
# files; Debian's do not.
if(NOT TARGET sillon::text)
  add_library(sillon::text INTERFACE IMPORTED GLOBAL)
  function(sillon_text_library package target header library)
    find_package(${package} CONFIG QUIET)
    if(TARGET ${target})
      target_link_libraries(sillon::text INTERFACE ${target})
      get_target_property(folders ${target} INTERFACE_INCLUDE_DIRECTORIES)
      # The packages keep their headers in a folder of their own, and only some of them say so.
      find_path(${library}_include NAMES ${header} PATH_SUFFIXES ${ARGN} HINTS ${folders} REQUIRED)
    else()
      find_path(${library}_include NAMES ${header} PATH_SUFFIXES ${ARGN} REQUIRED)
      find_library(${library}_library NAMES ${library} REQUIRED)
      target_link_libraries(sillon::text INTERFACE ${${library}_library})
    endif()
    target_include_directories(sillon::text SYSTEM INTERFACE ${${library}_include})
  endfunction()
  sillon_text_library(harfbuzz harfbuzz::harfbuzz hb.h harfbuzz harfbuzz)
  sillon_text_library(nayuki-qr-code-generator nayuki-qr-code-generator::nayuki-qr-code-generator qrcodegen.hpp qrcodegencpp
                      qrcodegen nayuki-qr-code-generator)
endif()
