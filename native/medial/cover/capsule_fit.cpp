// SPDX-License-Identifier: GPL-3.0-or-later
#include "cover/capsule_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>

namespace medial {
namespace {

constexpr int kFirst = 32;            // places along a segment to begin with
constexpr size_t kMostPieces = 8192;  // of a segment; a bound with more of them is less close

// Part of a segment, and how far the ball in its middle reaches out.
struct Piece {
  double middle, half, excess;
};

double excess(const Capsule& capsule, double share, const SolidDepth& depth) {
  return capsule.radius.at(share) - depth.at(capsule.place(share));
}

std::vector<Piece> first_pieces(const Capsule& capsule, const SolidDepth& depth) {
  std::vector<Piece> pieces;
  for (int i = 0; i < kFirst; ++i) {
    const double middle = (i + 0.5) / kFirst;
    pieces.push_back({middle, 0.5 / kFirst, excess(capsule, middle, depth)});
  }
  return pieces;
}

// Returns the capsule that is as much thinner as it reaches out, or nothing if that has no radius
// at an end.
std::optional<Capsule> drawn_in(Capsule capsule, const SolidDepth& depth) {
  const double out = std::max(reach_out(capsule, depth), 0.0);
  capsule.radius.first -= out;
  capsule.radius.second -= out;
  if (!(capsule.radius.first >= 0 && capsule.radius.second >= 0)) return {};
  return capsule;
}

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

// The volume of the frustum of a cone and of two halves of balls: exact for equal radii.
double Capsule::volume() const {
  const double p = radius.first, q = radius.second, long_side = distance(a, b);
  const double ends = 2 * (p * p * p + q * q * q);
  const double larger = std::max(p, q);
  const double whole = std::abs(p - q) < long_side ? long_side * (p * p + p * q + q * q) + ends
                                                   : 4 * larger * larger * larger;
  return std::numbers::pi / 3 * whole;
}

double reach_out(const Capsule& capsule, const SolidDepth& depth) {
  if (capsule.a == capsule.b) {
    return std::max(capsule.radius.first, capsule.radius.second) - depth.at(capsule.a);
  }
  const double change =
      distance(capsule.a, capsule.b) + std::abs(capsule.radius.second - capsule.radius.first);
  const double fine = kOfRadius * std::max(capsule.radius.first, capsule.radius.second);
  auto pieces = first_pieces(capsule, depth);
  double most = -HUGE_VAL, bound = -HUGE_VAL;
  while (!pieces.empty()) {
    for (const Piece& piece : pieces) most = std::max(most, piece.excess);
    std::vector<Piece> halves;
    for (const Piece& piece : pieces) {
      const double above = piece.excess + change * piece.half;
      if (above <= most + fine || pieces.size() > kMostPieces) {
        bound = std::max(bound, above);
        continue;
      }
      const double half = piece.half / 2;
      for (const double middle : {piece.middle - half, piece.middle + half}) {
        halves.push_back({middle, half, excess(capsule, middle, depth)});
      }
    }
    pieces = std::move(halves);
  }
  return bound;
}

Capsule inner_capsule(const Vec3& a, const Vec3& b, bool tapered, const SolidDepth& depth) {
  std::vector<LengthAt> depths;
  double least = HUGE_VAL;
  for (int i = 0; i <= kFirst; ++i) {
    const double share = static_cast<double>(i) / kFirst;
    depths.push_back({share, depth.at((1 - share) * a + share * b)});
    least = std::min(least, depths.back().length);
  }
  const double first = std::max(depths.front().length, 0.0);
  const double second = std::max(depths.back().length, 0.0);
  Capsule best{a, a, {first, first}};
  const auto take = [&](const std::optional<Capsule>& other) {
    if (other && other->volume() > best.volume()) best = *other;
  };
  take(Capsule{b, b, {second, second}});
  if (!(least > 0)) return best;
  take(drawn_in({a, b, {least, least}}, depth));
  if (!tapered) return best;
  const LinearLength line = highest_below(depths);
  if (line.first >= 0 && line.second >= 0) take(drawn_in({a, b, line}, depth));
  return best;
}

}  // namespace medial
