// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/polygon_triangles.h"

#include <medial/errors.h>

#include <climits>
#include <cmath>
#include <optional>
#include <string>

#include "base/cgal.h"
#include "base/insertion_order.h"
#include "base/polygon_edges.h"
#include "base/rows.h"
#include "base/text.h"
// clang-format off: CGAL's headers come after what sets CGAL up.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
// clang-format on

namespace medial {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = Kernel::Point_2;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int32_t, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<
    Kernel, CGAL::Triangulation_face_base_with_info_2<int32_t, Kernel>>;
using Plane = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

using Ring = std::vector<int32_t>;  // places of corners in the polygon

// More corners would take too long, because the time grows with their cube.
constexpr size_t kMostForLeastArea = 64;
// The weight of a squared length relative to an area: above rounding, and below all that counts.
constexpr double kShortDiagonals = 1e-13;  // derived: rounding
// One way of cutting a quad is better if its area is at most this share of that of the other way.
constexpr double kClearlyLess = 0.75;  // chosen: unseen

bool is_finite(const Vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void require_finite_corners(std::span<const Vec3> points, std::span<const int32_t> corners) {
  for (const int32_t corner : corners) {
    if (is_finite(points[corner])) continue;
    throw InvalidInputError("Expected finite coordinates, found " + text(points[corner]) +
                            " in row " + std::to_string(corner) +
                            "; repair or remove this vertex.");
  }
}

// Returns whether the differences of corners are finite, too; otherwise the polygon has no region.
bool has_an_extent(std::span<const Vec3> corners) {
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Vec3& p) { return is_finite(p - corners[0]); });
}

// Returns the corners relative to the first one, in a unit in which no coordinate exceeds 2. The
// unit is a power of two, so only the shift rounds.
std::vector<Vec3> around_origin(std::span<const Vec3> corners, int& exponent) {
  double extent = 0;
  for (const Vec3& p : corners) extent = std::max(extent, max_abs(p - corners[0]));
  exponent = extent > 0 ? std::ilogb(extent) : 0;
  std::vector<Vec3> result;
  result.reserve(corners.size());
  for (const Vec3& p : corners) {
    const Vec3 d = p - corners[0];
    result.push_back(
        {std::scalbn(d.x, -exponent), std::scalbn(d.y, -exponent), std::scalbn(d.z, -exponent)});
  }
  return result;
}

// Projects the corners along the axis nearest to the normal; their coordinates stay exact. The
// sense of rotation is kept.
std::vector<Point2> flattened(std::span<const Vec3> corners) {
  int exponent = 0;
  const auto around = around_origin(corners, exponent);
  Vec3 normal;
  for (size_t i = 2; i < around.size(); ++i) normal = normal + cross(around[i - 1], around[i]);
  const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  std::vector<Point2> result;
  result.reserve(corners.size());
  for (const Vec3& p : corners) {
    const double x = std::scalbn(p.x, -exponent), y = std::scalbn(p.y, -exponent),
                 z = std::scalbn(p.z, -exponent);
    if (size.z >= size.x && size.z >= size.y) {
      result.emplace_back(x, y);
    } else if (size.x >= size.y) {
      result.emplace_back(y, z);
    } else {
      result.emplace_back(z, x);
    }
  }
  return result;
}

// Makes one place of all corners of a polygon that coincide in the plane.
struct Places {
  explicit Places(std::span<const Point2> points) : of_corner(points.size()) {
    std::vector<int32_t> order = all_rows(points.size());
    std::sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
      return points[a] != points[b] ? points[a] < points[b] : a < b;
    });
    for (const int32_t corner : order) {
      if (corners.empty() || points[corners.back()] != points[corner]) corners.push_back(corner);
      of_corner[corner] = static_cast<int32_t>(corners.size()) - 1;
    }
  }

  Ring of_corner;
  Ring corners;  // the first corner at each place
};

// Cuts off, one after the other, corners at the place of their neighbour, and tips of spikes whose
// neighbours are at one place. The rest can bound a region. The cut triangles have no area.
Ring without_spikes(const Places& places, std::vector<Triangle>& cut) {
  Ring ring;
  const auto same = [&](int32_t a, int32_t b) {
    return places.of_corner[a] == places.of_corner[b];
  };
  const auto cut_last = [&](int32_t next) {
    cut.push_back({ring[ring.size() - 2], ring.back(), next});
    ring.pop_back();
  };
  for (int32_t corner = 0; corner < static_cast<int32_t>(places.of_corner.size()); ++corner) {
    while (ring.size() >= 2 && (same(ring.back(), corner) || same(ring[ring.size() - 2], corner))) {
      cut_last(corner);
    }
    ring.push_back(corner);
  }
  // The loop does the same where the ring closes.
  size_t first = 0;
  while (ring.size() - first > 3) {
    if (same(ring.back(), ring[first]) || same(ring[ring.size() - 2], ring[first])) {
      cut_last(ring[first]);
    } else if (same(ring[first], ring[first + 1]) || same(ring.back(), ring[first + 1])) {
      cut.push_back({ring.back(), ring[first], ring[first + 1]});
      ++first;
    } else {
      break;
    }
  }
  ring.erase(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(first));
  return ring;
}

// Counts how often a polygon runs along each of its edges, minus how often it runs back.
class Runs {
 public:
  Runs(const Ring& ring, const Places& places) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const int32_t from = places.of_corner[ring[i]];
      const int32_t to = places.of_corner[ring[(i + 1) % ring.size()]];
      all_.push_back({{std::min(from, to), std::max(from, to)}, from < to ? 1 : -1});
    }
    std::sort(all_.begin(), all_.end());
    size_t count = 0;
    for (const auto& run : all_) {
      if (count > 0 && all_[count - 1].first == run.first) {
        all_[count - 1].second += run.second;
      } else {
        all_[count++] = run;
      }
    }
    all_.resize(count);
  }

  size_t edges() const { return all_.size(); }

  // Returns the count from one place to the other, or nothing if that is not an edge.
  std::optional<int> along(int32_t from, int32_t to) const {
    const Edge edge{std::min(from, to), std::max(from, to)};
    const auto found =
        std::lower_bound(all_.begin(), all_.end(), edge,
                         [](const auto& run, const Edge& wanted) { return run.first < wanted; });
    if (found == all_.end() || found->first != edge) return std::nullopt;
    return from < to ? found->second : -found->second;
  }

 private:
  std::vector<std::pair<Edge, int>> all_;
};

// Returns the corners in an order in which insertion is fast: three that are not collinear, because
// CGAL searches collinear points one by one, then all in rounds along the ring, in which neighbours
// are close to each other. Returns nothing if all are on one line. (CGAL's own order depends on the
// C++ library, and with it the triangles of corners on one circle.)
std::vector<int32_t> corners_in_order(std::span<const Point2> points, const Ring& ring) {
  const auto off = std::find_if(ring.begin() + 2, ring.end(), [&](int32_t corner) {
    return !CGAL::collinear(points[ring[0]], points[ring[1]], points[corner]);
  });
  if (off == ring.end()) return {};
  std::vector<int32_t> order{ring[0], ring[1], *off};
  for (const int32_t i : insertion_order(static_cast<int32_t>(ring.size()))) {
    order.push_back(ring[i]);
  }
  return order;
}

// Returns the triangulation of all places, constrained to the edges of the polygon; its dimension
// is below 2 if all places are on one line. Throws CGAL's exception if edges cross.
Plane triangulated(std::span<const Point2> points, const Ring& ring, const Places& places) {
  Plane plane;
  std::vector<Plane::Vertex_handle> vertices(places.corners.size());
  Plane::Face_handle near;
  for (const int32_t corner : corners_in_order(points, ring)) {
    const int32_t place = places.of_corner[corner];
    if (vertices[place] != Plane::Vertex_handle()) continue;
    vertices[place] = plane.insert(points[corner], near);
    vertices[place]->info() = place;
    near = vertices[place]->face();
  }
  if (plane.dimension() < 2) return plane;
  for (size_t i = 0; i < ring.size(); ++i) {
    plane.insert_constraint(vertices[places.of_corner[ring[i]]],
                            vertices[places.of_corner[ring[(i + 1) % ring.size()]]]);
  }
  return plane;
}

// Stores in each face how often the polygon winds around it. Returns false if a constrained edge is
// only a part of an edge of the polygon, because another corner is on that edge.
bool wind(Plane& plane, const Runs& runs) {
  for (const auto face : plane.all_face_handles()) face->info() = INT_MAX;
  std::vector<Plane::Face_handle> reached{plane.infinite_face()};
  reached.back()->info() = 0;
  size_t constrained = 0;
  while (!reached.empty()) {
    const auto face = reached.back();
    reached.pop_back();
    for (int i = 0; i < 3; ++i) {
      int crossed = 0;
      if (face->is_constrained(i)) {
        const auto run =
            runs.along(face->vertex(Plane::ccw(i))->info(), face->vertex(Plane::cw(i))->info());
        if (!run) return false;
        crossed = *run;
        ++constrained;  // once from each side
      }
      const auto next = face->neighbor(i);
      if (next->info() != INT_MAX) continue;
      next->info() = face->info() - crossed;
      reached.push_back(next);
    }
  }
  return constrained == 2 * runs.edges();
}

// Returns a corner of the ring for each place, or nothing if corners at one place differ in space.
std::optional<Ring> corner_at_place(std::span<const Vec3> corners, const Ring& ring,
                                    const Places& places) {
  Ring result(places.corners.size(), -1);
  for (const int32_t corner : ring) {
    int32_t& first = result[places.of_corner[corner]];
    if (first < 0) first = corner;
    if (corners[first] != corners[corner]) return std::nullopt;
  }
  return result;
}

// Returns the triangles of the region that a polygon bounds, or nothing if it crosses itself,
// touches itself so that its edges are split, or winds around a part more than once.
std::optional<std::vector<Triangle>> region(std::span<const Vec3> corners,
                                            std::span<const Point2> points, const Ring& ring,
                                            const Places& places) {
  if (ring.size() < 3) return std::nullopt;
  const auto corner = corner_at_place(corners, ring, places);
  if (!corner) return std::nullopt;
  std::vector<Triangle> result;
  try {
    Plane plane = triangulated(points, ring, places);
    if (plane.dimension() < 2 || !wind(plane, Runs(ring, places))) return std::nullopt;
    for (const auto face : plane.finite_face_handles()) {
      if (face->info() == 0) continue;
      if (std::abs(face->info()) > 1) return std::nullopt;
      Triangle t{};
      for (int i = 0; i < 3; ++i) t[i] = (*corner)[face->vertex(i)->info()];
      if (face->info() < 0) std::swap(t[1], t[2]);
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      result.push_back(t);
    }
  } catch (const Plane::Intersection_of_constraints_exception&) {
    return std::nullopt;
  }
  if (result.size() + 2 != ring.size()) return std::nullopt;
  std::sort(result.begin(), result.end());
  return result;
}

void cut_every_other_corner(Ring ring, std::vector<Triangle>& cut) {
  while (ring.size() >= 3) {
    size_t kept = 0;
    for (size_t i = 0; i < ring.size(); i += 2) {
      if (i + 1 < ring.size()) cut.push_back({ring[i], ring[i + 1], ring[(i + 2) % ring.size()]});
      ring[kept++] = ring[i];
    }
    ring.resize(kept);
  }
}

double doubled_area(const Point2& p, const Point2& q, const Point2& r) {
  return std::abs((q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x()));
}

double squared(const Point2& p, const Point2& q) {
  return (q.x() - p.x()) * (q.x() - p.x()) + (q.y() - p.y()) * (q.y() - p.y());
}

// Cuts a ring such that the areas of all triangles have the least sum. If the ring bounds a region,
// though it touches itself or crosses itself by rounding, this sum is the area of the region. Of
// equal sums the one with short diagonals is taken.
class LeastArea {
 public:
  LeastArea(std::span<const Point2> points, const Ring& ring)
      : points_(points), ring_(ring), size_(static_cast<int32_t>(ring.size())) {
    best_.resize(ring.size() * ring.size());
    for (int32_t length = 2; length < size_; ++length) {
      for (int32_t i = 0; i + length < size_; ++i) best_at(i, i + length) = best(i, i + length);
    }
  }

  void cut(std::vector<Triangle>& triangles) const { cut(0, size_ - 1, triangles); }

 private:
  struct Best {
    double cost = 0;
    int32_t tip = -1;
  };

  Best& best_at(int32_t i, int32_t j) { return best_[static_cast<size_t>(i) * ring_.size() + j]; }
  const Best& best_at(int32_t i, int32_t j) const {
    return best_[static_cast<size_t>(i) * ring_.size() + j];
  }

  // Returns how the part of the ring between two of its corners is cut best.
  Best best(int32_t i, int32_t j) const {
    const Point2 &p = points_[ring_[i]], &q = points_[ring_[j]];
    Best found{HUGE_VAL, -1};
    for (int32_t tip = i + 1; tip < j; ++tip) {
      const double cost =
          best_at(i, tip).cost + best_at(tip, j).cost + doubled_area(p, points_[ring_[tip]], q);
      if (cost < found.cost) found = {cost, tip};
    }
    found.cost += kShortDiagonals * squared(p, q);
    return found;
  }

  void cut(int32_t i, int32_t j, std::vector<Triangle>& triangles) const {
    if (j - i < 2) return;
    const int32_t tip = best_at(i, j).tip;
    triangles.push_back({ring_[i], ring_[tip], ring_[j]});
    cut(i, tip, triangles);
    cut(tip, j, triangles);
  }

  std::span<const Point2> points_;
  const Ring& ring_;
  int32_t size_;
  std::vector<Best> best_;  // per first corner and last corner of a part
};

// Returns whether a quad is cut from its first corner to its third. Where it is not convex there,
// it is cut the other way; where it is convex nowhere, the way with less area is taken. Rounding
// must not decide this.
bool is_cut_at_first_diagonal(std::span<const Vec3> corners) {
  int exponent = 0;
  const auto p = around_origin(corners, exponent);
  const Vec3 a = cross(p[1], p[2]), b = cross(p[3], p[2]);
  if (!(dot(a, b) > 0)) return true;
  const Vec3 c = cross(p[1], p[3]), d = cross(p[2] - p[1], p[3] - p[1]);
  if (dot(c, d) > 0) return false;
  return length(a) + length(b) <= kClearlyLess * (length(c) + length(d));
}

// Returns triangles of places in the polygon.
std::vector<Triangle> triangles_of(std::span<const Vec3> corners) {
  if (corners.size() == 3) return {{0, 1, 2}};
  if (corners.size() == 4) {
    if (has_an_extent(corners) && is_cut_at_first_diagonal(corners)) return {{0, 1, 2}, {0, 2, 3}};
    return {{0, 1, 3}, {1, 2, 3}};
  }
  std::vector<Triangle> cut;
  if (!has_an_extent(corners)) {
    std::vector<int32_t> ring = all_rows(corners.size());
    cut_every_other_corner(std::move(ring), cut);
    return cut;
  }
  const auto points = flattened(corners);
  const Places places(points);
  const Ring ring = without_spikes(places, cut);
  if (const auto inside = region(corners, points, ring, places)) {
    cut.insert(cut.end(), inside->begin(), inside->end());
  } else if (ring.size() <= kMostForLeastArea) {
    LeastArea(points, ring).cut(cut);
  } else {
    cut_every_other_corner(ring, cut);
  }
  return cut;
}

}  // namespace

std::vector<Triangle> polygon_triangles(std::span<const Vec3> points,
                                        std::span<const int32_t> face_offsets,
                                        std::span<const int32_t> face_vertices, const Run& run) {
  require_polygons(face_offsets, face_vertices, static_cast<int32_t>(points.size()));
  const auto faces = static_cast<int64_t>(face_offsets.size()) - 1;
  for (int64_t face = 0; face < faces; ++face) {
    if (face_offsets[face + 1] - face_offsets[face] >= 3) continue;
    throw InvalidInputError("Expected polygons of three corners or more, found one of " +
                            std::to_string(face_offsets[face + 1] - face_offsets[face]) +
                            "; leave it out.");
  }
  require_finite_corners(points, face_vertices);
  std::vector<Triangle> result(face_vertices.size() - 2 * static_cast<size_t>(faces));
  parallel_chunks(
      faces, run,
      [&](int64_t begin, int64_t end, int) {
        std::vector<Vec3> corners;
        for (int64_t face = begin; face < end; ++face) {
          const int32_t first = face_offsets[face];
          corners.clear();
          for (int32_t c = first; c < face_offsets[face + 1]; ++c) {
            corners.push_back(points[face_vertices[c]]);
          }
          auto place = result.begin() + (first - 2 * face);
          for (Triangle t : triangles_of(corners)) {
            for (int32_t& corner : t) corner = face_vertices[first + corner];
            *place++ = t;
          }
        }
      },
      64);
  return result;
}

}  // namespace medial
