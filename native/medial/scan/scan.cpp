// SPDX-License-Identifier: GPL-3.0-or-later
#include <medial/scan.h>

#include <algorithm>

#include "base/parallel.h"
#include "base/random.h"
#include "base/rows.h"
#include "scan/mover.h"
#include "scan/noise.h"
#include "scan/outliers.h"

namespace medial {
namespace {

constexpr double kApart = 3;    // spacings between places with neighbourhoods; chosen: axis
constexpr double kBorder = 6;   // spacings over which a border is looked for; chosen: axis
constexpr double kLeft = 0.05;  // of the new spacing, what may be left of the noise; chosen: unseen
constexpr double kOfRadius = 1.0 / 3;  // of the neighbourhood: the widest spacing; chosen: axis
constexpr double kClose = 0.5;  // of the new spacing, how close moved points may be; chosen: unseen

// Returns the ids that stay if, in an order that is random but always the same, each that is left
// takes all others within its own distance away; those of distance 0 are taken away.
std::vector<int32_t> thinned(const PointTree& tree, std::span<const double> distances) {
  std::vector<std::pair<uint64_t, int32_t>> order;
  for (int32_t i = 0; i < tree.size(); ++i) order.emplace_back(scrambled(i), i);
  std::sort(order.begin(), order.end());
  std::vector<uint8_t> gone(static_cast<size_t>(tree.size()), 0);
  std::vector<int32_t> kept;
  for (const auto& entry : order) {
    const int32_t i = entry.second;
    if (gone[i] || !(distances[i] > 0)) continue;
    kept.push_back(i);
    const double squared = distances[i] * distances[i];
    tree.visit([&](const Box& box) { return squared_distance(box, tree[i]) <= squared; },
               [&](const Vec3& p) {
                 if (squared_length(p - tree[i]) <= squared) gone[&p - &tree[0]] = 1;
               });
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

// Returns the distance of neighbours after moving: the rest of the noise is a small share of it.
double apart(const Neighbourhood& near, double spacing) {
  if (!(near.radius > 0)) return 0;
  return std::clamp(near.left / kLeft, 0.7 * spacing, std::max(spacing, kOfRadius * near.radius));
}

// A point that is kept: the caller's row, and its new place.
using Kept = std::pair<int32_t, Vec3>;

// Returns the distinct points that do not stand alone.
std::vector<Kept> together(std::span<const Vec3> points, const ScanMeasure& measure,
                           const Run& run) {
  const DistinctRows distinct = distinct_rows(points, "points", run);
  std::vector<uint8_t> alone(points.size(), 0);
  for (const int32_t row : measure.outliers) alone[row] = 1;
  std::vector<Kept> kept;
  for (int32_t i = 0; i < distinct.count(); ++i) {
    if (!alone[distinct.row[i]]) kept.emplace_back(distinct.row[i], distinct.points[i]);
  }
  return kept;
}

// Thins points in spatial order, moves those that are left, and thins what came too close.
std::vector<Kept> smoothed(std::span<const Kept> given, const ScanMeasure& measure,
                           const Run& run) {
  std::vector<Vec3> places;
  for (const Kept& one : given) places.push_back(one.second);
  const PointTree tree(places);
  const double widest = kWidest * length(box_of(places).extent());
  std::vector<double> distances(places.size(), kApart * measure.spacing);
  const auto near = neighbourhoods(tree, thinned(tree, distances), measure.noise, widest, run);
  distances.clear();
  for (const Neighbourhood& one : near) distances.push_back(apart(one, measure.spacing));
  const auto centres = thinned(tree, distances);
  const auto moved = moved_points(tree, centres, near, measure.noise, run);
  std::vector<Vec3> after;
  distances.clear();
  for (const Moved& one : moved) {
    after.push_back(one.place);
    distances.push_back(kClose * apart(one.of, measure.spacing));
  }
  std::vector<Kept> kept;
  for (const int32_t i : thinned(PointTree(after), distances)) {
    kept.emplace_back(given[centres[i]].first, after[i]);
  }
  return kept;
}

}  // namespace

ScanMeasure measure_scan(std::span<const Vec3> points, int threads, Progress* progress) {
  const Run run{thread_count(threads), progress};
  const DistinctRows distinct = distinct_rows(points, "points", run);
  ScanMeasure measure;
  measure.duplicates = static_cast<int64_t>(points.size()) - distinct.count();
  if (distinct.count() < 4) return measure;
  const PointTree tree(distinct.points);
  const double diagonal = length(box_of(distinct.points).extent());
  for (const int32_t id : lone_points(tree, run)) measure.outliers.push_back(distinct.row[id]);
  std::sort(measure.outliers.begin(), measure.outliers.end());
  const NoiseFigures figures = noise_of(tree, diagonal, run);
  measure.spacing = figures.spacing;
  measure.noise = figures.noise;
  measure.kurtosis = figures.kurtosis;
  measure.mates = figures.mates;
  measure.border = border_share(tree, std::max(kBorder * figures.spacing, 3 * figures.noise), run);
  return measure;
}

PreparedScan prepare_scan(std::span<const Vec3> points, const ScanMeasure& measure, bool move,
                          int threads, Progress* progress) {
  const Run run{thread_count(threads), progress};
  auto kept = together(points, measure, run);
  if (move && measure.noise > 0) kept = smoothed(kept, measure, run);
  std::sort(kept.begin(), kept.end(),
            [](const Kept& a, const Kept& b) { return a.first < b.first; });
  PreparedScan prepared;
  for (const auto& [row, place] : kept) {
    prepared.rows.push_back(row);
    prepared.points.push_back(place);
    prepared.moved.push_back(distance(place, points[row]));
  }
  return prepared;
}

}  // namespace medial
