#include "winding_number.h"

#include <cfloat>
#include <numbers>

namespace medial {
namespace {

constexpr int32_t kLeafTriangles = 8;

// Signed solid angle of a triangle seen from the origin (van Oosterom & Strackee 1983).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = length(a), lb = length(b), lc = length(c);
  const double numerator = dot(a, cross(b, c));
  const double denominator = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return 2 * std::atan2(numerator, denominator);
}

void add_scaled(std::array<Vec3, 3>& moment, const Vec3& offset, const Vec3& area_vector) {
  moment[0] = moment[0] + offset.x * area_vector;
  moment[1] = moment[1] + offset.y * area_vector;
  moment[2] = moment[2] + offset.z * area_vector;
}

}  // namespace

WindingNumber::WindingNumber(std::span<const Vec3> vertices, std::span<const Triangle> triangles) {
  corners_.reserve(triangles.size());
  for (const auto& [i, j, k] : triangles) {
    const Corners t{vertices[i], vertices[j], vertices[k]};
    if (t.a != t.b && t.b != t.c && t.c != t.a) corners_.push_back(t);
  }
  nodes_.reserve(corners_.size() / 2 + 2);
  if (!corners_.empty()) build(0, static_cast<int32_t>(corners_.size()));
}

int32_t WindingNumber::build(int32_t begin, int32_t end) {
  const auto id = static_cast<int32_t>(nodes_.size());
  Node& node = nodes_.emplace_back();
  node.begin = begin;
  node.end = end;
  if (end - begin <= kLeafTriangles) {
    describe_leaf(nodes_[id]);
    return id;
  }
  Box box;
  for (int32_t i = begin; i < end; ++i) box.add(corners_[i].a);
  const Vec3 extent = box.extent();
  double Vec3::*axis = extent.x >= extent.y && extent.x >= extent.z ? &Vec3::x
                       : extent.y >= extent.z                       ? &Vec3::y
                                                                    : &Vec3::z;
  const int32_t middle = begin + (end - begin) / 2;
  std::nth_element(corners_.begin() + begin, corners_.begin() + middle, corners_.begin() + end,
                   [&](const Corners& s, const Corners& t) { return s.a.*axis < t.a.*axis; });
  const int32_t left = build(begin, middle), right = build(middle, end);
  nodes_[id].right = right;
  describe_parent(nodes_[id], nodes_[left], nodes_[right]);
  return id;
}

void WindingNumber::describe_leaf(Node& node) const {
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
  node.centroid = node.area > 0 ? (1 / node.area) * weighted : (1.0 / (node.end - node.begin)) * plain;
  for (int32_t i = node.begin; i < node.end; ++i) {
    const Vec3 a = corners_[i].a - node.centroid, b = corners_[i].b - node.centroid,
               c = corners_[i].c - node.centroid;
    const Vec3 area_vector = 0.5 * cross(b - a, c - a), sum = a + b + c;
    add_scaled(node.moment, (1.0 / 3) * sum, area_vector);
    node.spread += length(area_vector) / 12 * (dot(a, a) + dot(b, b) + dot(c, c) + dot(sum, sum));
    node.radius = std::max({node.radius, length(a), length(b), length(c)});
  }
}

void WindingNumber::describe_parent(Node& node, const Node& left, const Node& right) const {
  node.area = left.area + right.area;
  node.area_vector = left.area_vector + right.area_vector;
  const double share = node.area > 0 ? left.area / node.area : 0.5;
  node.centroid = share * left.centroid + (1 - share) * right.centroid;
  for (const Node* child : {&left, &right}) {
    const Vec3 offset = child->centroid - node.centroid;
    for (int k = 0; k < 3; ++k) node.moment[k] = node.moment[k] + child->moment[k];
    add_scaled(node.moment, offset, child->area_vector);
    node.spread += child->spread + child->area * dot(offset, offset);
    node.radius = std::max(node.radius, child->radius + length(offset));
  }
}

WindingNumber::Sum WindingNumber::evaluate(const Vec3& query, double tolerance) const {
  Sum sum;
  std::array<int32_t, 128> stack;  // the tree is balanced: its depth is below 32
  int top = 0;
  if (!nodes_.empty()) stack[top++] = 0;
  while (top > 0) {
    const int32_t id = stack[--top];
    const Node& node = nodes_[id];
    const Vec3 y = node.centroid - query;
    const double yy = dot(y, y), r = std::sqrt(yy), gap = r - node.radius;
    // The third derivatives of 1/r are at most 6/r^4: Taylor's remainder after the linear term.
    const double remainder = 3 * node.spread / (gap * gap * gap * gap);
    if (gap > 0 && remainder <= tolerance) {
      const double trace = node.moment[0].x + node.moment[1].y + node.moment[2].z;
      const Vec3 my{dot(node.moment[0], y), dot(node.moment[1], y), dot(node.moment[2], y)};
      sum.value += (dot(node.area_vector, y) + trace - 3 * dot(y, my) / yy) / (yy * r);
      sum.error += remainder;
    } else if (node.right >= 0) {
      stack[top++] = node.right;
      stack[top++] = id + 1;
    } else {
      for (int32_t i = node.begin; i < node.end; ++i) {
        sum.value += solid_angle(corners_[i].a - query, corners_[i].b - query, corners_[i].c - query);
      }
    }
  }
  return sum;
}

double WindingNumber::operator()(const Vec3& query) const {
  constexpr double kFull = 4 * std::numbers::pi;
  for (double tolerance = 0.02; tolerance > DBL_EPSILON; tolerance /= 32) {
    const Sum sum = evaluate(query, tolerance);
    const double value = sum.value / kFull, error = sum.error / kFull;
    if (error < 0.1 && std::abs(value - 0.5) > error) return value;
  }
  return evaluate(query, -1).value / kFull;
}

}  // namespace medial
