// SPDX-License-Identifier: GPL-3.0-or-later
// The parameters of a stage besides its data, and the arrays that it returns.
#pragma once

#include "base/arena.h"
#include "base/progress.h"

namespace medial {

// The parameters of every stage besides its data.
struct Run {
  int threads = 1;
  Progress* progress = nullptr;
  Arena* arena = nullptr;
};

// Elements without a value, or with the same one.
template <typename T>
Array<T> array(size_t count, const Run& run) {
  return Array<T>(count, ArenaAllocator<T>(run.arena));
}
template <typename T>
Array<T> array(size_t count, const T& value, const Run& run) {
  return Array<T>(count, value, ArenaAllocator<T>(run.arena));
}

// A copy that is as long as it has to be.
template <typename Values>
Array<typename Values::value_type> pack(const Values& values, const Run& run) {
  return {values.begin(), values.end(), ArenaAllocator<typename Values::value_type>(run.arena)};
}

}  // namespace medial
