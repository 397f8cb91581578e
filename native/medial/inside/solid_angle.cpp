// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/solid_angle.h"

#include <numbers>
#include <tuple>

#include "base/portable_math.h"
#include "base/select.h"

namespace medial {
namespace {

constexpr double kFull = 4 * std::numbers::pi;  // derived: 4 pi
constexpr int32_t kLeafTriangles = 8;           // as many as close a small opening

// Returns the signed solid angle of a triangle seen from the origin (van Oosterom & Strackee 1983).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = length(a), lb = length(b), lc = length(c);
  const double numerator = dot(a, cross(b, c));
  const double denominator = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return 2 * portable::atan2(numerator, denominator);
}

void add_scaled(std::array<Vec3, 3>& moment, const Vec3& offset, const Vec3& area_vector) {
  moment[0] = moment[0] + offset.x * area_vector;
  moment[1] = moment[1] + offset.y * area_vector;
  moment[2] = moment[2] + offset.z * area_vector;
}

}  // namespace

double solid_angle_sum(std::span<const Corners> triangles, const Vec3& query) {
  double total = 0;
  for (const auto& [a, b, c] : triangles) total += solid_angle(a - query, b - query, c - query);
  return total / kFull;
}

int32_t split_in_half(std::vector<Corners>& corners, int32_t begin, int32_t end) {
  Box box;
  for (int32_t i = begin; i < end; ++i) box.add(corners[i].a);
  const int axis = longest_axis(box.extent());
  return split_in_middle(corners, begin, end,
                         [axis](const Corners& t) { return coordinate(t.a, axis); });
}

SolidAngle::SolidAngle(std::vector<Corners> triangles) : corners_(std::move(triangles)) {
  nodes_.reserve(corners_.size() + 2);
  if (corners_.empty()) return;
  const auto describe = [&](Node& node) {
    if (node.end - node.begin <= kLeafTriangles) describe_leaf(node);
  };
  const auto split_run = [&](const Node& node) { return split(node.begin, node.end); };
  build_tree(nodes_, 0, static_cast<int32_t>(corners_.size()), kLeafTriangles, describe, split_run);
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {  // children before parents
    if (node->is_leaf()) continue;
    describe_parent(*node, *node.base(), nodes_[node->right]);
    find_radius(*node);
  }
}

// Splits a range between triangles with different last corners, as near to the middle as possible:
// the triangles of a cap share their last corner, and only the whole cap of a small opening is a
// small cluster.
int32_t SolidAngle::split(int32_t begin, int32_t end) {
  const auto first = corners_.begin() + begin, last = corners_.begin() + end;
  Box box;
  for (auto t = first; t != last; ++t) box.add(t->c);
  if (box.low == box.high) return split_in_half(corners_, begin, end);
  const int axis = longest_axis(box.extent());
  const auto place = [&](const Corners& t) {
    return std::tuple(coordinate(t.c, axis), t.c.x, t.c.y, t.c.z);
  };
  const auto before = [&](const auto& s, const auto& t) { return place(s) < place(t); };
  const auto middle = first + (end - begin) / 2;
  select(first, middle, last, before);
  const Corners at = *middle;
  const auto low =
      std::stable_partition(first, middle, [&](const auto& t) { return before(t, at); });
  const auto high =
      std::stable_partition(middle, last, [&](const auto& t) { return !before(at, t); });
  const bool after = low == first || (high != last && high - middle < middle - low);
  return static_cast<int32_t>((after ? high : low) - corners_.begin());
}

void SolidAngle::describe_leaf(Node& node) const {
  Vec3 weighted, plain;
  for (int32_t i = node.begin; i < node.end; ++i) {
    const auto& [a, b, c] = corners_[i];
    const Vec3 area_vector = 0.5 * cross(b - a, c - a);
    const double area = length(area_vector);
    const Vec3 sum = a + b + c;
    node.area += area;
    node.area_vector = node.area_vector + area_vector;
    weighted = weighted + (area / 3) * sum;
    plain = plain + (1.0 / 3) * sum;
  }
  node.centroid =
      node.area > 0 ? (1 / node.area) * weighted : (1.0 / (node.end - node.begin)) * plain;
  for (int32_t i = node.begin; i < node.end; ++i) {
    const Vec3 a = corners_[i].a - node.centroid, b = corners_[i].b - node.centroid,
               c = corners_[i].c - node.centroid;
    const Vec3 area_vector = 0.5 * cross(b - a, c - a), sum = a + b + c;
    add_scaled(node.moment, (1.0 / 3) * sum, area_vector);
    node.spread += length(area_vector) / 12 * (dot(a, a) + dot(b, b) + dot(c, c) + dot(sum, sum));
    node.radius = std::max({node.radius, length(a), length(b), length(c)});
  }
}

void SolidAngle::describe_parent(Node& node, const Node& left, const Node& right) {
  node.area = left.area + right.area;
  node.area_vector = left.area_vector + right.area_vector;
  const double share = node.area > 0 ? left.area / node.area : 0.5;
  node.centroid = share * left.centroid + (1 - share) * right.centroid;
  for (const Node* child : {&left, &right}) {
    const Vec3 offset = child->centroid - node.centroid;
    for (int k = 0; k < 3; ++k) node.moment[k] = node.moment[k] + child->moment[k];
    add_scaled(node.moment, offset, child->area_vector);
    node.spread += child->spread + child->area * dot(offset, offset);
  }
}

void SolidAngle::find_radius(Node& node) const {
  for (int32_t i = node.begin; i < node.end; ++i) {
    for (const Vec3& p : {corners_[i].a, corners_[i].b, corners_[i].c}) {
      node.radius = std::max(node.radius, distance(p, node.centroid));
    }
  }
}

SolidAngle::Term SolidAngle::term(int32_t id, const Vec3& query) const {
  const Node& node = nodes_[id];
  const Vec3 y = node.centroid - query;
  const double yy = dot(y, y), r = std::sqrt(yy), gap = r - node.radius;
  // Taylor's remainder after the linear term: the third derivatives of 1/r are at most 6/r^4.
  const double error = 3 * node.spread / (gap * gap * gap * gap);
  if (gap <= 0 || error > kFull) return {HUGE_VAL, 0, id};
  const double trace = node.moment[0].x + node.moment[1].y + node.moment[2].z;
  const Vec3 my{dot(node.moment[0], y), dot(node.moment[1], y), dot(node.moment[2], y)};
  const double value = (dot(node.area_vector, y) + trace - 3 * dot(y, my) / yy) / (yy * r);
  return {error, value, id};
}

// Replaces the cluster with the largest bound by its children, or by its triangles, until the value
// and its error bound are good enough; both are times 4 pi.
template <typename Enough>
double SolidAngle::opened(const Vec3& query, const Enough& enough) const {
  const auto smaller = [](const Term& s, const Term& t) {
    return s.error != t.error ? s.error < t.error : s.node > t.node;
  };
  std::vector<Term> heap;
  heap.reserve(64);
  int unbounded = 0;  // terms in the heap without a finite bound
  double total = 0, error = 0;
  const auto count = [&](const Term& t, int sign) {
    total += sign * t.value;
    if (t.error == HUGE_VAL) {
      unbounded += sign;
    } else {
      error += sign * t.error;
    }
  };
  const auto push = [&](const Term& t) {
    heap.push_back(t);
    std::push_heap(heap.begin(), heap.end(), smaller);
    count(t, 1);
  };
  if (!nodes_.empty()) push(term(0, query));
  while (!heap.empty() && (unbounded > 0 || !enough(total, error))) {
    std::pop_heap(heap.begin(), heap.end(), smaller);
    const Term top = heap.back();
    heap.pop_back();
    count(top, -1);
    const Node& node = nodes_[top.node];
    if (node.is_leaf()) {
      const std::span<const Corners> triangles(corners_);
      total += kFull * solid_angle_sum(triangles.subspan(node.begin, node.end - node.begin), query);
    } else {
      push(term(top.node + 1, query));
      push(term(node.right, query));
    }
  }
  return total;
}

bool SolidAngle::is_below(double bound, const Vec3& query) const {
  const auto told = [&](double total, double error) {
    return std::abs(total - bound * kFull) > error;
  };
  return opened(query, told) < bound * kFull;
}

double SolidAngle::within(double tolerance, const Vec3& query) const {
  const auto close = [&](double, double error) { return error <= tolerance * kFull; };
  return opened(query, close) / kFull;
}

}  // namespace medial
