// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/mesh_parts.h"

#include <algorithm>

#include "base/rounding.h"
#include "base/rows.h"
#include "base/union_find.h"
#include "inside/boundary.h"
#include "inside/surface.h"

namespace medial {
namespace {

// Two faces that share an edge; or one at whose edge its part is open, and -1.
struct EdgeFaces {
  int32_t first, second;
};

std::vector<EdgeFaces> edge_faces(std::span<const Triangle> faces, int32_t vertices,
                                  const Run& run) {
  const auto fans = rows_containing(faces, vertices, run);
  return append_by_edge<EdgeFaces>(
      faces, fans, run, [](int32_t, std::span<const EdgeUse> uses, std::vector<EdgeFaces>& out) {
        int surplus = 0;
        for (const EdgeUse& use : uses) surplus += use.forward ? 1 : -1;
        for (const EdgeUse& use : uses.subspan(1)) {
          out.push_back({uses[0].triangle, use.triangle});
        }
        if (surplus != 0) out.push_back({uses[0].triangle, -1});
      });
}

// Calls use(part, vertex) for the corners of the faces that are in a part.
template <typename Use>
void for_corners(const MeshParts& parts, std::span<const Triangle> faces, const Use& use) {
  for (size_t face = 0; face < faces.size(); ++face) {
    if (parts.part[face] < 0) continue;
    for (const int32_t v : faces[face]) use(static_cast<size_t>(parts.part[face]), v);
  }
}

struct Farthest {
  int32_t corner = -1;  // the first one that is farthest; -1 where all distances are zero
  double distance = 0;
};

// Finds the corner of each part that is farthest by a measure of parts and vertices.
template <typename Measure>
std::vector<Farthest> farthest_corners(const MeshParts& parts, std::span<const Triangle> faces,
                                       const Measure& measure) {
  std::vector<Farthest> found(static_cast<size_t>(parts.count));
  for_corners(parts, faces, [&](size_t p, int32_t v) {
    const double distance = measure(p, v);
    if (distance > found[p].distance) found[p] = {v, distance};
  });
  return found;
}

// Returns the rounding of the corners of each part.
std::vector<double> roundings(const MeshParts& parts, std::span<const Triangle> faces,
                              std::span<const Vec3> points) {
  std::vector<std::vector<Vec3>> corners(static_cast<size_t>(parts.count));
  for_corners(parts, faces, [&](size_t p, int32_t v) { corners[p].push_back(points[v]); });
  std::vector<double> found;
  found.reserve(corners.size());
  for (const auto& some : corners) found.push_back(rounding_of(some));
  return found;
}

// Marks the parts whose corners lie in the plane of three of them that are far from each other.
void mark_flat(MeshParts& parts, std::span<const Triangle> faces, std::span<const Vec3> points) {
  std::vector<int32_t> first(static_cast<size_t>(parts.count), -1);
  for_corners(parts, faces, [&](size_t p, int32_t v) {
    if (first[p] < 0) first[p] = v;
  });
  const auto way = [&](size_t p, int32_t v) { return points[v] - points[first[p]]; };
  const auto second =
      farthest_corners(parts, faces, [&](size_t p, int32_t v) { return length(way(p, v)); });
  const auto normal = [&](size_t p, int32_t v) {
    return second[p].corner < 0 ? Vec3{} : cross(way(p, second[p].corner), way(p, v));
  };
  const auto third =
      farthest_corners(parts, faces, [&](size_t p, int32_t v) { return length(normal(p, v)); });
  const auto height = farthest_corners(parts, faces, [&](size_t p, int32_t v) {
    if (third[p].corner < 0) return 0.0;
    return std::abs(dot(way(p, v), normal(p, third[p].corner))) / third[p].distance;
  });
  const auto rounding = roundings(parts, faces, points);
  for (size_t p = 0; p < height.size(); ++p) {
    parts.flat[p] = height[p].distance <= rounding[p] ? 1 : 0;
  }
}

void number_parts(MeshParts& parts, std::span<const Triangle> faces, UnionFind sets) {
  std::vector<int32_t> number(faces.size(), -1);
  parts.part.assign(faces.size(), -1);
  for (size_t face = 0; face < faces.size(); ++face) {
    if (!has_three_corners(faces[face])) continue;
    const int32_t root = sets.find(static_cast<int32_t>(face));
    if (number[root] < 0) number[root] = parts.count++;
    parts.part[face] = number[root];
  }
}

}  // namespace

MeshParts mesh_parts(std::span<const Vec3> rows, std::span<const Triangle> triangles,
                     const Run& run) {
  require_corners(triangles, rows.size());
  const DistinctRows distinct = distinct_rows(rows, "point", run);
  std::vector<Triangle> faces, counted;
  faces.reserve(triangles.size());
  for (const auto& [i, j, k] : triangles) {
    faces.push_back({distinct.point_of_row[i], distinct.point_of_row[j], distinct.point_of_row[k]});
  }
  counted = faces;
  for (Triangle& t : counted) {
    if (!has_three_corners(t)) t.fill(-1);
  }
  const auto edges = edge_faces(counted, distinct.count(), run);
  UnionFind sets(faces.size(), run);
  for (const auto& [first, second] : edges) {
    if (second >= 0) sets.unite(first, second);
  }
  MeshParts parts;
  number_parts(parts, faces, std::move(sets));
  parts.open.assign(static_cast<size_t>(parts.count), 0);
  parts.flat.assign(static_cast<size_t>(parts.count), 0);
  for (const auto& [first, second] : edges) {
    if (second < 0) parts.open[parts.part[first]] = 1;
  }
  mark_flat(parts, faces, distinct.points);
  return parts;
}

}  // namespace medial
