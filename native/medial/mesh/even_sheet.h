// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the triangles of a sheet even.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/run.h"
#include "base/triangle.h"
#include "base/vec3.h"

namespace medial {

struct EvenSheet {
  std::vector<Vec3> rows;
  std::vector<int32_t> given;  // the given row that each is, -1 for new ones
  std::vector<Triangle> triangles;
};

// Remeshes a sheet to nearly equilateral triangles of an edge length (Botsch & Kobbelt 2004, by
// CGAL); new rows lie on the given triangles. Border edges, and edges at which the sheet turns by
// more than 45 degrees, stay: none may be longer than 4/3 of the length. Returns nothing if an edge
// has more than two triangles or its two triangles turn opposite ways.
std::optional<EvenSheet> even_sheet(std::span<const Vec3> rows, std::span<const Triangle> triangles,
                                    double length, const Run& run);

}  // namespace medial
