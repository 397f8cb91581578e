// SPDX-License-Identifier: GPL-3.0-or-later
#include "cocone/cocone.h"

#include <string>

#include "base/portable_math.h"
#include "base/rows.h"

namespace medial {
namespace {

// Holds the zone of each Voronoi vertex. The zones above and below are convex, so a Voronoi edge
// misses the cocone exactly when both its ends are above, or both below.
using Zones = std::vector<std::array<Zone, 4>>;  // per cell and corner

// Holds bits per cell and face (opposite to each of its corners): bit i is set if the dual Voronoi
// edge meets the cocone of corner i.
using Meetings = std::vector<std::array<uint8_t, 4>>;

struct CoconeInput {
  std::span<const Vec3> points;
  const Triangulation& t;
  const Voronoi& voronoi;
  const Csr<int32_t>& incident;
  const CoconeOptions& options;
  std::vector<Vec3> normal;  // unit pole vectors

  int32_t samples() const { return static_cast<int32_t>(incident.size()); }
  bool is_sample(int32_t id) const { return id >= 0 && id < samples(); }

  Vec3 towards(int32_t p, int32_t cell) const {
    return medial::towards(points[p], t, voronoi, cell);
  }
};

Zones zones(const CoconeInput& s, const Run& run) {
  const double sine = portable::sin(s.options.cocone_angle);
  Zones result(s.t.cells.size());
  parallel_for(s.t.cell_count(), run, [&](int64_t c) {
    for (int i = 0; i < 4; ++i) {
      const int32_t p = s.t.cells[c][i];
      if (!s.is_sample(p)) continue;
      result[c][i] = zone_of(s.towards(p, static_cast<int32_t>(c)), s.normal[p], sine);
    }
  });
  return result;
}

Meetings meetings(const CoconeInput& s, const Zones& zones, const Run& run) {
  Meetings result(s.t.cells.size());
  parallel_for(s.t.cell_count(), run, [&](int64_t c) {
    const Cell& ids = s.t.cells[c];
    for (int face = 0; face < 4; ++face) {
      const int32_t across = s.t.neighbors[c][face];
      for (int i = 0; i < 4; ++i) {
        if (i == face || !s.is_sample(ids[i])) continue;
        const Zone here = zones[c][i], there = zones[across][slot_of(s.t.cells[across], ids[i])];
        const bool meet = here != there || here == Zone::in_cocone;
        result[c][face] |= static_cast<uint8_t>(meet << i);
      }
    }
  });
  return result;
}

// Finds the triangles at p whose dual Voronoi edges meet the cocone of p, each from one cell.
void meetings_at(int32_t p, const CoconeInput& s, const Meetings& meetings,
                 std::vector<CellFace>& out) {
  out.clear();
  for (const int32_t cell : s.incident[p]) {
    const int corner = slot_of(s.t.cells[cell], p);
    for (int i = 0; i < 4; ++i) {
      if ((meetings[cell][i] >> corner & 1) && s.t.neighbors[cell][i] > cell)
        out.push_back({cell, i});
    }
  }
}

// Returns the squared distance from p at which the dual Voronoi edge of two cells crosses the
// tangent plane, or 0 if it does not cross it.
double crossing(int32_t p, int32_t cell, int32_t across, const CoconeInput& s) {
  const Vec3 a = s.towards(p, cell), b = s.towards(p, across);
  const double ha = dot(a, s.normal[p]), hb = dot(b, s.normal[p]);
  if ((ha >= 0) == (hb >= 0)) return 0;
  if (s.t.is_infinite(cell) || (s.t.is_infinite(across) && hb == 0)) return HUGE_VAL;
  if (s.t.is_infinite(across)) return squared_length(a - (ha / hb) * b);
  // The computation starts at the nearer end of the edge, where rounding loses less.
  const bool a_is_nearer = squared_length(a) <= squared_length(b);
  return squared_length(a_is_nearer ? a + (ha / (ha - hb)) * (b - a)
                                    : b + (hb / (hb - ha)) * (a - b));
}

// Returns whether Voronoi vertices of p are at least this far (squared) away on both sides of the
// tangent plane; then the poles are, too.
bool reaches(int32_t p, double distance, const CoconeInput& s) {
  bool above = false, below = false;
  for (const int32_t cell : s.incident[p]) {
    const Vec3 d = s.towards(p, cell);
    if (!s.t.is_infinite(cell) && squared_length(d) < distance) continue;
    (dot(d, s.normal[p]) > 0 ? above : below) = true;
    if (above && below) return true;
  }
  return false;
}

bool is_thin(int32_t p, const CoconeInput& s, std::span<const CellFace> faces) {
  double width = 0;
  for (const CellFace& f : faces) {
    width = std::max(width, crossing(p, f.cell, s.t.neighbors[f.cell][f.slot], s));
  }
  const double ratio = s.options.flatness_ratio;
  return width < HUGE_VAL && reaches(p, ratio * ratio * width, s);
}

// Calls found(neighbour) for the samples of triangles at p, for some of them several times.
template <typename Found>
void for_neighbours(int32_t p, const CoconeInput& s, std::span<const CellFace> faces,
                    const Found& found) {
  for (const CellFace& f : faces) {
    for (const int32_t q : corners(s.t, f)) {
      if (q != p && s.is_sample(q)) found(q);
    }
  }
}

// A thin sample may grow flat from a cocone neighbour with which it agrees.
struct Growth {
  int32_t sample, neighbour;
};

// Decides which samples are thin, and which are flat at once; returns the ways in which the other
// thin samples may grow flat.
std::vector<Growth> agreement(const CoconeInput& s, const Meetings& meetings, Cocone& result,
                              const Run& run) {
  const double least = portable::cos(s.options.flatness_angle);
  std::vector<std::vector<CellFace>> faces_of(run.threads);
  return parallel_append<Growth>(s.samples(), run, [&](int64_t id, auto& growths, int worker) {
    auto& faces = faces_of[worker];
    const auto p = static_cast<int32_t>(id);
    meetings_at(p, s, meetings, faces);
    result.thin[p] = is_thin(p, s, faces);
    if (!result.thin[p]) return;
    const size_t before = growths.size();
    bool all = true;
    for_neighbours(p, s, faces, [&](int32_t q) {
      const bool agree = std::abs(dot(s.normal[p], s.normal[q])) >= least;
      all = all && agree;
      if (agree) growths.push_back({p, q});
    });
    if (!all) return;
    result.flat[p] = 1;
    growths.resize(before);
  });
}

void grow(std::span<const Growth> growths, std::vector<uint8_t>& flat) {
  std::vector<std::array<int32_t, 1>> neighbour;
  for (const Growth& g : growths) neighbour.push_back({g.neighbour});
  const auto at = rows_containing(std::span<const std::array<int32_t, 1>>(neighbour),
                                  static_cast<int32_t>(flat.size()));
  auto queue = rows_where(flat.size(), [&](int32_t p) { return flat[p] && !at[p].empty(); });
  while (!queue.empty()) {
    const int32_t q = queue.back();
    queue.pop_back();
    for (const int32_t row : at[q]) {
      const int32_t p = growths[row].sample;
      if (!flat[p]) {
        flat[p] = 1;
        queue.push_back(p);
      }
    }
  }
}

bool is_candidate(const CellFace& f, const CoconeInput& s, const Meetings& meetings,
                  std::span<const uint8_t> flat) {
  bool any = false;
  for (int i = 0; i < 4; ++i) {
    if (i == f.slot) continue;
    const int32_t p = s.t.cells[f.cell][i];
    if (!s.is_sample(p)) return false;
    if (flat[p] && !(meetings[f.cell][f.slot] >> i & 1)) return false;
    any |= flat[p] != 0;
  }
  return any;
}

}  // namespace

void require_valid(const CoconeOptions& o) {
  const auto require_angle = [](const char* name, double value, double limit, const char* words) {
    if (value > 0 && value < limit) return;
    throw InvalidInputError("Expected " + std::string(name) + " above 0 and below " + words +
                            " radians, found " + std::to_string(value) +
                            "; leave it out for the default.");
  };
  require_angle("cocone_angle", o.cocone_angle, std::numbers::pi / 2, "pi/2");
  require_angle("flatness_angle", o.flatness_angle, std::numbers::pi / 2, "pi/2");
  require_angle("sharp_angle", o.sharp_angle, std::numbers::pi, "pi");
  if (!(o.flatness_ratio > 0 && o.flatness_ratio < HUGE_VAL)) {
    throw InvalidInputError("Expected a positive flatness_ratio, found " +
                            std::to_string(o.flatness_ratio) + "; leave it out for the default.");
  }
}

Cocone cocone(std::span<const Vec3> points, const Triangulation& t, const Voronoi& voronoi,
              const Csr<int32_t>& incident, const Poles& poles, const CoconeOptions& options,
              const Run& run) {
  begin_stage(run.progress, "Cocone", 0.9, 0.93);
  CoconeInput s{points, t, voronoi, incident, options, {poles.vector.begin(), poles.vector.end()}};
  parallel_for(s.samples(), run, [&](int64_t p) { s.normal[p] = normalized(s.normal[p]); });
  const auto samples = static_cast<size_t>(s.samples());
  Cocone result{{}, std::vector<uint8_t>(samples), std::vector<uint8_t>(samples), FaceSet(t)};
  const Meetings m = meetings(s, zones(s, run), run);
  grow(agreement(s, m, result, run), result.flat);
  parallel_for(t.cell_count(), run, [&](int64_t c) {
    for (int i = 0; i < 4; ++i) {
      const CellFace f{static_cast<int32_t>(c), i};
      if (is_candidate(f, s, m, result.flat)) result.candidates.insert(f);
    }
  });
  result.normal = std::move(s.normal);
  return result;
}

}  // namespace medial
