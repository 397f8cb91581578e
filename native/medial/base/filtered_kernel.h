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
#include <limits>

#include "base/double_double.h"

namespace medial {

// Returns the largest power of two of which a number is a multiple; infinity for 0.
inline double unit_of(double x) {
  if (x == 0) return HUGE_VAL;
  constexpr int kDigits = std::numeric_limits<double>::digits;
  int exponent = 0;
  const double share = std::abs(std::frexp(x, &exponent));
  const auto whole = static_cast<uint64_t>(std::ldexp(share, kDigits));
  return std::ldexp(1.0, exponent - kDigits + std::countr_zero(whole));
}

// Samples and triangles of flat faces are as good as coplanar and cospherical wherever the faces
// are turned. CGAL's exact numbers took nearly half of the time of the axis of a turned box.
struct InTwiceTheDigits : CGAL::Exact_predicates_inexact_constructions_kernel {
  using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Exact::Point_3;
  // derived: what twice the digits are off by over what doubles are off by, 2^-100 / 2^-53
  static constexpr double kFiner = 0x1p-47;
  static constexpr double kLeast = 1e-250;  // derived: below it parts of products underflow

  struct Orientation_3 : Exact::Orientation_3 {
    using Exact::Orientation_3::operator();
    CGAL::Orientation operator()(const Point& p, const Point& q, const Point& r,
                                 const Point& s) const {
      constexpr double kError = 5.2e-15 * kFiner;  // derived: CGAL's bound for doubles
      const Differences<3> d({q, r, s}, p);
      const auto& [a, b, c] = d.rows;
      const double x = CGAL::determinant(a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]).high;
      const double bound = kError * d.most[0] * d.most[1] * d.most[2];
      if (bound > kLeast && std::abs(x) > bound) return x > 0 ? CGAL::POSITIVE : CGAL::NEGATIVE;
      // What is a multiple of a unit, and smaller than it, is nothing.
      const double unit = d.unit(0) * d.unit(1) * d.unit(2);
      if (bound > kLeast && std::abs(x) + bound < unit) return CGAL::COPLANAR;
      return Exact::Orientation_3::operator()(p, q, r, s);
    }
  };

  struct Side_of_oriented_sphere_3 {
    CGAL::Oriented_side operator()(const Point& p, const Point& q, const Point& r, const Point& s,
                                   const Point& t) const {
      constexpr double kError = 1.25e-13 * kFiner;  // derived: CGAL's bound for doubles
      const Differences<4> m({p, r, q, s}, t);
      const auto& [a, b, c, d] = m.rows;
      const double x = CGAL::determinant(a[0], a[1], a[2], square(a), b[0], b[1], b[2], square(b),
                                         c[0], c[1], c[2], square(c), d[0], d[1], d[2], square(d))
                           .high;
      const double largest = std::max({m.most[0], m.most[1], m.most[2]});
      const double bound = kError * (m.most[0] * m.most[1] * m.most[2] * largest * largest);
      if (!(bound > kLeast && std::abs(x) > bound))
        return Exact::Side_of_oriented_sphere_3()(p, q, r, s, t);
      return x > 0 ? CGAL::ON_POSITIVE_SIDE : CGAL::ON_NEGATIVE_SIDE;
    }
  };

 private:
  using Difference = std::array<DoubleDouble, 3>;

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
