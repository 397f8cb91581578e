// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh of sheets in space, with what its vertices and triangles stand for.
#pragma once

#include <array>
#include <optional>

#include "base/vec3.h"
#include "remesh/sheet_complex.h"

namespace medial {

// Values of EvenMesh::held.
inline constexpr uint8_t kFree = 0, kOnLine = 1, kInCorner = 2, kStill = 3;

// A mesh, and what belongs to its vertices and triangles.
struct EvenMesh {
  SheetComplex mesh;
  std::vector<Vec3> position;   // (v)
  std::vector<double> target;   // (v) wanted length of the edges there
  std::vector<int32_t> origin;  // (v) the vertex of the input that it stands for
  // (v) whether the vertex is held on a line, along which alone it moves and is collapsed, or in a
  // corner of lines, which is a node, or belongs to what stays as it is
  std::vector<uint8_t> held;
  std::vector<int32_t> source;  // (t) the facet of the input that it stands for
  // (t) unit normal, by which turns are judged: of the facet as long as the triangle has none that
  // is worth the name
  std::vector<Vec3> normal;
};

// Returns whether all triangles at a vertex would keep their side if it moved to a place, and no
// sheet would turn by more than 120 degrees at an edge of them at which it does not yet. Triangles
// at the edges to `without` do not count.
bool keeps_sides(const EvenMesh& even, int32_t v, const Vec3& place,
                 std::span<const int32_t> without = {});
// Does the same for the place where a ball touches the faces, at which needles may get flatter: a
// sheet that ends just beside a seam is one, and is right.
bool can_be_placed(const EvenMesh& even, int32_t v, const Vec3& place);
// Returns whether a triangle whose corners have moved since is turned over.
bool is_turned_over(const EvenMesh& even, int32_t triangle);
// Returns whether all triangles at a vertex that has an edge to another one would keep their side
// if it were collapsed into that.
bool turns_none(const EvenMesh& even, int32_t from, int32_t to);
// Returns whether a vertex can be collapsed into another one: the complex allows it, triangles keep
// their side, and no sheet folds.
bool can_collapse(const EvenMesh& even, int32_t from, int32_t to);
// Collapses a vertex into another one; `moved` becomes the triangles that it had.
void collapse(EvenMesh& even, int32_t from, int32_t to, std::vector<int32_t>& moved);
void move(EvenMesh& even, int32_t v, const Vec3& place);
// Adds a triangle on the edges from a corner to two others, the first of which is on a rim, if the
// complex allows it and the sheet that ends there does not fold. Returns whether it did.
bool add_triangle(EvenMesh& even, int32_t corner, int32_t a, int32_t b);
// Does what SheetComplex::compact does; returns the new number of each former vertex, or -1.
std::vector<int32_t> compact(EvenMesh& even);
// Takes over the normal of a triangle whose corners have moved.
void settle_normal(EvenMesh& even, int32_t triangle);
// Returns the normals of the two triangles at an edge as they would be after SheetComplex::flip;
// nothing if one of them would be turned over.
std::optional<std::array<Vec3, 2>> normals_of_flip(const EvenMesh& even, int32_t a, int32_t b);
// Returns the mean direction across the sheet at a vertex, whose triangles may be turned either
// way; unit, or zero.
Vec3 normal_at(const EvenMesh& even, int32_t v);

}  // namespace medial
