// SPDX-License-Identifier: GPL-3.0-or-later
// Moves the vertices of an even mesh to where balls touch the faces, and its smooth rims to where
// the two places that a ball touches become one.
#pragma once

#include "base/rows.h"
#include "exact/crisp.h"
#include "exact/smooth_rim.h"
#include "remesh/even_mesh.h"

namespace medial {

class EvenPlaces {
 public:
  // `generators` are per facet. The arguments must outlive this object.
  EvenPlaces(EvenMesh& even, const SamplesOnFaces& samples, std::span<const Edge> generators,
             std::span<const Edge> wires, const Run& run);

  // Takes over what is known of vertices that stay as they are.
  void start_from(std::span<const Placing> placing, std::span<const double> radius);
  // Places all vertices of triangles. What turns a triangle over is refused.
  void place();
  // Does the same for the last time: all balls are compared with all faces. Where they refuse the
  // place of a vertex inside a sheet, it looks for another one from the mean of its neighbours.
  void finish();
  // Moves the rims of smooth sheets towards their ends. Returns whether some moved far. Rims and
  // what is beside them must be placed.
  bool slide();
  // Places rims that end on no crease, and what is beside them.
  void place_rims();

  // (v) as of the last call of `place`; a vertex in no triangle is `voronoi`
  const std::vector<Placing>& placing() const { return placing_; }
  // (v) of the ball that touches the faces, where the placing is `touching` or more
  const std::vector<double>& radius() const { return radius_; }

 private:
  void place(std::span<const int32_t> vertices);
  void join_neighbour(int32_t v);
  Vec3 mean_beside(int32_t v) const;
  // Returns the vertices of triangles for which is_wanted(vertex), ascending.
  template <typename Wanted>
  std::vector<int32_t> vertices_where(const Wanted& is_wanted) const {
    return rows_where(e_.mesh.vertices(),
                      [&](int32_t v) { return e_.mesh.has_triangles(v) && is_wanted(v); });
  }
  // A vertex of a rim, and its neighbours along it.
  struct OnRim {
    int32_t vertex;
    Edge along;
  };
  std::vector<int32_t> open_rims() const;
  std::vector<OnRim> along_rims(std::span<const int32_t> rims) const;
  double hole_at(int32_t v) const;
  bool has_walls(int32_t v) const;
  std::vector<Foot> feet_of(int32_t v) const;
  Walls walls_of(int32_t v) const;
  Touch ball_at(int32_t v) const;
  Touch ball_from_beyond(int32_t v) const;
  Touch ball_of_walls(int32_t v) const;
  Walls nearest_walls(int32_t v) const;
  std::optional<Touch> smooth_ball_at(int32_t v, const Vec3& start, const Walls& walls) const;
  SmoothRim way_out(int32_t v) const;
  SmoothRim last_ball(int32_t v) const;
  bool is_beyond_walls(int32_t v, const Vec3& place) const;
  SmoothRim before_third_wall(int32_t v) const;
  bool has_parallel_walls(int32_t v) const;
  Touch ball_between(int32_t v, const Vec3& start) const;
  Vec3 last_place(int32_t v, const Vec3& far) const;
  double step_of(int32_t v, const SmoothRim& way) const;
  static void take_means(std::span<const OnRim> rims, int rounds, std::vector<double>& values);
  Vec3 outward_at(int32_t v) const;
  void even_out(std::span<const OnRim> rims, std::span<const SmoothRim> way,
                std::vector<double>& step) const;

  EvenMesh& e_;
  const SamplesOnFaces& samples_;
  std::span<const Edge> generators_;
  const Run& run_;
  std::vector<int32_t> along_wire_;  // (v) the other end of a wire that ends at a sheet; or -1
  std::vector<Placing> placing_;
  std::vector<double> radius_;
  std::vector<double> went_back_;  // per vertex: how far slides moved its rim back
  std::vector<Touch> found_;
  bool finishes_ = false;
};

}  // namespace medial
