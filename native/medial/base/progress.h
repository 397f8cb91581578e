// SPDX-License-Identifier: GPL-3.0-or-later
// Reports of the stages to a Progress, where there is one.
#pragma once

#include <medial/progress.h>

namespace medial {

inline void begin_stage(Progress* progress, const char* name, double from, double to) {
  if (progress) progress->begin_stage(name, from, to);
}
inline void throw_if_cancelled(const Progress* progress) {
  if (progress && progress->cancelled()) throw Cancelled();
}
inline void advance(Progress* progress, double share) {
  if (progress) progress->advance(share);
}

}  // namespace medial
