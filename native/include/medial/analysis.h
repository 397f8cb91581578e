// SPDX-License-Identifier: GPL-3.0-or-later
// MEDIAL(P) computes everything that does not depend on the thresholds once; the axis can then be
// extracted as often as needed.
#pragma once

#include <medial/faces.h>
#include <medial/hierarchy.h>
#include <medial/medial_mesh.h>
#include <medial/options.h>
#include <medial/progress.h>
#include <medial/thickness.h>
#include <medial/watertight_surface.h>

#include <memory>
#include <optional>
#include <span>

namespace medial {

// The input is a surface, or points alone; what is left out counts as unknown.
struct AnalysisInput {
  std::span<const Vec3> points;                        // samples of the surface
  std::span<const Triangle> triangles = {};            // its outward faces, as rows of `vertices`
  std::optional<std::span<const Vec3>> normals = {};   // outward, one per point
  std::optional<std::span<const Vec3>> vertices = {};  // none: `points`
};

// Holds places where Voronoi edges meet the faces more often than they should, or between samples
// of another wall, and the distance from there to the next such place, or to the samples.
struct Doubts {
  std::vector<Vec3> places;
  std::vector<double> gaps;
};

// These options choose how the input is analysed.
struct AnalysisOptions {
  SidesFrom sides = SidesFrom::automatic;
  CoconeOptions cocone = {};
  bool bounding_sphere = false;  // sect. 4.2
  int threads = 0;               // 0: all cores
};

// Estimates the peak memory in bytes of an analysis of so many samples of a surface: 1,430 to 1,470
// bytes were measured for each. A hierarchy in addition takes 700 to 900 more. Long and thin facets
// take up to four times as many.
inline int64_t memory_needed(int64_t points) { return 1450 * points; }

// An analysis keeps nothing of its input. Its const members may be called from several threads.
class MedialAnalysis {
 public:
  // Throws InvalidInputError, DegenerateInputError, Cancelled.
  explicit MedialAnalysis(const AnalysisInput& input, const AnalysisOptions& options = {},
                          Progress* progress = nullptr);
  ~MedialAnalysis();
  MedialAnalysis(MedialAnalysis&&) noexcept;
  MedialAnalysis& operator=(MedialAnalysis&&) noexcept;

  // Returns the closure of F. Throws InvalidInputError, DegenerateInputError, Cancelled.
  MedialMesh extract(const Extraction& extraction, Progress* progress = nullptr) const;
  // Returns the ids of the selected edges: the set F of the paper, including facets without area
  // and unbounded ones.
  std::vector<int32_t> select(const Extraction& extraction, Progress* progress = nullptr) const;

  // Returns all levels of the inner axis, which no longer need the analysis. If the solid is known
  // to consist of this many bodies, parts without any ball larger than the hole between the samples
  // at them are left out, those with few cells first, until no more parts than bodies are left.
  // With faces, sheets reach the sharp convex edges, and with `places`, which take long, vertices
  // also have crisp places. Partners
  // are, per point, the row of its partner on the opposite wall, or -1; the facets between partners
  // are selected, whatever the thresholds say. Throws InvalidInputError for other sides, and unless
  // there is a face and a partner per point; DegenerateInputError for samples that enclose nothing.
  Hierarchy hierarchy(const Thresholds& thresholds = {}, Side side = Side::inner,
                      std::optional<int64_t> bodies = std::nullopt, Progress* progress = nullptr,
                      const FacesInput* faces = nullptr, std::span<const int32_t> partners = {},
                      bool places = true) const;

  // Returns for each sample, ascending by row, the largest circumradius in its umbrella, infinite
  // for an empty one.
  std::vector<double> spacing() const;
  // Returns the distance to the nearest Voronoi vertex of the facets of either side that the
  // thresholds select, too large by at most 1/32 of itself. It is measured at the samples of
  // `rows`, or at all in ascending order if there are none.
  std::vector<double> feature_size(const Thresholds& thresholds,
                                   std::optional<std::span<const int32_t>> rows = {},
                                   Progress* progress = nullptr) const;
  // Returns the thickness of the solid at the samples, or the width of the gap. It needs sides.
  // Throws InvalidInputError, also unless normals and edges are one per point, DegenerateInputError
  // for samples that enclose nothing, Cancelled.
  WallThickness thickness(const ThicknessInput& input, const ThicknessOptions& options = {},
                          Progress* progress = nullptr) const;
  // Returns the places where the points are too sparse for the topology of the faces on which they
  // lie. `normals` are one per point, outward, zero where there is none; `reach` is the distance
  // from each point to the farthest place of the faces that it may be the nearest of. Throws
  // InvalidInputError, Cancelled.
  Doubts doubts(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                std::span<const Vec3> normals, std::span<const double> reach,
                Progress* progress = nullptr) const;
  // Returns the boundary between inner cells and others, as rows. Throws InvalidInputError for
  // sides none.
  std::vector<Triangle> solid_triangles() const;

  // Returns all Delaunay edges as input rows p < q in lexicographic order; significance and side
  // have the same order.
  std::vector<Edge> edge_rows() const;
  std::vector<double> theta(Rule rule) const;
  std::vector<double> rho(Rule rule) const;
  std::vector<Side> edge_sides() const;
  std::vector<uint8_t> edges_bounded() const;

  std::vector<int32_t> sample_rows() const;  // ascending
  int64_t duplicates() const;                // rows merged into an earlier one
  size_t bytes() const;                      // memory of the analysis
  int64_t finite_cells() const;
  bool closed() const;
  int64_t boundary_edges() const;
  SidesFrom sides_from() const;
  // Returns the share of the samples whose labelled poles lie on two sides for which Tight Cocone
  // disagrees; none unless Automatic had to choose between the two.
  std::optional<double> pole_disagreement() const;
  // Returns null unless the sides are from Tight Cocone; its own `sides` are moved out.
  const std::shared_ptr<const WatertightSurface>& tight_cocone() const;
  const Timings& timings() const;

  // Parts are the results of the stages, for the library itself.
  struct Parts;
  const Parts& parts() const { return *parts_; }

 private:
  std::unique_ptr<const Parts> parts_;
};

}  // namespace medial
