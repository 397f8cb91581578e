// SPDX-License-Identifier: GPL-3.0-or-later
// This header sets CGAL up. All units that use CGAL must include it before any of CGAL's headers,
// so that CGAL's templates are the same in all of them.
#pragma once

// CGAL's containers also allocate from the arena of the run.
#define CGAL_ALLOCATOR(T) medial::RunAllocator<T>
#include "base/arena.h"

namespace medial {

inline thread_local Arena* run_arena = nullptr;

struct InArena {
  explicit InArena(Arena* arena) { run_arena = arena; }
  ~InArena() { run_arena = nullptr; }
  InArena(const InArena&) = delete;
};

template <typename T>
struct RunAllocator : ArenaAllocator<T> {
  RunAllocator() : ArenaAllocator<T>(run_arena) {}
  template <typename U>
  RunAllocator(const RunAllocator<U>& other) : ArenaAllocator<T>(other.arena) {}
  template <typename U>
  struct rebind {
    using other = RunAllocator<U>;
  };
};

// In a module that is loaded late, thread-local variables are found by a call, and the compiler
// makes one at each use: in CGAL's innermost loop these calls took a tenth of its time. This
// function makes the compiler find the address only once.
template <typename T>
T& found_once(T& variable) {
  T* address = &variable;
#ifdef __GNUC__
  asm("" : "+r"(address));  // hides from the compiler whose address it is
#endif
  return *address;
}

}  // namespace medial

#include <CGAL/tss.h>
#include <CGAL/version.h>
#if CGAL_VERSION_NR < 1050200000 || CGAL_VERSION_NR >= 1070000000
#error \
    "Expected CGAL 5.2 to 6.x; look whether CGAL_ALLOCATOR and CGAL_STATIC_THREAD_LOCAL_VARIABLE_0 are what they were."
#endif
#ifndef CGAL_STATIC_THREAD_LOCAL_VARIABLE_0
#error \
    "Expected CGAL to declare its thread-local variables by CGAL_STATIC_THREAD_LOCAL_VARIABLE_0; look for what it uses instead."
#endif
#undef CGAL_STATIC_THREAD_LOCAL_VARIABLE_0
#define CGAL_STATIC_THREAD_LOCAL_VARIABLE_0(TYPE, VARIABLE) \
  static thread_local TYPE VARIABLE##_of_thread;            \
  TYPE& VARIABLE = medial::found_once(VARIABLE##_of_thread)
