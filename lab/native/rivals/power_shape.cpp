// SPDX-License-Identifier: GPL-3.0-or-later
#include "rivals/power_shape.h"

#include <string>

#include "base/cgal.h"
#include "base/frame.h"
#include "base/rows.h"
// clang-format off: CGAL's headers come after what sets CGAL up.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
// clang-format on
#include "base/insertion_order.h"

namespace medial {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
struct Ball {
  int32_t row = -1;
};
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_3<Ball, Kernel,
                                                CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using CellBase = CGAL::Regular_triangulation_cell_base_3<Kernel>;
using Regular =
    CGAL::Regular_triangulation_3<Kernel,
                                  CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using VertexHandle = Regular::Vertex_handle;

void check(std::span<const Vec3> centres, std::span<const double> radii,
           std::span<const uint8_t> wanted) {
  require_finite(centres, "centre");
  if (radii.size() != centres.size() || wanted.size() != centres.size()) {
    throw InvalidInputError("Expected a radius and a flag for each of " +
                            std::to_string(centres.size()) + " centres, found " +
                            std::to_string(radii.size()) + " and " + std::to_string(wanted.size()) +
                            "; pass one per centre.");
  }
  for (const double radius : radii) {
    if (!(radius >= 0 && radius <= kLargestCoordinate)) {
      throw InvalidInputError("Expected finite radii of 0 or more, found " +
                              std::to_string(radius) + "; leave such balls out.");
    }
  }
}

// Inserts all balls. Among equal balls the one with the lowest row gets the cell.
void insert_all(Regular& regular, std::span<const Vec3> centres, std::span<const double> radii,
                Progress* progress) {
  constexpr size_t kStep = 512;
  const Frame frame = frame_of(centres, {});
  const double scale = std::ldexp(1.0, -frame.exponent);
  const auto along_curve = hilbert_order(centres, {});
  const auto order = insertion_order(static_cast<int32_t>(centres.size()));
  VertexHandle hint;
  for (size_t i = 0; i < order.size(); ++i) {
    if (i % kStep == 0) {
      throw_if_cancelled(progress);
      advance(progress, static_cast<double>(i) / static_cast<double>(order.size()));
    }
    const int32_t row = along_curve[order[i]];
    const Vec3 c = frame.inward(centres[row]);
    const double r = scale * radii[row];
    const auto vertex = regular.insert(Regular::Weighted_point({c.x, c.y, c.z}, r * r), hint);
    if (vertex == VertexHandle()) continue;  // another ball has the place
    int32_t& first = vertex->info().row;
    if (first < 0 || row < first) first = row;
    hint = vertex;
  }
}

// Finds the rows of the corners, ascending; returns whether all of them are wanted.
template <size_t Size>
bool rows_of(const std::array<VertexHandle, Size>& corners, std::span<const uint8_t> wanted,
             std::array<int32_t, Size>& rows) {
  std::transform(corners.begin(), corners.end(), rows.begin(),
                 [](const VertexHandle& corner) { return corner->info().row; });
  std::sort(rows.begin(), rows.end());
  return std::all_of(rows.begin(), rows.end(), [&](int32_t row) { return wanted[row] != 0; });
}

Column<Triangle> triangles_of(const Regular& regular, std::span<const uint8_t> wanted) {
  Column<Triangle> found;
  Triangle rows;
  for (const auto& [cell, i] : regular.finite_facets()) {
    const std::array<VertexHandle, 3> corners = {
        cell->vertex((i + 1) & 3), cell->vertex((i + 2) & 3), cell->vertex((i + 3) & 3)};
    if (rows_of(corners, wanted, rows)) found.push_back(rows);
  }
  std::sort(found.begin(), found.end());
  return found;
}

Column<Edge> edges_of(const Regular& regular, std::span<const uint8_t> wanted) {
  Column<Edge> found;
  Edge rows;
  for (const auto& [cell, i, j] : regular.finite_edges()) {
    if (rows_of<2>({cell->vertex(i), cell->vertex(j)}, wanted, rows)) found.push_back(rows);
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<Edge> edges_of(std::span<const Triangle> triangles) {
  std::vector<Edge> edges;
  for (const auto& [i, j, k] : triangles) edges.insert(edges.end(), {{i, j}, {i, k}, {j, k}});
  std::sort(edges.begin(), edges.end());
  return edges;
}

}  // namespace

PowerShape power_shape(std::span<const Vec3> centres, std::span<const double> radii,
                       std::span<const uint8_t> wanted, Progress* progress) {
  check(centres, radii, wanted);
  begin_stage(progress, "Power shape", 0, 1);
  Regular regular;
  insert_all(regular, centres, radii, progress);
  PowerShape shape;
  for (const auto vertex : regular.finite_vertex_handles()) {
    const int32_t row = vertex->info().row;
    if (wanted[row]) shape.balls.push_back(row);
  }
  std::sort(shape.balls.begin(), shape.balls.end());
  shape.triangles = triangles_of(regular, wanted);
  const auto in_triangles = edges_of(shape.triangles);
  for (const Edge& edge : edges_of(regular, wanted)) {
    if (!std::binary_search(in_triangles.begin(), in_triangles.end(), edge)) {
      shape.edges.push_back(edge);
    }
  }
  advance(progress, 1);
  return shape;
}

}  // namespace medial
