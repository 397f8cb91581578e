#include "selection.h"

namespace medial {

std::vector<int32_t> select(const Significance& significance, const Thresholds& thresholds,
                            const Run& run) {
  return parallel_append<int32_t>(
      static_cast<int64_t>(significance.theta.size()), run,
      [&](int64_t e, std::vector<int32_t>& ids, int) {
        if (satisfies_angle(significance, e, thresholds) ||
            satisfies_ratio(significance, e, thresholds)) {
          ids.push_back(static_cast<int32_t>(e));
        }
      },
      1 << 16);
}

}  // namespace medial
