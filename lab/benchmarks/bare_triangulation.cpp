// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's Delaunay triangulation alone: bare_triangulation FILE, a file of doubles x y z x y z ...
// Prints seconds, those of the processor, and the bytes of memory that it added to the points.
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <chrono>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

using Delaunay =
    CGAL::Delaunay_triangulation_3<CGAL::Exact_predicates_inexact_constructions_kernel>;

namespace {

long resident_bytes(const std::string& field) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word == field) {
      long kilobytes = 0;
      status >> kilobytes;
      return 1024 * kilobytes;
    }
  }
  return 0;
}

}  // namespace

int main(int, char** arguments) {
  std::ifstream file(arguments[1], std::ios::binary);
  std::vector<Delaunay::Point> points;
  double x[3];
  while (file.read(reinterpret_cast<char*>(x), sizeof x)) points.emplace_back(x[0], x[1], x[2]);
  points.shrink_to_fit();
  const long before = resident_bytes("VmRSS:");
  const std::clock_t processor = std::clock();
  const auto start = std::chrono::steady_clock::now();
  const Delaunay delaunay(points.begin(), points.end());
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::cout << seconds.count() << ' '
            << static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC << ' '
            << resident_bytes("VmHWM:") - before << '\n';
  return delaunay.number_of_vertices() > 0 ? 0 : 1;
}
