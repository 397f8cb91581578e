// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the empty ball that touches walls of the faces near a place.
#pragma once

#include "walls/samples_on_faces.h"
#include "walls/touching_ball.h"

namespace medial {

// Holds the walls that a ball touches, by triangles of the mesh.
struct Walls {
  std::array<int32_t, kMostContacts> triangle{-1, -1, -1, -1};
  size_t count = 0;

  std::span<int32_t> all() { return {triangle.data(), count}; }
  bool add(int32_t t) {
    if (count == kMostContacts) return false;
    triangle[count++] = t;
    return true;
  }
  bool operator==(const Walls&) const = default;
};

struct Touch {
  Vec3 position;
  double radius = 0;  // 0: there is no empty ball that touches the walls
  Walls walls{};
  std::array<Vec3, kMostContacts> away{};  // unit directions from the feet
};

// Returns the squared sine of half the angle between the directions to the first two feet.
inline double openness(const std::array<Vec3, kMostContacts>& away) {
  return 0.5 * (1 - dot(away[0], away[1]));
}

// A place, and the largest hole between the samples there, in which lengths are measured.
struct NearPlace {
  Vec3 place;
  double hole;
};

// Finds the ball that touches some walls near a place; the search begins at `start`. A wall that it
// sticks out of is added, up to a number of walls; then
// it takes the place of the one that is seen nearest to it, if `swaps`.
Touch empty_ball(const SamplesOnFaces& samples, const NearPlace& near, const Walls& walls,
                 const Vec3& start, size_t most = kMostContacts, bool swaps = false);
// Finds the ball between two curved walls, without a search of all faces: the ball of a place in a
// Voronoi facet is empty of samples, so a third wall can be in it by no more than what a curved
// face rises between samples. Nothing is found where a wall ends.
Touch smooth_ball(const SamplesOnFaces& samples, const NearPlace& near, Walls walls);
// Returns whether the faces between the two feet of a ball are outside of it, as they are not
// beyond the end of a smooth sheet.
bool is_empty_between(const SamplesOnFaces& samples, const Touch& ball, double hole);
// Returns whether all faces are outside of a ball.
bool is_empty(const SamplesOnFaces& samples, const Touch& ball, double hole);
// A wire that ends at a sheet, as the axis of a cylinder does, ends where the ball touches walls
// all round it and one before it. Returns that ball near one that touches the walls of the sheet;
// `along` is the direction of the wire there. Its radius is 0 where there is none.
Touch wire_end(const SamplesOnFaces& samples, double hole, const Touch& at, const Vec3& along);

}  // namespace medial
