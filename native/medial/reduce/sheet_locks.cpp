// SPDX-License-Identifier: GPL-3.0-or-later
#include "reduce/sheet_locks.h"

#include <algorithm>

#include "base/triangle.h"

namespace medial {

SheetLocks::SheetLocks(const SphereComplex& complex, const SheetLabels& labels, size_t vertices)
    : shortest_(labels.shortest),
      part_(labels.part.begin(), labels.part.end()),
      node_(vertices, 0),
      curve_(vertices, 0) {
  for (const int32_t v : labels.nodes) node_[v] = 1;
  for (size_t v = 0; v < vertices; ++v) curve_[v] = curve_edges(complex, static_cast<int32_t>(v));
}

bool SheetLocks::is_curve(const SphereComplex& complex, int32_t a, int32_t b) const {
  int count = 0;
  int32_t part = -1;
  for (const int32_t t : complex.triangles_of(a)) {
    if (!has_corner(complex.triangle(t), b)) continue;
    if (count++ > 0 && part_[t] != part) return true;
    part = part_[t];
  }
  return count != 2;
}

bool SheetLocks::may_merge(const SphereComplex& complex, int32_t vertex, int32_t into,
                           std::span<const Sphere> spheres) const {
  if (is_node(vertex)) return false;
  if (is_sharp(vertex, spheres[vertex]) && !is_sharp(into, spheres[into])) return false;
  if (!is_on_curve(vertex)) return true;
  return is_curve(complex, vertex, into) && (!is_end(vertex) || is_end(into));
}

bool SheetLocks::may_move(const SphereComplex& complex, int32_t a, int32_t b,
                          std::span<const Sphere> spheres) const {
  if (is_node(a) || is_node(b) || is_on_curve(a) != is_on_curve(b)) return false;
  if (!is_on_curve(a)) return true;
  if (is_end(a) || is_end(b)) return false;
  return !is_sharp(a, spheres[a]) && !is_sharp(b, spheres[b]) && is_curve(complex, a, b);
}

bool SheetLocks::ends_sheet(const SphereComplex& complex, int32_t a, int32_t b) const {
  return std::ranges::any_of(complex.triangles_of(a), [&](int32_t t) {
    const auto& [p, q, r] = complex.triangle(t);
    return has_corner({p, q, r}, b) && is_curve(complex, p, q) && is_curve(complex, q, r) &&
           is_curve(complex, r, p);
  });
}

void SheetLocks::update(const SphereComplex& complex, int32_t vertex) {
  curve_[vertex] = curve_edges(complex, vertex);
  for (const int32_t v : complex.neighbours(vertex)) curve_[v] = curve_edges(complex, v);
}

int32_t SheetLocks::curve_edges(const SphereComplex& complex, int32_t vertex) const {
  const auto others = complex.neighbours(vertex);
  return static_cast<int32_t>(std::count_if(
      others.begin(), others.end(), [&](int32_t v) { return is_curve(complex, vertex, v); }));
}

}  // namespace medial
