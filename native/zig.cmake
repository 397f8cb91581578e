# SPDX-License-Identifier: GPL-3.0-or-later
# Another system from Debian, by zig's Clang and its C++ library, which is linked into the modules. zig.py brings zig,
# the commands that compile for one target each, and newer headers of CGAL and Boost than Debian 12 has.
set(CMAKE_SYSTEM_NAME ${MEDIAL_SYSTEM_NAME})
set(CMAKE_SYSTEM_PROCESSOR ${MEDIAL_SYSTEM_PROCESSOR})
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES MEDIAL_SYSTEM_NAME MEDIAL_SYSTEM_PROCESSOR MEDIAL_ZIG_COMMANDS)
set(CMAKE_CXX_COMPILER ${MEDIAL_ZIG_COMMANDS}/c++)
set(CMAKE_AR ${MEDIAL_ZIG_COMMANDS}/ar CACHE FILEPATH "")
set(CMAKE_RANLIB ${MEDIAL_ZIG_COMMANDS}/ranlib CACHE FILEPATH "")
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_OSX_SYSROOT "" CACHE PATH "")  # zig brings its own
if(CMAKE_SYSTEM_NAME STREQUAL Linux)
  set(CMAKE_LIBRARY_ARCHITECTURE ${CMAKE_SYSTEM_PROCESSOR}-linux-gnu)  # as names of modules have it
endif()
# Messages of Boost and CGAL name the files that they come from, and no module may name the folder of its build.
get_filename_component(root ${CMAKE_CURRENT_LIST_DIR}/.. ABSOLUTE)
set(CMAKE_CXX_FLAGS_INIT "-fmacro-prefix-map=${root}/=")
if(CMAKE_SYSTEM_NAME STREQUAL Darwin)
  # Apple's math.h asks float.h for INFINITY and NAN alone, after which the C++ library's float.h gives nothing more:
  # so both parts come first.
  string(APPEND CMAKE_CXX_FLAGS_INIT " -include float.h -include __float_infinity_nan.h")
endif()
if(CMAKE_SYSTEM_NAME STREQUAL Linux)
  string(APPEND CMAKE_CXX_FLAGS_INIT " -I${CMAKE_CURRENT_LIST_DIR}/old_glibc")
endif()
set(CGAL_INCLUDE_DIR ${root}/build/zig/include CACHE PATH "")
set(BOOST_INCLUDE_DIR ${CGAL_INCLUDE_DIR} CACHE PATH "")
