// SPDX-License-Identifier: GPL-3.0-or-later
// Does what std::nth_element does, but leaves the same order with every C++ library: sums over the
// halves, and ties between their items, depend on it.
#pragma once

#include <algorithm>
#include <cstddef>

#include "base/random.h"

namespace medial {

// Reorders a range such that no item before `nth` is behind it by `before`, and none after it is
// before it (Hoare's selection, with scrambled pivots).
template <typename Iterator, typename Before>
void select(Iterator first, Iterator nth, Iterator last, const Before& before) {
  while (last - first > 1) {
    // The last item is never the pivot, so that both parts have items.
    const auto others = static_cast<uint64_t>(last - first - 1);
    const auto pivot = *(first + static_cast<std::ptrdiff_t>(scrambled(others) % others));
    Iterator low = first, high = last - 1;
    for (;; ++low, --high) {
      while (before(*low, pivot)) ++low;
      while (before(pivot, *high)) --high;
      if (low >= high) break;
      std::iter_swap(low, high);
    }
    (nth <= high ? last : first) = high + 1;
  }
}

}  // namespace medial
