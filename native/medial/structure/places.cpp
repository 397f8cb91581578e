// SPDX-License-Identifier: GPL-3.0-or-later
#include "structure/places.h"

#include "base/rows.h"

namespace medial {
namespace {

// Sorts ids by a coordinate, and those that follow each other closely by the next one.
void arrange(std::span<const Placed> things, std::span<int32_t> ids, int axis) {
  if (axis > 2 || ids.size() < 2) return;
  const auto at = [&](int32_t id) { return coordinate(things[id].place, axis); };
  std::stable_sort(ids.begin(), ids.end(), [&](int32_t a, int32_t b) { return at(a) < at(b); });
  for (size_t begin = 0, end = 0; begin < ids.size(); begin = end) {
    for (end = begin + 1; end < ids.size(); ++end) {
      const double apart = std::max(things[ids[end - 1]].apart, things[ids[end]].apart);
      if (at(ids[end]) - at(ids[end - 1]) > apart) break;
    }
    const auto close = ids.subspan(begin, end - begin);
    std::sort(close.begin(), close.end());
    arrange(things, close, axis + 1);
  }
}

}  // namespace

std::vector<int32_t> order_of(std::span<const Placed> things) {
  std::vector<int32_t> ids = all_rows(things.size());
  std::stable_sort(ids.begin(), ids.end(),
                   [&](int32_t a, int32_t b) { return things[a].keys < things[b].keys; });
  for (size_t begin = 0, end = 0; begin < ids.size(); begin = end) {
    while (end < ids.size() && things[ids[end]].keys == things[ids[begin]].keys) ++end;
    arrange(things, std::span(ids).subspan(begin, end - begin), 0);
  }
  return ids;
}

}  // namespace medial
