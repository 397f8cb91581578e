// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's kernel of exact predicates, of which two ask twice the digits of double, and then
// integers, where doubles are not enough. Include it after base/cgal.h.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/double_double.h"
#include "base/exact_integer.h"

namespace medial {

// Samples and triangles of flat faces are as good as coplanar and cospherical wherever the faces
// are turned, and vertices of symmetrical solids are cospherical. CGAL's exact numbers took nearly
// half of the time of the axis of a turned box, and a quarter of that of a symmetrical mesh.
struct BeyondDoubles : CGAL::Exact_predicates_inexact_constructions_kernel {
  using Doubles = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Doubles::Point_3;

  struct Orientation_3 : Doubles::Orientation_3 {
    using Doubles::Orientation_3::operator();
    CGAL::Orientation operator()(const Point& p, const Point& q, const Point& r,
                                 const Point& s) const {
      return sign_of<3>({q, r, s}, p, 5.2e-15, [](const auto& rows) {
        const auto& [a, b, c] = rows;
        return CGAL::determinant(a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]);
      });
    }
  };

  struct Side_of_oriented_sphere_3 {
    CGAL::Oriented_side operator()(const Point& p, const Point& q, const Point& r, const Point& s,
                                   const Point& t) const {
      return sign_of<4>({p, r, q, s}, t, 1.25e-13, [](const auto& rows) {
        const auto& [a, b, c, d] = rows;
        return CGAL::determinant(a[0], a[1], a[2], square(a), b[0], b[1], b[2], square(b), c[0],
                                 c[1], c[2], square(c), d[0], d[1], d[2], square(d));
      });
    }
  };

 private:
  // Returns the sign of a determinant of the differences of points to another one. CGAL says that
  // doubles have this error, for sizes of one.
  template <size_t N, typename Determinant>
  static CGAL::Sign sign_of(const std::array<Point, N>& points, const Point& from, double error,
                            const Determinant& determinant) {
    const auto rows = differences(points, from, [](double x) { return DoubleDouble(x); });
    const DoubleDouble value = determinant(rows);
    // The digits are finer by 2^-100 / 2^-53.
    if (std::abs(value.high) > 0x1p-47 * error * size(rows)) return CGAL::sign(value.high);
    int unit = last_bit(from.x(), from.y(), from.z());
    for (const Point& p : points) unit = std::min(unit, last_bit(p.x(), p.y(), p.z()));
    const auto integer = [unit](double x) { return times_power_of_two(x, unit); };
    return CGAL::sign(determinant(differences(points, from, integer)).sign());
  }

  template <size_t N, typename NumberOf>
  static auto differences(const std::array<Point, N>& points, const Point& from,
                          const NumberOf& number_of) {
    std::array<std::array<decltype(number_of(0)), 3>, N> rows;
    for (int axis = 0; axis < 3; ++axis) {
      const auto origin = number_of(from[axis]);
      for (size_t i = 0; i < N; ++i) rows[i][axis] = number_of(points[i][axis]) - origin;
    }
    return rows;
  }

  // Returns what the error of a determinant is proportional to: the product of the largest
  // differences along the axes, times the square of the largest one where rows have their squares.
  template <size_t N>
  static double size(const std::array<std::array<DoubleDouble, 3>, N>& rows) {
    constexpr double kLeast = 1e-220;  // derived: below it parts of products underflow
    std::array<double, 3> most{};
    for (const auto& row : rows) {
      for (int axis = 0; axis < 3; ++axis) {
        most[axis] = std::max(most[axis], std::abs(row[axis].high));
      }
    }
    const double largest = std::max({most[0], most[1], most[2]});
    const double found = most[0] * most[1] * most[2] * (N == 4 ? largest * largest : 1);
    return found > kLeast ? found : HUGE_VAL;
  }

  template <typename Row>
  static auto square(const Row& d) -> typename Row::value_type {
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  }
};

struct FilteredKernel : CGAL::Exact_predicates_inexact_constructions_kernel {
  using Orientation_3 = CGAL::internal::Static_filters_predicates::Orientation_3<BeyondDoubles>;
  using Side_of_oriented_sphere_3 =
      CGAL::internal::Static_filters_predicates::Side_of_oriented_sphere_3<BeyondDoubles>;
  static Orientation_3 orientation_3_object() { return {}; }
  static Side_of_oriented_sphere_3 side_of_oriented_sphere_3_object() { return {}; }
};

}  // namespace medial
