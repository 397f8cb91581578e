// SPDX-License-Identifier: GPL-3.0-or-later
#include "reduce/checked_mesh.h"

#include <algorithm>

#include "base/rows.h"
#include "base/sort_unique.h"
#include "base/text.h"
#include "base/triangle.h"

namespace medial {
namespace {

template <typename Rows>
void require_ids(const Rows& rows, size_t vertices, const char* what) {
  for (size_t i = 0; i < rows.size(); ++i) {
    for (const int32_t id : rows[i]) {
      if (id >= 0 && static_cast<size_t>(id) < vertices) continue;
      throw InvalidInputError("Expected rows of " + std::to_string(vertices) + " vertices in " +
                              what + ", found " + std::to_string(id) + " in row " +
                              std::to_string(i) + "; number them from 0.");
    }
  }
}

Column<Triangle> distinct(const Column<Triangle>& triangles) {
  std::vector<std::pair<Triangle, size_t>> keys;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const Triangle t = ascending(triangles[i]);
    if (t[0] != t[1] && t[1] != t[2]) keys.emplace_back(t, i);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<size_t> kept;
  for (size_t k = 0; k < keys.size(); ++k) {
    if (k == 0 || keys[k].first != keys[k - 1].first) kept.push_back(keys[k].second);
  }
  std::sort(kept.begin(), kept.end());
  Column<Triangle> result;
  for (const size_t i : kept) result.push_back(triangles[i]);
  return result;
}

}  // namespace

void require_sphere_mesh(const SphereMesh& mesh) {
  require_finite(mesh.vertices, "vertex");
  require_one_each(mesh.radius.size(), mesh.vertices.size(), "one radius per vertex",
                   "vertices; pass all of them");
  for (size_t v = 0; v < mesh.radius.size(); ++v) {
    if (mesh.radius[v] >= 0 && mesh.radius[v] <= kLargestCoordinate) continue;
    throw InvalidInputError("Expected radii of 0 to " + text(kLargestCoordinate) + ", found " +
                            text(mesh.radius[v]) + " at vertex " + std::to_string(v) +
                            "; correct it.");
  }
  require_ids(mesh.triangles, mesh.vertices.size(), "triangles");
  require_ids(mesh.wires, mesh.vertices.size(), "edges");
}

std::vector<Edge> sides_of(std::span<const Triangle> triangles) {
  std::vector<Edge> sides;
  for (const auto& [a, b, c] : triangles) {
    for (const Edge& side : {Edge{a, b}, Edge{b, c}, Edge{a, c}}) {
      sides.push_back({std::min(side[0], side[1]), std::max(side[0], side[1])});
    }
  }
  return sides;
}

SphereMesh without_doubles(SphereMesh mesh) {
  mesh.triangles = distinct(mesh.triangles);
  auto sides = sides_of(mesh.triangles);
  sort_unique(sides);
  for (Edge& wire : mesh.wires) wire = {std::min(wire[0], wire[1]), std::max(wire[0], wire[1])};
  sort_unique(mesh.wires);
  std::erase_if(mesh.wires, [&](const Edge& wire) {
    return wire[0] == wire[1] || std::binary_search(sides.begin(), sides.end(), wire);
  });
  return mesh;
}

Frame frame_of(const SphereMesh& mesh) {
  const Box box = box_of(mesh.vertices);
  double extent = max_abs(box.extent());
  for (const double radius : mesh.radius) extent = std::max(extent, radius);
  return {box.centre(), extent > 0 ? std::ilogb(extent) : 0};
}

}  // namespace medial
