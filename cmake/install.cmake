# cmake --install build/release --prefix P: headers, the static library, what find_package and pkg-config read, licences,
# and the command line where it is built. All of it finds itself from where it lies: P may be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS sillon_core EXPORT sillonTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY core/include/sillon DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/sillon)
install(EXPORT sillonTargets NAMESPACE sillon:: DESTINATION ${package_folder})
configure_package_config_file(cmake/sillonConfig.cmake.in ${PROJECT_BINARY_DIR}/sillonConfig.cmake
  INSTALL_DESTINATION ${package_folder})
# Below 1.0 names may change between minor versions.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/sillonConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/sillonConfig.cmake ${PROJECT_BINARY_DIR}/sillonConfigVersion.cmake
  cmake/sillonText.cmake
  DESTINATION ${package_folder})

file(RELATIVE_PATH SILLON_PC_TO_PREFIX /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
set(SILLON_PC_PRIVATE "")
if(SILLON_TEXT)
  set(SILLON_PC_PRIVATE "-lqrcodegencpp -licuuc -licudata -lbrotlidec -lbrotlicommon")
  if(NOT SILLON_HARFBUZZ_INSIDE)
    string(PREPEND SILLON_PC_PRIVATE "-lharfbuzz ")
  endif()
endif()
configure_file(cmake/sillon.pc.in ${PROJECT_BINARY_DIR}/sillon.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/sillon.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

install(FILES LICENSE THIRD-PARTY.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(TARGET sillon)
  install(TARGETS sillon RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
