// SPDX-License-Identifier: GPL-3.0-or-later
// Where the samples of an analysis lie on the faces, and which pairs of them lie on the two sides
// of a sharp convex edge.
#pragma once

#include "axis/selection.h"
#include "base/point_tree.h"
#include "delaunay/samples.h"
#include "walls/convex_creases.h"

namespace medial {

// Marks of Delaunay edges that decide before the thresholds do.
enum class EdgeMark : uint8_t { none, into_crease, at_crease, between_partners };

class SamplesOnFaces {
 public:
  // The faces must outlive this object; `spacing` is per sample. Throws InvalidInputError unless
  // there is a face, or -1, per row of the samples.
  SamplesOnFaces(const FacesInput& input, const Faces& faces, const Samples& samples,
                 std::span<const double> spacing, const Run& run);

  const Faces& faces() const { return faces_; }
  const ConvexCreases& creases() const { return creases_; }
  int64_t count() const { return static_cast<int64_t>(triangle_.size()); }
  const Vec3& point(int32_t sample) const { return tree_[sample]; }
  double spacing(int32_t sample) const { return spacing_[sample]; }
  // Returns the triangle of the mesh on which a sample lies, or -1.
  int32_t triangle(int32_t sample) const {
    return sample < static_cast<int32_t>(triangle_.size()) ? triangle_[sample] : -1;
  }
  // Returns the place of the convex crease in which the tangent planes at two samples meet, as near
  // to `at` as possible; nothing if they do not meet in one. If one sample is on a crease, it is
  // the place of this sample.
  std::optional<PlaceOnCrease> crease_between(const Edge& samples, const Vec3& at) const;
  EdgeMark mark(const Edge& samples) const;
  // Returns whether a sample is near a place of the faces. Where none is, the faces do not bound
  // the solid: they are inside it, or doubled.
  bool are_near(const Vec3& place) const;
  // Returns the radius of a ball, or the distance to the faces if that is less. Balls between
  // samples leave faces that are closer to each other than the samples are, and would be two times
  // too large.
  double within_faces(const Vec3& centre, double radius) const;
  // Returns the hole at the sample nearest to a place.
  double hole_near(const Vec3& place) const { return spacing_[tree_.nearest(place).id]; }
  // Returns the cosine of the sharp angle.
  double most_alike() const { return most_alike_; }
  // Returns the triangle on which the sample nearest to a place lies, or -1.
  int32_t triangle_near(const Vec3& place) const { return triangle(tree_.nearest(place).id); }
  size_t bytes() const;

 private:
  void place(int32_t sample, int32_t triangle);
  // Returns whether the sides of a crease are walls with these normals. Tangent planes of round
  // walls also meet far from where the walls themselves do.
  bool lies_between(int32_t crease, const Vec3& n, const Vec3& m) const;
  // Returns whether two samples lie on reflex edges with walls that face each other, as those round
  // the line in which two walls cross. Neither sample satisfies the Angle condition, since its
  // umbrella has triangles of the other wall, too.
  bool are_opposite_reflex_edges(const Edge& samples) const;
  // Returns the place nearest to `at` in which planes with these normals at two samples meet;
  // nothing if they do not meet in a convex edge.
  std::optional<Vec3> meeting_of_planes(const Edge& samples, const Vec3& n, const Vec3& m,
                                        const Vec3& at) const;

  const Faces& faces_;
  ConvexCreases creases_;
  std::vector<double> spacing_;
  PointTree tree_;
  double reach_ = 0;
  double most_alike_ = 0;  // the cosine of the sharp angle
  std::vector<int32_t> triangle_;
  std::vector<std::array<Vec3, 2>> normals_;  // on a reflex edge those of both sides; else one
  std::vector<uint8_t> on_crease_;
};

// Returns the marks of all Delaunay edges: those into a crease are selected, those at a crease are
// not.
std::vector<EdgeMark> crease_marks(const SamplesOnFaces& samples, const Edges& edges,
                                   const Run& run);

}  // namespace medial
