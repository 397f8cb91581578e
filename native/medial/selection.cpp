#include "selection.h"

namespace medial {

std::vector<int32_t> select(const Significance& significance, const Thresholds& thresholds,
                            const Run& run) {
  const Conditions holds(significance, thresholds);
  return parallel_append<int32_t>(
      static_cast<int64_t>(significance.sine.size()), run,
      [&](int64_t e, std::vector<int32_t>& ids, int) {
        if (holds.either(e)) ids.push_back(static_cast<int32_t>(e));
      },
      1 << 16);
}

}  // namespace medial
