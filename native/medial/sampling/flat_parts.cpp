// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/flat_parts.h"

#include "base/union_find.h"

namespace medial {
namespace {

struct Plane {
  Vec3 normal, origin;
};

// Returns the cross product of two sides.
Vec3 doubled_area(const TriangleMesh& mesh, int32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vec3& p = mesh.points[a];
  return cross(mesh.points[b] - p, mesh.points[c] - p);
}

double height_over(const TriangleMesh& mesh, int32_t triangle, const Edge& edge, int32_t other) {
  const Triangle& t = mesh.triangles[other];
  const Vec3& third = mesh.points[t[0] + t[1] + t[2] - edge[0] - edge[1]];
  return std::abs(dot(mesh.normal[triangle], third - mesh.points[edge[0]]));
}

bool in_plane(const TriangleMesh& mesh, int32_t triangle, const Plane& plane, double rounding) {
  const auto near = [&](int32_t p) {
    return std::abs(dot(plane.normal, mesh.points[p] - plane.origin)) <= rounding;
  };
  const Triangle& t = mesh.triangles[triangle];
  return near(t[0]) && near(t[1]) && near(t[2]);
}

// Joins triangles whose neighbours lie in their planes.
std::vector<int32_t> joined_by_edges(const TriangleMesh& mesh, const Creases& creases,
                                     double rounding) {
  UnionFind joined(mesh.triangles.size());
  for (const MeshEdge& edge : creases.edges) {
    if (edge.crease != Crease::none || !edge.manifold) continue;
    const auto& [s, t] = edge.triangles;
    const double off =
        std::min(height_over(mesh, s, edge.ends, t), height_over(mesh, t, edge.ends, s));
    if (off <= rounding) joined.unite(s, t);
  }
  const auto parts = std::move(joined).representatives();
  return {parts.begin(), parts.end()};
}

// Returns the largest triangle of each part, at the id of the part.
std::vector<int32_t> largest_of(const TriangleMesh& mesh, std::span<const int32_t> part) {
  std::vector<int32_t> largest(part.size(), -1);
  std::vector<double> area(part.size(), -1);
  for (size_t t = 0; t < part.size(); ++t) {
    const double here = squared_length(doubled_area(mesh, static_cast<int32_t>(t)));
    if (!(here > area[part[t]])) continue;
    area[part[t]] = here;
    largest[part[t]] = static_cast<int32_t>(t);
  }
  return largest;
}

// Returns the plane with the mean normal of each part, at the id of the part.
std::vector<Plane> mean_planes(const TriangleMesh& mesh, std::span<const int32_t> part) {
  std::vector<Plane> planes(part.size());
  std::vector<double> weight(part.size(), 0);
  for (size_t t = 0; t < part.size(); ++t) {
    const Vec3 normal = doubled_area(mesh, static_cast<int32_t>(t));
    const auto& [a, b, c] = mesh.triangles[t];
    const double third = length(normal) / 3;
    Plane& plane = planes[part[t]];
    plane.normal = plane.normal + normal;
    plane.origin = plane.origin + third * (mesh.points[a] + mesh.points[b] + mesh.points[c]);
    weight[part[t]] += 3 * third;
  }
  for (size_t i = 0; i < planes.size(); ++i) {
    planes[i].normal = normalized(planes[i].normal);
    if (weight[i] > 0) planes[i].origin = (1 / weight[i]) * planes[i].origin;
  }
  return planes;
}

// Neighbours that lie in each other's planes may lead round a bend, as on finely cut smooth
// surfaces. A bent part keeps what lies in the plane of its largest triangle if that is most of
// it, as where a sliver joins a wall and a fillet; else each triangle is by itself.
void keep_planar(const TriangleMesh& mesh, double rounding, std::vector<int32_t>& part) {
  const std::vector<Plane> means = mean_planes(mesh, part);
  const auto largest = largest_of(mesh, part);
  std::vector<uint8_t> bent(part.size(), 0);
  std::vector<double> balance(part.size(), 0);  // the area in the plane minus the other one
  const auto stays = [&](int32_t t) {
    const int32_t base = largest[part[t]];
    return in_plane(mesh, t, {mesh.normal[base], mesh.points[mesh.triangles[base][0]]}, rounding);
  };
  const auto count = static_cast<int32_t>(part.size());
  for (int32_t t = 0; t < count; ++t) {
    const double area = length(doubled_area(mesh, t));
    bent[part[t]] |= !in_plane(mesh, t, means[part[t]], rounding);
    balance[part[t]] += stays(t) ? area : -area;
  }
  for (int32_t t = 0; t < count; ++t) {
    const int32_t of = part[t];
    const bool whole = !bent[of] || (balance[of] > 0 && stays(t));
    part[t] = whole ? largest[of] : t;
  }
}

// Returns the length of the border of each part, at the id of the part.
std::vector<double> borders(const TriangleMesh& mesh, const Creases& creases,
                            std::span<const int32_t> part) {
  std::vector<double> border(part.size(), 0);
  for (const MeshEdge& edge : creases.edges) {
    const auto& [s, t] = edge.triangles;
    if (t >= 0 && part[s] == part[t]) continue;
    const double length = distance(mesh.points[edge.ends[0]], mesh.points[edge.ends[1]]);
    border[part[s]] += length;
    if (t >= 0) border[part[t]] += length;
  }
  return border;
}

}  // namespace

FlatParts flat_parts(const TriangleMesh& mesh, const Creases& creases) {
  const size_t count = mesh.triangles.size();
  FlatParts flat{joined_by_edges(mesh, creases, mesh.rounding), {}, {}, {}};
  keep_planar(mesh, mesh.rounding, flat.part);
  std::vector<double> area(count, 0);
  std::vector<int32_t> members(count, 0);
  for (size_t t = 0; t < count; ++t) {
    area[flat.part[t]] += length(doubled_area(mesh, static_cast<int32_t>(t)));
    ++members[flat.part[t]];
  }
  const auto border = borders(mesh, creases, flat.part);
  for (const int32_t part : flat.part) {
    flat.area.push_back(area[part]);
    flat.width.push_back(border[part] > 0 ? area[part] / border[part] : HUGE_VAL);
    flat.alone.push_back(members[part] == 1);
  }
  return flat;
}

double reach_from(const TriangleMesh& mesh, int32_t triangle, const Edge& edge) {
  const double length = distance(mesh.points[edge[0]], mesh.points[edge[1]]);
  return medial::length(doubled_area(mesh, triangle)) / length;
}

}  // namespace medial
