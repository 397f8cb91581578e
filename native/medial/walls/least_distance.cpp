// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/least_distance.h"

namespace medial {
namespace {

// The corners of a triangle in turn.
constexpr int kAfter[3] = {1, 2, 0}, kBefore[3] = {2, 0, 1};

using Three = std::array<double, 3>;

// A polynomial of degree 4 on a triangle by its coefficients in Bernstein form.
struct Quartic {
  Three corner;
  std::array<Three, 3> side;  // from each corner to the next, without the corners
  Three inner;                // next to each corner
};

// A polynomial of degree 2, likewise; `side` belongs to the side from each corner to the next.
struct Quadratic {
  Three corner, side;
};

// The patch is its flat triangle plus a displacement. Returns the square of the patch, without the
// square of the displacement, which is of fourth order and positive.
Quartic lowered_square(const Patch& patch, const Vec3& from) {
  const auto controls = patch.controls();
  std::array<Vec3, 3> flat;
  for (int i = 0; i < 3; ++i) flat[i] = controls[i] - from;
  // the displacements of the control points near a corner, on the sides to the next and previous
  // one
  std::array<Vec3, 3> to_next, to_previous;
  Quartic square{};
  Three mixed{};
  for (int i = 0; i < 3; ++i) {
    const int j = kAfter[i];
    to_next[i] = controls[3 + 2 * i] - from - (1.0 / 3) * (2 * flat[i] + flat[j]);
    to_previous[j] = controls[4 + 2 * i] - from - (1.0 / 3) * (2 * flat[j] + flat[i]);
    square.corner[i] = dot(flat[i], flat[i]);
    mixed[i] = dot(flat[i], flat[j]);
  }
  const Vec3 middle = controls[9] - from - (1.0 / 3) * (flat[0] + flat[1] + flat[2]);
  for (int i = 0; i < 3; ++i) {
    const int j = kAfter[i], k = kBefore[i];
    const double ii = square.corner[i], jj = square.corner[j], ij = mixed[i];
    square.side[i] = {
        0.5 * (ii + ij) + 1.5 * dot(flat[i], to_next[i]),
        (1.0 / 6) * (ii + 4 * ij + jj) + dot(flat[i], to_previous[j]) + dot(flat[j], to_next[i]),
        0.5 * (jj + ij) + 1.5 * dot(flat[j], to_previous[j])};
    square.inner[i] = (1.0 / 6) * (ii + 2 * (ij + mixed[k]) + mixed[j]) + dot(flat[i], middle) +
                      0.5 * (dot(flat[j], to_previous[i]) + dot(flat[k], to_next[i]));
  }
  return square;
}

// Returns the least value on a side from its three coefficients.
double least_on_side(double first, double middle, double last) {
  const double bend = first - 2 * middle + last, fall = first - middle;
  if (fall > 0 && fall < bend) return first - fall * fall / bend;
  return std::min(first, last);
}

// Returns the least value on the triangle.
double least_of(const Quadratic& q) {
  const double b = q.side[0] - q.corner[0], c = q.side[2] - q.corner[0];
  const double bb = q.corner[1] - q.side[0] - b, cc = q.corner[2] - q.side[2] - c;
  const double bc = q.side[1] - q.side[0] - c, determinant = bb * cc - bc * bc;
  if (bb > 0 && determinant > 0) {
    const double at_b = bc * c - cc * b, at_c = bc * b - bb * c;
    if (at_b > 0 && at_c > 0 && at_b + at_c < determinant) {
      return q.corner[0] + (b * at_b + c * at_c) / determinant;
    }
  }
  double least = HUGE_VAL;
  for (int i = 0; i < 3; ++i) {
    least = std::min(least, least_on_side(q.corner[i], q.side[i], q.corner[kAfter[i]]));
  }
  return least;
}

}  // namespace

// A quadratic polynomial takes nearly all of the square. Its least value is known, and the rest is
// nowhere below its least coefficient.
double least_squared_distance(const Patch& patch, const Vec3& from) {
  const Quartic square = lowered_square(patch, from);
  Quadratic near{square.corner, {}};
  for (int i = 0; i < 3; ++i) {
    near.side[i] = 0.25 * (6 * square.side[i][1] - near.corner[i] - near.corner[kAfter[i]]);
  }
  double rest = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = kAfter[i], k = kBefore[i];
    rest = std::min({rest, square.side[i][0] - 0.5 * (near.corner[i] + near.side[i]),
                     square.side[i][2] - 0.5 * (near.corner[j] + near.side[i]),
                     square.inner[i] - (1.0 / 6) * (near.corner[i] + near.side[j] +
                                                    2 * (near.side[i] + near.side[k]))});
  }
  return least_of(near) + rest;
}

}  // namespace medial
