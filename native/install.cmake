# SPDX-License-Identifier: GPL-3.0-or-later
# Installs everything that a C++ project needs: find_package(medial) then gives the target medial::medial.
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/medial)

install(TARGETS medial EXPORT medial-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT cpp)
install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/include/medial DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT cpp FILES_MATCHING PATTERN *.h)
install(EXPORT medial-targets NAMESPACE medial:: DESTINATION ${package_folder} COMPONENT cpp)
# While the first number is 0, the second one says what fits together.
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/medial-config-version.cmake
  VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/medial-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/medial-config-version.cmake
  DESTINATION ${package_folder} COMPONENT cpp)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/licenses/medial
  COMPONENT cpp)
