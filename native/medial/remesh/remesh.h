// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the triangles of sheets even: edges get a wanted length, by splits, collapses, flips and
// tangential smoothing (Botsch and Kobbelt 2004). Topology and strata stay.
#pragma once

#include <functional>

#include "base/run.h"
#include "remesh/even_mesh.h"

namespace medial {

// An edge longer than the first share of its target is split, one shorter than the second share is
// collapsed, so that neither makes work for the other (Botsch and Kobbelt 2004).
inline constexpr double kLong = 4.0 / 3, kShort = 4.0 / 5;  // derived: neither makes work

// An edge runs along a line if the line misses its middle by no more than this share of it: an arc
// of 28 degrees rises by that.
inline constexpr double kRise = 1.0 / 16;  // chosen: axis

// Returns the nearest place of some lines if it is nearer than a distance.
using OntoLine = std::function<std::optional<Vec3>(const Vec3& from, double than)>;

struct RemeshOptions {
  // Curves move to the middle of their neighbours, too, which takes the zigzag of samples off them;
  // else vertices of curves move along them only.
  bool moves_curves = false;
  double chord = 0;    // the distance that an edge along a line may miss it by
  OntoLine onto_line;  // the lines on which vertices are held
};

// Merges vertices inside sheets with vertices that are nearer than `within`, (v), nearest first:
// they are one place, as far as the samples tell. Triangles keep their sides.
void merge_close(EvenMesh& even, std::span<const double> within);

// Splits, collapses, flips and smooths once.
void remesh(EvenMesh& even, const RemeshOptions& options, const Run& run);

}  // namespace medial
