// SPDX-License-Identifier: GPL-3.0-or-later
#include "reduce/sphere_complex.h"

#include <algorithm>

#include "base/sort_unique.h"
#include "base/triangle.h"

namespace medial {
namespace {

bool holds(std::span<const int32_t> ids, int32_t id) {
  return std::binary_search(ids.begin(), ids.end(), id);
}

void insert(std::vector<int32_t>& ids, int32_t id) {
  const auto at = std::lower_bound(ids.begin(), ids.end(), id);
  if (at == ids.end() || *at != id) ids.insert(at, id);
}

void erase(std::vector<int32_t>& ids, int32_t id) {
  const auto at = std::lower_bound(ids.begin(), ids.end(), id);
  if (at != ids.end() && *at == id) ids.erase(at);
}

// Returns the corners of a triangle other than the given one.
Edge others(const Triangle& triangle, int32_t vertex) {
  const auto& [a, b, c] = triangle;
  return a == vertex ? Edge{b, c} : b == vertex ? Edge{c, a} : Edge{a, b};
}

}  // namespace

SphereComplex::SphereComplex(const SphereMesh& mesh)
    : triangles_(mesh.triangles.begin(), mesh.triangles.end()),
      neighbours_(mesh.vertices.size()),
      of_vertex_(mesh.vertices.size()) {
  const auto join = [&](int32_t a, int32_t b) {
    neighbours_[a].push_back(b);
    neighbours_[b].push_back(a);
  };
  for (size_t t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    join(a, b);
    join(b, c);
    join(c, a);
    for (const int32_t corner : triangles_[t]) of_vertex_[corner].push_back(int32_t(t));
  }
  for (const auto& [a, b] : mesh.wires) join(a, b);
  for (auto& ids : neighbours_) {
    sort_unique(ids);
  }
}

int64_t SphereComplex::triangle_count(int32_t a, int32_t b) const {
  return std::count_if(of_vertex_[a].begin(), of_vertex_[a].end(),
                       [&](int32_t t) { return has_corner(triangles_[t], b); });
}

bool SphereComplex::has_triangle(int32_t a, int32_t b, int32_t c) const {
  return std::any_of(of_vertex_[a].begin(), of_vertex_[a].end(), [&](int32_t t) {
    return has_corner(triangles_[t], b) && has_corner(triangles_[t], c);
  });
}

bool SphereComplex::can_collapse(int32_t a, int32_t b) const {
  for (const int32_t vertex : neighbours_[a]) {
    if (holds(neighbours_[b], vertex) && !has_triangle(a, b, vertex)) return false;
  }
  return std::all_of(of_vertex_[a].begin(), of_vertex_[a].end(), [&](int32_t t) {
    if (has_corner(triangles_[t], b)) return true;
    const auto [c, d] = others(triangles_[t], a);
    return !holds(neighbours_[b], c) || !has_triangle(b, c, d);
  });
}

void SphereComplex::collapse(int32_t a, int32_t b) {
  for (const int32_t t : of_vertex_[b]) {
    Triangle& triangle = triangles_[t];
    if (has_corner(triangle, a)) {
      for (const int32_t corner : triangle) {
        if (corner != b) erase(of_vertex_[corner], t);
      }
    } else {
      *std::find(triangle.begin(), triangle.end(), b) = a;
      insert(of_vertex_[a], t);
    }
  }
  of_vertex_[b].clear();
  for (const int32_t vertex : neighbours_[b]) {
    erase(neighbours_[vertex], b);
    if (vertex == a) continue;
    insert(neighbours_[vertex], a);
    insert(neighbours_[a], vertex);
  }
  neighbours_[b].clear();
}

}  // namespace medial
