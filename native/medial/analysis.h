// MEDIAL(P): everything that does not depend on the thresholds, computed once; the axis, extracted
// as often as one likes.
#pragma once

#include <memory>
#include <optional>

#include "axis/feature_size.h"
#include "axis/medial_mesh.h"
#include "axis/selection.h"
#include "cocone/watertight_surface.h"

namespace medial {

struct AnalysisInput {
  std::span<const Vec3> points;                        // samples of the surface
  std::span<const Triangle> triangles = {};            // its outward faces, as rows of `vertices`
  std::optional<std::span<const Vec3>> normals = {};   // outward, one per point
  std::optional<std::span<const Vec3>> vertices = {};  // none: `points`
};

struct AnalysisOptions {
  SidesFrom sides = SidesFrom::automatic;
  CoconeOptions cocone = {};
  bool bounding_sphere = false;  // sect. 4.2
  int threads = 0;               // 0: all cores
};

// Bytes at the peak of an analysis of so many samples of a surface and an extraction, as measured.
// Facets that are long and thin take up to four times as many.
inline int64_t memory_needed(int64_t points) { return 1400 * points; }

class MedialAnalysis {
 public:
  // Throws InvalidInputError, DegenerateInputError, Cancelled.
  MedialAnalysis(const AnalysisInput& input, const AnalysisOptions& options, Progress* progress);
  // Its arrays lie in its arena, and a move would free that before them.
  MedialAnalysis(const MedialAnalysis&) = delete;
  MedialAnalysis& operator=(const MedialAnalysis&) = delete;

  // Ids of the selected edges: the set F of the paper, facets without area or end included.
  std::vector<int32_t> select(const Extraction& extraction, Progress* progress = nullptr) const;
  // The closure of F.
  MedialMesh extract(const Extraction& extraction, Progress* progress = nullptr) const;

  // Per sample, ascending by row: the largest circumradius in its umbrella, infinite for an empty
  // one.
  std::vector<double> spacing() const;
  // At the samples of `rows`, of all in ascending order when there are none: the distance to the
  // facets of either side that the thresholds select, as feature_size.h has it.
  std::vector<double> feature_size(const Thresholds& thresholds,
                                   std::optional<std::span<const int32_t>> rows = {},
                                   Progress* progress = nullptr) const;
  // The boundary between inner cells and others, as rows. Throws InvalidInputError for sides none.
  std::vector<Triangle> solid_triangles() const;

  // All Delaunay edges as input rows p < q in lexicographic order; significance and side in the
  // same order.
  std::vector<Edge> edge_rows() const;
  std::vector<double> theta(Rule rule) const;
  std::vector<double> rho(Rule rule) const;
  std::vector<Side> edge_sides() const;
  std::vector<uint8_t> edges_bounded() const;

  std::vector<int32_t> sample_rows() const;  // ascending
  int64_t duplicates() const { return duplicates_; }
  size_t bytes() const;  // of memory that it holds
  int64_t finite_cells() const { return triangulation_.finite_cells; }
  bool closed() const { return closed_; }
  int64_t boundary_edges() const { return boundary_edges_; }
  SidesFrom sides_from() const { return sides_from_; }
  // Null unless the sides are from Tight Cocone; its own sides are moved away.
  const std::shared_ptr<const WatertightSurface>& tight_cocone() const { return tight_cocone_; }
  const Timings& timings() const { return timings_; }

 private:
  void tell_sides(const Surface& surface, std::span<const Vec3> vertices,
                  std::span<const Vec3> normals, const Csr<int32_t>& incident,
                  const CoconeOptions& options, const Run& run);
  Selection selection(const Extraction& extraction) const;
  // Edges in lexicographic order of their input rows, and values in that order.
  std::vector<int32_t> edges_by_row() const;
  template <typename T, typename Value>
  std::vector<T> by_row(const Value& value) const;

  int threads_ = 1;
  std::unique_ptr<Arena> arena_;  // goes after all that lies in it
  Samples samples_;
  Triangulation triangulation_;
  Voronoi voronoi_;
  Edges edges_;
  Significance significance_;
  CellSides sides_;
  SidesFrom sides_from_ = SidesFrom::none;
  std::shared_ptr<const WatertightSurface> tight_cocone_;
  int64_t duplicates_ = 0, boundary_edges_ = 0;
  bool closed_ = false;
  Timings timings_;
};

}  // namespace medial
