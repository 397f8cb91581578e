// SPDX-License-Identifier: GPL-3.0-or-later
// Reads faces as those of a solid: whichever way they were drawn, they look outward.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/run.h"
#include "base/triangle.h"
#include "base/vec3.h"

namespace medial {

// How a face is read.
enum class FaceReading : uint8_t { as_given, turned, repeated, without_corners };

struct OutwardFaces {
  // The rows of each face, outward. A face that repeats another one has three times the same row;
  // one that repeats a corner stays as it is.
  std::vector<Triangle> triangles;
  std::vector<FaceReading> reading;  // of each face
  int32_t patches = 0;
  int32_t unseen = 0;  // patches whose sides see equally much of the sky
};

// Faces that are closed, consistent and outward are returned as they are. Otherwise faces are made
// consistent where two meet at an edge, and each patch is turned such that it looks to the side
// from which more rays escape; an open patch whose faces agree only if nearly all rays say so.
// Patches for which rays do not decide keep the side of most of their faces, or take the other one
// if most of the area that rays decide about is turned; where their own faces differ, they look to
// where rays meet an even number of faces. One of several equal faces stays, or none of an even
// number where this leaves fewer edges open. Nothing is changed that would leave more edges open
// than the faces as they were given, or no face at all. Throws InvalidInputError for a corner
// outside the rows and for rows that are not finite.
OutwardFaces outward_faces(std::span<const Vec3> rows, std::span<const Triangle> triangles,
                           const Run& run);

}  // namespace medial
