// SPDX-License-Identifier: GPL-3.0-or-later
// Several threads find a maximum or minimum together.
#pragma once

#include <cstdint>

#include "base/atomic.h"

namespace medial {

inline void raise(float& value, float to) {
  float now = shared_load(value);
  while (now < to && !shared_exchange(value, now, to)) {
  }
}

inline void lower(int32_t& value, int32_t to) {
  int32_t now = shared_load(value);
  while (now > to && !shared_exchange(value, now, to)) {
  }
}

}  // namespace medial
