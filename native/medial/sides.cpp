#include "sides.h"

namespace medial {
namespace {

// What a trusted generator says of a Voronoi vertex: which patch it speaks for, and on which side of that patch it lies.
struct Vote {
  int32_t patch = -1;
  bool inside = false;
};

// u is outside the fan when it is on the outer side of all its triangles, as it is when its angle to the plane of the
// mean normal exceeds the largest angle between the mean normal and a triangle's.
Vote vote(const Cell& generators, const Vec3& centre, std::span<const Vec3> points, const Trust& trust) {
  for (const int32_t p : generators) {
    if (p >= static_cast<int32_t>(trust.patch.size()) || trust.patch[p] < 0) continue;
    const Vec3 u = centre - points[p];
    const double height = dot(u, trust.normal[p]);
    if (std::abs(height) > trust.sine[p] * length(u)) return {trust.patch[p], height < 0};
  }
  return {};
}

// Winding number just outside each patch: asked once, at the first Voronoi vertex that the patch speaks for.
std::vector<double> outside_patches(const std::vector<Vote>& votes, int32_t patches,
                                    const Voronoi& voronoi, const WindingNumber& winding) {
  std::vector<int32_t> witness(static_cast<size_t>(patches), -1);
  for (int32_t c = 0; c < static_cast<int32_t>(votes.size()); ++c) {
    if (votes[c].patch >= 0 && witness[votes[c].patch] < 0) witness[votes[c].patch] = c;
  }
  std::vector<double> outside(static_cast<size_t>(patches), 0);
  for (int32_t k = 0; k < patches; ++k) {
    if (witness[k] < 0) continue;
    outside[k] = std::round(winding(voronoi.centre[witness[k]])) - (votes[witness[k]].inside ? 1 : 0);
  }
  return outside;
}

}  // namespace

CellSides sides_from_surface(std::span<const Vec3> points, const Surface& surface, const Triangulation& t,
                             const Voronoi& voronoi, const Csr<int32_t>& incident, const Run& run) {
  begin_stage(run.progress, "Inside and outside", 0.88, 0.99);
  const Run quiet{run.threads, nullptr};
  const WindingNumber winding(points, surface.triangles);
  advance(run.progress, 0.2);
  // Off a closed surface the winding number is an integer that changes only across it; else every vertex is asked.
  const Trust trust = surface.closed() ? trusted_samples(points, surface, t, incident, quiet) : Trust{};
  advance(run.progress, 0.4);
  std::vector<Vote> votes(static_cast<size_t>(t.finite_cells));
  parallel_for(t.finite_cells, quiet, [&](int64_t c) {
    votes[c] = vote(t.cells[c], voronoi.centre[c], points, trust);
  });
  const std::vector<double> outside = outside_patches(votes, trust.patches, voronoi, winding);
  begin_stage(run.progress, "Winding numbers", 0.93, 0.99);
  CellSides sides(t.cells.size(), static_cast<uint8_t>(Side::outer));
  parallel_for(t.finite_cells, run, [&](int64_t c) {
    const double w = votes[c].patch >= 0 ? outside[votes[c].patch] + (votes[c].inside ? 1 : 0)
                                         : winding(voronoi.centre[c]);
    if (w > 0.5) sides[c] = static_cast<uint8_t>(Side::inner);
  });
  // One Voronoi vertex, one side.
  parallel_for(t.finite_cells, quiet, [&](int64_t c) {
    if (voronoi.vertex[c] != c) sides[c] = sides[voronoi.vertex[c]];
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
