// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/ray_crossings.h"

#include <cfloat>
#include <numbers>

#include "delaunay/circumcentre.h"

namespace medial {
namespace {

constexpr int32_t kTrianglesOfLeaf = 4;

Vec3 inverse(const Vec3& v) { return {1 / v.x, 1 / v.y, 1 / v.z}; }

// Returns whether a ray meets a box that is larger by some room on each side, by slabs. The far end
// is stretched by more than the rounding of both ends (Ize 2013), so no hit is lost. Along an axis
// that the ray does not move on, it is between the slabs or not; the product with an infinite
// inverse would be no number on a slab.
bool meets(const Box& box, const Vec3& origin, const Vec3& inverse_direction, double reach,
           double room) {
  double near = 0, far = reach;
  const auto clip = [&](double low, double high, double o, double i) {
    low -= room;
    high += room;
    if (std::isinf(i)) {
      if (o < low || o > high) far = -1;
      return;
    }
    const double t0 = (low - o) * i, t1 = (high - o) * i;
    near = std::max(near, std::min(t0, t1));
    far = std::min(far, std::max(t0, t1));
  };
  clip(box.low.x, box.high.x, origin.x, inverse_direction.x);
  clip(box.low.y, box.high.y, origin.y, inverse_direction.y);
  clip(box.low.z, box.high.z, origin.z, inverse_direction.z);
  return near <= far * (1 + 8 * DBL_EPSILON);
}

// Returns how far a place of a box is at most.
double farthest(const Box& box, const Vec3& from) {
  return std::max(max_abs(box.low - from), max_abs(box.high - from)) * std::numbers::sqrt3;
}

// Returns +1 if the ray leaves through the triangle, -1 if it enters, 0 if it misses, and nothing
// if it is too close to an edge to decide.
std::optional<int> crossing(const Corners& t, const Vec3& origin, const Vec3& direction,
                            double reach) {
  const Vec3 a = t.a - origin, b = t.b - origin, c = t.c - origin;
  // These are the volumes of the ray with each edge; their rounding errors are below 16 epsilon
  // |b||c| for a unit direction.
  const double u = dot(direction, cross(b, c)), v = dot(direction, cross(c, a)),
               w = dot(direction, cross(a, b));
  const double la = length(a), lb = length(b), lc = length(c), tiny = 16 * DBL_EPSILON;
  const double eu = tiny * lb * lc, ev = tiny * lc * la, ew = tiny * la * lb;
  const bool may_leave = u > -eu && v > -ev && w > -ew, may_enter = u < eu && v < ev && w < ew;
  if (!may_leave && !may_enter) return 0;
  // The line meets the plane at volume / flux.
  const double volume = dot(a, cross(b, c)), flux = u + v + w, error = tiny * la * lb * lc;
  const bool in_plane = std::abs(volume) <= error;
  // A ray that starts on the triangle or on its edge does not count it.
  const double farthest = std::max({la, lb, lc});
  const bool at_once = in_plane && error <= kCoarsestError * std::abs(flux) * farthest;
  if (at_once && reach == HUGE_VAL) return 0;
  const bool leaves = u > eu && v > ev && w > ew, enters = u < -eu && v < -ev && w < -ew;
  if (!leaves && !enters) return std::nullopt;
  if (reach < HUGE_VAL) {
    const double end = volume - reach * flux;
    if (in_plane || std::abs(end) <= error + reach * (eu + ev + ew)) return std::nullopt;
    if ((end > 0) == leaves) return 0;
  }
  if ((volume > 0) != leaves) return 0;
  return leaves ? 1 : -1;
}

// Returns where a line meets a triangle, in floating point.
std::optional<RayCrossings::Hit> where_met(const Corners& t, const Vec3& origin,
                                           const Vec3& direction) {
  const Vec3 a = t.a - origin, b = t.b - origin, c = t.c - origin;
  const double u = dot(direction, cross(b, c)), v = dot(direction, cross(c, a)),
               w = dot(direction, cross(a, b)), flux = u + v + w;
  const bool leaves = u >= 0 && v >= 0 && w >= 0, enters = u <= 0 && v <= 0 && w <= 0;
  if (leaves == enters) return std::nullopt;
  const Vec3 normal = cross(t.b - t.a, t.c - t.a);
  const double size = length(normal);
  if (!(size > 0)) return std::nullopt;
  return RayCrossings::Hit{dot(a, normal) / flux, flux / size, (1 / size) * normal};
}

}  // namespace

RayCrossings::RayCrossings(std::vector<Corners> triangles, const Progress* progress)
    : corners_(std::move(triangles)) {
  nodes_.reserve(corners_.size() + 2);
  const auto describe = [&](BoxNode& node) {
    if (node.end - node.begin > 1 << 14) throw_if_cancelled(progress);
    for (int32_t i = node.begin; i < node.end; ++i) {
      for (const Vec3& p : {corners_[i].a, corners_[i].b, corners_[i].c}) node.box.add(p);
    }
  };
  const auto split = [&](const BoxNode& node) {
    return split_in_half(corners_, node.begin, node.end);
  };
  if (corners_.empty()) return;
  build_tree(nodes_, 0, static_cast<int32_t>(corners_.size()), kTrianglesOfLeaf, describe, split);
}

// Visits the triangles whose boxes the ray meets, until a visit returns false.
template <typename Visit>
void RayCrossings::visit(const Vec3& origin, const Vec3& direction, double reach,
                         const Visit& visit) const {
  if (nodes_.empty()) return;
  const Vec3 inverse_direction = inverse(direction);
  // So far from a triangle a ray may begin that is taken to begin on it.
  const double room = kCoarsestError * farthest(nodes_[0].box, origin);
  std::array<int32_t, 64> stack;  // halved at every level, the tree is less than 32 deep
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const int32_t id = stack[--top];
    const BoxNode& node = nodes_[id];
    if (!meets(node.box, origin, inverse_direction, reach, room)) continue;
    if (!node.is_leaf()) {
      stack[top++] = node.right;
      stack[top++] = id + 1;
      continue;
    }
    for (int32_t i = node.begin; i < node.end; ++i) {
      if (!visit(corners_[i])) return;
    }
  }
}

std::optional<int> RayCrossings::operator()(const Vec3& origin, const Vec3& direction,
                                            double reach) const {
  std::optional<int> sum = 0;
  visit(origin, direction, reach, [&](const Corners& t) {
    const auto found = crossing(t, origin, direction, reach);
    sum = found ? std::optional(*sum + *found) : std::nullopt;
    return sum.has_value();
  });
  return sum;
}

bool RayCrossings::is_beyond(const Vec3& place) const {
  if (nodes_.empty()) return true;
  const Box& box = nodes_[0].box;
  const double room = kCoarsestError * length(box.extent());
  return squared_distance(box, place) > room * room;
}

void RayCrossings::hits(const Vec3& origin, const Vec3& direction, double reach,
                        std::vector<Hit>& found) const {
  found.clear();
  visit(origin, direction, reach, [&](const Corners& t) {
    const auto hit = where_met(t, origin, direction);
    if (!hit) return true;
    // A face that is entered where the ray starts is the face on which it starts.
    const double start = hit->cosine < 0 ? 0x1p-20 * reach : 0;
    if (hit->at > start && hit->at <= reach) found.push_back(*hit);
    return true;
  });
}

int64_t RayCrossings::met(const Vec3& origin, const Vec3& direction, double start,
                          int64_t most) const {
  int64_t count = 0;
  visit(origin, direction, HUGE_VAL, [&](const Corners& t) {
    const auto hit = where_met(t, origin, direction);
    count += hit && hit->at > start ? 1 : 0;
    return count < most;
  });
  return count;
}

}  // namespace medial
