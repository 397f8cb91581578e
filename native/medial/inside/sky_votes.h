// SPDX-License-Identifier: GPL-3.0-or-later
// Asks rays which side of a patch of faces is outside (Takayama, Jacobson, Kavan & Sorkine-Hornung,
// "A simple method for correcting facet orientations in polygon meshes based on ray casting",
// 2014).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/run.h"
#include "inside/face_patches.h"

namespace medial {

// Counts rays from both sides of a patch; front is the side to which its first face looks.
struct SkyVotes {
  int64_t rays = 0;                       // from each side
  int64_t front = 0, back = 0;            // rays that meet no face
  int64_t even_front = 0, even_back = 0;  // rays that meet an even number of faces

  // Returns whether one side sees more of the sky than the other, and not by chance.
  bool decided() const;
  // Returns whether one side sees most of the sky, and the other nearly none of it.
  bool clear() const;
};

// Returns the votes of each patch. Their places lie evenly in the area of the patch, more of them
// on larger patches. The parity is only asked on patches that do not decide by the sky.
std::vector<SkyVotes> sky_votes(const FacePatches& patches, std::span<const Vec3> vertices,
                                const Run& run);

}  // namespace medial
