// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/even_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/cgal.h"
#include "base/portable_math.h"
#include "base/progress.h"
// clang-format off: CGAL's headers come after what sets CGAL up.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>
// clang-format on

namespace medial {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Edges = Mesh::Property_map<Mesh::Edge_index, bool>;
using Rows = Mesh::Property_map<Mesh::Vertex_index, int32_t>;

// CGAL 6 flips edges by angles, which it would ask the C library for.
struct Traits : Kernel {
  struct Compute_approximate_angle_3 {
    double operator()(const Kernel::Point_3& p, const Kernel::Point_3& q,
                      const Kernel::Point_3& r) const {
      const Kernel::Vector_3 u = p - q, v = r - q;
      const double lengths = std::sqrt(u.squared_length() * v.squared_length());
      return lengths > 0 ? degrees * portable::acos(std::clamp(u * v / lengths, -1.0, 1.0)) : 0;
    }
    static constexpr double degrees = 180 / std::numbers::pi;
  };
  static Compute_approximate_angle_3 compute_approximate_angle_3_object() { return {}; }
};

constexpr int iterations = 5;             // more change little
constexpr double flat = 0.01;             // the square of height by longest edge
constexpr double half_right_angle = 0.5;  // the squared cosine

Vec3 place(const Mesh& mesh, Mesh::Vertex_index v) {
  const auto& p = mesh.point(v);
  return {p.x(), p.y(), p.z()};
}

// Returns the normal of a triangle, as long as twice its area; none if the triangle is so flat that
// it may point anywhere.
Vec3 normal(const Mesh& mesh, Mesh::Halfedge_index h) {
  const Vec3 a = place(mesh, mesh.source(h)), b = place(mesh, mesh.target(h));
  const Vec3 c = place(mesh, mesh.target(mesh.next(h)));
  const Vec3 n = cross(b - a, c - a);
  const double longest =
      std::max({squared_length(b - a), squared_length(c - b), squared_length(a - c)});
  return dot(n, n) > flat * longest * longest ? n : Vec3{};
}

bool is_fold(const Mesh& mesh, Mesh::Edge_index e) {
  const auto h = mesh.halfedge(e);
  const Vec3 a = normal(mesh, h), b = normal(mesh, mesh.opposite(h));
  const double both = dot(a, b);
  if (!(dot(a, a) > 0 && dot(b, b) > 0)) return false;
  return both < 0 || both * both < half_right_angle * dot(a, a) * dot(b, b);
}

bool is_oriented_manifold(std::span<const Triangle> triangles) {
  std::vector<std::array<size_t, 3>> faces;
  faces.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles)
    faces.push_back({static_cast<size_t>(a), static_cast<size_t>(b), static_cast<size_t>(c)});
  return pmp::is_polygon_soup_a_polygon_mesh(faces);
}

// Returns the sheet with the length as unit, so that no product overflows or underflows.
Mesh in_lengths(std::span<const Vec3> rows, std::span<const Triangle> triangles, double length) {
  Mesh mesh;
  for (const Vec3& p : rows) {
    const Vec3 q = (1 / length) * (p - rows[0]);
    mesh.add_vertex({q.x, q.y, q.z});
  }
  for (const auto& [a, b, c] : triangles)
    mesh.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c));
  return mesh;
}

// Marks the edges that stay, and gives their ends the rows that they are.
Edges edges_that_stay(Mesh& mesh, Rows& row) {
  Edges stays = mesh.add_property_map<Mesh::Edge_index, bool>("e:stays", false).first;
  for (const auto e : mesh.edges()) {
    stays[e] = mesh.is_border(e) || is_fold(mesh, e);
    if (!stays[e]) continue;
    for (const int end : {0, 1}) {
      const auto v = mesh.vertex(e, end);
      row[v] = static_cast<int32_t>(v.idx());
    }
  }
  return stays;
}

EvenSheet taken(const Mesh& mesh, const Rows& row, std::span<const Vec3> rows, double length) {
  EvenSheet found;
  for (const auto v : mesh.vertices()) {
    found.given.push_back(row[v]);
    found.rows.push_back(row[v] < 0 ? rows[0] + length * place(mesh, v) : rows[row[v]]);
  }
  for (const auto f : mesh.faces()) {
    Triangle t;
    int corner = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
      t[corner++] = static_cast<int32_t>(v.idx());
    found.triangles.push_back(t);
  }
  return found;
}

}  // namespace

std::optional<EvenSheet> even_sheet(std::span<const Vec3> rows, std::span<const Triangle> triangles,
                                    double length, const Run& run) {
  throw_if_cancelled(run.progress);
  if (triangles.empty() || !is_oriented_manifold(triangles)) return std::nullopt;
  Mesh mesh = in_lengths(rows, triangles, length);
  Rows row = mesh.add_property_map<Mesh::Vertex_index, int32_t>("v:row", -1).first;
  const Edges stays = edges_that_stay(mesh, row);
  pmp::isotropic_remeshing(mesh.faces(), 1.0, mesh,
                           CGAL::parameters::number_of_iterations(iterations)
                               .geom_traits(Traits())
                               .protect_constraints(true)
                               .edge_is_constrained_map(stays));
  mesh.collect_garbage();
  return taken(mesh, row, rows, length);
}

}  // namespace medial
