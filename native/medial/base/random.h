// SPDX-License-Identifier: GPL-3.0-or-later
// These random numbers depend only on their input: they are the same on every machine.
#pragma once

#include <cstdint>

namespace medial {

// The mixing step of SplitMix64 (Steele, Lea & Flood 2014): neighbouring numbers give unrelated
// ones.
inline uint64_t scrambled(uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// Maps a scrambled number to [0, 1).
inline double unit(uint64_t scrambled) { return static_cast<double>(scrambled >> 11) * 0x1p-53; }

}  // namespace medial
