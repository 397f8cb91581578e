// SPDX-License-Identifier: GPL-3.0-or-later
// A Run has the parameters of a stage except its data; the functions make the arrays that stages
// return.
#pragma once

#include "base/arena.h"
#include "base/progress.h"

namespace medial {

// The parameters of every stage besides its data.
struct Run {
  int threads = 1;
  Progress* progress = nullptr;
  Arena* arena = nullptr;
  bool moves_bar = true;  // whether loops tell how far they are; cancelling always stops them
};

// Makes an array whose elements are uninitialised, or all have the same value.
template <typename T>
Array<T> array(size_t count, const Run& run) {
  return Array<T>(count, ArenaAllocator<T>(run.arena));
}
template <typename T>
Array<T> array(size_t count, const T& value, const Run& run) {
  return Array<T>(count, value, ArenaAllocator<T>(run.arena));
}

// Makes a copy without spare capacity.
template <typename Values>
Array<typename Values::value_type> pack(const Values& values, const Run& run) {
  return {values.begin(), values.end(), ArenaAllocator<typename Values::value_type>(run.arena)};
}

}  // namespace medial
