// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/opposite_walls.h"

#include "base/rows.h"
#include "sampling/closest_on_flat.h"

namespace medial {
namespace {

constexpr int kMostShrinkings = 32;
constexpr double kUpright = 0.94;  // cosine of a normal and the way to the centre; chosen: unseen
constexpr int kMostSteps = 12;
constexpr double kPrecise = 1e-12;  // in barycentric coordinates; derived: rounding
// A ball touches where it is not cut deeper than by this share of its radius.
constexpr double kTouching = 1e-9;  // derived: rounding
// Walls closer than this share of the reach meet there.
constexpr double kMeeting = 1e-8;  // derived: rounding
constexpr size_t kMostInColumn = 32;
constexpr double kTight = 0.5;  // of the reach, up to which places are tight; chosen: axis

}  // namespace

OppositeWalls::OppositeWalls(const CurvedSurface& surface, const Creases& creases)
    : surface_(surface),
      creases_(creases),
      mesh_(surface.mesh()),
      order_(all_rows(mesh_.triangles.size())) {
  std::vector<Box> boxes(order_.size());
  for (size_t t = 0; t < boxes.size(); ++t) {
    for (const int32_t corner : mesh_.triangles[t]) boxes[t].add(mesh_.points[corner]);
  }
  nodes_ = tree_of_boxes(order_, [&](int32_t t) { return boxes[t]; });
}

Vec3 OppositeWalls::point(int32_t triangle, const Barycentric& at) const {
  const auto& [p, q, r] = mesh_.triangles[triangle];
  const Vec3& origin = mesh_.points[p];
  return origin + at.b * (mesh_.points[q] - origin) + at.c * (mesh_.points[r] - origin);
}

// Returns the nearest place of the triangles that face a normal; of equally near ones that of the
// lowest triangle. The sign is negative where normals of triangles are to be turned around.
OppositeWalls::Touch OppositeWalls::nearest_facing(const Vec3& centre, const Vec3& normal,
                                                   double than, double sign) const {
  Touch best;
  double within = than * than;
  visit_nearest(
      nodes_, 0, [&](const BoxNode& node) { return squared_distance(node.box, centre); },
      [&] { return within; },
      [&](const BoxNode& leaf) {
        for (int32_t i = leaf.begin; i < leaf.end; ++i) {
          const int32_t t = order_[i];
          if (!(sign * dot(mesh_.normal[t], normal) < kOpposite)) continue;
          const auto& [p, q, r] = mesh_.triangles[t];
          const Barycentric at =
              closest_on_flat(mesh_.points[p], mesh_.points[q], mesh_.points[r], centre);
          const Vec3 found = point(t, at);
          const double away = squared_length(found - centre);
          if (away < within || (away == within && best.triangle > t)) {
            best = {t, at, found};
            within = away;
          }
        }
      });
  return best;
}

// The ball shrinks to touch the place that lies deepest in it, until it holds none.
std::optional<OppositeWalls::Touch> OppositeWalls::touch(const Vec3& from, const Vec3& normal,
                                                         double reach, double sign) const {
  double radius = 0.5 * reach;
  Touch touch;
  if (normal == Vec3{} || nodes_.empty()) return {};
  for (int i = 0; i < kMostShrinkings; ++i) {
    const Touch next =
        nearest_facing(from - radius * normal, normal, (1 - kTouching) * radius, sign);
    if (next.triangle < 0) break;
    const Vec3 back = from - next.point;
    const double depth = dot(back, normal);
    if (!(depth > kMeeting * reach)) return {};
    radius = squared_length(back) / (2 * depth);
    touch = next;
  }
  if (touch.triangle < 0) return {};
  const Vec3 away = normalized(from - radius * normal - touch.point);
  if (!(-sign * dot(away, mesh_.normal[touch.triangle]) > kUpright)) return {};
  return touch;
}

std::optional<WallPlace> OppositeWalls::operator()(const SurfacePlace& from, double reach,
                                                   Through through) const {
  const double sign = through == Through::solid ? 1 : -1;
  const Vec3 normal = sign * mesh_.normal[from.triangle];
  const auto flat = touch(point(from.triangle, from.at), normal, reach, sign);
  if (!flat) return {};
  SurfacePlace place{flat->triangle, flat->at};
  const bool inside = flat->at.a > 0 && flat->at.b > 0 && flat->at.c > 0;
  if (inside || surface_.smooth()) place = on_curved(from, place, sign);
  const Vec3 there = surface_.point(place.triangle, place.at);
  return WallPlace{place.triangle, place.at,
                   distance(surface_.point(from.triangle, from.at), there)};
}

void OppositeWalls::column(const SurfacePlace& from, double reach,
                           std::vector<ColumnPlace>& out) const {
  out.assign(1, {from});
  bool beyond = false;
  const auto add = [&](size_t before, Through through) {
    const Found found = add_opposite(out, static_cast<int>(before), through, reach);
    beyond |= found == Found::beyond;
  };
  add(0, Through::solid);
  add(0, Through::gap);
  for (size_t i = 1; i < out.size() && out.size() < kMostInColumn; ++i) {
    add(i, out[i].through == Through::gap ? Through::solid : Through::gap);
  }
  if (beyond) keep_tight(out);
}

OppositeWalls::Found OppositeWalls::add_opposite(std::vector<ColumnPlace>& column, int before,
                                                 Through through, double reach) const {
  const SurfacePlace from = column[before].place, &first = column[0].place;
  const auto found = (*this)(from, reach, through);
  if (!found) return Found::nothing;
  const bool is_tight = found->distance < kTight * reach;
  const Vec3 there = surface_.point(found->triangle, found->at);
  if (before > 0 && distance(there, surface_.point(first.triangle, first.at)) > reach) {
    return is_tight ? Found::beyond : Found::nothing;
  }
  column.push_back({{found->triangle, found->at}, found->distance, before, through, is_tight});
  return Found::within;
}

void keep_tight(std::vector<ColumnPlace>& column) {
  std::vector<int> kept(column.size(), -1);
  int count = 0;
  for (size_t i = 0; i < column.size(); ++i) {
    ColumnPlace next = column[i];
    if (i > 0) {
      next.before = kept[next.before];
      if (!next.is_tight || next.before < 0) continue;
    }
    kept[i] = count;
    column[count++] = next;
  }
  column.resize(count);
}

// Moves a place of the flat wall to where the ball touches the curved one. In each step the curved
// wall is replaced by its tangent plane. A place that would go farther than the walls are apart
// stays where it was: there the faces are too coarse for a curved wall.
SurfacePlace OppositeWalls::on_curved(const SurfacePlace& from, const SurfacePlace& flat,
                                      double sign) const {
  const Vec3 start = surface_.point(from.triangle, from.at);
  const Vec3 n = sign * surface_.normal(from.triangle, from.at);
  const Vec3 first = surface_.point(flat.triangle, flat.at);
  SurfacePlace place = flat;
  for (int i = 0; i < kMostSteps; ++i) {
    const PatchExpansion here =
        surface_.patch(place.triangle).polynomial(start).expansion(place.at.b, place.at.c);
    const Vec3 m = sign * normalized(cross(here.b, here.c));
    const double facing = 1 - dot(n, m);
    if (!(facing > 1)) break;
    const double radius = dot(here.point, m) / facing;
    const Vec3 way = radius * (m - n) - here.point;
    const double bb = dot(here.b, here.b), bc = dot(here.b, here.c), cc = dot(here.c, here.c);
    const double by_b = dot(way, here.b), by_c = dot(way, here.c), det = bb * cc - bc * bc;
    if (!(det > 0)) break;
    const double db = (by_b * cc - by_c * bc) / det, dc = (by_c * bb - by_b * bc) / det;
    if (!go(place, {-db - dc, db, dc}) && std::abs(db) + std::abs(dc) < kPrecise) break;
  }
  const Vec3 last = surface_.point(place.triangle, place.at);
  return distance(first, last) < distance(first, start) ? place : flat;
}

// Takes a step in barycentric coordinates as far as the side of the triangle, and then over it to
// the next triangle if that is on the same wall. Returns whether it went over.
bool OppositeWalls::go(SurfacePlace& place, const std::array<double, 3>& step) const {
  std::array<double, 3> at{place.at.a, place.at.b, place.at.c};
  double share = 1;
  int out = -1;
  for (int i = 0; i < 3; ++i) {
    if (!(at[i] + step[i] < 0) || !(at[i] < -share * step[i])) continue;
    share = std::max(0.0, -at[i] / step[i]);
    out = i;
  }
  for (int i = 0; i < 3; ++i) at[i] = std::clamp(at[i] + share * step[i], 0.0, 1.0);
  if (out >= 0) at[out] = 0;
  place.at = {at[0], at[1], at[2]};
  if (out < 0) return false;
  const Triangle& t = mesh_.triangles[place.triangle];
  const int32_t p = t[(out + 1) % 3], q = t[(out + 2) % 3];
  const MeshEdge& edge = creases_.edges[creases_.find(p, q)];
  if (edge.crease != Crease::none || !edge.manifold) return false;
  const int32_t next = edge.triangles[edge.triangles[0] == place.triangle];
  place = {next, place_on_edge(mesh_.triangles[next], {p, q}, at[(out + 2) % 3])};
  return true;
}

}  // namespace medial
