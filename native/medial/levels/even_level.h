// SPDX-License-Identifier: GPL-3.0-or-later
// Writes an even mesh into the level that it was made of.
#pragma once

#include "levels/level.h"
#include "remesh/even_mesh.h"

namespace medial {

// share of the diagonal that a chord misses a curved sheet by, at most
inline constexpr double kChord = 1e-3;  // chosen: axis
// the same for creases, whose corners stand out against the background
inline constexpr double kChordOfLine = 0.3 * kChord;  // chosen: axis

// Triangles are in the order of their facets, and vertices in the order in which triangles, wires
// and points first use them. The sources of the mesh are facets of the level, its origins vertices.
// A vertex that moved has the given radius if its ball touches the faces, else the distance to the
// samples. `placing` and `radius` are per vertex of the mesh, or empty.
EvenVertices write_even(const EvenMesh& even, std::span<const Placing> placing,
                        std::span<const double> radius, const Hierarchy::Parts& hierarchy,
                        Level& level, const Run& run);

}  // namespace medial
