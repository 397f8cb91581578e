// SPDX-License-Identifier: GPL-3.0-or-later
// A maximum that several threads find together.
#pragma once

#include <atomic>

namespace medial {

inline void raise(float& value, float to) {
  const std::atomic_ref shared(value);
  float now = shared.load(std::memory_order_relaxed);
  while (now < to && !shared.compare_exchange_weak(now, to, std::memory_order_relaxed)) {
  }
}

}  // namespace medial
