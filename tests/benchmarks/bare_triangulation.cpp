// Seconds of CGAL's Delaunay triangulation alone: bare_triangulation FILE, a file of doubles x y z
// x y z ...
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <chrono>
#include <fstream>
#include <iostream>
#include <vector>

using Delaunay =
    CGAL::Delaunay_triangulation_3<CGAL::Exact_predicates_inexact_constructions_kernel>;

int main(int, char** arguments) {
  std::ifstream file(arguments[1], std::ios::binary);
  std::vector<Delaunay::Point> points;
  double x[3];
  while (file.read(reinterpret_cast<char*>(x), sizeof x)) points.emplace_back(x[0], x[1], x[2]);
  const auto start = std::chrono::steady_clock::now();
  const Delaunay delaunay(points.begin(), points.end());
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::cout << seconds.count() << ' ' << delaunay.number_of_vertices() << '\n';
}
