// SPDX-License-Identifier: GPL-3.0-or-later
#include "cover/capsule_line.h"

#include <algorithm>
#include <tuple>

namespace medial {
namespace {

// Whether b lies on or above the line from a to c.
bool is_above(const LengthAt& a, const LengthAt& b, const LengthAt& c) {
  return (b.length - a.length) * (c.share - a.share) >= (c.length - a.length) * (b.share - a.share);
}

// Returns the corners of the lower boundary of the convex hull, ascending in shares.
std::vector<LengthAt> lower_hull(std::vector<LengthAt> points) {
  std::sort(points.begin(), points.end(), [](const LengthAt& a, const LengthAt& b) {
    return std::tie(a.share, a.length) < std::tie(b.share, b.length);
  });
  std::vector<LengthAt> hull;
  for (const LengthAt& point : points) {
    if (!hull.empty() && hull.back().share == point.share) continue;
    while (hull.size() >= 2 && is_above(hull[hull.size() - 2], hull.back(), point)) hull.pop_back();
    hull.push_back(point);
  }
  return hull;
}

}  // namespace

// The line is highest in the middle if it goes along the side of the hull below the middle.
// Rounding may leave it above a corner by the last bits; it is moved down by what is found.
LinearLength highest_below(const std::vector<LengthAt>& points) {
  const auto hull = lower_hull(points);
  size_t right = 0;
  while (right + 1 < hull.size() && hull[right].share < 0.5) ++right;
  const LengthAt b = hull[right], a = hull[right == 0 ? 0 : right - 1];
  const double slope = b.share > a.share ? (b.length - a.length) / (b.share - a.share) : 0;
  LinearLength line{b.length - slope * b.share, b.length + slope * (1 - b.share)};
  double above = 0;
  for (const LengthAt& point : points) {
    above = std::max(above, line.at(point.share) - point.length);
  }
  return {line.first - above, line.second - above};
}

LinearLength lowest_above(std::vector<LengthAt> points) {
  for (LengthAt& point : points) point.length = -point.length;
  const LinearLength line = highest_below(points);
  return {-line.first, -line.second};
}

}  // namespace medial
