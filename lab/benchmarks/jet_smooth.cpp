// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL smooths points by fitted jets: jet_smooth FILE NEIGHBOURS OUTPUT. Both files are doubles.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/jet_smooth_point_set.h>

#include <fstream>
#include <string>
#include <vector>

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

int main(int, char** arguments) {
  std::ifstream file(arguments[1], std::ios::binary);
  std::vector<Point> points;
  double x[3];
  while (file.read(reinterpret_cast<char*>(x), sizeof x)) points.emplace_back(x[0], x[1], x[2]);
  CGAL::jet_smooth_point_set<CGAL::Sequential_tag>(points,
                                                   static_cast<unsigned>(std::stoi(arguments[2])));
  std::ofstream output(arguments[3], std::ios::binary);
  for (const Point& p : points) {
    const double y[3]{p.x(), p.y(), p.z()};
    output.write(reinterpret_cast<const char*>(y), sizeof y);
  }
  return output ? 0 : 1;
}
