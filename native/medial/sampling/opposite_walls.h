// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the place of the opposite wall for a place of a surface: where the ball that touches the
// surface there from inside touches the faces that look the other way. Across a gap it is the ball
// that touches the surface from outside.
#pragma once

#include <optional>

#include "base/box_tree.h"
#include "sampling/pn_triangles.h"

namespace medial {

struct SurfacePlace {
  int32_t triangle;
  Barycentric at;
};

// A place of the opposite wall.
struct WallPlace {
  int32_t triangle = -1;
  Barycentric at{};
  double distance = 0;  // between the two places
};

enum class Through { solid, gap };

// A place opposite to the one `before` it in a column.
struct ColumnPlace {
  SurfacePlace place;
  double distance = 0;  // from the place before
  int before = -1;
  Through through = Through::gap;
  bool is_tight = true;  // so close that neither place may be without the other
};

// Leaves the places of a column that are tight.
void keep_tight(std::vector<ColumnPlace>& column);

// It finds the triangle by the flat triangles, and the place on the surface. Its const members may
// be called from several threads.
class OppositeWalls {
 public:
  // The surface must outlive this object; its triangles turn outward.
  OppositeWalls(const CurvedSurface& surface, const Creases& creases);

  // Returns where the ball that touches the surface at a place from inside, or from outside,
  // touches the opposite wall. Only triangles within 60 degrees of the opposite direction count, so
  // the ball ignores walls aside, and the sides of acute grooves and edges are opposite walls.
  // There is nothing if the diameter of the ball is above `reach`, or if the ball touches the end
  // of a wall at a slant.
  std::optional<WallPlace> operator()(const SurfacePlace& from, double reach,
                                      Through through = Through::solid) const;
  // Returns a place and those opposite to it, through solid and gaps in turn, that are within reach
  // of it. If a place would be beyond that without which another one may not be, only places that
  // are tight are returned.
  void column(const SurfacePlace& from, double reach, std::vector<ColumnPlace>& out) const;
  // Returns a place on the flat triangle.
  Vec3 point(int32_t triangle, const Barycentric& at) const;

 private:
  struct Touch {
    int32_t triangle = -1;
    Barycentric at{};
    Vec3 point;
  };

  std::optional<Touch> touch(const Vec3& from, const Vec3& normal, double reach, double sign) const;
  Touch nearest_facing(const Vec3& centre, const Vec3& normal, double than, double sign) const;
  SurfacePlace on_curved(const SurfacePlace& from, const SurfacePlace& flat, double sign) const;
  enum class Found { nothing, within, beyond };
  Found add_opposite(std::vector<ColumnPlace>& column, int before, Through through,
                     double reach) const;
  bool go(SurfacePlace& place, const std::array<double, 3>& step) const;

  const CurvedSurface& surface_;
  const Creases& creases_;
  const TriangleMesh& mesh_;
  std::vector<int32_t> order_;  // triangles, leaf after leaf
  std::vector<BoxNode> nodes_;
};

}  // namespace medial
