// SPDX-License-Identifier: GPL-3.0-or-later
#include "scan/noise.h"

#include "base/parallel.h"
#include "scan/local_quadric.h"

namespace medial {
namespace {

constexpr std::array<size_t, 10> kSizes{10, 16, 24, 36, 54, 80, 120, 180, 270, 400};
constexpr int64_t kPlaces = 1500;  // determine a median to 3 percent
constexpr double kPlateau = 1.2;   // a smaller growth from size to size is no curvature
constexpr double kLargest = 0.12;  // of the diagonal: a larger neighbourhood is the shape itself
// The median distance of even samples to their nearest neighbour, in units of the root of the area
// that each has.
constexpr double kNearest = 0.85;
constexpr double kLeast = 0.01;  // spacings: less is rounding, not noise
constexpr double kSeen = 0.8;    // of the residual that noise shows in the smallest neighbourhood

struct Ladder {
  std::array<double, kSizes.size()> spread{}, radius{}, kurtosis{};
};

double kurtosis_of(const LocalQuadric& quadric, std::span<const Vec3> points) {
  double second = 0, fourth = 0;
  for (const Vec3& p : points) {
    const double off = quadric.above(p), square = off * off;
    second += square;
    fourth += square * square;
  }
  return second > 0 ? static_cast<double>(points.size()) * fourth / (second * second) : 3;
}

Ladder ladder_at(const PointTree& tree, int32_t place) {
  std::vector<Neighbour> near;
  tree.find(tree[place], kSizes.back(), near);
  std::vector<Vec3> points;
  Ladder ladder;
  for (size_t i = 0; i < kSizes.size(); ++i) {
    for (; points.size() < std::min(kSizes[i], near.size());) {
      points.push_back(tree[near[points.size()].id]);
    }
    ladder.radius[i] = near[points.size() - 1].distance;
    if (!(ladder.radius[i] > 0)) continue;
    auto quadric =
        fit_quadric(points, tree[place], least_spread(points), ladder.radius[i], Weights::equal);
    if (!quadric) continue;
    const auto turned =
        fit_quadric(points, tree[place], quadric->tilted(), ladder.radius[i], Weights::equal);
    ladder.spread[i] = spread(points, *quadric);
    const double off = turned ? spread(points, *turned) : ladder.spread[i];
    if (off < ladder.spread[i]) {
      quadric = turned;
      ladder.spread[i] = off;
    }
    ladder.kurtosis[i] = kurtosis_of(*quadric, points);
  }
  return ladder;
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<int64_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Ladder median_ladder(const PointTree& tree, const Run& run) {
  const int64_t places = std::min<int64_t>(kPlaces, tree.size());
  std::vector<Ladder> ladders(static_cast<size_t>(places));
  parallel_for(
      places, run,
      [&](int64_t i) {
        ladders[i] = ladder_at(tree, static_cast<int32_t>(i * tree.size() / places));
      },
      16);
  Ladder all;
  for (size_t i = 0; i < kSizes.size(); ++i) {
    const auto middle = [&](auto member) {
      std::vector<double> values;
      for (const Ladder& ladder : ladders) values.push_back((ladder.*member)[i]);
      return median(values);
    };
    all.spread[i] = middle(&Ladder::spread);
    all.radius[i] = middle(&Ladder::radius);
    all.kurtosis[i] = middle(&Ladder::kurtosis);
  }
  return all;
}

// Returns the residual in the smallest neighbourhood for noise of one unit, by the noise in
// spacings: where the noise is as large, the plane of ten points is chosen by the noise.
double seen_of(double noise) {
  constexpr std::array<std::array<double, 2>, 5> known{
      {{0.1, 0.90}, {0.25, 0.85}, {0.5, 0.70}, {1, 0.45}, {2, 0.30}}};
  if (noise <= known.front()[0]) return known.front()[1];
  for (size_t i = 1; i < known.size(); ++i) {
    const auto [x, y] = known[i];
    const auto [low, there] = known[i - 1];
    if (noise <= x) return there + (y - there) * (noise - low) / (x - low);
  }
  return known.back()[1];
}

}  // namespace

NoiseFigures noise_of(const PointTree& tree, double diagonal, const Run& run) {
  const Ladder all = median_ladder(tree, run);
  const auto spacing_at = [&](size_t i) {
    return kNearest * all.radius[i] *
           std::sqrt(3.14159265358979323846 / static_cast<double>(kSizes[i]));
  };
  NoiseFigures figures{spacing_at(2)};
  if (static_cast<size_t>(tree.size()) <= kSizes[4]) return figures;
  for (size_t i = 1; i < kSizes.size(); ++i) {
    if (static_cast<size_t>(tree.size()) < kSizes[i] || all.radius[i] > kLargest * diagonal) break;
    if (all.spread[i] >= kPlateau * all.spread[i - 1] || !(all.spread[i] > 0)) continue;
    // The least growth marks the plateau.
    size_t best = i;
    for (size_t j = i + 1; j < kSizes.size() && all.radius[j] <= kLargest * diagonal; ++j) {
      if (all.spread[j] / all.spread[j - 1] < all.spread[best] / all.spread[best - 1]) best = j;
    }
    const double noise = all.spread[best], spacing = spacing_at(best);
    if (noise < kLeast * spacing) break;
    if (all.spread[0] < kSeen * seen_of(noise / spacing) * noise) break;
    return {spacing, noise, all.kurtosis[best]};
  }
  return figures;
}

}  // namespace medial
