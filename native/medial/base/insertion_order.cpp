// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/insertion_order.h"

#include "base/random.h"

namespace medial {

std::vector<int32_t> insertion_order(int32_t count) {
  std::vector<std::vector<int32_t>> rounds(1);
  for (int32_t id = 0; id < count; ++id) {
    std::size_t level = 0;
    for (uint64_t bits = scrambled(static_cast<uint64_t>(id)); bits % 8 == 0 && level < 20;
         bits /= 8) {
      ++level;
    }
    if (level >= rounds.size()) rounds.resize(level + 1);
    rounds[level].push_back(id);
  }
  std::vector<int32_t> order;
  order.reserve(static_cast<std::size_t>(count));
  for (auto round = rounds.rbegin(); round != rounds.rend(); ++round) {
    order.insert(order.end(), round->begin(), round->end());
  }
  return order;
}

}  // namespace medial
