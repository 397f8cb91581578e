// SPDX-License-Identifier: GPL-3.0-or-later
// Divides faces into patches whose faces can be turned to look to the same side.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/run.h"
#include "base/triangle.h"
#include "base/vec3.h"

namespace medial {

// The faces that stay where several have the same corners, whichever way they look.
enum class Repeated {
  all,
  first,
  first_of_odd,  // none of an even number: a wall between two solids, drawn from both sides
};

struct FacePatches {
  // The vertices of each face, distinct rows being one vertex. A face that counts for nothing,
  // because it repeats a corner or another face, has three times the same.
  std::vector<Triangle> faces;
  // The patch of each face, in the order of their first faces; -1 for a face that counts for
  // nothing.
  std::vector<int32_t> patch;
  // Whether a face looks to the other side than the first face of its patch.
  std::vector<uint8_t> turned;
  int32_t count = 0;
  // Whether a patch has an edge that is not between two of its faces.
  std::vector<uint8_t> open;
  // Whether each edge has exactly two faces, which look to the same side: the faces are closed.
  bool closed = false;

  bool counts(size_t face) const { return patch[face] >= 0; }
};

// Faces are in one patch where they share an edge with no third face. A patch that cannot be turned
// to one side, as a Moebius strip, keeps edges at which it looks both ways.
FacePatches face_patches(std::span<const Triangle> triangles,
                         std::span<const int32_t> vertex_of_row, int32_t vertices,
                         Repeated repeated, const Run& run);

}  // namespace medial
