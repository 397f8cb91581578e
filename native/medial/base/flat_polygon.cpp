// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/flat_polygon.h"

#include <algorithm>
#include <cmath>

namespace medial {
namespace {

constexpr double kRoundingOfTurn = 1e-9;   // the sine of a turn
constexpr double kRoundingOfArea = 1e-12;  // as a share of the product of the lengths

FlatPoint from(const FlatPoint& a, const FlatPoint& b) { return {b.x - a.x, b.y - a.y}; }
double cross(const FlatPoint& a, const FlatPoint& b) { return a.x * b.y - a.y * b.x; }
double length(const FlatPoint& a) { return std::sqrt(a.x * a.x + a.y * a.y); }

// Returns on which side of a line through two points a third one lies: 1 left, -1 right, 0 unclear.
int side(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
  const FlatPoint along = from(a, b), away = from(a, c);
  const double area = cross(along, away), room = kRoundingOfArea * length(along) * length(away);
  return area > room ? 1 : area < -room ? -1 : 0;
}

bool cross_inside(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c, const FlatPoint& d) {
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

}  // namespace

bool is_turned_over(std::span<const FlatPoint> corners) {
  double area = 0, size = 0;
  for (size_t i = 1; i + 1 < corners.size(); ++i) {
    const FlatPoint a = from(corners[0], corners[i]), b = from(corners[0], corners[i + 1]);
    area += cross(a, b);
    size += length(a) * length(b);
  }
  return area < -kRoundingOfArea * size;
}

bool has_dent(std::span<const FlatPoint> corners, double sine) {
  const size_t n = corners.size();
  for (size_t i = 0; i < n; ++i) {
    const FlatPoint in = from(corners[i], corners[(i + 1) % n]);
    const FlatPoint out = from(corners[(i + 1) % n], corners[(i + 2) % n]);
    if (cross(in, out) < -sine * length(in) * length(out)) return true;
  }
  return false;
}

bool turns_back(std::span<const FlatPoint> corners) {
  const size_t n = corners.size();
  for (size_t i = 0; i < n; ++i) {
    const FlatPoint in = from(corners[i], corners[(i + 1) % n]);
    const FlatPoint out = from(corners[(i + 1) % n], corners[(i + 2) % n]);
    const double lengths = length(in) * length(out);
    if (in.x * out.x + in.y * out.y < 0 && cross(in, out) <= kRoundingOfTurn * lengths &&
        lengths > 0) {
      return true;
    }
  }
  return false;
}

bool crosses_itself(std::span<const FlatPoint> corners) {
  const size_t n = corners.size();
  for (size_t i = 0; i + 2 < n; ++i) {
    for (size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j + 1 == n) continue;
      if (cross_inside(corners[i], corners[i + 1], corners[j], corners[(j + 1) % n])) return true;
    }
  }
  return false;
}

bool is_on_line(std::span<const FlatPoint> corners) {
  FlatPoint chord;
  for (const FlatPoint& corner : corners) {
    const FlatPoint way = from(corners[0], corner);
    if (length(way) > length(chord)) chord = way;
  }
  const double room = kRoundingOfTurn * length(chord) * length(chord);
  return std::all_of(corners.begin(), corners.end(), [&](const FlatPoint& corner) {
    return std::abs(cross(chord, from(corners[0], corner))) <= room;
  });
}

}  // namespace medial
