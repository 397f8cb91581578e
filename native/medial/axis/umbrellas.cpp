// SPDX-License-Identifier: GPL-3.0-or-later
#include "axis/umbrellas.h"

#include <optional>

namespace medial {
namespace {

enum class Height : uint8_t { below, above, level };

// Returns the side of the tangent plane on which the Voronoi vertex of a cell lies, or to which the
// ray of an infinite cell points. A vertex in the plane counts as above: of the Voronoi edges that
// meet in it, those from below then cross the plane, and the umbrella stays a disc.
Height height(const Vec3& p, const Vec3& pole, int32_t cell, const Triangulation& t,
              const Voronoi& voronoi) {
  if (t.is_infinite(cell)) {
    const double h = dot(voronoi.centre[cell], pole);
    return h > 0 ? Height::above : h < 0 ? Height::below : Height::level;
  }
  return dot(voronoi.centre[cell] - p, pole) >= 0 ? Height::above : Height::below;
}

// kOthers[i][j] are the slots of a cell that are neither i nor j.
constexpr int kOthers[4][4][2] = {{{}, {2, 3}, {1, 3}, {1, 2}},
                                  {{2, 3}, {}, {0, 3}, {0, 2}},
                                  {{1, 3}, {0, 3}, {}, {0, 1}},
                                  {{1, 2}, {0, 2}, {0, 1}, {}}};

// This collects umbrellas, one after the other.
class Collector {
 public:
  Collector(std::span<const Vec3> points, const Triangulation& t, const Voronoi& voronoi,
            const Run& run)
      : points_(points), t_(t), voronoi_(voronoi), height_(array<Height>(t.cells.size(), run)) {}

  // Appends U_p. Each Voronoi edge that crosses the plane is found once, from below.
  void append(int32_t p, std::span<const int32_t> cells, std::vector<std::array<int32_t, 2>>& out) {
    const Vec3 to_pole = pole(points_[p], cells, t_, voronoi_, below_);
    if (below_.size() < cells.size()) below_.resize(cells.size());
    size_t count = 0;
    for (const int32_t cell : cells) {
      height_[cell] = height(points_[p], to_pole, cell, t_, voronoi_);
      below_[count] = cell;
      count += height_[cell] == Height::below;
    }
    for (size_t i = 0; i < count; ++i) append_above(p, below_[i], out);
  }

 private:
  // Appends the triangles at p through which a cell below has a neighbour above. They are opposite
  // to the other corners of the cell, so p is a corner of all these neighbours.
  void append_above(int32_t p, int32_t cell, std::vector<std::array<int32_t, 2>>& out) const {
    const Cell& ids = t_.cells[cell];
    const int own = slot_of(ids, p);
    for (int i = 0; i < 4; ++i) {
      const int32_t next = t_.neighbors[cell][i];
      if (i == own || height_[next] != Height::above) continue;
      if (t_.is_infinite(cell) && t_.is_infinite(next)) continue;
      auto& [a, b] = out.emplace_back();
      a = ids[kOthers[own][i][0]];
      b = ids[kOthers[own][i][1]];
    }
  }

  std::span<const Vec3> points_;
  const Triangulation& t_;
  const Voronoi& voronoi_;
  Array<Height> height_;  // heights of the cells at the current sample
  std::vector<int32_t> below_;
};

}  // namespace

Umbrellas umbrellas(std::span<const Vec3> points, const Triangulation& t, const Voronoi& voronoi,
                    const Csr<int32_t>& incident, const Run& run) {
  begin_stage(run.progress, "Umbrellas", 0.68, 0.8);
  std::vector<std::optional<Collector>> collectors(run.threads);
  Umbrellas result;
  result.offsets = array<int64_t>(static_cast<size_t>(incident.size()) + 1, 0, run);
  result.items = array<std::array<int32_t, 2>>(0, run);
  parallel_append_to(result.items, incident.size(), run, [&](int64_t p, auto& out, int worker) {
    auto& collector = collectors[worker];
    if (!collector) collector.emplace(points, t, voronoi, run);
    const size_t before = out.size();
    collector->append(static_cast<int32_t>(p), incident[p], out);
    result.offsets[p] = static_cast<int64_t>(out.size() - before);
  });
  counts_to_offsets(result.offsets);
  return result;
}

}  // namespace medial
