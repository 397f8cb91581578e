// SPDX-License-Identifier: GPL-3.0-or-later
// Places the samples on creases and next to them together with their partners on opposite walls.
// Wherever walls are close, the samples of one wall are then at the places of the other one, so
// that their Voronoi facets are pieces of the sheet between the walls, however close these are. The
// same holds across gaps: there the facets keep both sides apart.
#pragma once

#include <unordered_map>

#include "sampling/crease_lines.h"
#include "sampling/fixed_samples.h"

namespace medial {

class PairedSamples {
 public:
  // All must outlive this object.
  PairedSamples(const CurvedSurface& surface, const Creases& creases, const OppositeWalls& walls,
                const Spacing& spacing, const Run& run);

  // Adds samples on corners and creases, each with its partners, through the solid and across gaps,
  // for all faces that meet there.
  // Partners on other creases take the place of the samples that would be there.
  void add_on_creases(std::span<const FixedSample> samples);
  // Adds a row along each convex edge of a thin wall, at twice the thickness from it, so that the
  // sheet reaches the edge as far as its thickness and not as far as the spacing allows.
  void add_rims();
  // Adds pairs of samples on the two sides of an edge where they and their partners have room.
  void add_beside(std::span<const std::array<FixedSample, 2>> rows);
  // Returns all samples in the order of their kinds.
  std::vector<FixedSample> sorted() &&;

 private:
  struct Opposite {
    int32_t triangle;  // from which the wall is opposite
    WallPlace wall;
    Through through = Through::solid;
  };
  using Opposites = std::vector<Opposite>;

  const TriangleMesh& mesh() const { return surface_.mesh(); }
  bool is_reflex(int32_t edge) const;
  const Vec3& normal(int32_t triangle) const { return mesh().normal[triangle]; }
  std::vector<SurfacePlace> places_of(const FixedSample& sample, Through through) const;
  std::vector<SurfacePlace> places_at_vertex(int32_t vertex) const;
  std::optional<WallPlace> wall_opposite(const FixedSample& sample, const SurfacePlace& place,
                                         Through through = Through::solid) const;
  Opposites opposites_of(const FixedSample& sample) const;

  int32_t add(const FixedSample& sample, bool is_partner);
  void add_partners(int32_t id, const Opposites& opposites, int depth);
  std::optional<Through> inside_corner(const FixedSample& sample, const Opposites& opposites) const;
  uint8_t rank_of(const FixedSample& sample, const Opposites& opposites) const;
  void add_outer_edge(int32_t id, const Opposites& opposites, int depth);
  int32_t add_partner(const FixedSample& found, double tolerance, Through through, int depth);
  void add_rim(int32_t id, int side);
  bool add_member(const FixedSample& sample);
  void link(int32_t p, int32_t q);

  uint64_t cell_of(const Vec3& point, int dx, int dy, int dz) const;
  template <typename Found>
  void for_near(const Vec3& point, double reach, const Found& found) const;
  int32_t coincident(const FixedSample& sample, double tolerance) const;
  bool is_crowded(const FixedSample& sample, size_t before) const;
  bool is_replaced(const FixedSample& sample) const;

  const CurvedSurface& surface_;
  const Creases& creases_;
  const OppositeWalls& walls_;
  const CreaseLines lines_;
  const Spacing& spacing_;
  Run run_;
  std::vector<int32_t> chain_of_;  // per edge
  std::vector<FixedSample> samples_;
  std::vector<uint8_t> is_partner_;
  double width_ = 0;  // of the cells
  std::unordered_map<uint64_t, std::vector<int32_t>> cells_;
};

}  // namespace medial
