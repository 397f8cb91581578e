// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/pockets.h"

#include <array>
#include <unordered_map>

namespace medial {
namespace {

// Lists connected cells in the order in which they were found.
using Part = std::vector<int32_t>;

// Finds the parts of the inner cells that are too small for the samples to determine their shape.
class Finder {
 public:
  Finder(std::span<const Vec3> points, std::span<const double> spacing, const Triangulation& t,
         const Voronoi& voronoi, const CellSides& sides, const Run& run)
      : points_(points), spacing_(spacing), t_(t), voronoi_(voronoi), sides_(sides), run_(run) {}

  // Returns the parts, the smallest first; equal ones are in the order of their lowest cells.
  std::vector<Part> operator()() {
    const auto small =
        parallel_append<int32_t>(t_.finite_cells, run_, [&](int64_t c, auto& out, int) {
          const auto cell = static_cast<int32_t>(c);
          if (sides_[cell] == Side::inner && is_small(cell)) out.push_back(cell);
        });
    std::vector<Part> parts;
    if (small.empty()) return parts;
    seen_.assign(t_.cells.size(), 0);
    for (const int32_t cell : small) {
      if (seen_[cell]) continue;
      Part part;
      if (fill(cell, part)) parts.push_back(std::move(part));
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Part& a, const Part& b) { return a.size() < b.size(); });
    return parts;
  }

 private:
  bool is_small(int32_t cell) const {
    const Cell& corners = t_.cells[cell];
    double hole = 0;
    for (const int32_t p : corners) {
      if (static_cast<size_t>(p) < spacing_.size()) hole = std::max(hole, spacing_[p]);
    }
    return distance(voronoi_.centre[cell], points_[corners[0]]) <= hole;
  }

  // Collects the small cells that are connected with one; returns false if a larger cell touches
  // them.
  bool fill(int32_t first, Part& part) {
    bool alone = true;
    part.assign(1, first);
    seen_[first] = 1;
    for (size_t i = 0; i < part.size(); ++i) {
      for (const int32_t n : t_.neighbors[part[i]]) {
        if (sides_[n] != Side::inner || seen_[n]) continue;
        if (!is_small(n)) {
          alone = false;
          continue;
        }
        seen_[n] = 1;
        part.push_back(n);
      }
    }
    return alone;
  }

  std::span<const Vec3> points_;
  std::span<const double> spacing_;
  const Triangulation& t_;
  const Voronoi& voronoi_;
  const CellSides& sides_;
  Run run_;
  std::vector<uint8_t> seen_;  // per cell: 1 if it is in a part already
};

using CellsAtSample = std::unordered_map<int32_t, std::vector<int32_t>>;

// Returns the inner cells at the samples of some parts.
CellsAtSample inner_cells_at(std::span<const Part> parts, const Triangulation& t,
                             const CellSides& sides) {
  CellsAtSample found;
  for (const Part& part : parts) {
    for (const int32_t cell : part) {
      for (const int32_t p : t.cells[cell]) found.try_emplace(p);
    }
  }
  for (int32_t c = 0; c < t.finite_cells; ++c) {
    if (sides[c] != Side::inner) continue;
    for (const int32_t p : t.cells[c]) {
      const auto at = found.find(p);
      if (at != found.end()) at->second.push_back(c);
    }
  }
  return found;
}

// This is a straight way from a part to a cell of a larger one.
struct Way {
  double length;
  int32_t from, to;

  auto operator<=>(const Way&) const = default;
};

// Counts the parts of the inner cells.
int64_t number_of_parts(const Triangulation& t, const CellSides& sides) {
  std::vector<uint8_t> seen(t.cells.size(), 0);
  int64_t count = 0;
  Part left;
  for (int32_t c = 0; c < t.finite_cells; ++c) {
    if (sides[c] != Side::inner || seen[c]) continue;
    ++count;
    seen[c] = 1;
    left.assign(1, c);
    while (!left.empty()) {
      const int32_t cell = left.back();
      left.pop_back();
      for (const int32_t n : t.neighbors[cell]) {
        if (sides[n] != Side::inner || seen[n]) continue;
        seen[n] = 1;
        left.push_back(n);
      }
    }
  }
  return count;
}

constexpr double kWidth = 0.01;  // half a way's width at its end, by its length; chosen: unseen

// Returns whether a way is wide enough: there is no width between bodies that touch in an edge or
// in a corner. At its beginning a way has no width, because Voronoi vertices of pockets may be
// close beneath the surface.
bool is_wide_way(const Vec3& from, const Vec3& to, const WindingNumber& winding) {
  const Vec3 way = to - from;
  const double width = kWidth * length(way);
  const auto [u, v] = across(normalized(way));
  const std::array<Vec3, 5> beside{Vec3{}, width * u, -width * u, width * v, -width * v};
  return std::all_of(beside.begin(), beside.end(), [&](const Vec3& offset) {
    return winding.is_inside_along(from, to + offset);
  });
}

}  // namespace

SmallParts small_parts(std::span<const Vec3> points, std::span<const double> spacing,
                       const std::shared_future<WindingNumber>& winding, const Triangulation& t,
                       const Voronoi& voronoi, const CellSides& sides, const Run& run) {
  const auto parts = Finder(points, spacing, t, voronoi, sides, run)();
  if (parts.empty()) return {};
  std::unordered_map<int32_t, size_t> part_of;
  for (size_t i = 0; i < parts.size(); ++i) {
    for (const int32_t cell : parts[i]) part_of.emplace(cell, i);
  }
  const CellsAtSample beside = inner_cells_at(parts, t, sides);
  const auto is_pocket = [&](size_t i) {
    std::vector<Way> ways;
    for (const int32_t from : parts[i]) {
      for (const int32_t p : t.cells[from]) {
        for (const int32_t to : beside.at(p)) {
          const auto other = part_of.find(to);
          if (other != part_of.end() && other->second <= i) continue;
          ways.push_back({distance(voronoi.centre[from], voronoi.centre[to]), from, to});
        }
      }
    }
    std::sort(ways.begin(), ways.end());  // the shortest ways are the likeliest
    return std::any_of(ways.begin(), ways.end(), [&](const Way& way) {
      return is_wide_way(voronoi.centre[way.from], voronoi.centre[way.to], winding.get());
    });
  };
  SmallParts found;
  for (size_t i = 0; i < parts.size(); ++i) {
    throw_if_cancelled(run.progress);
    if (is_pocket(i)) {
      found.pockets.insert(found.pockets.end(), parts[i].begin(), parts[i].end());
    } else {
      found.crumbs.push_back(parts[i]);
    }
  }
  std::sort(found.pockets.begin(), found.pockets.end());
  return found;
}

CellSides without(const SmallParts& small, std::optional<int64_t> bodies,
                  const Triangulation& triangulation, CellSides sides) {
  for (const int32_t cell : small.pockets) sides[cell] = Side::outer;
  if (!bodies || small.crumbs.empty()) return sides;
  int64_t left = number_of_parts(triangulation, sides);
  if (left == std::ssize(small.crumbs)) return sides;
  for (const Part& crumb : small.crumbs) {
    if (left-- <= *bodies) break;
    for (const int32_t cell : crumb) sides[cell] = Side::outer;
  }
  return sides;
}

}  // namespace medial
