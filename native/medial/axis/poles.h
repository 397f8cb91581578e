// SPDX-License-Identifier: GPL-3.0-or-later
// This computes poles (Dey & Zhao, Definition 1).
#pragma once

#include "delaunay/edges.h"
#include "delaunay/voronoi.h"

namespace medial {

struct Poles {
  // The pole vector is v_p = p+ - p; for an unbounded cell it is the mean direction of the infinite
  // edges.
  Array<Vec3> vector;
  Array<uint8_t> unbounded;  // the pole is at infinity
};

// Returns the pole vector of one sample, whose cells are `cells`; `room` is a scratch buffer.
Vec3 pole(const Vec3& p, std::span<const int32_t> cells, const Triangulation& triangulation,
          const Voronoi& voronoi, std::vector<int32_t>& room);

// Returns the poles of all samples; `incident` is the result of incident_cells.
Poles poles(std::span<const Vec3> points, const Triangulation& triangulation,
            const Voronoi& voronoi, const Csr<int32_t>& incident, const Run& run);

}  // namespace medial
