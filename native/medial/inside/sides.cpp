// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/sides.h"

#include <climits>

#include "delaunay/circumcentre.h"
#include "delaunay/face_set.h"

namespace medial {
namespace {

constexpr int64_t kFlooded = 1 << 15;  // cells that one flood may reach

// Gives all cells with the same Voronoi vertex the same side.
void share_sides(const Triangulation& t, const Voronoi& voronoi, CellSides& sides, const Run& run) {
  parallel_for(t.finite_cells, {run.threads, nullptr}, [&](int64_t c) {
    if (voronoi.vertex[c] != c) sides[c] = sides[voronoi.vertex[c]];
  });
}

bool is_beyond(std::span<const Vec3> points, const Triangulation& t, const CellFace& f,
               const Vec3& x) {
  const auto [i, j, k] = corners(t, f);
  return dot(cross(points[j] - points[i], points[k] - points[i]), x - points[i]) < 0;
}

// Returns the cell that contains a point, or an infinite one, by walking towards the point. In
// exact arithmetic the walk ends; rounding may lead it in a circle around flat cells, until it
// returns to a remembered cell.
int32_t cell_of(std::span<const Vec3> points, const Vec3& x, int32_t from, const Triangulation& t) {
  int32_t cell = from, last = from, remembered = -1;
  for (int64_t steps = 0; cell != remembered && !t.is_infinite(cell); ++steps) {
    if ((steps & (steps - 1)) == 0) remembered = cell;  // at the powers of two
    int i = 0;
    while (i < 4 && (t.neighbors[cell][i] == last || !is_beyond(points, t, {cell, i}, x))) ++i;
    if (i == 4) break;
    last = cell;
    cell = t.neighbors[cell][i];
  }
  return cell;
}

// Returns the square of the largest distance of a point of a triangle from the nearest corner: the
// squared circumradius, but at most a third of the longest edge squared, which also bounds needles.
double squared_reach(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest =
      std::max({squared_length(b - a), squared_length(c - b), squared_length(a - c)});
  const double circumradius = squared_circumradius(a, b, c);
  return circumradius < longest / 3 ? circumradius : longest / 3;
}

double largest_squared_reach(std::span<const Vec3> points, std::span<const Triangle> triangles,
                             const Run& run) {
  std::vector<double> largest(run.threads, 0);
  parallel_chunks(static_cast<int64_t>(triangles.size()), run,
                  [&](int64_t begin, int64_t end, int worker) {
                    for (int64_t i = begin; i < end; ++i) {
                      const auto [p, q, r] = triangles[i];
                      largest[worker] =
                          std::max(largest[worker], squared_reach(points[p], points[q], points[r]));
                    }
                  });
  return *std::max_element(largest.begin(), largest.end());
}

// Returns the square of the least distance between the samples and the Voronoi edge dual to a
// Delaunay triangle. A triangle of samples that crosses the edge reaches at least as far from its
// corners.
double distance_to_samples(std::span<const Vec3> points, const Triangulation& t,
                           const Voronoi& voronoi, const CellFace& f) {
  const auto [i, j, k] = corners(t, f);
  const Vec3 normal = cross(points[j] - points[i], points[k] - points[i]);
  const Vec3 a = voronoi.centre[f.cell] - points[i];
  const Vec3 b = voronoi.centre[t.neighbors[f.cell][f.slot]] - points[i];
  if ((dot(normal, a) > 0) == (dot(normal, b) > 0)) {
    return std::min(squared_length(a), squared_length(b));
  }
  return squared_circumradius(points[i], points[j], points[k]);
}

// Returns whether no triangle whose reach is at most `widest` is between the Voronoi vertices of a
// cell and its neighbour.
bool is_clear(std::span<const Vec3> points, const Triangulation& t, const Voronoi& voronoi,
              const CellFace& f, double widest) {
  const double ball = squared_length(voronoi.centre[f.cell] - points[t.cells[f.cell][0]]);
  return ball > widest && distance_to_samples(points, t, voronoi, f) > widest;
}

// Computes the winding numbers of a closed soup at Voronoi vertices, one from another.
class Flood {
 public:
  Flood(std::span<const Vec3> points, const Triangulation& t, const Voronoi& voronoi,
        const WindingNumber& winding, double widest)
      : points_(points), t_(t), voronoi_(voronoi), winding_(winding), widest_(widest) {}

  // Returns the winding numbers for the cells begin .. end - 1.
  std::span<const int> operator()(int32_t begin, int32_t end) {
    begin_ = begin;
    closed_.assign(static_cast<size_t>(end - begin), kUnknown);
    for (int32_t c = begin; c < end; ++c) {
      if (at(c) != kUnknown) continue;
      at(c) = told(c);
      spread(c);
    }
    return closed_;
  }

 private:
  static constexpr int kUnknown = INT_MIN;

  int& at(int32_t cell) { return closed_[static_cast<size_t>(cell - begin_)]; }
  bool has(int32_t cell) const {
    return cell >= begin_ && cell < begin_ + static_cast<int32_t>(closed_.size());
  }

  // Computes the winding number from the neighbour whose Voronoi vertex is nearest, because the
  // fewest triangles are in between; or by itself if no neighbour is known.
  int told(int32_t cell) {
    int32_t nearest = -1;
    double least = HUGE_VAL;
    for (const int32_t n : t_.neighbors[cell]) {
      if (!has(n) || at(n) == kUnknown) continue;
      const double d = squared_length(voronoi_.centre[n] - voronoi_.centre[cell]);
      if (d < least) least = d, nearest = n;
    }
    const Vec3& here = voronoi_.centre[cell];
    if (nearest < 0) return winding_.closed(here);
    return winding_.closed_from(voronoi_.centre[nearest], at(nearest), here);
  }

  // Spreads the winding number to all cells that nothing separates from this one.
  void spread(int32_t cell) {
    ahead_.assign(1, cell);
    while (!ahead_.empty()) {
      const int32_t c = ahead_.back();
      ahead_.pop_back();
      for (int i = 0; i < 4; ++i) {
        const int32_t n = t_.neighbors[c][i];
        if (!has(n) || at(n) != kUnknown) continue;
        if (!is_clear(points_, t_, voronoi_, {c, i}, widest_)) continue;
        at(n) = at(c);
        ahead_.push_back(n);
      }
    }
  }

  std::span<const Vec3> points_;
  const Triangulation& t_;
  const Voronoi& voronoi_;
  const WindingNumber& winding_;
  double widest_;
  int32_t begin_ = 0;
  std::vector<int> closed_;
  std::vector<int32_t> ahead_;
};

// Returns a bound that includes the rounding of Voronoi vertices.
double widened(double squared) { return (1 + 16 * kCoarsestError) * squared; }

// Returns the samples that are lowest and highest along each axis.
std::array<std::array<size_t, 2>, 3> extremes(std::span<const Vec3> points) {
  std::array<std::array<size_t, 2>, 3> found{};
  for (size_t p = 0; p < points.size(); ++p) {
    const auto at = [&](size_t id) { return std::array{points[id].x, points[id].y, points[id].z}; };
    for (int k = 0; k < 3; ++k) {
      auto& [low, high] = found[k];
      if (at(p)[k] < at(low)[k]) low = p;
      if (at(p)[k] > at(high)[k]) high = p;
    }
  }
  return found;
}

bool is_between(const Vec3& x, const Vec3& low, const Vec3& high) {
  return low.x <= x.x && x.x <= high.x && low.y <= x.y && x.y <= high.y && low.z <= x.z &&
         x.z <= high.z;
}

}  // namespace

CellSides sides_from_surface(std::span<const Vec3> points, std::span<const Vec3> vertices,
                             const Surface& surface, const WindingNumber& winding,
                             const Triangulation& t, const Voronoi& voronoi, const Run& run) {
  begin_stage(run.progress, "Inside and outside", 0.9, 0.99);
  const bool of_samples = vertices.data() == points.data() && surface.closed();
  const double widest =
      of_samples ? widened(largest_squared_reach(points, surface.triangles, run)) : HUGE_VAL;
  CellSides sides(t.cells.size(), Side::outer);
  const auto tell = [&](int64_t begin, int64_t end, int) {
    Flood flood(points, t, voronoi, winding, widest);
    const auto closed = flood(static_cast<int32_t>(begin), static_cast<int32_t>(end));
    for (int64_t c = begin; c < end; ++c) {
      if (winding.is_inside(voronoi.centre[c], closed[c - begin])) {
        sides[c] = Side::inner;
      }
    }
  };
  parallel_chunks(t.finite_cells, run, tell, kFlooded);
  share_sides(t, voronoi, sides, run);
  return sides;
}

CellSides sides_from_normals(std::span<const Vec3> points, std::span<const Vec3> normals,
                             const Triangulation& t, const Voronoi& voronoi, const Run& run) {
  begin_stage(run.progress, "Inside and outside", 0.9, 0.99);
  CellSides sides(t.cells.size(), Side::outer);
  const auto samples = static_cast<int32_t>(normals.size());
  const auto [x, y, z] = extremes(points.first(normals.size()));
  const Vec3 low{points[x[0]].x, points[y[0]].y, points[z[0]].z};
  const Vec3 high{points[x[1]].x, points[y[1]].y, points[z[1]].z};
  const double outward = normals[x[1]].x - normals[x[0]].x + normals[y[1]].y - normals[y[0]].y +
                         normals[z[1]].z - normals[z[0]].z;
  const Side beyond = outward < 0 ? Side::inner : Side::outer;
  parallel_for(t.finite_cells, run, [&](int64_t c) {
    // Far Voronoi vertices may see the samples from behind, through an opening. So all places
    // beyond the box of the samples are on one side.
    if (!is_between(voronoi.centre[c], low, high)) {
      sides[c] = beyond;
      return;
    }
    double vote = 0;
    for (const int32_t p : t.cells[c]) {
      if (p < samples) vote += dot(normals[p], normalized(voronoi.centre[c] - points[p]));
    }
    if (vote < 0) sides[c] = Side::inner;
  });
  share_sides(t, voronoi, sides, run);
  return sides;
}

CellSides sides_in_solid(std::span<const Vec3> points, const CellSides& solid,
                         std::span<const Triangle> boundary, const Triangulation& t,
                         const Voronoi& voronoi, const Run& run) {
  const double widest = widened(largest_squared_reach(points, boundary, run));
  CellSides sides(solid);
  parallel_chunks(t.finite_cells, run, [&](int64_t begin, int64_t end, int) {
    // Returns a neighbour whose side is decided, with no boundary between its Voronoi vertex and
    // that of the cell; or -1 if there is none.
    const auto like_neighbour = [&](int32_t c) {
      for (int i = 0; i < 4; ++i) {
        const int32_t n = t.neighbors[c][i];
        const bool decided = n >= begin && n < c && solid[n] == Side::inner;
        if (decided && is_clear(points, t, voronoi, {c, i}, widest)) return n;
      }
      return -1;
    };
    int32_t last = -1;  // the end of the last walk, which is near, as cells are in spatial order
    for (auto c = static_cast<int32_t>(begin); c < end; ++c) {
      if (solid[c] != Side::inner) continue;
      const int32_t like = like_neighbour(c);
      if (like < 0) {
        last = cell_of(points, voronoi.centre[c], last < 0 || t.is_infinite(last) ? c : last, t);
      }
      sides[c] = like < 0 ? solid[last] : sides[like];
    }
  });
  return sides;
}

Side facet_side(std::span<const int32_t> ring, const CellSides& sides) {
  if (sides.empty()) return Side::both;
  size_t inner = 0;
  for (const int32_t cell : ring) inner += sides[cell] == Side::inner;
  return inner == ring.size() ? Side::inner : inner == 0 ? Side::outer : Side::crossing;
}

}  // namespace medial
