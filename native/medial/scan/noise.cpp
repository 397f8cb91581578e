// SPDX-License-Identifier: GPL-3.0-or-later
#include "scan/noise.h"

#include <numeric>

#include "base/parallel.h"
#include "scan/local_quadric.h"

namespace medial {
namespace {

constexpr std::array<size_t, 10> kSizes{10, 16, 24, 36, 54, 80, 120, 180, 270, 400};
constexpr int64_t kPlaces = 1500;  // determine a median to 3 percent
constexpr int64_t kPlacesOfFaces = 500;
constexpr double kPlateau = 1.2;  // less growth is no curvature; measured: lab/scans.md, growth
// The median distance of even samples to their nearest neighbour, in units of the root of the area
// that each has.
constexpr double kNearest = 0.85;  // measured: even samples
constexpr double kLeast = 0.01;    // spacings: less is rounding, not noise; chosen: unseen
constexpr double kSeen = 0.8;      // of the residual that small neighbourhoods show; chosen: axis
// Pairs of the 24 nearest points are compared by their heights over the quadric of 54.
constexpr size_t kPaired = 2, kUnder = 4;  // among the sizes
constexpr double kSame = 0.05;  // deviations between points of the same height; chosen: unseen
constexpr double kOfErrors = 0.0282;  // pairs of errors as close; derived: erf(kSame / 2)
// Vertices of faces are compared with fewer neighbours: those whose normals look the same way.
constexpr size_t kOfFaces = 8;         // of the sizes
constexpr size_t kLeastOfFaces = 3;    // among the sizes, the one to whose quadric vertices move
constexpr double kWider = 1.15;        // less growth from there on; measured: lab/scans.md, growth
constexpr double kSeenOfFaces = 0.15;  // as kSeen, of the noise; measured: lab/scans.md, fandisk

struct Ladder {
  std::array<double, kSizes.size()> spread{}, radius{}, kurtosis{};
  double mates = 0;
  bool whole = false;  // there were as many points as the largest size wants
};

// Points in spatial order are measured, and if they have faces their unit normals, or else none.
struct Measured {
  const PointTree& tree;
  std::span<const Vec3> normals;

  bool has_faces() const { return !normals.empty(); }
  size_t sizes() const { return has_faces() ? kOfFaces : kSizes.size(); }
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

// Returns the share of the pairs of points that have the same height over a quadric, in units of
// that of errors.
double mates_of(const LocalQuadric& quadric, std::span<const Vec3> points, double spread) {
  std::vector<double> heights;
  for (const Vec3& p : points) heights.push_back(quadric.above(p));
  std::sort(heights.begin(), heights.end());
  size_t same = 0;
  for (size_t i = 0; i < heights.size(); ++i) {
    for (size_t j = i + 1; j < heights.size() && heights[j] - heights[i] < kSame * spread; ++j) {
      ++same;
    }
  }
  const auto count = static_cast<double>(points.size());
  return static_cast<double>(same) / (kOfErrors * count * (count - 1) / 2);
}

Ladder ladder_at(const Measured& measured, int32_t place) {
  const PointTree& tree = measured.tree;
  std::vector<Neighbour> near;
  tree.find(tree[place], kSizes.back(), near);
  if (measured.has_faces()) {
    std::erase_if(near, [&](const Neighbour& one) {
      return !(dot(measured.normals[one.id], measured.normals[place]) > kSameWay);
    });
  }
  std::vector<Vec3> points;
  Ladder ladder;
  ladder.whole = near.size() >= kSizes[measured.sizes() - 1];
  if (measured.has_faces() && !ladder.whole) return ladder;
  for (size_t i = 0; i < measured.sizes(); ++i) {
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
    if (i == kUnder && points.size() == kSizes[i]) {
      ladder.mates = mates_of(*quadric, std::span(points).first(kSizes[kPaired]), ladder.spread[i]);
    }
  }
  return ladder;
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<int64_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Returns the mean of the middle half.
double middle_mean(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  const size_t quarter = values.size() / 4;
  const auto begin = values.begin() + static_cast<int64_t>(quarter),
             end = values.end() - static_cast<int64_t>(quarter);
  return std::accumulate(begin, end, 0.0) / static_cast<double>(end - begin);
}

Ladder median_ladder(const Measured& measured, const Run& run) {
  const PointTree& tree = measured.tree;
  const int64_t places =
      std::min<int64_t>(measured.has_faces() ? kPlacesOfFaces : kPlaces, tree.size());
  std::vector<Ladder> ladders(static_cast<size_t>(places));
  parallel_for(
      places, run,
      [&](int64_t i) {
        ladders[i] = ladder_at(measured, static_cast<int32_t>(i * tree.size() / places));
      },
      16);
  Ladder all;
  if (measured.has_faces()) {
    std::erase_if(ladders, [](const Ladder& ladder) { return !ladder.whole; });
    if (2 * static_cast<int64_t>(ladders.size()) < places) return all;
  }
  for (size_t i = 0; i < measured.sizes(); ++i) {
    const auto middle = [&](auto member) {
      std::vector<double> values;
      for (const Ladder& ladder : ladders) values.push_back((ladder.*member)[i]);
      return median(values);
    };
    all.spread[i] = middle(&Ladder::spread);
    all.radius[i] = middle(&Ladder::radius);
    all.kurtosis[i] = middle(&Ladder::kurtosis);
  }
  std::vector<double> mates;
  for (const Ladder& ladder : ladders) mates.push_back(ladder.mates);
  all.mates = middle_mean(mates);
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

struct Plateau {
  size_t best = 0, last = 0;  // the size at which it is flattest, and its largest; 0: there is none
};

// Returns the first plateau; a later one is that of two walls. Of faces two steps have to be flat,
// as their smallest neighbourhoods say less.
Plateau plateau_of(const Measured& measured, const Ladder& all, double widest) {
  const auto count = static_cast<size_t>(measured.tree.size());
  size_t end = 1;
  while (end < measured.sizes() && count >= kSizes[end] && all.radius[end] <= widest) ++end;
  const auto growth = [&](size_t i) {
    return all.spread[i] > 0 ? all.spread[i] / all.spread[i - 1] : kPlateau;
  };
  for (size_t i = 1; i < end; ++i) {
    if (!(growth(i) < kPlateau)) continue;
    if (measured.has_faces() && !(i + 1 < end && growth(i + 1) < kPlateau)) continue;
    Plateau found{i, i};
    while (found.last + 1 < end && growth(found.last + 1) < kPlateau) {
      if (growth(++found.last) < growth(found.best)) found.best = found.last;
    }
    return found;
  }
  return {};
}

// Returns the size of the neighbourhoods onto whose quadrics the vertices of faces move.
size_t widened(const Measured& measured, const Ladder& all, size_t best, double widest) {
  size_t size = std::max(best, kLeastOfFaces);
  while (size + 1 < measured.sizes() && all.radius[size + 1] <= widest &&
         all.spread[size + 1] < kWider * all.spread[size]) {
    ++size;
  }
  return size;
}

}  // namespace

NoiseFigures noise_of(const PointTree& tree, double diagonal, const Run& run,
                      std::span<const Vec3> normals) {
  const Measured measured{tree, normals};
  const Ladder all = median_ladder(measured, run);
  const auto spacing_at = [&](size_t i) {
    return kNearest * all.radius[i] *
           std::sqrt(3.14159265358979323846 / static_cast<double>(kSizes[i]));
  };
  const NoiseFigures none{spacing_at(2)};
  if (static_cast<size_t>(tree.size()) <= kSizes[4]) return none;
  const auto [best, last] = plateau_of(measured, all, kWidest * diagonal);
  if (best == 0) return none;
  const double noise = all.spread[best], spacing = spacing_at(best);
  if (noise < kLeast * spacing) return none;
  const double seen = measured.has_faces() ? kSeenOfFaces : kSeen * seen_of(noise / spacing);
  if (all.spread[0] < seen * noise) return none;
  const size_t wide = widened(measured, all, best, kWidest * diagonal);
  // Beyond the plateau a neighbourhood holds two walls, whose points have the same heights.
  const double mates = last < kUnder ? 0 : all.mates;
  return {spacing, noise, all.kurtosis[best], mates, all.radius[wide]};
}

}  // namespace medial
