// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/closest_on_flat.h"

namespace medial {

// Ericson, Real-Time Collision Detection, sect. 5.1.5: the regions of the corners, the sides, the
// inside. Where p and q are one place, there is no side between them.
Barycentric closest_on_flat(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& x) {
  const Vec3 pq = q - p, pr = r - p, px = x - p, qx = x - q, rx = x - r;
  const double d1 = dot(pq, px), d2 = dot(pr, px);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = dot(pq, qx), d4 = dot(pr, qx);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const double d5 = dot(pq, rx), d6 = dot(pr, rx);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double share = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - share, share};
  }
  const double whole = va + vb + vc;
  return {1 - vb / whole - vc / whole, vb / whole, vc / whole};
}

}  // namespace medial
