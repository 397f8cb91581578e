// SPDX-License-Identifier: GPL-3.0-or-later
// Lengths between walls, at the samples: how thick the solid is there, or how wide the gap.
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

// The properties of the samples besides their places.
struct ThicknessInput {
  // Outward, one per point, of any length; what has none, or a zero one, is not measured but
  // filled. Not for scan.
  std::span<const Vec3> normals;
  // Whether a point is on a sharp edge, where the mean of the normals is none of a wall: it is
  // filled. None: no point is.
  std::optional<std::span<const uint8_t>> at_edge = {};
};

// The mode of the measurement, and the side.
struct ThicknessOptions {
  ThicknessMode mode = ThicknessMode::wall;
  Side side = Side::inner;     // outer: the gap between walls
  Thresholds thresholds = {};  // of the facets, for wall and ball
};

// Per sample, ascending by row.
struct WallThickness {
  std::vector<double> values;     // infinite where there is no wall, or no ball
  std::vector<uint8_t> measured;  // whether at the sample itself; else filled, or infinite
};

}  // namespace medial
