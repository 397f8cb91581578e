#include "sides.h"

#include "circumcentre.h"
#include "facet_set.h"
#include "winding_number.h"

namespace medial {
namespace {

// The neighbour, of the cells from `begin` on that come before this one, whose Voronoi vertex is
// nearest; -1: none.
int32_t nearest_decided(int32_t cell, int64_t begin, const Triangulation& t,
                        const Voronoi& voronoi) {
  int32_t nearest = -1;
  double least = HUGE_VAL;
  for (const int32_t n : t.neighbors[cell]) {
    if (n < begin || n >= cell) continue;
    const double d = squared_length(voronoi.centre[n] - voronoi.centre[cell]);
    if (d < least) {
      least = d;
      nearest = n;
    }
  }
  return nearest;
}

// One Voronoi vertex, one side.
void share_sides(const Triangulation& t, const Voronoi& voronoi, CellSides& sides, const Run& run) {
  parallel_for(t.finite_cells, {run.threads, nullptr}, [&](int64_t c) {
    if (voronoi.vertex[c] != c) sides[c] = sides[voronoi.vertex[c]];
  });
}

bool is_beyond(std::span<const Vec3> points, const Triangulation& t, const Facet& f,
               const Vec3& x) {
  const auto [i, j, k] = corners(t, f);
  return dot(cross(points[j] - points[i], points[k] - points[i]), x - points[i]) < 0;
}

// The cell that contains a point, or an infinite one; found by walking towards it. In exact
// arithmetic the walk ends; rounding may turn it in a circle about flat cells, until it meets a
// cell again that it remembers.
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

// How far, squared, a point of a triangle may lie from the nearest corner: the circumradius, but no
// more than a third of the longest edge squared, also of needles.
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

// The least distance, squared, of the Voronoi edge dual to a facet to the samples. A triangle of
// samples that crosses the edge reaches at least as far from its corners.
double distance_to_samples(std::span<const Vec3> points, const Triangulation& t,
                           const Voronoi& voronoi, const Facet& f) {
  const auto [i, j, k] = corners(t, f);
  const Vec3 normal = cross(points[j] - points[i], points[k] - points[i]);
  const Vec3 a = voronoi.centre[f.cell] - points[i];
  const Vec3 b = voronoi.centre[t.neighbors[f.cell][f.slot]] - points[i];
  if ((dot(normal, a) > 0) == (dot(normal, b) > 0)) {
    return std::min(squared_length(a), squared_length(b));
  }
  return squared_circumradius(points[i], points[j], points[k]);
}

// A neighbour that comes before a cell, from `begin` on, with nothing between their Voronoi
// vertices that reaches no farther than `widest`; -1: none. `known` tells which neighbours are
// decided.
template <typename Known>
int32_t clear_neighbour(int32_t cell, int64_t begin, double widest, std::span<const Vec3> points,
                        const Triangulation& t, const Voronoi& voronoi, const Known& known) {
  const double ball = squared_length(voronoi.centre[cell] - points[t.cells[cell][0]]);
  for (int i = 0; i < 4 && ball > widest; ++i) {
    const int32_t n = t.neighbors[cell][i];
    if (n < begin || n >= cell || !known(n)) continue;
    if (distance_to_samples(points, t, voronoi, {cell, i}) > widest) return n;
  }
  return -1;
}

// Beyond the rounding of Voronoi vertices.
double widened(double squared) { return (1 + 16 * kCoarsestError) * squared; }

// The samples that are lowest and highest along each axis.
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
                             const Surface& surface, const Triangulation& t, const Voronoi& voronoi,
                             const Run& run) {
  begin_stage(run.progress, "Inside and outside", 0.9, 0.99);
  const WindingNumber winding(vertices, surface.triangles, surface.boundary, run.progress);
  const bool of_samples = vertices.data() == points.data() && surface.closed();
  const double widest =
      of_samples ? widened(largest_squared_reach(points, surface.triangles, run)) : HUGE_VAL;
  CellSides sides(t.cells.size(), static_cast<uint8_t>(Side::outer));
  // Along a Voronoi edge there is nothing to cross, or little: most vertices are told from a
  // neighbour of the same chunk.
  parallel_chunks(t.finite_cells, run, [&](int64_t begin, int64_t end, int) {
    std::vector<int> closed;
    const auto told = [&](int32_t c) {
      const int32_t like =
          clear_neighbour(c, begin, widest, points, t, voronoi, [](int32_t) { return true; });
      if (like >= 0) return closed[like - begin];
      const Vec3& here = voronoi.centre[c];
      const int32_t known = nearest_decided(c, begin, t, voronoi);
      if (known < 0) return winding.closed(here);
      return winding.closed_from(voronoi.centre[known], closed[known - begin], here);
    };
    for (auto c = static_cast<int32_t>(begin); c < end; ++c) {
      closed.push_back(told(c));
      if (winding.is_inside(voronoi.centre[c], closed.back())) {
        sides[c] = static_cast<uint8_t>(Side::inner);
      }
    }
  });
  share_sides(t, voronoi, sides, run);
  return sides;
}

CellSides sides_from_normals(std::span<const Vec3> points, std::span<const Vec3> normals,
                             const Triangulation& t, const Voronoi& voronoi, const Run& run) {
  begin_stage(run.progress, "Inside and outside", 0.9, 0.99);
  CellSides sides(t.cells.size(), static_cast<uint8_t>(Side::outer));
  const auto samples = static_cast<int32_t>(normals.size());
  const auto [x, y, z] = extremes(points.first(normals.size()));
  const Vec3 low{points[x[0]].x, points[y[0]].y, points[z[0]].z};
  const Vec3 high{points[x[1]].x, points[y[1]].y, points[z[1]].z};
  const double outward = normals[x[1]].x - normals[x[0]].x + normals[y[1]].y - normals[y[0]].y +
                         normals[z[1]].z - normals[z[0]].z;
  const auto beyond = static_cast<uint8_t>(outward < 0 ? Side::inner : Side::outer);
  parallel_for(t.finite_cells, run, [&](int64_t c) {
    // Through an opening far vertices see the samples from behind: beyond the samples all is one
    // side.
    if (!is_between(voronoi.centre[c], low, high)) {
      sides[c] = beyond;
      return;
    }
    double vote = 0;
    for (const int32_t p : t.cells[c]) {
      if (p < samples) vote += dot(normals[p], normalized(voronoi.centre[c] - points[p]));
    }
    if (vote < 0) sides[c] = static_cast<uint8_t>(Side::inner);
  });
  share_sides(t, voronoi, sides, run);
  return sides;
}

CellSides sides_in_solid(std::span<const Vec3> points, const CellSides& solid,
                         std::span<const Triangle> boundary, const Triangulation& t,
                         const Voronoi& voronoi, const Run& run) {
  const auto inner = static_cast<uint8_t>(Side::inner);
  const double widest = widened(largest_squared_reach(points, boundary, run));
  CellSides sides(solid);
  parallel_chunks(t.finite_cells, run, [&](int64_t begin, int64_t end, int) {
    int32_t last = -1;  // where the last walk ended: near, for cells are in spatial order
    for (auto c = static_cast<int32_t>(begin); c < end; ++c) {
      if (solid[c] != inner) continue;
      const int32_t like = clear_neighbour(c, begin, widest, points, t, voronoi,
                                           [&](int32_t n) { return solid[n] == inner; });
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
  for (const int32_t cell : ring) inner += sides[cell] == static_cast<uint8_t>(Side::inner);
  return inner == ring.size() ? Side::inner : inner == 0 ? Side::outer : Side::crossing;
}

}  // namespace medial
