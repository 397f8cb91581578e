// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/pn_triangles.h"

#include <numbers>

#include "base/portable_math.h"
#include "base/rows.h"
#include "base/sort_unique.h"
#include "sampling/beside_walls.h"
#include "sampling/smooth_normal.h"

namespace medial {
namespace {

// Sides closer than about 6 degrees do not determine the direction of their edge.
constexpr double kParallel = 0.1;  // chosen: unseen

// The weight with which a sum of normals is exact where all vertices lie on a sphere (Max 1999).
double weight_on_spheres(const TriangleMesh& mesh, int32_t triangle, int corner) {
  const Triangle& t = mesh.triangles[triangle];
  const Vec3& here = mesh.points[t[corner]];
  const Vec3 next = mesh.points[t[(corner + 1) % 3]] - here;
  const Vec3 last = mesh.points[t[(corner + 2) % 3]] - here;
  return length(cross(next, last)) / (squared_length(next) * squared_length(last));
}

// Finds the normals of smooth fans. Where a fan ends at creases, is flat, or holds a dominant wall,
// they are means by angles, and so are all unless fitted ones are wanted.
struct FanNormals {
  const TriangleMesh& mesh;
  const Creases& creases;
  const FlatParts& flat;
  std::span<const Triangle> fan_of, edge_of;
  bool fitted;

  // Flat parts up to an area do not count.
  Vec3 of_fan_at(int32_t triangle, int corner, double small) const {
    const int32_t vertex = mesh.triangles[triangle][corner], fan = fan_of[triangle][corner];
    Vec3 by_angle, of_sphere;
    bool closed = fitted, bent = false;
    std::vector<int32_t> round;
    for (const int32_t t : mesh.fans[vertex]) {
      const int i = corner_of(mesh.triangles[t], vertex);
      if (fan_of[t][i] != fan) continue;
      const bool counts = flat.area[t] > small || small == 0;
      closed &= counts && is_smooth(t, i) && is_smooth(t, (i + 2) % 3);
      if (!counts) continue;
      bent |= flat.part[t] != flat.part[triangle];
      by_angle = by_angle + mesh.corner_angle(t, i) * mesh.normal[t];
      if (!closed) continue;
      of_sphere = of_sphere + weight_on_spheres(mesh, t, i) * mesh.normal[t];
      add_beyond(t, (i + 1) % 3, round);
    }
    const Vec3 mean = normalized(by_angle);
    if (!closed || !bent || of_sphere == Vec3{}) return mean;
    const Vec3 found =
        smooth_normal(mesh.points[vertex], places(round, vertex), {mean, normalized(of_sphere)});
    return dot(found, mean) < least_agreement(vertex, fan, mean) ? mean : found;
  }

 private:
  bool is_smooth(int32_t triangle, int side) const {
    return creases.edges[edge_of[triangle][side]].crease == Crease::none;
  }
  // Adds the ends of a side, and the vertex across it.
  void add_beyond(int32_t triangle, int side, std::vector<int32_t>& round) const {
    const MeshEdge& edge = creases.edges[edge_of[triangle][side]];
    round.insert(round.end(), edge.ends.begin(), edge.ends.end());
    if (edge.crease != Crease::none) return;
    const Triangle& other = mesh.triangles[edge.triangles[edge.triangles[0] == triangle ? 1 : 0]];
    round.push_back(other[0] + other[1] + other[2] - edge.ends[0] - edge.ends[1]);
  }
  // Returns each vertex once, in ascending order, without one.
  std::vector<Vec3> places(std::vector<int32_t>& ids, int32_t without) const {
    sort_unique(ids);
    std::vector<Vec3> found;
    for (const int32_t id : ids) {
      if (id != without) found.push_back(mesh.points[id]);
    }
    return found;
  }
  // Returns the least cosine between a mean normal and those of the fan's triangles. A normal that
  // is farther away is none of the surface that the triangles stand for.
  double least_agreement(int32_t vertex, int32_t fan, const Vec3& mean) const {
    double least = 1;
    for (const int32_t t : mesh.fans[vertex]) {
      if (fan_of[t][corner_of(mesh.triangles[t], vertex)] != fan) continue;
      least = std::min(least, dot(mean, mesh.normal[t]));
    }
    return least;
  }
};

// Returns a third of the chord, made tangent to both sides. Its length is not kept; neither is it
// with one side.
Vec3 tangent_third(const Vec3& chord, const Vec3& left, const Vec3& right) {
  const Vec3 third = (1.0 / 3) * chord, along = cross(left, right);
  if (length(along) > kParallel) {
    const Vec3 unit = normalized(along);
    return dot(third, unit) * unit;
  }
  const Vec3 normal = normalized(left + right);
  return third - dot(third, normal) * normal;
}

}  // namespace

Barycentric place_on_edge(const Triangle& t, const Edge& ends, double share) {
  std::array<double, 3> at{};
  for (int i = 0; i < 3; ++i) at[i] = t[i] == ends[0] ? 1 - share : t[i] == ends[1] ? share : 0;
  return {at[0], at[1], at[2]};
}

// The control point in the middle is a quarter of the handles minus a sixth of the corners.
Patch::Patch(const Vec3& p, const Vec3& q, const Vec3& r, const std::array<Vec3, 6>& handles)
    : controls_{p, q, r}, flat_(false) {
  Vec3 centre = (-1.0 / 6) * (p + q + r);
  for (const Vec3& handle : handles) centre = centre + 0.25 * handle;
  std::copy(handles.begin(), handles.end(), controls_.begin() + 3);
  controls_[9] = centre;
}

Vec3 Patch::point(const Barycentric& at) const {
  const auto& [p, q, r, pq, qp, qr, rq, rp, pr, centre] = controls_;
  const auto& [a, b, c] = at;
  if (flat_) return p + b * (q - p) + c * (r - p);
  const Vec3 corners = a * a * a * p + b * b * b * q + c * c * c * r;
  const Vec3 edges =
      a * b * (a * pq + b * qp) + b * c * (b * qr + c * rq) + c * a * (c * rp + a * pr);
  return corners + 3 * edges + 6 * a * b * c * centre;
}

// The coefficients are differences of the control points towards q and towards r.
PatchPolynomial Patch::polynomial(const Vec3& origin) const {
  const auto& [p, q, r, pq, qp, qr, rq, rp, pr, centre] = controls_;
  if (flat_) return PatchPolynomial({p - origin, q - p, r - p});
  const Vec3 b = pq - p, c = pr - p, bb = qp - pq - b, bc = centre - pq - c, cc = rp - pr - c;
  return PatchPolynomial({p - origin, 3 * b, 3 * c, 3 * bb, 6 * bc, 3 * cc,
                          (q - qp) - (qp - pq) - bb, 3 * ((qr - centre) - (qp - pq) - bc),
                          3 * ((rq - centre) - (rp - pr) - bc), (r - rp) - (rp - pr) - cc});
}

PatchExpansion PatchPolynomial::expansion(double b, double c) const {
  const auto& [one, kb, kc, kbb, kbc, kcc, kbbb, kbbc, kbcc, kccc] = of_;
  const Vec3 bbb = b * kbbb, bbc = b * kbbc, bcc = c * kbcc, ccc = c * kccc;
  const Vec3 bb = kbb + bbb + c * kbbc, cc = kcc + ccc + b * kbcc;
  return {one + b * (kb + b * bb) + c * (kc + c * cc) + b * c * kbc,
          kb + b * (2 * bb + bbb) + c * (kbc + bcc),
          kc + c * (2 * cc + ccc) + b * (kbc + bbc),
          2 * (bb + 2 * bbb),
          kbc + 2 * (bbc + bcc),
          2 * (cc + 2 * ccc)};
}

// A patch is a mean of its control points, its flat triangle the same mean of those of a flat one.
double Patch::bulge(const Vec3& free) const {
  if (flat_) return 0;
  const auto& [p, q, r, pq, qp, qr, rq, rp, pr, centre] = controls_;
  double most = 0;
  const auto count = [&](const Vec3& way) {
    most = std::max(most, length(way - std::max(dot(way, free), 0.0) * free));
  };
  const auto take = [&](const Vec3& handle, const Vec3& near, const Vec3& far) {
    count(handle - (1.0 / 3) * (2 * near + far));
  };
  count(centre - (1.0 / 3) * (p + q + r));
  take(pq, p, q);
  take(qp, q, p);
  take(qr, q, r);
  take(rq, r, q);
  take(rp, r, p);
  take(pr, p, r);
  return most;
}

Box Patch::box() const { return box_of(controls()); }

CurvedSurface::CurvedSurface(const TriangleMesh& mesh, const Creases& creases, bool smooth,
                             const Run& run, VertexNormals normals)
    : mesh_(mesh) {
  if (!smooth) return;
  edge_of_ = edges_of_triangles(mesh, creases, run);
  add_normals(creases, normals, run);
  handles_.resize(creases.edges.size());
  parallel_for(static_cast<int64_t>(creases.edges.size()), run,
               [&](int64_t e) { handles_[e] = handles_of(creases.edges[e]); });
}

size_t CurvedSurface::bytes() const {
  return fan_normals_.size() * sizeof(Vec3) + handles_.size() * sizeof(Handles) +
         (fan_of_.size() + edge_of_.size()) * sizeof(Triangle);
}

void CurvedSurface::add_normals(const Creases& creases, VertexNormals normals, const Run& run) {
  Fans fans = smooth_fans(mesh_, creases);
  const FlatParts flat = flat_parts(mesh_, creases);
  const auto small = areas_beside_walls(mesh_, creases, flat, fans, edge_of_);
  fan_of_ = std::move(fans.of);
  fan_normals_.resize(small.size());
  const FanNormals found{mesh_, creases, flat, fan_of_, edge_of_, normals == VertexNormals::fitted};
  parallel_for(static_cast<int64_t>(small.size()), run, [&](int64_t f) {
    fan_normals_[f] = found.of_fan_at(fans.first[f] / 3, fans.first[f] % 3, small[f]);
  });
  split_steep_fans(creases.sharp_angle);
}

// Splits the fans at the tips of cones. There the mean normal is far from those of the sides, and
// patches bent towards it would leave the cone. So each triangle keeps its own normal there, and
// edges leave the tip straight.
void CurvedSurface::split_steep_fans(double sharp_angle) {
  const double least = portable::cos(std::min(sharp_angle, std::numbers::pi / 2));
  std::vector<uint8_t> steep(fan_normals_.size(), 0);
  for (size_t t = 0; t < fan_of_.size(); ++t) {
    const Vec3& normal = mesh_.normal[t];
    if (normal == Vec3{}) continue;
    for (const int32_t fan : fan_of_[t]) steep[fan] |= dot(normal, fan_normals_[fan]) < least;
  }
  for (size_t t = 0; t < fan_of_.size(); ++t) {
    for (int32_t& fan : fan_of_[t]) {
      if (!steep[fan]) continue;
      fan = static_cast<int32_t>(fan_normals_.size());
      fan_normals_.push_back(mesh_.normal[t]);
    }
  }
}

const Vec3& CurvedSurface::fan_normal(int32_t triangle, int32_t vertex) const {
  return fan_normals_[fan_of_[triangle][corner_of(mesh_.triangles[triangle], vertex)]];
}

// Returns the handles of an edge. It stays straight if it is unclear which sides it joins.
CurvedSurface::Handles CurvedSurface::handles_of(const MeshEdge& edge) const {
  Handles handles;
  const bool open = edge.crease == Crease::boundary;
  for (const int i : {0, 1}) {
    const Vec3& here = mesh_.points[edge.ends[i]];
    const Vec3 chord = mesh_.points[edge.ends[1 - i]] - here;
    const Vec3 third = edge.manifold || open
                           ? tangent_third(chord, fan_normal(edge.triangles[0], edge.ends[i]),
                                           fan_normal(edge.triangles[open ? 0 : 1], edge.ends[i]))
                           : (1.0 / 3) * chord;
    handles[i] = here + third;
  }
  return handles;
}

// Returns the control point that is next to `from` on the edge between two corners.
const Vec3& CurvedSurface::handle(int32_t triangle, int from, int to) const {
  const Triangle& t = mesh_.triangles[triangle];
  const int32_t edge = edge_of_[triangle][to == (from + 1) % 3 ? from : to];
  return handles_[edge][t[from] < t[to] ? 0 : 1];
}

Patch CurvedSurface::patch(int32_t triangle) const {
  const Triangle& t = mesh_.triangles[triangle];
  const Vec3 &p = mesh_.points[t[0]], &q = mesh_.points[t[1]], &r = mesh_.points[t[2]];
  if (!smooth()) return {p, q, r};
  return {p,
          q,
          r,
          {handle(triangle, 0, 1), handle(triangle, 1, 0), handle(triangle, 1, 2),
           handle(triangle, 2, 1), handle(triangle, 2, 0), handle(triangle, 0, 2)}};
}

Vec3 CurvedSurface::normal(int32_t triangle, const Barycentric& at) const {
  if (!smooth()) return mesh_.normal[triangle];
  const auto& [i, j, k] = fan_of_[triangle];
  return normalized(at.a * fan_normals_[i] + at.b * fan_normals_[j] + at.c * fan_normals_[k]);
}

}  // namespace medial
