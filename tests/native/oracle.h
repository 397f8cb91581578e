// SPDX-License-Identifier: GPL-3.0-or-later
// MEDIAL(P) restated by brute force from the definitions of the paper, for some dozens of points
// whose coordinates are integers below 2^20 (times a power of two). It shares no code with the
// library. Every sign, tie and coincidence is decided in exact integers; angles and lengths are
// long doubles.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <vector>

#include "base/triangle.h"
#include "base/vec3.h"

namespace medial::test {

using Integer = boost::multiprecision::cpp_int;
using Ids = std::vector<int32_t>;  // of points, ascending

template <typename T>
struct Vector {
  T x, y, z;

  friend Vector operator-(const Vector& a, const Vector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend Vector operator+(const Vector& a, const Vector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend Vector operator*(const T& s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend auto operator<=>(const Vector&, const Vector&) = default;
};

template <typename T>
T dot(const Vector<T>& a, const Vector<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename T>
Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename To, typename From>
Vector<To> to(const Vector<From>& a) {
  return {static_cast<To>(a.x), static_cast<To>(a.y), static_cast<To>(a.z)};
}

using GridPoint = Vector<int64_t>;
using Exact = Vector<Integer>;
using Real = Vector<long double>;

inline long double length(const Real& a) { return std::sqrt(dot(a, a)); }
inline Real unit(const Real& a) { return (1 / length(a)) * a; }

// ---- Delaunay --------------------------------------------------------------------------------

// Differences of coordinates have 21 bits, so these determinants have less than 120.
__extension__ typedef __int128 Wide;

inline Wide orientation(const GridPoint& a, const GridPoint& b, const GridPoint& c,
                        const GridPoint& d) {
  return dot(to<Wide>(a - d), cross(to<Wide>(b - d), to<Wide>(c - d)));
}

// Above 0: e lies inside of the sphere through four points, 0: on it. Any orientation.
template <typename T = Wide>
int in_sphere(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d,
              const GridPoint& e) {
  const auto u = to<T>(a - d), v = to<T>(b - d), w = to<T>(c - d), q = to<T>(e - d);
  const T volume = dot(u, cross(v, w));
  const T lifted = dot(u, u) * dot(q, cross(v, w)) + dot(v, v) * dot(q, cross(w, u)) +
                   dot(w, w) * dot(q, cross(u, v));
  const T value = lifted - dot(q, q) * volume;
  return (value > 0) - (value < 0) == 0 ? 0 : ((value > 0) == (volume > 0) ? 1 : -1);
}

// All maximal sets of points on one empty sphere: the Delaunay cells before any is cut up. Sets of
// four only, when the points are in general position.
inline std::set<Ids> empty_spheres(const std::vector<GridPoint>& points) {
  const auto n = static_cast<int32_t>(points.size());
  std::set<Ids> found;
  const auto try_sphere = [&](int32_t i, int32_t j, int32_t k, int32_t l) {
    if (orientation(points[i], points[j], points[k], points[l]) == 0) return;
    Ids on;
    for (int32_t e = 0; e < n; ++e) {
      const bool corner = e == i || e == j || e == k || e == l;
      const int side =
          corner ? 0 : in_sphere(points[i], points[j], points[k], points[l], points[e]);
      if (side > 0) return;
      if (side == 0) on.push_back(e);
    }
    found.insert(on);
  };
  for (int32_t i = 0; i < n; ++i) {
    for (int32_t j = i + 1; j < n; ++j) {
      for (int32_t k = j + 1; k < n; ++k) {
        for (int32_t l = k + 1; l < n; ++l) try_sphere(i, j, k, l);
      }
    }
  }
  return found;
}

// ---- The method, for a Delaunay triangulation ------------------------------------------------

class Oracle {
 public:
  // Relative: decisions that are closer than this are not settled, for the Voronoi vertices of the
  // library carry 24 bits.
  static constexpr long double kNear = 1e-6L;

  // `cells`: corners of the finite cells, each ascending. `symmetric`: a Voronoi vertex that lies
  // exactly in a tangent plane is there in doubles, too, so that its side is settled.
  Oracle(std::vector<GridPoint> points, double unit_length, const std::set<Ids>& cells,
         bool symmetric = false)
      : points_(std::move(points)), unit_(unit_length), symmetric_(symmetric) {
    for (const Ids& cell : cells) add_cell(cell);
    find_rays();
    poles_.resize(points_.size());
    umbrellas_.resize(points_.size());
    for (int32_t p = 0; p < static_cast<int32_t>(points_.size()); ++p) {
      find_pole(p);
      find_umbrella(p);
    }
  }

  // Whether every cell has a volume and an empty sphere, and every triangle two cells, one on
  // either side, or one and lies on the hull.
  bool is_delaunay() const {
    for (const Ids& c : cells_) {
      const auto &a = points_[c[0]], &b = points_[c[1]], &d = points_[c[2]], &e = points_[c[3]];
      if (orientation(a, b, d, e) == 0) return false;
      for (const GridPoint& q : points_) {
        if (in_sphere(a, b, d, e, q) > 0) return false;
      }
    }
    for (const auto& [triangle, cells] : cells_at_) {
      if (cells.size() > 2) return false;
      const int side = side_of(triangle, apex(cells[0], triangle));
      if (cells.size() == 2) {
        if (side_of(triangle, apex(cells[1], triangle)) != -side) return false;
        continue;
      }
      for (int32_t q = 0; q < static_cast<int32_t>(points_.size()); ++q) {
        if (side_of(triangle, q) == -side) return false;
      }
    }
    return true;
  }

  std::set<Edge> edges() const {
    std::set<Edge> all;
    for (const Ids& cell : cells_) {
      for (const int32_t p : cell) {
        for (const int32_t q : cell) {
          if (p < q) all.insert({p, q});
        }
      }
    }
    return all;
  }
  bool is_bounded(const Edge& pq) const {
    for (const auto& [triangle, ray] : rays_) {
      if (has(triangle, pq[0]) && has(triangle, pq[1])) return false;
    }
    return true;
  }

  // Whether the definitions settle the pole and the umbrella of a sample.
  bool settled(int32_t p) const { return poles_[p].settled; }
  const Exact& exact_pole(int32_t p) const { return poles_[p].exact; }
  // v_p, in the units of the input; for an unbounded cell the mean direction of its infinite edges.
  Real pole_vector(int32_t p) const { return poles_[p].vector; }
  bool pole_at_infinity(int32_t p) const { return poles_[p].infinite; }
  // The edges opposite to p in the triangles of U_p, lower end first.
  const std::set<Edge>& umbrella(int32_t p) const { return umbrellas_[p]; }
  bool in_umbrella(int32_t p, int32_t q) const {
    for (const Edge& link : umbrellas_[p]) {
      if (link[0] == q || link[1] == q) return true;
    }
    return false;
  }

  // pi/2 - max of the angles between the normals of U_p and pq.
  long double theta(int32_t p, int32_t q) const {
    long double largest = 0;
    const Real t = unit(to<long double>(points_[q] - points_[p]));
    for (const auto& [a, b] : umbrellas_[p]) {
      const Real n = to<long double>(to<Wide>(normal_of(p, a, b)));
      largest = std::max(largest, std::acos(std::min(1.0L, std::abs(dot(unit(n), t)))));
    }
    return std::numbers::pi_v<long double> / 2 - largest;
  }
  // Largest circumradius in U_p.
  long double umbrella_radius(int32_t p) const {
    long double largest = 0;
    for (const auto& [a, b] : umbrellas_[p]) {
      const long double ab = size(a, b), pa = size(p, a), pb = size(p, b);
      // The angle opposite to ab gives it, as in the law of sines.
      const auto u = to<long double>(points_[a] - points_[p]);
      const auto v = to<long double>(points_[b] - points_[p]);
      const long double sine = unit_ * unit_ * length(cross(u, v)) / (pa * pb);
      largest = std::max(largest, ab / (2 * sine));
    }
    return largest;
  }
  // min of |pq| / R over U_p.
  long double rho(int32_t p, int32_t q) const { return size(p, q) / umbrella_radius(p); }
  long double size(int32_t p, int32_t q) const {
    return unit_ * length(to<long double>(points_[q] - points_[p]));
  }

  // Cells round an edge: those of both its ends.
  Ids ring(const Edge& pq) const {
    Ids found;
    for (size_t c = 0; c < cells_.size(); ++c) {
      if (has(cells_[c], pq[0]) && has(cells_[c], pq[1])) found.push_back(static_cast<int32_t>(c));
    }
    return found;
  }
  size_t cell_count() const { return cells_.size(); }
  Real centre(int32_t cell) const {
    const auto w = static_cast<long double>(centres_[cell].w);
    return (unit_ / w) * to<long double>(centres_[cell].xyz);
  }
  // The radius of the empty ball.
  long double radius(int32_t cell) const {
    return unit_ * length(real(arm(cells_[cell][0], cell)));
  }

  // The distinct Voronoi vertices of the dual facet, counter-clockwise about the direction from p
  // to q: some cell of each.
  Ids facet(const Edge& pq) const {
    Ids distinct;
    for (const int32_t c : ring(pq)) {
      bool is_new = true;
      for (const int32_t d : distinct) is_new = is_new && !same_centre(c, d);
      if (is_new) distinct.push_back(c);
    }
    Real middle{0, 0, 0};
    for (const int32_t c : distinct) {
      middle = middle + (1.0L / static_cast<long double>(distinct.size())) * centre(c);
    }
    const Real axis = unit(to<long double>(points_[pq[1]] - points_[pq[0]]));
    const Real aside = std::abs(axis.x) < 0.5L ? Real{1, 0, 0} : Real{0, 1, 0};
    const Real u = unit(cross(axis, aside)), v = cross(axis, u);
    const auto angle = [&](int32_t c) {
      return std::atan2(dot(centre(c) - middle, v), dot(centre(c) - middle, u));
    };
    std::sort(distinct.begin(), distinct.end(),
              [&](int32_t c, int32_t d) { return angle(c) < angle(d); });
    return distinct;
  }

  // Conditions of an edge by one end; an edge of the umbrella is not tried from there.
  struct End {
    bool tried;
    long double theta, rho;
  };
  End end(int32_t p, int32_t q) const { return {!in_umbrella(p, q), theta(p, q), rho(p, q)}; }

  // Definition 4, of an edge that the Ratio condition selects: |pq| >= eps^(1/4) mu, mu the least
  // radius of the balls at the facet's vertices, eps = R / mu by the radius that was compared.
  bool in_limit_set(const Edge& pq, bool both) const {
    long double mu = HUGE_VALL;
    for (const int32_t c : ring(pq)) mu = std::min(mu, radius(c));
    const auto [p, q] = pq;
    const long double at_p = in_umbrella(p, q) ? HUGE_VALL : umbrella_radius(p);
    const long double at_q = in_umbrella(q, p) ? HUGE_VALL : umbrella_radius(q);
    const long double compared = both ? std::max(at_p, at_q) : std::min(at_p, at_q);
    return size(p, q) >= std::pow(compared / mu, 0.25L) * mu;
  }

 private:
  struct Centre {
    Exact xyz;
    Integer w;  // above 0
  };
  struct Pole {
    Exact exact;  // in any length; for a bounded cell
    Real vector;
    bool infinite = false, settled = true;
  };

  static bool has(const Ids& ids, int32_t id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  }
  static Real real(const std::pair<Exact, Integer>& fraction) {
    return (1 / static_cast<long double>(fraction.second)) * to<long double>(fraction.first);
  }

  void add_cell(const Ids& cell) {
    const auto id = static_cast<int32_t>(cells_.size());
    cells_.push_back(cell);
    const auto d = to<Integer>(points_[cell[3]]);
    const auto u = to<Integer>(points_[cell[0]]) - d, v = to<Integer>(points_[cell[1]]) - d,
               w = to<Integer>(points_[cell[2]]) - d;
    const Exact numerator =
        dot(u, u) * cross(v, w) + dot(v, v) * cross(w, u) + dot(w, w) * cross(u, v);
    const Integer twice = 2 * dot(u, cross(v, w)), sign = twice > 0 ? 1 : -1;
    centres_.push_back({sign * numerator + Integer(sign * twice) * d, sign * twice});
    for (const int32_t corner : cell) {
      Ids triangle = cell;
      triangle.erase(std::find(triangle.begin(), triangle.end(), corner));
      cells_at_[triangle].push_back(id);
    }
  }
  // The outward normal of each triangle of the hull: where its Voronoi ray leads.
  void find_rays() {
    for (const auto& [triangle, cells] : cells_at_) {
      if (cells.size() != 1) continue;
      const GridPoint n = normal_of(triangle[0], triangle[1], triangle[2]);
      const bool outward = side_of(triangle, apex(cells[0], triangle)) < 0;
      rays_[triangle] = outward ? n : GridPoint{-n.x, -n.y, -n.z};
    }
  }
  int32_t apex(int32_t cell, const Ids& triangle) const {
    for (const int32_t corner : cells_[cell]) {
      if (!has(triangle, corner)) return corner;
    }
    return -1;
  }
  int side_of(const Ids& triangle, int32_t q) const {
    const Wide value =
        orientation(points_[triangle[0]], points_[triangle[1]], points_[triangle[2]], points_[q]);
    // orientation() is positive where q sees the corners clockwise: below their normal.
    return value > 0 ? -1 : value < 0 ? 1 : 0;
  }
  GridPoint normal_of(int32_t a, int32_t b, int32_t c) const {
    return cross(points_[b] - points_[a], points_[c] - points_[a]);
  }
  bool same_centre(int32_t c, int32_t d) const {
    const Centre &a = centres_[c], &b = centres_[d];
    return b.w * a.xyz == a.w * b.xyz;
  }
  // From a sample to a Voronoi vertex: numerator and denominator.
  std::pair<Exact, Integer> arm(int32_t p, int32_t cell) const {
    const Centre& c = centres_[cell];
    return {c.xyz - c.w * to<Integer>(points_[p]), c.w};
  }

  // Definition 1. The rays of one infinite edge, which cocircular triangles of the hull share,
  // count once.
  void find_pole(int32_t p) {
    std::vector<std::pair<int32_t, Exact>> rays;
    for (const auto& [triangle, normal] : rays_) {
      if (!has(triangle, p)) continue;
      const int32_t cell = cells_at_[triangle][0];
      const auto n = to<Integer>(normal);
      const bool known = std::any_of(rays.begin(), rays.end(), [&](const auto& other) {
        return same_centre(cell, other.first) && cross(n, other.second) == Exact{0, 0, 0};
      });
      if (!known) rays.push_back({cell, n});
    }
    rays.empty() ? take_farthest(p) : take_mean(p, rays);
  }
  void take_mean(int32_t p, const std::vector<std::pair<int32_t, Exact>>& rays) {
    Real mean{0, 0, 0};
    for (const auto& [cell, n] : rays) {
      mean = mean + (1.0L / static_cast<long double>(rays.size())) * unit(to<long double>(n));
    }
    poles_[p] = {{}, mean, true, length(mean) > kNear};
  }
  void take_farthest(int32_t p) {
    int32_t farthest = -1;
    long double largest = 0, second = 0;
    for (size_t c = 0; c < cells_.size(); ++c) {
      const auto cell = static_cast<int32_t>(c);
      if (!has(cells_[c], p) || (farthest >= 0 && same_centre(cell, farthest))) continue;
      const long double away = length(real(arm(p, cell)));
      second = std::max(second, std::min(away, largest));
      if (away > largest) largest = away, farthest = cell;
    }
    poles_[p] = {arm(p, farthest).first, unit_ * real(arm(p, farthest)), false,
                 second < (1 - kNear) * largest};
  }

  // On which side of the plane through p normal to the pole vector; 1: above, -1: below, 0: in it.
  int side_of_plane(int32_t p, const Exact& towards) {
    Pole& pole = poles_[p];
    const Real direction = to<long double>(towards);
    long double height = dot(unit(direction), pole.vector) / length(pole.vector);
    if (!pole.infinite && dot(towards, pole.exact) == 0) height = 0;
    if (std::abs(height) < kNear && !(height == 0 && symmetric_)) pole.settled = false;
    return height > 0 ? 1 : height < 0 ? -1 : 0;
  }
  // Definition 3. A Voronoi vertex in the plane counts as above it; a ray along it does not cross.
  void find_umbrella(int32_t p) {
    for (const auto& [triangle, cells] : cells_at_) {
      if (!has(triangle, p)) continue;
      std::array<int, 2> ends{};
      for (size_t i = 0; i < cells.size(); ++i) {
        const Exact towards = arm(p, cells[i]).first;
        // The centre of a ball is no sample.
        ends[i] = side_of_plane(p, towards) < 0 ? -1 : 1;
      }
      if (cells.size() == 1) ends[1] = side_of_plane(p, to<Integer>(rays_[triangle]));
      if (ends[0] * ends[1] >= 0) continue;
      Ids link = triangle;
      link.erase(std::find(link.begin(), link.end(), p));
      umbrellas_[p].insert({link[0], link[1]});
    }
  }

  std::vector<GridPoint> points_;
  long double unit_;
  bool symmetric_;
  std::vector<Ids> cells_;
  std::vector<Centre> centres_;
  std::map<Ids, Ids> cells_at_;  // of each triangle
  std::map<Ids, GridPoint> rays_;
  std::vector<Pole> poles_;
  std::vector<std::set<Edge>> umbrellas_;
};

// ---- Inside and outside ----------------------------------------------------------------------

// Sum of the solid angles of all triangles, in full turns (van Oosterom & Strackee 1983).
inline long double turns(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                         const Real& query) {
  long double sum = 0;
  const auto arm = [&](int32_t v) {
    return Real{vertices[v].x, vertices[v].y, vertices[v].z} - query;
  };
  for (const auto& [i, j, k] : triangles) {
    const Real a = arm(i), b = arm(j), c = arm(k);
    const long double la = length(a), lb = length(b), lc = length(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)),
                          la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4 * std::numbers::pi_v<long double>);
}

}  // namespace medial::test
