// SPDX-License-Identifier: GPL-3.0-or-later
// Counts how often a ray, or a segment, leaves a triangle soup minus how often it enters. For a
// closed soup this is the winding number at the origin of the ray, or the drop of the winding
// number along the segment.
#pragma once

#include <optional>
#include <tuple>

#include "base/box_tree.h"
#include "base/progress.h"
#include "inside/solid_angle.h"

namespace medial {

class RayCrossings {
 public:
  RayCrossings(std::vector<Corners> triangles, const Progress* progress);

  // Returns the count; `direction` is a unit vector. Returns nothing if an edge, or the end of the
  // segment, is so close that doubles cannot decide.
  std::optional<int> operator()(const Vec3& origin, const Vec3& direction,
                                double reach = HUGE_VAL) const;
  // Holds where the ray meets a triangle, the cosine between the triangle's normal and the ray,
  // which is negative where the ray enters, and the unit normal.
  struct Hit {
    double at, cosine;
    Vec3 normal;

    // At one place, the ray enters before it leaves: bodies that touch are one. The rest of the
    // order makes it total.
    friend bool operator<(const Hit& s, const Hit& t) {
      const auto key = [](const Hit& hit) {
        return std::tie(hit.at, hit.cosine, hit.normal.x, hit.normal.y, hit.normal.z);
      };
      return key(s) < key(t);
    }
  };
  // Finds all triangles that the ray meets up to `reach`, in no order. The triangle on which the
  // ray starts, against its normal, is omitted.
  void hits(const Vec3& origin, const Vec3& direction, double reach, std::vector<Hit>& found) const;
  // Returns how many triangles the ray meets farther away than `start`, but stops at `most`.
  int64_t met(const Vec3& origin, const Vec3& direction, double start, int64_t most) const;
  std::span<const Corners> triangles() const { return corners_; }
  // Returns whether a place is outside of the box of the triangles by more than rounding.
  bool is_beyond(const Vec3& place) const;

 private:
  template <typename Visit>
  void visit(const Vec3& origin, const Vec3& direction, double reach, const Visit& visit) const;

  std::vector<Corners> corners_;
  std::vector<BoxNode> nodes_;
};

}  // namespace medial
