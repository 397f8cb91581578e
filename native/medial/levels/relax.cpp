// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels/relax.h"

#include <algorithm>

#include "base/parallel.h"
#include "levels/curves.h"

namespace medial {
namespace {

// spacings from a tip: curves end in it, and farther away samples fix them
constexpr double kNearTip = 4;      // chosen: unseen
constexpr double kLikeACone = 0.2;  // deviation from the radius half way to a tip; chosen: unseen
constexpr double kBluntest = 0.95;  // half the angle of a cone with a tip: its sine; chosen: unseen

// Ends curves in the tips of cones. Near a tip samples hardly determine a curve, so that it goes
// straight on where the balls are larger there.
class Tips {
 public:
  Tips(std::span<const Vec3> tips, const Faces& faces) : tips_(tips), faces_(faces) {}

  void end(Curve& curve, bool at_front) const {
    const size_t last = curve.canal.size() - 1;
    const auto vertex = [&](size_t k) -> Canal& { return curve.canal[at_front ? k : last - k]; };
    const double spacing = at_front ? curve.spacing.front() : curve.spacing.back();
    for (const Vec3& tip : tips_) {
      if (!(distance(tip, vertex(0).centre) < kNearTip * spacing)) continue;
      size_t clear = 1;
      while (clear < last && distance(tip, vertex(clear).centre) < kNearTip * spacing) ++clear;
      if (!is_cone(vertex(clear).centre, vertex(0).centre, tip)) continue;
      for (size_t k = 1; k < clear; ++k) straighten(vertex(k), vertex(clear).centre, tip);
      vertex(0).centre = tip;
      vertex(0).radius = 0;
      return;
    }
  }

 private:
  double radius_at(const Vec3& place) const { return faces_.nearer(place, HUGE_VAL)->distance; }

  // Returns whether the faces are a cone round the way to a tip: the ball half way is half as
  // large.
  bool is_cone(const Vec3& from, const Vec3& end, const Vec3& tip) const {
    const double radius = radius_at(from), half = radius_at(0.5 * (from + tip));
    return std::abs(half - 0.5 * radius) < kLikeACone * radius && dot(tip - from, end - from) > 0 &&
           radius < kBluntest * distance(from, tip);
  }

  void straighten(Canal& canal, const Vec3& from, const Vec3& tip) const {
    const Vec3 way = tip - from;
    const double share = dot(canal.centre - from, way) / squared_length(way);
    const Vec3 place = from + std::clamp(share, 0.0, 1.0) * way;
    const double radius = radius_at(place);
    if (!(radius > radius_at(canal.centre))) return;
    canal.centre = place;
    canal.radius = radius;
  }

  std::span<const Vec3> tips_;
  const Faces& faces_;
};

// Returns the points in which smooth faces end, as in the tip of a cone.
std::vector<Vec3> tips_of(const Faces& faces) {
  const auto& mesh = faces.mesh();
  std::vector<uint8_t> on_crease(mesh.points.size(), 0);
  for (const MeshEdge& edge : faces.creases().edges) {
    if (edge.crease == Crease::none) continue;
    for (const int32_t end : edge.ends) on_crease[end] = 1;
  }
  std::vector<Vec3> tips;
  for (size_t p = 0; p < mesh.points.size(); ++p) {
    if (faces.creases().corner[p] && !on_crease[p]) tips.push_back(mesh.points[p]);
  }
  return tips;
}

// Returns the chains of a level; they end at facets and at vertices with other than two wires.
std::vector<Chain> chains_of(const Level& level) {
  std::vector<uint8_t> on_facet(level.vertices.size(), 0);
  for (const int32_t v : level.face_vertices) on_facet[v] = 1;
  return medial::chains_of(level.wires, on_facet);
}

// Replaces chains by curves.
class Rewirer {
 public:
  Rewirer(Level& level, const Hierarchy::Parts& hierarchy, const std::vector<Chain>& chains,
          const std::vector<Curve>& curves)
      : level_(level), h_(hierarchy), chains_(chains), curves_(curves) {}

  void rewire() && {
    take_out();
    old_edge_of_ = std::move(level_.edge_of);
    level_.wires.clear();
    level_.edge_of = {};
    for (size_t c = 0; c < chains_.size(); ++c) put_in(chains_[c], curves_[c]);
    level_.limb.clear();
    for (const int32_t e : level_.edge_of) level_.limb.push_back(h_.limb_of_edge(e));
  }

 private:
  // Removes the vertices inside chains. Vertices of facets come first, so they keep their numbers.
  void take_out() {
    number_.assign(level_.vertices.size(), 0);
    for (const Chain& chain : chains_) {
      for (size_t k = chain.closed ? 0 : 1; k < chain.size(); ++k) number_[chain.vertices[k]] = -1;
    }
    int32_t left = 0;
    for (int32_t& number : number_) {
      if (number == 0) number = left++;
    }
    old_exact_ = level_.exact;
    old_exact_radius_ = level_.exact_radius;
    old_vertex_of_ = level_.vertex_of;
    keep(level_.vertices);
    keep(level_.radius);
    keep(level_.exact);
    keep(level_.exact_radius);
    keep(level_.vertex_of);
    keep(level_.place);
    for (int32_t& v : level_.points) v = number_[v];
  }

  template <typename T>
  void keep(Column<T>& values) const {
    size_t left = 0;
    for (size_t v = 0; v < number_.size(); ++v) {
      if (number_[v] >= 0) values[left++] = values[v];
    }
    values.resize(left);
  }

  void put_in(const Chain& chain, const Curve& curve) {
    const size_t last = curve.canal.size() - 1;
    const int32_t first = chain.closed ? add(chain, curve, 0) : end(chain, curve, 0);
    int32_t before = first;
    for (size_t k = 1; k <= last; ++k) {
      const int32_t next = k < last       ? add(chain, curve, k)
                           : chain.closed ? first
                                          : end(chain, curve, 1);
      level_.wires.push_back({before, next});
      const auto middle = static_cast<size_t>(0.5 * (curve.at[k - 1] + curve.at[k]));
      level_.edge_of.push_back(old_edge_of_[chain.wires[std::min(middle, chain.size() - 1)]]);
      before = next;
    }
  }

  int32_t end(const Chain& chain, const Curve& curve, int which) {
    const int32_t vertex = number_[which == 0 ? chain.vertices.front() : chain.vertices.back()];
    if (chain.loose[which]) {
      const Canal& canal = which == 0 ? curve.canal.front() : curve.canal.back();
      level_.vertices[vertex] = canal.centre;
      level_.radius[vertex] = canal.radius;
    }
    return vertex;
  }

  // A new vertex stands for the nearest old one along the wire. Places between two old vertices may
  // lie outside of the solid even where both of these are inside.
  int32_t add(const Chain& chain, const Curve& curve, size_t k) {
    const auto nearest = static_cast<size_t>(std::lround(curve.at[k]));
    const int32_t old = chain.vertices[std::min(nearest, chain.size())];
    level_.vertices.push_back(curve.canal[k].centre);
    level_.radius.push_back(curve.canal[k].radius);
    level_.exact.push_back(old_exact_[old]);
    level_.exact_radius.push_back(old_exact_radius_[old]);
    level_.vertex_of.push_back(old_vertex_of_[old]);
    level_.place.push_back(Placing::voronoi);
    return static_cast<int32_t>(level_.vertices.size()) - 1;
  }

  Level& level_;
  const Hierarchy::Parts& h_;
  const std::vector<Chain>& chains_;
  const std::vector<Curve>& curves_;
  std::vector<int32_t> number_;  // per old vertex: its new number, or -1 if it is removed
  Column<Vec3> old_exact_;
  Column<double> old_exact_radius_;
  Column<int32_t> old_vertex_of_, old_edge_of_;
};

}  // namespace

void relax(Level& level, const Hierarchy::Parts& h, bool to_faces, const Run& run) {
  begin_stage(run.progress, "Curves", 0.6, 1);
  if (level.wires.empty()) return;
  const auto chains = chains_of(level);
  auto curves = fit_curves(chains, level.vertices, *h.samples, run);
  if (to_faces && h.on_faces) {
    const std::vector<Vec3> places = tips_of(*h.faces);
    const Tips tips(places, *h.faces);
    for (size_t c = 0; c < chains.size(); ++c) {
      if (chains[c].loose[0]) tips.end(curves[c], true);
      if (chains[c].loose[1]) tips.end(curves[c], false);
    }
  }
  Rewirer(level, h, chains, curves).rewire();
}

}  // namespace medial
