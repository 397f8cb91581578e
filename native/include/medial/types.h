// SPDX-License-Identifier: GPL-3.0-or-later
// The words of the library: points, ids, sides. All data are plain arrays of these.
//
// Ids are rows of the caller's arrays, int32_t; -1 means none. Angles are radians; lengths are in
// the unit of the input.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace medial {

// A point or vector of R^3: three contiguous doubles, so that an (n, 3) array is a span of Vec3.
struct Vec3 {
  double x = 0, y = 0, z = 0;

  friend bool operator==(const Vec3&, const Vec3&) = default;
};

// These are rows of the corners, or of the ends.
using Triangle = std::array<int32_t, 3>;
using Edge = std::array<int32_t, 2>;

// The side is that of the axis to which a facet belongs. As an argument `both` selects every facet,
// as a value it means "unknown"; `crossing` is only a value: the facet is partly inside.
enum class Side : uint8_t { both = 0, inner = 1, outer = 2, crossing = 3 };

// Timings are the seconds of the stages of a computation, in order.
using Timings = std::vector<std::pair<std::string, double>>;

// This allocator leaves elements uninitialised until they are written: large results are written
// once, on all cores.
template <typename T>
struct UnsetAllocator : std::allocator<T> {
  template <typename U>
  struct rebind {
    using other = UnsetAllocator<U>;
  };

  UnsetAllocator() = default;
  template <typename U>
  UnsetAllocator(const UnsetAllocator<U>& other) noexcept : std::allocator<T>(other) {}

  template <typename U>
  void construct(U*) noexcept {}
  template <typename U, typename... Values>
  void construct(U* element, Values&&... values) {
    ::new (static_cast<void*>(element)) U(std::forward<Values>(values)...);
  }
};

// A column of a result is a std::vector whose `resize` leaves new elements uninitialised.
template <typename T>
using Column = std::vector<T, UnsetAllocator<T>>;

}  // namespace medial
