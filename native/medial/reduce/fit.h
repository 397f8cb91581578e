// SPDX-License-Identifier: GPL-3.0-or-later
// Moves the spheres of a mesh such that its solid comes near to places on a surface.
#pragma once

#include <medial/sphere_mesh.h>

#include <span>

#include "base/run.h"
#include "reduce/tangent_places.h"

namespace medial {

// Moves the spheres of a mesh, in a unit near its extent. A sphere, as (x, y, z, r), changes by at
// most half of its radius. Returns false, and leaves all spheres as they are, if no step brings
// them nearer.
bool fit_spheres(SphereMesh& mesh, std::span<const TangentPlace> places, const Run& run);

}  // namespace medial
