# The target sillon::text: HarfBuzz, which shapes letters, where it is no part of the library (SILLON_HARFBUZZ_INSIDE), ICU,
# which orders the runs of a line, Brotli, which unpacks web fonts, and libqrcodegen, which makes QR codes. Packages of vcpkg bring CMake files; Debian's do not.
if(NOT TARGET sillon::text)
  add_library(sillon::text INTERFACE IMPORTED GLOBAL)

  # A program of ours starts where these libraries are not installed. The library alone takes what its user's linker would:
  # a static archive need not fit into a plugin.
  function(sillon_text_archive result name)
    set(names ${name})
    if(SILLON_CLI)
      set(names ${CMAKE_STATIC_LIBRARY_PREFIX}${name}${CMAKE_STATIC_LIBRARY_SUFFIX} ${name})
    endif()
    find_library(${result} NAMES ${names} REQUIRED)
  endfunction()

  function(sillon_text_library package target header library)
    find_package(${package} CONFIG QUIET)
    if(TARGET ${target})
      target_link_libraries(sillon::text INTERFACE ${target})
      get_target_property(folders ${target} INTERFACE_INCLUDE_DIRECTORIES)
      # The packages keep their headers in a folder of their own, and only some of them say so.
      find_path(${library}_include NAMES ${header} PATH_SUFFIXES ${ARGN} HINTS ${folders} REQUIRED)
    else()
      find_path(${library}_include NAMES ${header} PATH_SUFFIXES ${ARGN} REQUIRED)
      sillon_text_archive(${library}_library ${library})
      target_link_libraries(sillon::text INTERFACE ${${library}_library})
    endif()
    target_include_directories(sillon::text SYSTEM INTERFACE ${${library}_include})
  endfunction()

  if(NOT SILLON_HARFBUZZ_INSIDE)
    sillon_text_library(harfbuzz harfbuzz::harfbuzz hb.h harfbuzz harfbuzz)
  endif()
  sillon_text_library(nayuki-qr-code-generator nayuki-qr-code-generator::nayuki-qr-code-generator qrcodegen.hpp qrcodegencpp
                      qrcodegen nayuki-qr-code-generator)
  sillon_text_library(unofficial-brotli unofficial::brotli::brotlidec brotli/decode.h brotlidec)
  if(NOT TARGET unofficial::brotli::brotlidec)
    sillon_text_archive(brotlicommon_library brotlicommon)
    target_link_libraries(sillon::text INTERFACE ${brotlicommon_library})
  endif()
  # Archives of ICU give a program of ours what it asks for, 0.2 MB, and it needs none of the 31 MB of data. CMake's own module finds
  # ICU, and its targets would be unknown outside this folder.
  function(sillon_text_icu)
    if(SILLON_CLI)
      set(CMAKE_FIND_LIBRARY_SUFFIXES ${CMAKE_STATIC_LIBRARY_SUFFIX} ${CMAKE_FIND_LIBRARY_SUFFIXES})
    endif()
    find_package(ICU REQUIRED COMPONENTS uc data)
    target_link_libraries(sillon::text INTERFACE ${ICU_LIBRARIES} ${CMAKE_DL_LIBS})
    target_include_directories(sillon::text SYSTEM INTERFACE ${ICU_INCLUDE_DIRS})
  endfunction()
  sillon_text_icu()
endif()
