# SPDX-License-Identifier: GPL-3.0-or-later
# The CMake package `medial`: find_package(medial CONFIG), then the target medial::medial.
include(CMakeFindDependencyMacro)
find_dependency(Threads)
include(${CMAKE_CURRENT_LIST_DIR}/medial-targets.cmake)
