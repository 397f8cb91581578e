// SPDX-License-Identifier: GPL-3.0-or-later
// These functions let several threads change plain memory at the same time, with relaxed order.
// They stand in for std::atomic_ref, which libc++ before 19 lacks.
#pragma once

#include <cstdint>

#ifndef __GNUC__
#include <atomic>
#endif

namespace medial {

// Returns the previous value.
template <typename T>
T shared_add(T& memory, T value) {
#ifdef __GNUC__
  return __atomic_fetch_add(&memory, value, __ATOMIC_RELAXED);
#else
  return std::atomic_ref(memory).fetch_add(value, std::memory_order_relaxed);
#endif
}

template <typename T>
void shared_or(T& memory, T bits) {
#ifdef __GNUC__
  __atomic_fetch_or(&memory, bits, __ATOMIC_RELAXED);
#else
  std::atomic_ref(memory).fetch_or(bits, std::memory_order_relaxed);
#endif
}

template <typename T>
T shared_load(const T& memory) {
#ifdef __GNUC__
  T value;
  __atomic_load(&memory, &value, __ATOMIC_RELAXED);
  return value;
#else
  return std::atomic_ref(const_cast<T&>(memory)).load(std::memory_order_relaxed);
#endif
}

// Writes `wanted` and returns true if the memory holds `expected`. Otherwise `expected` becomes the
// value found.
template <typename T>
bool shared_exchange(T& memory, T& expected, T wanted) {
#ifdef __GNUC__
  return __atomic_compare_exchange(&memory, &expected, &wanted, false, __ATOMIC_RELAXED,
                                   __ATOMIC_RELAXED);
#else
  return std::atomic_ref(memory).compare_exchange_strong(expected, wanted,
                                                         std::memory_order_relaxed);
#endif
}

template <typename T>
void shared_store(T& memory, T value) {
#ifdef __GNUC__
  __atomic_store_n(&memory, value, __ATOMIC_RELAXED);
#else
  std::atomic_ref(memory).store(value, std::memory_order_relaxed);
#endif
}

// Several threads find a maximum, or a minimum, together.
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
