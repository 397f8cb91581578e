// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/crisp_parts.h"

namespace medial {
namespace {

constexpr double kLongerThanBeside = 1.25;  // of the way of a vertex to that of its neighbours
constexpr int kRimRounds = 3;
constexpr int kShareRounds = 24;      // of means along the rim of how many have found its end
constexpr double kCertainRim = 0.55;  // of the vertices round one must have found it
constexpr int kGapRounds = 6;         // half the length of the longest gap that is filled

class SmoothRims {
 public:
  explicit SmoothRims(CrispState& state) : c_(state) {}

  void settle() {
    leave_doubtful_rims();
    for (int round = 0; round < kGapRounds; ++round) fill_gaps();
    for (int round = 0; round < kRimRounds; ++round) {
      std::vector<double> settled(c_.smooth_rim.size());
      for_rims([&](int32_t v) { settled[v] = settled_reach(v); });
      for_rims([&](int32_t v) { c_.smooth_rim[v].reach = settled[v]; });
    }
    for_rims([&](int32_t v) {
      const SmoothRim& rim = c_.smooth_rim[v];
      if (rim.reach > 0) c_.end_at(v, c_.made.position[v] + rim.reach * rim.outward);
    });
  }

 private:
  template <typename Found>
  void for_rims(const Found& found) const {
    parallel_for(c_.complex.vertices(), c_.run, [&](int64_t v) {
      if (c_.on_rim[v]) found(static_cast<int32_t>(v));
    });
  }

  // The end of the sheet that a few vertices have found is left where most of those round them have
  // not, as on rough bodies: the rim would become ragged.
  void leave_doubtful_rims() {
    std::vector<double> share(c_.smooth_rim.size()), mean(c_.smooth_rim.size());
    for_rims([&](int32_t v) { share[v] = c_.smooth_rim[v].reach > 0; });
    for (int round = 0; round < kShareRounds; ++round) {
      for_rims([&](int32_t v) {
        double sum = 0;
        for (const int32_t other : c_.beside[v]) sum += share[other];
        mean[v] = 0.5 * share[v] + 0.5 * sum / static_cast<double>(c_.beside[v].size());
      });
      std::swap(share, mean);
    }
    for_rims([&](int32_t v) {
      if (share[v] < kCertainRim) c_.smooth_rim[v].reach = 0;
      is_certain_[v] = share[v] >= kCertainRim;
    });
  }

  // A vertex that has not found the end of the sheet goes as far as its neighbours.
  void fill_gaps() {
    std::vector<SmoothRim> filled(c_.smooth_rim.begin(), c_.smooth_rim.end());
    for_rims([&](int32_t v) {
      if (c_.smooth_rim[v].reach > 0 || !is_certain_[v] || !c_.is_open_rim(v)) return;
      SmoothRim sum;
      int count = 0;
      for (const int32_t other : c_.beside[v]) {
        const SmoothRim& rim = c_.smooth_rim[other];
        if (!(rim.reach > 0)) continue;
        sum.outward = sum.outward + rim.outward;
        sum.reach += rim.reach;
        ++count;
      }
      if (count > 0) filled[v] = {normalized(sum.outward), sum.reach / count};
    });
    std::copy(filled.begin(), filled.end(), c_.smooth_rim.begin());
  }

  // A vertex goes no farther than the rim beside it does.
  double settled_reach(int32_t v) const {
    if (!(c_.smooth_rim[v].reach > 0)) return 0;
    std::vector<double> beside{c_.smooth_rim[v].reach};
    for (const int32_t other : c_.beside[v]) beside.push_back(c_.smooth_rim[other].reach);
    const auto middle = beside.begin() + static_cast<std::ptrdiff_t>((beside.size() - 1) / 2);
    std::nth_element(beside.begin(), middle, beside.end());
    return std::min(c_.smooth_rim[v].reach, kLongerThanBeside * *middle);
  }

  CrispState& c_;
  std::vector<uint8_t> is_certain_ = std::vector<uint8_t>(c_.smooth_rim.size(), 0);
};

}  // namespace

void settle_smooth_rims(CrispState& state) { SmoothRims(state).settle(); }

}  // namespace medial
