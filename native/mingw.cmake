# SPDX-License-Identifier: GPL-3.0-or-later
# Windows x64 from Debian: g++-mingw-w64-x86-64-posix. What the modules need of the compiler is linked into them.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR AMD64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_AR x86_64-w64-mingw32-gcc-ar-posix)
set(CMAKE_RANLIB x86_64-w64-mingw32-gcc-ranlib-posix)
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_MODULE_LINKER_FLAGS_INIT "-static -Wl,--no-insert-timestamp") # the same bytes tomorrow
find_program(CMAKE_CROSSCOMPILING_EMULATOR NAMES wine64 wine PATHS /usr/lib/wine) # for the tests
# CGAL and Boost are headers alone, the same for all systems; those of the C library beside them are not.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/include)
foreach(library CGAL boost)
  file(CREATE_LINK /usr/include/${library} ${CMAKE_BINARY_DIR}/include/${library} SYMBOLIC)
endforeach()
set(CGAL_INCLUDE_DIR ${CMAKE_BINARY_DIR}/include CACHE PATH "")
set(BOOST_INCLUDE_DIR ${CMAKE_BINARY_DIR}/include CACHE PATH "")
