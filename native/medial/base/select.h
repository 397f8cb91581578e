// SPDX-License-Identifier: GPL-3.0-or-later
// Does what std::nth_element does, but leaves the same order with every C++ library: sums over the
// halves, and ties between their items, depend on it.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>

#include "base/random.h"

namespace medial {

// Moves the median of the first item, the middle one and the last one to the front.
template <typename Iterator, typename Before>
void move_pivot_to_front(Iterator first, Iterator last, const Before& before) {
  const Iterator a = first + 1, b = first + (last - first) / 2, c = last - 1;
  const auto median = [&] {
    if (before(*a, *b)) return before(*b, *c) ? b : before(*a, *c) ? c : a;
    return before(*a, *c) ? a : before(*b, *c) ? c : b;
  };
  std::iter_swap(first, median());
}

// Reorders a range such that no item before `nth` is behind it by `before`, and none after it is
// before it: Hoare's selection by medians of three, in the order of GNU's C++ library.
template <typename Iterator, typename Before>
void select(Iterator first, Iterator nth, Iterator last, const Before& before) {
  auto rounds = 2 * std::bit_width(static_cast<size_t>(last - first));
  while (last - first > 3) {
    const auto count = static_cast<uint64_t>(last - first);
    if (rounds == 0) std::iter_swap(first + 1, first + 1 + scrambled(count) % (count - 1));
    if (rounds > 0) --rounds;
    move_pivot_to_front(first, last, before);
    Iterator low = first + 1, high = last;
    for (;; ++low) {
      while (before(*low, *first)) ++low;
      --high;
      while (before(*first, *high)) --high;
      if (low >= high) break;
      std::iter_swap(low, high);
    }
    (low <= nth ? first : last) = low;
  }
  for (Iterator end = first; end != last; ++end) {
    for (Iterator at = end; at != first && before(*at, *(at - 1)); --at) std::iter_swap(at, at - 1);
  }
}

}  // namespace medial
