// SPDX-License-Identifier: GPL-3.0-or-later
// Rims of sheets that lead into sharp convex edges of the solid end on them, with radius 0.
#pragma once

#include "remesh/even_mesh.h"
#include "walls/samples_on_faces.h"

namespace medial {

// Moves vertices of rims onto creases, where the mesh holds them from then on, and to the corners
// of these, which become nodes. `generators` and `hole` are per facet and per vertex.
void hold_on_creases(EvenMesh& even, const SamplesOnFaces& samples,
                     std::span<const Edge> generators, std::span<const double> hole,
                     std::span<const double> radius, const Run& run);

// Makes one vertex of those that are held at one place, where the mesh keeps its topology by it.
void unite_held(EvenMesh& even);

}  // namespace medial
