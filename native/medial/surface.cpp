#include "surface.h"

#include <numbers>

#include "circumcentre.h"
#include "union_find.h"

namespace medial {
namespace {

// Next and previous corner seen from corner `id`.
Edge link_of(const Triangle& t, int32_t id) {
  const int i = t[0] == id ? 0 : t[1] == id ? 1 : 2;
  return {t[(i + 1) % 3], t[(i + 2) % 3]};
}

// Edges at their lower end that are not used equally often in both directions.
int64_t unbalanced_edges(int32_t id, std::span<const int32_t> fan, std::span<const Triangle> triangles,
                         std::vector<Edge>& uses) {
  uses.clear();
  for (const int32_t t : fan) {
    const auto [a, b] = link_of(triangles[t], id);
    if (a > id) uses.push_back({a, 1});   // id -> a
    if (b > id) uses.push_back({b, -1});  // b -> id
  }
  std::sort(uses.begin(), uses.end());
  int64_t unbalanced = 0;
  for (size_t i = 0; i < uses.size();) {
    int32_t balance = 0;
    const int32_t end = uses[i][0];
    for (; i < uses.size() && uses[i][0] == end; ++i) balance += uses[i][1];
    unbalanced += balance != 0;
  }
  return unbalanced;
}

// The links of the triangles form one closed, consistently directed cycle.
bool is_disc(int32_t id, std::span<const int32_t> fan, std::span<const Triangle> triangles,
             std::vector<Edge>& links) {
  links.clear();
  for (const int32_t t : fan) links.push_back(link_of(triangles[t], id));
  std::sort(links.begin(), links.end());
  for (size_t i = 1; i < links.size(); ++i) {
    if (links[i][0] == links[i - 1][0]) return false;
  }
  int32_t at = links.empty() ? -1 : links.front()[0];
  for (size_t steps = 1; steps <= links.size(); ++steps) {
    const auto next = std::lower_bound(links.begin(), links.end(), Edge{at, -1});
    if (next == links.end() || (*next)[0] != at) return false;
    at = (*next)[1];
    if (at == links.front()[0]) return steps == links.size();
  }
  return false;
}

double angle(const Vec3& a, const Vec3& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

struct Fan {
  Vec3 normal;
  double sine = 2;  // above 1: not a graph over the plane of the normal
};

Fan describe_fan(int32_t id, std::span<const int32_t> fan, std::span<const Vec3> points,
                 std::span<const Triangle> triangles) {
  Vec3 sum;
  for (const int32_t t : fan) {
    const auto [a, b] = link_of(triangles[t], id);
    const Vec3 n = unit_normal(points[id], points[a], points[b]).direction;
    sum = sum + angle(points[a] - points[id], points[b] - points[id]) * n;
  }
  Fan result{normalized(sum), 2};
  double cosine = 1, turn = 0;
  for (const int32_t t : fan) {
    const auto [a, b] = link_of(triangles[t], id);
    const Vec3 u = points[a] - points[id], v = points[b] - points[id];
    cosine = std::min(cosine, dot(unit_normal(points[id], points[a], points[b]).direction, result.normal));
    const Vec3 flat_u = u - dot(u, result.normal) * result.normal;
    turn += std::atan2(dot(result.normal, cross(u, v)), dot(flat_u, v));
  }
  const bool once = std::abs(turn - 2 * std::numbers::pi) < 1;
  if (cosine > 0 && once) result.sine = std::sqrt(1 - std::min(1.0, cosine * cosine));
  return result;
}

// A convex polygon of at most 8 corners: a triangle cut by half-spaces.
struct Polygon {
  std::array<Vec3, 8> corner;
  int count = 0;

  void push(const Vec3& p) {
    if (count < 8) corner[count++] = p;
  }
};

// The part of `polygon` that is nearer to s than to p.
Polygon nearer_part(const Polygon& polygon, const Vec3& s, const Vec3& p) {
  const Vec3 middle = 0.5 * (s + p), direction = s - p;
  Polygon part;
  for (int i = 0; i < polygon.count; ++i) {
    const Vec3 &a = polygon.corner[i], &b = polygon.corner[(i + 1) % polygon.count];
    const double ha = dot(a - middle, direction), hb = dot(b - middle, direction);
    if (ha > 0) part.push(a);
    if ((ha > 0) != (hb > 0)) part.push(a + (ha / (ha - hb)) * (b - a));
  }
  return part;
}

// Some point of the triangle is nearer to s than to each of its own corners.
bool intrudes(const Vec3& s, const std::array<Vec3, 3>& triangle) {
  const Vec3 centroid = (1.0 / 3) * (triangle[0] + triangle[1] + triangle[2]);
  double reach = 0;
  for (const Vec3& p : triangle) reach = std::max(reach, squared_length(p - centroid));
  if (squared_length(s - centroid) >= 4 * reach) return false;
  Polygon part;
  for (const Vec3& p : triangle) part.push(p);
  for (const Vec3& p : triangle) part = nearer_part(part, s, p);
  return part.count > 2;
}

class Intrusions {
 public:
  Intrusions(std::span<const Vec3> points, const Surface& surface, const Triangulation& t,
             const Csr<int32_t>& incident)
      : points_(points), surface_(surface), t_(t), incident_(incident), entered_(points.size(), 0) {}

  // Marks the samples whose Voronoi cells are entered by a triangle at sample `id`, if one next to `id` is.
  void mark(int32_t id, std::span<const int32_t> fan, std::vector<int32_t>& near) {
    neighbors(id, near);
    for (const int32_t f : fan) {
      const Triangle& triangle = surface_.triangles[f];
      const std::array<Vec3, 3> corners{points_[triangle[0]], points_[triangle[1]], points_[triangle[2]]};
      for (const int32_t s : near) {
        if (foreign(s, triangle) && intrudes(points_[s], corners)) {
          flood(s, triangle, corners);
          break;
        }
      }
    }
  }
  bool entered(int32_t id) const { return entered_[id] != 0; }

 private:
  static bool foreign(int32_t s, const Triangle& t) { return s != t[0] && s != t[1] && s != t[2]; }

  void neighbors(int32_t id, std::vector<int32_t>& near) const {
    near.clear();
    if (id >= incident_.size()) return;
    for (const int32_t cell : incident_[id]) {
      for (const int32_t s : t_.cells[cell]) {
        if (s != kInfinite && s != id) near.push_back(s);
      }
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
  }

  // The cells that a triangle enters are connected along it.
  void flood(int32_t start, const Triangle& triangle, const std::array<Vec3, 3>& corners) {
    std::vector<int32_t> visited{start}, near;
    for (const int32_t corner : triangle) {
      neighbors(corner, near);
      for (const int32_t s : near) visit(s, triangle, corners, visited);
    }
    for (size_t i = 0; i < visited.size(); ++i) {
      std::atomic_ref(entered_[visited[i]]).store(1, std::memory_order_relaxed);
      neighbors(visited[i], near);
      for (const int32_t s : near) visit(s, triangle, corners, visited);
    }
  }
  void visit(int32_t s, const Triangle& triangle, const std::array<Vec3, 3>& corners,
             std::vector<int32_t>& visited) const {
    if (!foreign(s, triangle) || !intrudes(points_[s], corners)) return;
    if (std::find(visited.begin(), visited.end(), s) == visited.end()) visited.push_back(s);
  }

  std::span<const Vec3> points_;
  const Surface& surface_;
  const Triangulation& t_;
  const Csr<int32_t>& incident_;
  std::vector<uint8_t> entered_;
};

// Patches: trusted samples joined by triangles of which all three corners are trusted.
void number_patches(Trust& trust, std::span<const Triangle> triangles) {
  UnionFind patches(trust.patch.size());
  for (const auto& [a, b, c] : triangles) {
    if (trust.patch[a] < 0 || trust.patch[b] < 0 || trust.patch[c] < 0) continue;
    patches.unite(a, b);
    patches.unite(b, c);
  }
  // A representative is the lowest id of its patch, so it is numbered before the others ask.
  for (int32_t id = 0; id < static_cast<int32_t>(trust.patch.size()); ++id) {
    if (trust.patch[id] < 0) continue;
    const int32_t lowest = patches.find(id);
    trust.patch[id] = lowest == id ? trust.patches++ : trust.patch[lowest];
  }
}

}  // namespace

Surface make_surface(std::span<const Triangle> triangles, std::span<const int32_t> sample_of_row,
                     int32_t samples, const Run& run) {
  Surface surface;
  surface.triangles.reserve(triangles.size());
  for (const auto& [i, j, k] : triangles) {
    const Triangle t{sample_of_row[i], sample_of_row[j], sample_of_row[k]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) surface.triangles.push_back(t);
  }
  surface.fans = rows_containing(std::span<const Triangle>(surface.triangles), samples);
  std::atomic<int64_t> unbalanced{0};
  parallel_chunks(samples, run, [&](int64_t begin, int64_t end, int) {
    std::vector<Edge> uses;
    int64_t found = 0;
    for (int64_t p = begin; p < end; ++p) {
      found += unbalanced_edges(static_cast<int32_t>(p), surface.fans[p], surface.triangles, uses);
    }
    unbalanced += found;
  });
  surface.boundary_edges = unbalanced;
  return surface;
}

Trust trusted_samples(std::span<const Vec3> points, const Surface& surface, const Triangulation& t,
                      const Csr<int32_t>& incident, const Run& run) {
  const auto samples = static_cast<int32_t>(incident.size());
  Trust trust{std::vector<int32_t>(samples, -1), std::vector<Vec3>(samples), std::vector<double>(samples, 2)};
  Intrusions intrusions(points, surface, t, incident);
  parallel_chunks(samples, run, [&](int64_t begin, int64_t end, int) {
    std::vector<int32_t> near;
    std::vector<Edge> links;
    for (auto p = static_cast<int32_t>(begin); p < end; ++p) {
      intrusions.mark(p, surface.fans[p], near);
      if (!is_disc(p, surface.fans[p], surface.triangles, links)) continue;
      const Fan fan = describe_fan(p, surface.fans[p], points, surface.triangles);
      trust.normal[p] = fan.normal;
      trust.sine[p] = fan.sine;
    }
  });
  for (int32_t p = 0; p < samples; ++p) {
    if (trust.sine[p] <= 1 && !intrusions.entered(p)) trust.patch[p] = 0;
  }
  number_patches(trust, surface.triangles);
  return trust;
}

}  // namespace medial
