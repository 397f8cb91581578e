// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels/even_level.h"

#include "base/rows.h"

namespace medial {
namespace {

class EvenWriter {
 public:
  EvenWriter(const EvenMesh& even, std::span<const Placing> placing, std::span<const double> radius,
             const Hierarchy::Parts& h, Level& level)
      : e_(even),
        placing_(placing),
        radius_(radius),
        h_(h),
        level_(level),
        number_(even.position.size(), -1) {}

  EvenVertices write(const Run& run) {
    const std::vector<int32_t> rows = triangles_in_order();
    write_corners(rows);
    for (Edge& wire : level_.wires) {
      for (int32_t& v : wire) v = renumbered(v);
    }
    for (int32_t& v : level_.points) v = renumbered(v);
    write_facets(rows);
    write_vertices(run);
    EvenVertices of_mesh;
    for (const int32_t v : vertices_) of_mesh.is_end.push_back(e_.mesh.stays(v));
    of_mesh.target = rows_of(e_.target, vertices_);
    of_mesh.held = rows_of(e_.held, vertices_);
    return of_mesh;
  }

 private:
  std::vector<int32_t> triangles_in_order() const {
    auto rows = rows_where(e_.mesh.triangles(), [&](int32_t t) { return !e_.mesh.is_gone(t); });
    std::stable_sort(rows.begin(), rows.end(),
                     [&](int32_t a, int32_t b) { return e_.source[a] < e_.source[b]; });
    return rows;
  }

  int32_t renumbered(int32_t v) {
    if (number_[v] < 0) {
      number_[v] = static_cast<int32_t>(vertices_.size());
      vertices_.push_back(v);
    }
    return number_[v];
  }

  // Triangles are turned as their facets are, about the direction between the generators.
  void write_corners(std::span<const int32_t> rows) {
    level_.face_offsets = {0};
    level_.face_vertices.clear();
    for (const int32_t t : rows) {
      Triangle corners = e_.mesh.triangle(t);
      const auto& [p, q] = h_.complex.generators[level_.facet_of[e_.source[t]]];
      const Vec3 across = (*h_.samples)[q] - (*h_.samples)[p];
      if (dot(e_.normal[t], across) < 0) std::swap(corners[1], corners[2]);
      for (int32_t& v : corners) v = renumbered(v);
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      for (const int32_t v : corners) level_.face_vertices.push_back(v);
      level_.face_offsets.push_back(static_cast<int32_t>(level_.face_vertices.size()));
    }
  }

  void write_facets(std::span<const int32_t> rows) {
    const std::vector<int32_t> source = rows_of(e_.source, rows);
    level_.generators = rows_of(level_.generators, source);
    level_.facet_of = rows_of(level_.facet_of, source);
    level_.theta = rows_of(level_.theta, source);
    level_.rho = rows_of(level_.rho, source);
    level_.sheet = rows_of(level_.sheet, source);
    level_.erosion = rows_of(level_.erosion, source);
  }

  void write_vertices(const Run& run) {
    const std::vector<int32_t> origin = rows_of(e_.origin, vertices_);
    level_.vertex_of = rows_of(level_.vertex_of, origin);
    level_.exact = rows_of(level_.exact, origin);
    level_.exact_radius = rows_of(level_.exact_radius, origin);
    const Column<Vec3> before = rows_of(level_.vertices, origin);
    level_.radius = rows_of(level_.radius, origin);
    level_.vertices.resize(vertices_.size());
    level_.place.assign(vertices_.size(), Placing::voronoi);
    parallel_for(static_cast<int64_t>(vertices_.size()), run, [&](int64_t i) {
      const int32_t v = vertices_[i];
      level_.vertices[i] = e_.position[v];
      if (!placing_.empty()) level_.place[i] = placing_[v];
      if (level_.place[i] >= Placing::touching) {
        level_.radius[i] = radius_[v];
      } else {
        const bool moved = level_.vertices[i] != before[i];
        level_.radius[i] = radius_at(level_.vertices[i], moved ? HUGE_VAL : level_.radius[i]);
      }
    });
  }

  // Returns the radius of a vertex whose ball touches no two walls: the one that is known, or else
  // the distance to the samples, within the faces.
  double radius_at(const Vec3& place, double known) const {
    const double radius = known < HUGE_VAL ? known : h_.samples->nearest(place).distance;
    const bool has_faces = h_.on_faces && !placing_.empty();
    return has_faces ? h_.on_faces->within_faces(place, radius) : radius;
  }

  const EvenMesh& e_;
  std::span<const Placing> placing_;
  std::span<const double> radius_;
  const Hierarchy::Parts& h_;
  Level& level_;
  std::vector<int32_t> number_;    // per vertex of the mesh: its number in the level, or -1
  std::vector<int32_t> vertices_;  // the other direction
};

}  // namespace

EvenVertices write_even(const EvenMesh& even, std::span<const Placing> placing,
                        std::span<const double> radius, const Hierarchy::Parts& hierarchy,
                        Level& level, const Run& run) {
  return EvenWriter(even, placing, radius, hierarchy, level).write(run);
}

}  // namespace medial
