// SPDX-License-Identifier: GPL-3.0-or-later
// How CGAL is set up; to be included before any of its headers, and by all units that include them,
// so that they agree on what CGAL's templates are.
#pragma once

// CGAL's containers, too, take their memory from the arena of the run.
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

// A module that is loaded late finds its thread-local variables by a call, and the compiler makes
// one at each use: in CGAL's innermost loop these calls took a tenth of its time. Here the address
// is found once.
template <typename T>
T& found_once(T& variable) {
  T* address = &variable;
#ifdef __GNUC__
  asm("" : "+r"(address));  // the compiler no longer knows whose it is
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
