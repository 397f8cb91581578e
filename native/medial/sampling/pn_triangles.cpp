// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/pn_triangles.h"

#include <numbers>

#include "base/union_find.h"

namespace medial {
namespace {

// Sides closer than about 6 degrees do not determine the direction of their edge.
constexpr double kParallel = 0.1;

int corner_of(const Triangle& t, int32_t vertex) {
  return t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
}

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

Barycentric along(const Triangle& t, int32_t from, int32_t to, double share) {
  std::array<double, 3> at{};
  for (int i = 0; i < 3; ++i) at[i] = t[i] == from ? 1 - share : t[i] == to ? share : 0;
  return {at[0], at[1], at[2]};
}

// The control point in the middle is a quarter of the handles minus a sixth of the corners.
Patch::Patch(const Vec3& p, const Vec3& q, const Vec3& r, const std::array<Vec3, 6>& handles)
    : corners_{p, q, r}, flat_(false), handles_(handles), centre_((-1.0 / 6) * (p + q + r)) {
  for (const Vec3& handle : handles) centre_ = centre_ + 0.25 * handle;
}

Vec3 Patch::point(const Barycentric& at) const {
  const auto& [p, q, r] = corners_;
  const auto& [a, b, c] = at;
  if (flat_) return p + b * (q - p) + c * (r - p);
  const auto& [pq, qp, qr, rq, rp, pr] = handles_;
  const Vec3 corners = a * a * a * p + b * b * b * q + c * c * c * r;
  const Vec3 edges =
      a * b * (a * pq + b * qp) + b * c * (b * qr + c * rq) + c * a * (c * rp + a * pr);
  return corners + 3 * edges + 6 * a * b * c * centre_;
}

// The second derivatives of a cubic in Bernstein form are linear in its second differences, its
// first ones quadratic.
PatchExpansion Patch::expansion(const Barycentric& at) const {
  const auto& [p, q, r] = corners_;
  const double a = at.a, b = at.b, c = at.c;
  if (flat_) return {p + b * (q - p) + c * (r - p), q - p, r - p, {}, {}, {}};
  const auto& [pq, qp, qr, rq, rp, pr] = handles_;
  // the quadratic patches of the differences towards q and towards r, named by their corners
  const auto quadratic = [&](const Vec3& aa, const Vec3& ab, const Vec3& ac, const Vec3& bb,
                             const Vec3& bc, const Vec3& cc) {
    return a * a * aa + b * b * bb + c * c * cc + 2 * (a * b * ab + a * c * ac + b * c * bc);
  };
  const auto linear = [&](const Vec3& x, const Vec3& y, const Vec3& z) {
    return 6 * (a * x + b * y + c * z);
  };
  const std::array<Vec3, 6> to_q{pq - p, qp - pq, centre_ - pr, q - qp, qr - centre_, rq - rp};
  const std::array<Vec3, 6> to_r{pr - p, centre_ - pq, rp - pr, qr - qp, rq - centre_, r - rp};
  return {point(at),
          3 * quadratic(to_q[0], to_q[1], to_q[2], to_q[3], to_q[4], to_q[5]),
          3 * quadratic(to_r[0], to_r[1], to_r[2], to_r[3], to_r[4], to_r[5]),
          linear(to_q[1] - to_q[0], to_q[3] - to_q[1], to_q[4] - to_q[2]),
          linear(to_q[2] - to_q[0], to_q[4] - to_q[1], to_q[5] - to_q[2]),
          linear(to_r[2] - to_r[0], to_r[4] - to_r[1], to_r[5] - to_r[2])};
}

// A patch is a mean of its control points, its flat triangle the same mean of those of a flat one.
double Patch::bulge() const {
  if (flat_) return 0;
  const auto& [p, q, r] = corners_;
  const std::array<Vec3, 6> flat{(1.0 / 3) * (2 * p + q), (1.0 / 3) * (p + 2 * q),
                                 (1.0 / 3) * (2 * q + r), (1.0 / 3) * (q + 2 * r),
                                 (1.0 / 3) * (2 * r + p), (1.0 / 3) * (r + 2 * p)};
  double most = distance(centre_, (1.0 / 3) * (p + q + r));
  for (size_t i = 0; i < flat.size(); ++i) {
    // the handles are pq, qp, qr, rq, rp, pr
    most = std::max(most, distance(handles_[i], flat[i]));
  }
  return most;
}

// The control points hold the patch between them.
double Patch::least_distance(const Vec3& from, const Vec3& direction) const {
  double least = HUGE_VAL;
  const auto take = [&](const Vec3& control) {
    least = std::min(least, dot(from - control, direction));
  };
  for (const Vec3& corner : corners_) take(corner);
  if (flat_) return least;
  for (const Vec3& handle : handles_) take(handle);
  take(centre_);
  return least;
}

Box Patch::box() const {
  Box box;
  for (const Vec3& corner : corners_) box.add(corner);
  if (flat_) return box;
  for (const Vec3& handle : handles_) box.add(handle);
  box.add(centre_);
  return box;
}

CurvedSurface::CurvedSurface(const TriangleMesh& mesh, const Creases& creases, bool smooth,
                             const Run& run)
    : mesh_(mesh) {
  if (!smooth) return;
  add_normals(creases);
  const auto count = static_cast<int64_t>(mesh.triangles.size());
  edge_of_.resize(mesh.triangles.size());
  parallel_for(count, run, [&](int64_t t) {
    const Triangle& corners = mesh.triangles[t];
    for (int i = 0; i < 3; ++i) {
      edge_of_[t][i] = creases.find(corners[i], corners[(i + 1) % 3]);
    }
  });
  handles_.resize(creases.edges.size());
  parallel_for(static_cast<int64_t>(creases.edges.size()), run,
               [&](int64_t e) { handles_[e] = handles_of(creases.edges[e]); });
}

size_t CurvedSurface::bytes() const {
  return fan_normals_.size() * sizeof(Vec3) + handles_.size() * sizeof(Handles) +
         (fan_of_.size() + edge_of_.size()) * sizeof(Triangle);
}

void CurvedSurface::add_normals(const Creases& creases) {
  UnionFind corners(3 * mesh_.triangles.size());
  for (const MeshEdge& edge : creases.edges) {
    if (edge.crease != Crease::none) continue;
    const auto& [s, t] = edge.triangles;
    for (const int32_t end : edge.ends) {
      corners.unite(3 * s + corner_of(mesh_.triangles[s], end),
                    3 * t + corner_of(mesh_.triangles[t], end));
    }
  }
  const auto root = std::move(corners).representatives();
  fan_of_.resize(mesh_.triangles.size());
  std::vector<int32_t> fan(root.size(), -1);
  for (int32_t c = 0; c < static_cast<int32_t>(root.size()); ++c) {
    const int32_t t = c / 3;
    if (fan[root[c]] < 0) {
      fan[root[c]] = static_cast<int32_t>(fan_normals_.size());
      fan_normals_.emplace_back();
    }
    Vec3& sum = fan_normals_[fan_of_[t][c % 3] = fan[root[c]]];
    sum = sum + mesh_.corner_angle(t, c % 3) * mesh_.normal[t];
  }
  for (Vec3& normal : fan_normals_) normal = normalized(normal);
  split_steep_fans(creases.sharp_angle);
}

// Splits the fans at the tips of cones. There the mean normal is far from those of the sides, and
// patches bent towards it would leave the cone. So each triangle keeps its own normal there, and
// edges leave the tip straight.
void CurvedSurface::split_steep_fans(double sharp_angle) {
  const double least = std::cos(std::min(sharp_angle, std::numbers::pi / 2));
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
