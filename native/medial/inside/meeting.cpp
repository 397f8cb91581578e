// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/meeting.h"

#include <algorithm>

namespace medial {
namespace {

using ThreePoints = std::array<Vec3, 3>;

// Holds the heights of the corners of one triangle over the plane of another one.
using Heights = std::array<double, 3>;

Vec3 unit_normal(const ThreePoints& t) { return normalized(cross(t[1] - t[0], t[2] - t[0])); }

Heights heights_over(const ThreePoints& t, const Vec3& normal, const ThreePoints& s) {
  return {dot(normal, s[0] - t[0]), dot(normal, s[1] - t[0]), dot(normal, s[2] - t[0])};
}

bool are_on_one_side(const Heights& heights, double within) {
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  return *low > within || *high < -within;
}

// Returns how far a place in the plane of a triangle is from its nearest side, inward.
double depth_in(const ThreePoints& t, const Vec3& normal, const Vec3& place) {
  double depth = HUGE_VAL;
  for (int i = 0; i < 3; ++i) {
    const Vec3 inward = normalized(cross(normal, t[(i + 1) % 3] - t[i]));
    depth = std::min(depth, dot(inward, place - t[i]));
  }
  return depth;
}

bool passes_through(const ThreePoints& s, const Heights& heights, const ThreePoints& t,
                    const Vec3& normal, double within) {
  for (int i = 0; i < 3; ++i) {
    const int next = (i + 1) % 3;
    const double from = heights[i], to = heights[next];
    if (!(std::min(from, to) < -within && std::max(from, to) > within)) continue;
    const Vec3 place = s[i] + (from / (from - to)) * (s[next] - s[i]);
    if (depth_in(t, normal, place) > within) return true;
  }
  return false;
}

bool rests_on(const ThreePoints& s, const Heights& heights, const ThreePoints& t,
              const Vec3& normal, double within) {
  for (int i = 0; i < 3; ++i) {
    if (std::abs(heights[i]) <= within && depth_in(t, normal, s[i]) >= -within) return true;
  }
  return false;
}

// Returns the squared distance of two segments: where both are nearest to each other, or from an
// end of one of them.
double squared_distance_of_edges(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 p = b - a, q = d - c, away = a - c;
  const double pp = dot(p, p), qq = dot(q, q), pq = dot(p, q), pa = dot(p, away), qa = dot(q, away);
  const auto share = [](double part, double whole) {
    return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0;
  };
  double along = share(pq * qa - qq * pa, pp * qq - pq * pq);
  const double other = share(qa + along * pq, qq);
  along = share(other * pq - pa, pp);
  return squared_length(away + along * p - other * q);
}

bool do_edges_touch(const ThreePoints& s, const ThreePoints& t, double within) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double squared = squared_distance_of_edges(s[i], s[(i + 1) % 3], t[j], t[(j + 1) % 3]);
      if (squared <= within * within) return true;
    }
  }
  return false;
}

}  // namespace

TriangleMeeting meeting_of(const Corners& first, const Corners& second, double within) {
  const ThreePoints s{first.a, first.b, first.c}, t{second.a, second.b, second.c};
  const Vec3 normal_of_t = unit_normal(t), normal_of_s = unit_normal(s);
  const Heights over_t = heights_over(t, normal_of_t, s);
  if (are_on_one_side(over_t, within)) return TriangleMeeting::none;
  const Heights over_s = heights_over(s, normal_of_s, t);
  if (are_on_one_side(over_s, within)) return TriangleMeeting::none;
  if (passes_through(s, over_t, t, normal_of_t, within) ||
      passes_through(t, over_s, s, normal_of_s, within)) {
    return TriangleMeeting::crossed;
  }
  const bool touch = rests_on(s, over_t, t, normal_of_t, within) ||
                     rests_on(t, over_s, s, normal_of_s, within) || do_edges_touch(s, t, within);
  return touch ? TriangleMeeting::touch : TriangleMeeting::none;
}

}  // namespace medial
