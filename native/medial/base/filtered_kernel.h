// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's kernel of exact predicates, of which two ask twice the digits of double before they ask
// exact numbers. Include it after base/cgal.h.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "base/double_double.h"

namespace medial {

// Returns the largest power of two of which a number is a multiple; infinity for 0.
inline double unit_of(double x) {
  if (x == 0) return HUGE_VAL;
  int exponent = 0;
  const auto digits = static_cast<uint64_t>(std::ldexp(std::abs(std::frexp(x, &exponent)), 53));
  return std::ldexp(1.0, exponent - 53 + std::countr_zero(digits));
}

// Samples and triangles of flat faces are as good as coplanar and cospherical wherever the faces
// are turned. CGAL's exact numbers took nearly half of the time of the axis of a turned box.
struct InTwiceTheDigits : CGAL::Exact_predicates_inexact_constructions_kernel {
  using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Exact::Point_3;

  struct Orientation_3 : Exact::Orientation_3 {
    using Exact::Orientation_3::operator();
    CGAL::Orientation operator()(const Point& p, const Point& q, const Point& r,
                                 const Point& s) const {
      const Differences<3> m({q, r, s}, p);
      const auto& [a, b, c] = m.rows;
      const Sum x{CGAL::determinant(a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]),
                  5.2e-15 * m.most[0] * m.most[1] * m.most[2]};
      if (x.has_sign()) return x.sign();
      // A multiple of a unit that is smaller than the unit is zero.
      return x.is_below(m.unit(0) * m.unit(1) * m.unit(2))
                 ? CGAL::COPLANAR
                 : Exact::Orientation_3::operator()(p, q, r, s);
    }
  };

  struct Side_of_oriented_sphere_3 {
    CGAL::Oriented_side operator()(const Point& p, const Point& q, const Point& r, const Point& s,
                                   const Point& t) const {
      const Differences<4> m({p, r, q, s}, t);
      const auto& [a, b, c, d] = m.rows;
      const double largest = std::max({m.most[0], m.most[1], m.most[2]});
      const Sum x{CGAL::determinant(a[0], a[1], a[2], square(a), b[0], b[1], b[2], square(b), c[0],
                                    c[1], c[2], square(c), d[0], d[1], d[2], square(d)),
                  1.25e-13 * (m.most[0] * m.most[1] * m.most[2] * largest * largest)};
      return x.has_sign() ? x.sign() : Exact::Side_of_oriented_sphere_3()(p, q, r, s, t);
    }
  };

 private:
  using Difference = std::array<DoubleDouble, 3>;

  // A determinant, and by how much CGAL says that doubles would be off.
  struct Sum {
    DoubleDouble value;
    double of_doubles;

    double bound() const {
      constexpr double kLeast = 1e-235;  // derived: below it parts of products underflow
      // The digits are finer by 2^-100 / 2^-53.
      return of_doubles > kLeast ? 0x1p-47 * of_doubles : HUGE_VAL;
    }
    bool has_sign() const { return std::abs(value.high) > bound(); }
    CGAL::Sign sign() const { return value.high > 0 ? CGAL::POSITIVE : CGAL::NEGATIVE; }
    bool is_below(double unit) const { return std::abs(value.high) + bound() < unit; }
  };

  static DoubleDouble square(const Difference& d) {
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  }

  // Holds the differences of points to another one, and the largest of them along each axis.
  template <size_t N>
  struct Differences {
    std::array<Difference, N> rows;
    std::array<double, 3> most{};

    Differences(const std::array<Point, N>& points, const Point& from) {
      for (size_t i = 0; i < N; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
          rows[i][axis] = DoubleDouble(points[i][axis]) - DoubleDouble(from[axis]);
          most[axis] = std::max(most[axis], std::abs(rows[i][axis].high));
        }
      }
    }

    // Returns a power of two of which all differences along an axis are multiples.
    double unit(int axis) const {
      double least = HUGE_VAL;
      for (const Difference& row : rows) {
        least = std::min({least, unit_of(row[axis].high), unit_of(row[axis].low)});
      }
      return least;
    }
  };
};

struct FilteredKernel : CGAL::Exact_predicates_inexact_constructions_kernel {
  using Orientation_3 = CGAL::internal::Static_filters_predicates::Orientation_3<InTwiceTheDigits>;
  using Side_of_oriented_sphere_3 =
      CGAL::internal::Static_filters_predicates::Side_of_oriented_sphere_3<InTwiceTheDigits>;
  static Orientation_3 orientation_3_object() { return {}; }
  static Side_of_oriented_sphere_3 side_of_oriented_sphere_3_object() { return {}; }
};

}  // namespace medial
