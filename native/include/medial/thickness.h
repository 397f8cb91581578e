// SPDX-License-Identifier: GPL-3.0-or-later
// Lengths between walls are measured at the samples: the thickness of the solid there, or the width
// of the gap.
#pragma once

#include <medial/options.h>

#include <optional>
#include <span>

namespace medial {

// The mode chooses the length that is measured at a sample p with the outward unit normal n_p. The
// ball that is tangent at p and touches q has the diameter |pq|^2 / (n_p . (p - q)); the smallest
// one over the selected facets (p, q) fits there.
//   wall  of the balls whose two normals differ by 120 degrees or more, as those of walls that face
//         each other do. Elsewhere, as next to an edge, where the ball shrinks to nothing, that of
//         the nearest wall along the surface, or where none is near that of the largest ball, but
//         never less than the own ball.
//   ball  of all balls: zero at every convex edge.
//   scan  the diameter of the ball that comes nearest to p, of those at the vertices of facets with
//         a theta above kScanTheta at both ends: noise lifts most samples off the balls. No normals
//         are used. It reads what tapers too thick.
enum class ThicknessMode : int32_t { wall = 0, ball = 1, scan = 2 };

inline constexpr double kScanTheta = 5 * std::numbers::pi / 18;  // 50 degrees, above a right edge's

// The input has the properties of the samples except their places.
struct ThicknessInput {
  // The normals point outward, one per point, of any length. Samples with a zero normal are not
  // measured but filled. The mode scan does not use them.
  std::span<const Vec3> normals;
  // This marks points on a sharp edge, where the mean normal belongs to no wall; they are filled.
  // Without it no point is marked.
  std::optional<std::span<const uint8_t>> at_edge = {};
};

// These options choose the mode of the measurement, and the side.
struct ThicknessOptions {
  ThicknessMode mode = ThicknessMode::wall;
  Side side = Side::inner;     // outer: the gap between walls
  Thresholds thresholds = {};  // of the facets, for wall and ball
};

// The result has one row per sample, ascending by row.
struct WallThickness {
  std::vector<double> values;     // infinite where there is no wall, or no ball
  std::vector<uint8_t> measured;  // whether measured at the sample itself; else filled, or infinite
};

}  // namespace medial
