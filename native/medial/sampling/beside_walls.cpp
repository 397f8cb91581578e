// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/beside_walls.h"

#include "base/union_find.h"

namespace medial {
namespace {

// The largest flat part at a vertex may be a wall beside triangles that are so many times smaller.
// It is one beside a bevel if it is so many times as wide as these reach from it, or reaches so
// many times as far from their edge. A ring on top of a tube is as wide as the next rows.
constexpr double kDominant = 8, kWide = 2;  // chosen: axis
// Beside a bevel the turn from a wall to the bevel is no larger than those of the bevel; beside the
// narrow rows of a smooth surface it is as large as the wall is wide. Edges along the same bevel
// are parallel up to this cosine.
constexpr double kTurn = 2, kAlong = 0.9;  // chosen: thickness
// The rows of a fillet are equal, and turn twice as far from one to the next as from the wall to
// the first one. So a wall beside them need not be much larger than a row.
constexpr double kLarger = 1.25, kEqual = 0.05, kRowsAlong = 0.999;  // chosen: thickness
// A strip of a fillet ends beside the rows of a sphere, which may be hardly smaller. It is straight
// if it is so many times as large as these, reaches as many times as far from their edge, and turns
// no more than they do.
constexpr double kLong = 4;  // chosen: unseen
// A single triangle, or a wall that is not quite flat, has to reach kDominant times as far from
// each edge as the small triangle there, and to turn as beside a bevel, or hardly at all.
constexpr double kTinyTurn = 0.01;  // chosen: unseen
// Large triangles that turn by less are of one wall.
constexpr double kOnePlane = 0.05;  // chosen: unseen

bool agree(double a, double b) { return std::abs(a - b) <= kEqual * std::max(a, b); }

// The largest flat part of a fan, and what is beside it.
struct Largest {
  int32_t part = -1;
  double area = 0, width = 0;
  bool alone = true;      // it is a single triangle
  bool others = false;    // there are parts that are not small beside it
  double beside = 0;      // how far small triangles reach from it
  bool narrow = false;    // it hardly reaches farther from an edge than a small triangle
  bool bevel = false;     // small triangles turn as those of a bevel
  bool fillet = false;    // triangles turn as the rows of a fillet
  bool strip = false;     // it is long, and ends beside triangles that turn as the rows of a sphere
  bool straight = false;  // it reaches far from an edge, and turns as beside a bevel there
  bool curved = false;    // it turns more than that, or is one of large triangles of no wall

  // Returns the area up to which others do not count beside it.
  double area_beside() const {
    if (fillet && !alone) return area / kLarger;
    if (strip) return area / kLong;
    const bool wide = !alone && (width >= kWide * beside || !narrow) && (bevel || !others);
    return wide || (straight && !curved) ? area / kDominant : 0;
  }
};

class Walls {
 public:
  Walls(const TriangleMesh& mesh, const Creases& creases, const FlatParts& flat, const Fans& fans,
        std::span<const Triangle> edge_of)
      : mesh_(mesh),
        creases_(creases),
        flat_(flat),
        fans_(fans),
        edge_of_(edge_of),
        largest_(fans.first.size()) {}

  std::vector<double> areas() {
    find_largest();
    for (const MeshEdge& edge : creases_.edges) {
      if (edge.crease != Crease::none) continue;
      const auto& [s, t] = edge.triangles;
      if (flat_.part[s] == flat_.part[t]) continue;
      look_from(s, t, edge);
      look_from(t, s, edge);
    }
    std::vector<double> areas;
    for (const Largest& here : largest_) areas.push_back(here.area_beside());
    return areas;
  }

 private:
  template <class Function>
  void for_each_corner(const Function& call) {
    for (size_t t = 0; t < fans_.of.size(); ++t) {
      for (int i = 0; i < 3; ++i) call(static_cast<int32_t>(t), i, largest_[fans_.of[t][i]]);
    }
  }
  void find_largest() {
    for_each_corner([this](int32_t t, int, Largest& here) {
      if (flat_.part[t] == here.part || !(flat_.area[t] > here.area)) return;
      here.part = flat_.part[t];
      here.area = flat_.area[t];
      here.width = flat_.width[t];
      here.alone = flat_.alone[t] != 0;
    });
    // Where a single crease ends, as a mitre does on a flat face, this may be a single triangle.
    const std::vector<int32_t> creases_at = creases_at_points(mesh_, creases_);
    for_each_corner([&](int32_t t, int corner, Largest& here) {
      here.others |= flat_.part[t] != here.part && !is_small(t, here);
      here.alone &= creases_at[mesh_.triangles[t][corner]] != 1;
    });
  }
  bool is_small(int32_t triangle, const Largest& here) const {
    return kDominant * flat_.area[triangle] <= here.area;
  }
  // Looks across an edge from a triangle that is not small beside the largest part of its fan.
  void look_from(int32_t wall, int32_t row, const MeshEdge& edge) {
    const double across = reach_from(mesh_, wall, edge.ends);
    const double reach = reach_from(mesh_, row, edge.ends);
    for (const int32_t end : edge.ends) {
      Largest& here = largest_[fans_.of[wall][corner_of(mesh_.triangles[wall], end)]];
      if (is_small(wall, here)) continue;
      if (flat_.part[wall] == here.part) {
        here.fillet |= across >= kLarger * reach && is_fillet(edge, row, reach);
        here.strip |= across >= kLong * reach && is_strip(edge, wall, row);
      }
      if (!is_small(row, here)) {
        here.curved |= turn(edge) > kOnePlane;
        continue;
      }
      const double rows = turn_of_rows(edge, row, here.area / kDominant);
      const bool bevel = turn(edge) <= kTurn * rows;
      if (flat_.part[wall] == here.part) {
        here.beside = std::max(here.beside, reach);
        here.narrow |= across < kWide * reach;
        here.bevel |= bevel;
      }
      if (across >= kDominant * reach)
        (bevel || turn(edge) <= kTinyTurn ? here.straight : here.curved) = true;
    }
  }
  double turn(const MeshEdge& edge) const {
    return distance(mesh_.normal[edge.triangles[0]], mesh_.normal[edge.triangles[1]]);
  }
  Vec3 direction(const MeshEdge& edge) const {
    return normalized(mesh_.points[edge.ends[1]] - mesh_.points[edge.ends[0]]);
  }
  // Calls a function with the edges along another one: those of a triangle beside it, and of the
  // triangle's neighbours. The edges of a bevel may be sharp.
  template <class Function>
  void for_each_along(const MeshEdge& edge, int32_t triangle, double cosine,
                      const Function& call) const {
    call_along(edge, triangle, cosine, call);
    for (const int32_t e : edge_of_[triangle]) {
      const MeshEdge& next = creases_.edges[e];
      if (next.crease != Crease::none || next.ends == edge.ends) continue;
      call_along(edge, next.triangles[next.triangles[0] == triangle], cosine, call);
    }
  }
  template <class Function>
  void call_along(const MeshEdge& edge, int32_t triangle, double cosine,
                  const Function& call) const {
    for (const int32_t e : edge_of_[triangle]) {
      const MeshEdge& other = creases_.edges[e];
      if (!other.manifold || other.ends == edge.ends) continue;
      if (std::abs(dot(direction(other), direction(edge))) > cosine) call(other);
    }
  }
  // Returns the largest turn at edges along another one between flat parts that are no larger than
  // an area; 0 if there are none.
  double turn_of_rows(const MeshEdge& edge, int32_t row, double area) const {
    double most = 0;
    for_each_along(edge, row, kAlong, [&](const MeshEdge& other) {
      const auto& [s, t] = other.triangles;
      if (std::max(flat_.area[s], flat_.area[t]) <= area) most = std::max(most, turn(other));
    });
    return most;
  }
  bool is_strip(const MeshEdge& edge, int32_t wall, int32_t row) const {
    const double area = flat_.area[wall] / kLong;
    return flat_.alone[wall] == 0 && flat_.area[row] <= area &&
           turn(edge) <= turn_of_rows(edge, row, area);
  }
  bool is_fillet(const MeshEdge& edge, int32_t row, double width) const {
    bool found = false;
    for_each_along(edge, row, kRowsAlong, [&](const MeshEdge& other) {
      const auto& [s, t] = other.triangles;
      found |= flat_.part[s] != flat_.part[t] && agree(2 * turn(edge), turn(other)) &&
               agree(reach_from(mesh_, s, other.ends), width) &&
               agree(reach_from(mesh_, t, other.ends), width);
    });
    return found;
  }

  const TriangleMesh& mesh_;
  const Creases& creases_;
  const FlatParts& flat_;
  const Fans& fans_;
  std::span<const Triangle> edge_of_;
  std::vector<Largest> largest_;  // per fan
};

}  // namespace

Fans smooth_fans(const TriangleMesh& mesh, const Creases& creases) {
  UnionFind corners(3 * mesh.triangles.size());
  for (const MeshEdge& edge : creases.edges) {
    if (edge.crease != Crease::none) continue;
    const auto& [s, t] = edge.triangles;
    for (const int32_t end : edge.ends) {
      corners.unite(3 * s + corner_of(mesh.triangles[s], end),
                    3 * t + corner_of(mesh.triangles[t], end));
    }
  }
  const auto root = std::move(corners).representatives();
  Fans fans{std::vector<Triangle>(mesh.triangles.size()), {}};
  std::vector<int32_t> fan(root.size(), -1);
  const auto count = static_cast<int32_t>(root.size());
  for (int32_t c = 0; c < count; ++c) {
    if (fan[root[c]] < 0) {
      fan[root[c]] = static_cast<int32_t>(fans.first.size());
      fans.first.push_back(c);
    }
    fans.of[c / 3][c % 3] = fan[root[c]];
  }
  return fans;
}

std::vector<double> areas_beside_walls(const TriangleMesh& mesh, const Creases& creases,
                                       const FlatParts& flat, const Fans& fans,
                                       std::span<const Triangle> edge_of) {
  return Walls(mesh, creases, flat, fans, edge_of).areas();
}

}  // namespace medial
