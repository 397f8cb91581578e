// SPDX-License-Identifier: GPL-3.0-or-later
// The faces of a solid, flat or smooth, as walls that balls touch: the places of them that are
// nearest to a point.
#pragma once

#include <medial/faces.h>

#include <atomic>
#include <limits>
#include <optional>

#include "base/box_tree.h"
#include "base/frame.h"
#include "base/oriented_box.h"
#include "sampling/pn_triangles.h"

namespace medial {

// A foot is a place of the faces that is nearest to a point, among its neighbours or among all.
struct Foot {
  int32_t triangle = -1;
  Barycentric at{};
  Vec3 point;
  double distance = HUGE_VAL;
};

// A search for the nearest face looks within two balls. Where very many faces are about as far
// away, as those of a sphere are from its centre, it goes on after some leaves of the tree in vain
// with those faces alone that are nearer than a smaller distance.
struct FaceSearch {
  Vec3 from;
  double than = HUGE_VAL;
  Vec3 second_centre = {};
  double second_radius = HUGE_VAL;
  int most_in_vain = std::numeric_limits<int>::max();
  double smaller = 0;
};

// Its const members may be called from several threads.
class Faces {
 public:
  // The faces are brought into the frame. Throws as make_mesh does.
  Faces(const FacesInput& input, const Frame& frame, const Run& run,
        VertexNormals normals = VertexNormals::mean);
  Faces(const Faces&) = delete;
  Faces& operator=(const Faces&) = delete;

  const TriangleMesh& mesh() const { return mesh_; }
  size_t bytes() const;
  const Creases& creases() const { return creases_; }
  // Returns how many rows of triangles the input had.
  size_t triangles() const { return triangle_of_.size(); }
  // Returns the triangle of the mesh for a row of the input, or -1 if it was left out.
  int32_t triangle_of(int32_t row) const { return row < 0 ? -1 : triangle_of_[row]; }
  // Returns the edge from a corner of a triangle to the next one.
  int32_t edge_of(int32_t triangle, int corner) const { return edge_of_[triangle][corner]; }
  // Returns whether an edge separates two walls: a sharp convex one, an open one, or one whose
  // sides are ambiguous. Sides of a reflex edge are one wall, which a ball rolls round.
  bool separates(int32_t edge) const { return separates_[edge] != 0; }
  // Returns whether an edge is sharp, and the solid is convex there.
  bool is_convex_crease(int32_t edge) const { return separates_[edge] == kConvex; }
  // Returns whether an edge is sharp, and a ball inside may roll round it.
  bool is_reflex_crease(int32_t edge) const {
    return separates_[edge] == 0 && creases_.edges[edge].crease != Crease::none;
  }

  // Returns how far the surface is at most from the flat triangle.
  double bulge(int32_t triangle) const { return bulge_.empty() ? 0 : bulge_[triangle].most; }
  bool is_curved(int32_t triangle) const { return !bulge_.empty() && bulge_[triangle].most > 0; }
  Vec3 point(int32_t triangle, const Barycentric& at) const;
  Vec3 normal(int32_t triangle, const Barycentric& at) const {
    return surface_->normal(triangle, at);
  }
  // Returns the normal of the patch itself, which that between the corners only follows.
  Vec3 normal_of_patch(int32_t triangle, const Barycentric& at) const;
  Patch patch(int32_t triangle) const { return surface_->patch(triangle); }
  // Returns whether a foot is on an edge that separates two walls.
  bool is_at_end(const Foot& foot) const;
  // Returns the foot on one triangle.
  Foot foot_on(int32_t triangle, const Vec3& from) const;
  // Walks from a triangle to neighbours of the same wall while they are nearer.
  Foot descend(int32_t triangle, const Vec3& from) const {
    return descend(foot_on(triangle, from), from);
  }
  // Does the same from the foot of a point close by.
  Foot descend_again(const Foot& before, const Vec3& from) const;
  // Returns the nearest place of all faces if it is nearer than a distance.
  std::optional<Foot> nearer(const Vec3& from, double than) const;
  // Returns how often `nearer` has searched: what balls cost.
  int64_t searches() const { return searches_; }
  // Returns the foot on the flat triangle, lifted to the surface: close to the nearest place of a
  // curved triangle, and sooner found.
  Foot lifted(int32_t triangle, const Vec3& from) const {
    const Foot flat = flat_foot(triangle, from);
    return is_curved(triangle) ? lifted(flat, from) : flat;
  }
  // Returns the nearest lifted foot on the triangles that meet where a foot is, in the same wall,
  // or the foot itself if it is nearer.
  Foot lifted_beside(const Foot& foot, const Vec3& from) const;
  // Returns the nearest lifted foot of a search without those that `ignored` is true of. Leaves of
  // curved faces count twice, as many of them touch a ball and none of them is exact.
  template <typename Ignored>
  std::optional<Foot> nearest_lifted(const FaceSearch& search, const Ignored& ignored) const {
    if (nodes_.empty()) return {};
    std::optional<Foot> best;
    double within = search.than;
    int in_vain = 0;
    const auto visit = [&](const Node& leaf) {
      in_vain += is_curved(order_[leaf.begin]) ? 2 : 1;
      for (int32_t i = leaf.begin; i < leaf.end; ++i) {
        const int32_t t = order_[i];
        const Foot flat = flat_foot(t, search.from);
        if (flat.distance - bulge(t) > within) continue;
        const Foot foot = is_curved(t) ? lifted(flat, search.from) : flat;
        const bool first = best && foot.distance == within && foot.triangle < best->triangle;
        if (!(foot.distance < within || first) || ignored(foot)) continue;
        best = foot;
        within = foot.distance;
        in_vain = 0;
      }
      if (in_vain > search.most_in_vain) within = std::min(within, search.smaller);
    };
    const double room = search.second_radius * search.second_radius;
    const auto bound = [&](const Node& node) {
      const bool outside =
          room < HUGE_VAL && medial::squared_distance(node.box, search.second_centre) > room;
      return outside ? HUGE_VAL : medial::squared_distance(node.box, search.from);
    };
    visit_nearest(
        nodes_, 0, bound, [&] { return within * within; }, visit);
    return best;
  }
  // Returns where each triangle is in the search tree, where neighbours are close to each other.
  std::vector<int32_t> places_in_tree() const;

 private:
  static constexpr uint8_t kConvex = 2;

  struct Node : TreeNode {
    OrientedBox box;
  };

  struct Bulge {
    float most = 0;
    float inwards = 0;  // without what leads away from all points on the inner side
  };

  Foot flat_foot(int32_t triangle, const Vec3& from) const;
  Foot lifted(const Foot& flat, const Vec3& from) const;
  void find_fans();
  void build_tree_of_faces();
  OrientedBox box_round(std::span<const int32_t> triangles, std::vector<Vec3>& controls) const;
  uint8_t separation(const MeshEdge& edge) const;
  Foot descend(Foot foot, const Vec3& from) const;
  Foot best_neighbour(const Foot& foot, const Vec3& from) const;
  template <typename FootOn>
  Foot nearest_beside(const Foot& foot, const FootOn& foot_on_triangle) const;
  std::optional<Foot> foot_within(int32_t triangle, const Vec3& from, double within) const;
  static Foot foot_on_patch(const Patch& patch, int32_t triangle, const Barycentric& start,
                            const Vec3& from);

  TriangleMesh mesh_;
  Creases creases_;
  std::optional<CurvedSurface> surface_;
  std::vector<int32_t> triangle_of_;
  std::vector<std::array<int32_t, 3>> edge_of_;
  std::vector<uint8_t> separates_;              // per edge
  std::vector<std::array<int32_t, 3>> fan_of_;  // the triangles round a corner in one wall
  std::vector<Bulge> bulge_;                    // per triangle, rounded up; empty if all are flat
  std::vector<int32_t> order_;                  // triangles, leaf after leaf
  std::vector<Node> nodes_;
  mutable std::atomic<int64_t> searches_{0};
};

}  // namespace medial
