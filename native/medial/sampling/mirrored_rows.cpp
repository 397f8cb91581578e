// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/mirrored_rows.h"

namespace medial {
namespace {

// limit around a vertex, where rounding could continue the walk for ever
constexpr int kMostTriangles = 1 << 12;
// A way out of a triangle that is longer than the way to its third corner by more than rounding is
// none: the walk is parallel to a side.
constexpr double kPastCorner = 1 + 1e-9;  // derived: 1 and rounding

// Holds a triangle in the plane: the edge where the walk enters is on the x axis, and the third
// corner above it.
struct Flat {
  int32_t third;
  double width;
  double x, y;  // of the third corner
};

Flat lay_down(const TriangleMesh& mesh, int32_t triangle, const Edge& base) {
  const Triangle& t = mesh.triangles[triangle];
  Flat flat{};
  for (const int32_t corner : t) {
    if (corner != base[0] && corner != base[1]) flat.third = corner;
  }
  const Vec3 along = mesh.points[base[1]] - mesh.points[base[0]];
  const Vec3 side = mesh.points[flat.third] - mesh.points[base[0]];
  flat.width = length(along);
  flat.x = dot(side, along) / flat.width;
  flat.y = length(cross(along, side)) / flat.width;
  return flat;
}

Barycentric barycentric(const Triangle& t, const Edge& base, double at_end, double at_third) {
  const auto share = [&](int32_t corner) {
    const double at = corner == base[0]   ? 1 - at_end - at_third
                      : corner == base[1] ? at_end
                                          : at_third;
    return std::max(0.0, at);  // near an edge, rounding could lead outside
  };
  return {share(t[0]), share(t[1]), share(t[2])};
}

}  // namespace

std::vector<int32_t> free_pairs(std::span<const Disk> fixed,
                                std::span<const std::array<Disk, 2>> pairs, const Run& run) {
  std::vector<Disk> disks(fixed.begin(), fixed.end());
  for (const auto& pair : pairs) disks.insert(disks.end(), pair.begin(), pair.end());
  std::vector<Vec3> centres;
  for (const Disk& disk : disks) centres.push_back(disk.centre);
  const PointTree tree = PointTree::sorted(centres, run);
  return parallel_append<int32_t>(
      static_cast<int64_t>(pairs.size()), run, [&](int64_t i, std::vector<int32_t>& kept, int) {
        const auto is_free = [&](size_t id) {
          return has_room(disks, id, tree, [&](size_t other) { return other != id; });
        };
        const size_t left = fixed.size() + 2 * static_cast<size_t>(i);
        if (is_free(left) && is_free(left + 1)) {
          kept.push_back(static_cast<int32_t>(i));
        }
      });
}

std::optional<SurfacePlace> walk_from_edge(const TriangleMesh& mesh, const Creases& creases,
                                           const MeshEdge& edge, int32_t triangle, double share,
                                           double distance) {
  Edge base = edge.ends;
  double start = share * medial::distance(mesh.points[base[0]], mesh.points[base[1]]);
  double along = 0, into = 1;  // the direction of the walk
  for (int i = 0; i < kMostTriangles; ++i) {
    const Flat flat = lay_down(mesh, triangle, base);
    if (!(flat.y > 0)) return {};
    // The walk leaves through the edge from `out` to the third corner.
    const int out = along * flat.y - into * (flat.x - start) >= 0;
    const double from = out ? flat.width : 0, slope = flat.x - from;
    // A walk along a side of the triangle leaves it at the third corner.
    const double to_corner = flat.y / into;
    double way = (from - start) * flat.y / (along * flat.y - into * slope);
    if (!(way < kPastCorner * to_corner)) way = to_corner;
    if (!(way < distance)) {
      const double at_third = distance * into / flat.y;
      const double at_end = (start + distance * along - at_third * flat.x) / flat.width;
      return SurfacePlace{triangle, barycentric(mesh.triangles[triangle], base, at_end, at_third)};
    }
    const int32_t next = creases.find(base[out], flat.third);
    if (creases.edges[next].crease != Crease::none) return {};
    const Edge& sides = creases.edges[next].triangles;
    const double size = std::sqrt(slope * slope + flat.y * flat.y);
    triangle = sides[sides[0] == triangle];
    base = {base[out], flat.third};
    start = way * into / flat.y * size;
    const double turned = (along * slope + into * flat.y) / size;
    into = std::abs(slope * into - flat.y * along) / size;
    along = turned;
    distance -= way;
  }
  return {};
}

}  // namespace medial
