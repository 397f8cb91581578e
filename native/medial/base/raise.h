// SPDX-License-Identifier: GPL-3.0-or-later
// A maximum that several threads find together.
#pragma once

#include "base/atomic.h"

namespace medial {

inline void raise(float& value, float to) {
  float now = shared_load(value);
  while (now < to && !shared_exchange(value, now, to)) {
  }
}

}  // namespace medial
