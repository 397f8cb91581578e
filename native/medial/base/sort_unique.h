// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

namespace medial {

// Sorts values in ascending order and keeps one of equal ones.
template <typename Values>
void sort_unique(Values& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace medial
