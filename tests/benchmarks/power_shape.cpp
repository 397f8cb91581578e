// SPDX-License-Identifier: GPL-3.0-or-later
// The power shape (Amenta, Choi & Kolluri 2001): power_shape BALLS OUTPUT.off
// BALLS is a file of doubles x y z radius inner ...; inner is 1 or 0. Written are the triangles and
// edges of CGAL's regular triangulation of all balls whose corners are inner balls: that is where
// power cells of these meet. Balls without a cell are left out.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <utility>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex =
    CGAL::Triangulation_vertex_base_with_info_3<int, Kernel,
                                                CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using Data =
    CGAL::Triangulation_data_structure_3<Vertex, CGAL::Regular_triangulation_cell_base_3<Kernel>>;
using Regular = CGAL::Regular_triangulation_3<Kernel, Data>;

namespace {

struct Balls {
  std::vector<std::pair<Regular::Weighted_point, int>> places;
  std::vector<bool> inner;
};

Balls read(const char* path) {
  Balls balls;
  std::ifstream file(path, std::ios::binary);
  double row[5];
  while (file.read(reinterpret_cast<char*>(row), sizeof row)) {
    const Regular::Bare_point centre(row[0], row[1], row[2]);
    const int id = static_cast<int>(balls.places.size());
    balls.places.emplace_back(Regular::Weighted_point(centre, row[3] * row[3]), id);
    balls.inner.push_back(row[4] != 0.0);
  }
  return balls;
}

// Ids of the inner balls whose cells meet: two or three of them, ascending.
template <std::size_t Size>
void keep(std::array<Regular::Vertex_handle, Size> corners, const std::vector<bool>& inner,
          std::vector<std::array<int, Size>>& found) {
  std::array<int, Size> ids;
  for (std::size_t i = 0; i < Size; ++i) {
    ids[i] = corners[i]->info();
    if (!inner[static_cast<std::size_t>(ids[i])]) return;
  }
  std::sort(ids.begin(), ids.end());
  found.push_back(ids);
}

template <std::size_t Size>
void write(std::ofstream& file, std::vector<std::array<int, Size>>& simplices,
           const std::vector<int>& row) {
  std::sort(simplices.begin(), simplices.end());
  for (const auto& simplex : simplices) {
    file << Size;
    for (const int id : simplex) file << ' ' << row[static_cast<std::size_t>(id)];
    file << '\n';
  }
}

// Row in the file of each inner ball that has a cell; -1: of none.
std::vector<int> rows_of(const Regular& regular, const Balls& balls) {
  std::vector<int> row(balls.inner.size(), -1);
  for (const auto vertex : regular.finite_vertex_handles())
    row[static_cast<std::size_t>(vertex->info())] = 0;
  int next = 0;
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = row[i] == 0 && balls.inner[i] ? next++ : -1;
  return row;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) {
    std::cerr << "Expected power_shape BALLS OUTPUT.off\n";
    return 2;
  }
  const Balls balls = read(arguments[1]);
  const Regular regular(balls.places.begin(), balls.places.end());
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> edges;
  for (const auto& [cell, i] : regular.finite_facets())
    keep<3>({cell->vertex((i + 1) & 3), cell->vertex((i + 2) & 3), cell->vertex((i + 3) & 3)},
            balls.inner, triangles);
  for (const auto& [cell, i, j] : regular.finite_edges())
    keep<2>({cell->vertex(i), cell->vertex(j)}, balls.inner, edges);
  const std::vector<int> row = rows_of(regular, balls);
  std::ofstream file(arguments[2]);
  file << "OFF\n"
       << 1 + *std::max_element(row.begin(), row.end()) << ' ' << triangles.size() + edges.size()
       << " 0\n"
       << std::setprecision(17);
  for (std::size_t i = 0; i < row.size(); ++i)
    if (row[i] >= 0) file << balls.places[i].first.point() << '\n';
  write(file, triangles, row);
  write(file, edges, row);
  return file.flush() ? 0 : 1;
}
