// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/level_set.h"

#include <array>
#include <unordered_map>
#include <unordered_set>

#include "base/parallel.h"
#include "base/rows.h"

namespace medial {
namespace {

constexpr double kRough = 0.1;  // share of a fall of the winding number: its error; chosen: unseen
constexpr double kFine = 1e-6;  // accepted error at a sample; derived: rounding
constexpr int kMostSteps = 8;   // steps of the secant method; two or three are usual
constexpr int kBits = 21;       // bits of a lattice coordinate
constexpr int64_t kCells = int64_t{1} << kBits;

using LatticePoint = std::array<int64_t, 3>;

uint64_t key_of(const LatticePoint& p) {
  return static_cast<uint64_t>(p[0]) << 2 * kBits | static_cast<uint64_t>(p[1]) << kBits |
         static_cast<uint64_t>(p[2]);
}

bool in_range(const LatticePoint& p) {
  return std::all_of(p.begin(), p.end(), [](int64_t x) { return x > 0 && x + 1 < kCells; });
}

LatticePoint corner_of(const LatticePoint& cube, int i) {
  return {cube[0] + (i & 1), cube[1] + (i >> 1 & 1), cube[2] + (i >> 2)};
}

}  // namespace

// Follows the level set in waves: all cubes that the last wave found are examined at once.
class Follower {
 public:
  Follower(const OpenSurface& surface, double step, const Run& run) : surface_(surface), run_(run) {
    const Box box = box_of(surface.vertices_);
    const Vec3 extent = box.extent();
    // The lattice reaches beyond the box by its extent. Its offset is unlike the round numbers in
    // models, so their vertices and edges are not on the edges of the lattice.
    step_ = std::max(step, 4 * max_abs(extent) / static_cast<double>(kCells));
    origin_ = box.low - extent - step_ * Vec3{1.3819, 1.6367, 1.4562};
  }

  void begin_at(const Vec3& p) {
    const Vec3 x = (1 / step_) * (p - origin_) - Vec3{0.5, 0.5, 0.5};
    const LatticePoint low{static_cast<int64_t>(x.x), static_cast<int64_t>(x.y),
                           static_cast<int64_t>(x.z)};
    for (int i = 0; i < 8; ++i) visit(corner_of(low, i));
  }

  std::vector<OpenSurface::Fall> operator()() {
    while (!next_.empty()) {
      throw_if_cancelled(run_.progress);
      const std::vector<LatticePoint> wave = std::move(next_);
      next_.clear();
      tell_corners(wave);
      tell_edges(wave);
    }
    return std::move(found_);
  }

 private:
  struct Corner {
    Vec3 at;
    int32_t from;  // a neighbouring corner with a known number, or -1
    int closed = 0;
    bool inside = false;
  };
  struct LatticeEdge {
    LatticePoint lower;
    int axis;
    int32_t ends[2];
  };

  void visit(const LatticePoint& cube) {
    if (in_range(cube) && seen_.insert(key_of(cube)).second) next_.push_back(cube);
  }

  Vec3 place_of(const LatticePoint& p) const {
    return origin_ + step_ * Vec3{static_cast<double>(p[0]), static_cast<double>(p[1]),
                                  static_cast<double>(p[2])};
  }

  void tell_corners(std::span<const LatticePoint> wave) {
    const auto known = static_cast<int32_t>(corners_.size());
    for (const LatticePoint& cube : wave) {
      int32_t from = -1;
      for (int i = 0; i < 8; ++i) {
        const auto at = number_.find(key_of(corner_of(cube, i)));
        if (at != number_.end() && at->second < known) from = at->second;
      }
      for (int i = 0; i < 8; ++i) {
        const LatticePoint p = corner_of(cube, i);
        const auto id = static_cast<int32_t>(corners_.size());
        if (number_.try_emplace(key_of(p), id).second) corners_.push_back({place_of(p), from});
      }
    }
    parallel_for(
        static_cast<int64_t>(corners_.size()) - known, {run_.threads},
        [&](int64_t i) { tell(corners_[static_cast<size_t>(known + i)]); }, 64);
  }

  void tell(Corner& corner) const {
    const WindingNumber& winding = surface_.winding_;
    if (corner.from < 0) {
      corner.closed = winding.closed(corner.at);
    } else {
      const Corner& near = corners_[static_cast<size_t>(corner.from)];
      corner.closed = winding.closed_from(near.at, near.closed, corner.at);
    }
    // The side is determined much faster than the number itself.
    corner.inside = winding.is_inside(corner.at, corner.closed);
  }

  void tell_edges(std::span<const LatticePoint> wave) {
    const auto edges = new_edges(wave);
    std::vector<std::optional<OpenSurface::Fall>> falls(edges.size());
    const auto tell = [&](int64_t i) {
      if (is_clear(edges[i])) falls[i] = fall_of(edges[i]);
    };
    parallel_for(static_cast<int64_t>(edges.size()), {run_.threads}, tell, 64);
    for (size_t i = 0; i < edges.size(); ++i) {
      if (!falls[i]) continue;
      found_.push_back(*falls[i]);
      visit_round(edges[i]);
    }
  }

  // Returns the edges of the cubes with one end inside and one outside that no earlier wave had.
  std::vector<LatticeEdge> new_edges(std::span<const LatticePoint> wave) {
    std::vector<LatticeEdge> edges;
    for (const LatticePoint& cube : wave) {
      std::array<int32_t, 8> ids;
      for (int i = 0; i < 8; ++i) ids[i] = number_.at(key_of(corner_of(cube, i)));
      for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < 8; ++i) {
          if (i >> axis & 1) continue;
          const int32_t p = ids[i], q = ids[i | 1 << axis];
          if (corners_[p].inside == corners_[q].inside) continue;
          const LatticePoint lower = corner_of(cube, i);
          if (had_[axis].insert(key_of(lower)).second) edges.push_back({lower, axis, {p, q}});
        }
      }
    }
    return edges;
  }

  // Returns whether no triangle is between the ends.
  bool is_clear(const LatticeEdge& edge) const {
    const Vec3 &p = corners_[edge.ends[0]].at, &q = corners_[edge.ends[1]].at;
    const double reach = distance(p, q);
    const auto drop = surface_.triangles_(p, (1 / reach) * (q - p), reach);
    return drop && *drop == 0;
  }

  OpenSurface::Fall fall_of(const LatticeEdge& edge) const {
    const Corner *in = &corners_[edge.ends[0]], *out = &corners_[edge.ends[1]];
    if (!in->inside) std::swap(in, out);
    double above = 0, below = 0;
    const auto tell = [&](double tolerance) {
      above = std::max(0.0, surface_.above(tolerance, in->at, in->closed));
      below = std::min(0.0, surface_.above(tolerance, out->at, out->closed));
    };
    double tolerance = kRough * kRough;
    for (tell(tolerance); tolerance > kFine && tolerance > kRough * (above - below);) {
      tell(tolerance *= 0.25);
    }
    return {in->at, out->at, above > below ? above / (above - below) : 0.5, above};
  }

  // Visits the four cubes at the edge.
  void visit_round(const LatticeEdge& edge) {
    const int other = (edge.axis + 1) % 3, third = (edge.axis + 2) % 3;
    for (int i = 0; i < 4; ++i) {
      LatticePoint cube = edge.lower;
      cube[other] -= i & 1;
      cube[third] -= i >> 1;
      visit(cube);
    }
  }

  const OpenSurface& surface_;
  const Run& run_;
  double step_;
  Vec3 origin_;
  std::unordered_set<uint64_t> seen_;  // cubes
  std::vector<LatticePoint> next_;     // in the order in which they were found
  std::unordered_map<uint64_t, int32_t> number_;
  std::vector<Corner> corners_;
  std::array<std::unordered_set<uint64_t>, 3> had_;  // edges by their lower end, per axis
  std::vector<OpenSurface::Fall> found_;
};

OpenSurface::OpenSurface(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                         std::span<const Edge> boundary, const Progress* progress)
    : vertices_(vertices),
      boundary_(boundary),
      winding_(vertices, triangles, boundary, progress),
      triangles_(soup(vertices, triangles), progress) {}

std::vector<OpenSurface::Fall> OpenSurface::falls(double step, const Run& run) const {
  Follower follow(*this, step, run);
  for (const auto& [from, to] : boundary_) {
    const Vec3 &a = vertices_[from], &b = vertices_[to];
    const double parts = std::ceil(distance(a, b) / step);
    for (double i = 0; i < parts; ++i) {
      const double share = (i + 0.5) / parts;
      follow.begin_at((1 - share) * a + share * b);
    }
  }
  return follow();
}

// This is the secant method from the two ends; the winding number is smooth between them.
std::optional<Vec3> OpenSurface::place(const Fall& fall) const {
  const Vec3 way = fall.outside - fall.inside;
  const int closed = winding_.closed(fall.inside);
  const auto above_at = [&](double share) {
    const Vec3 at = fall.inside + share * way;
    return above(kFine, at, winding_.closed_from(fall.inside, closed, at));
  };
  double last = 0, before = fall.above, share = fall.share;
  for (int i = 0; i < kMostSteps; ++i) {
    const double here = above_at(share);
    if (std::abs(here) <= 2 * kFine) return fall.inside + share * way;
    const double next = share - here * (share - last) / (here - before);
    if (!(std::abs(next - fall.share) < 1)) break;
    last = share, before = here, share = next;
  }
  return std::nullopt;
}

Vec3 OpenSurface::normal(const Vec3& place) const {
  Vec3 sum;
  for (const auto& [from, to] : boundary_) {
    const Vec3 a = vertices_[from] - place, b = vertices_[to] - place;
    const double la = length(a), lb = length(b), both = la * lb;
    const double below = both * (both + dot(a, b));
    if (below > 0) sum = sum + ((la + lb) / below) * cross(b, a);
  }
  return normalized(sum);
}

}  // namespace medial
