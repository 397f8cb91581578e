// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/rim_waves.h"

#include <algorithm>
#include <cmath>

namespace medial {
namespace {

// Rounds per squared number of the edges of a closed rim. So many leave 96 % of its longest wave,
// which is the rim itself.
constexpr double kRoundsOfRim = 1.0 / 44;

}  // namespace

RimWaves::RimWaves(std::vector<int32_t> moving, std::vector<std::span<const int32_t>> beside,
                   size_t vertices, int rounds)
    : moving_(std::move(moving)), beside_(std::move(beside)), row_(vertices, -1) {
  for (size_t i = 0; i < moving_.size(); ++i) row_[moving_[i]] = static_cast<int32_t>(i);
  limit_rounds(rounds);
}

// A rim of few edges would be drawn together in a point, or in the line between its fixed ends.
void RimWaves::limit_rounds(int most) {
  rounds_.assign(moving_.size(), most);
  std::vector<uint8_t> seen(moving_.size(), 0);
  std::vector<size_t> rim;
  for (size_t i = 0; i < moving_.size(); ++i) {
    if (seen[i]) continue;
    const int rounds = std::min(most, rounds_of(i, seen, rim));
    for (const size_t k : rim) rounds_[k] = rounds;
  }
}

// Finds the moving vertices of the rim through one of them, and returns its rounds.
int RimWaves::rounds_of(size_t first, std::vector<uint8_t>& seen, std::vector<size_t>& rim) const {
  rim.assign(1, first);
  seen[first] = 1;
  bool closed = true;
  for (size_t next = 0; next < rim.size(); ++next) {
    for (const int32_t v : beside_[rim[next]]) {
      const int32_t row = row_[v];
      closed &= row >= 0;
      if (row < 0 || seen[row]) continue;
      seen[row] = 1;
      rim.push_back(static_cast<size_t>(row));
    }
  }
  const auto edges = static_cast<double>(closed ? rim.size() : 2 * (rim.size() + 1));
  return static_cast<int>(std::lround(std::ceil(std::min(1e6, kRoundsOfRim * edges * edges))));
}

// Means alone would draw a rim in, so the means of what they take away are given back.
std::vector<Vec3> RimWaves::moves(std::span<const Vec3> places) const {
  std::vector<Vec3> lost;
  for (const int32_t v : moving_) lost.push_back(places[v]);
  const std::vector<Vec3> smooth = means(lost, [&](int32_t v) { return places[v]; });
  for (size_t i = 0; i < lost.size(); ++i) lost[i] = lost[i] - smooth[i];
  std::vector<Vec3> back = means(lost, [](int32_t) { return Vec3{}; });
  for (size_t i = 0; i < lost.size(); ++i) back[i] = back[i] - lost[i];
  return back;
}

// Returns means along the rims of vectors, of which there is one per moving vertex; `fixed` has
// those of the others.
template <typename Fixed>
std::vector<Vec3> RimWaves::means(std::span<const Vec3> of, const Fixed& fixed) const {
  std::vector<Vec3> mean(of.begin(), of.end()), next(mean);
  const auto value = [&](int32_t v) { return row_[v] >= 0 ? mean[row_[v]] : fixed(v); };
  const int most = rounds_.empty() ? 0 : *std::max_element(rounds_.begin(), rounds_.end());
  for (int round = 0; round < most; ++round) {
    for (size_t i = 0; i < mean.size(); ++i) {
      if (round >= rounds_[i]) continue;
      Vec3 sum;
      for (const int32_t v : beside_[i]) sum = sum + value(v);
      next[i] = 0.5 * mean[i] + (0.5 / static_cast<double>(beside_[i].size())) * sum;
    }
    mean = next;
  }
  return mean;
}

}  // namespace medial
