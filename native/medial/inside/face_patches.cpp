// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/face_patches.h"

#include <algorithm>

#include "base/rows.h"
#include "base/union_find.h"
#include "inside/boundary.h"

namespace medial {
namespace {

// Two faces that share an edge; or one of another number of faces at an edge, and -1.
struct Meeting {
  int32_t first, second;
  bool same_side;  // they use the edge in opposite directions
};

std::vector<Meeting> meetings(std::span<const Triangle> faces, int32_t vertices, const Run& run) {
  const auto fans = rows_containing(faces, vertices, run);
  return append_by_edge<Meeting>(
      faces, fans, run, [](int32_t, std::span<const EdgeUse> uses, std::vector<Meeting>& out) {
        if (uses.size() == 2 && uses[0].triangle != uses[1].triangle) {
          out.push_back({uses[0].triangle, uses[1].triangle, uses[0].forward != uses[1].forward});
        } else {
          for (const EdgeUse& use : uses) out.push_back({use.triangle, -1, false});
        }
      });
}

// Leaves out faces that have the same corners as another one, in any order.
void leave_out_repeated(std::vector<Triangle>& faces, Repeated repeated) {
  std::vector<Triangle> sorted(faces);
  for (Triangle& t : sorted) t = ascending(t);
  std::vector<int32_t> order = all_rows(faces.size());
  std::sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
    return sorted[a] != sorted[b] ? sorted[a] < sorted[b] : a < b;
  });
  for (size_t i = 0, end = 0; i < order.size(); i = end) {
    while (end < order.size() && sorted[order[end]] == sorted[order[i]]) ++end;
    const bool none = repeated == Repeated::first_of_odd && (end - i) % 2 == 0;
    for (size_t k = none ? i : i + 1; k < end; ++k) faces[order[k]].fill(sorted[order[k]][0]);
  }
}

void number_patches(FacePatches& patches, OrientedUnionFind sets) {
  const size_t count = patches.faces.size();
  std::vector<int32_t> number(count, -1);
  patches.patch.assign(count, -1);
  patches.turned.assign(count, 0);
  for (size_t face = 0; face < count; ++face) {
    if (!has_three_corners(patches.faces[face])) continue;
    const auto [root, turned] = sets.find(static_cast<int32_t>(face));
    if (number[root] < 0) number[root] = patches.count++;
    patches.patch[face] = number[root];
    patches.turned[face] = turned ? 1 : 0;
  }
}

}  // namespace

FacePatches face_patches(std::span<const Triangle> triangles,
                         std::span<const int32_t> vertex_of_row, int32_t vertices,
                         Repeated repeated, const Run& run) {
  FacePatches patches;
  patches.faces.reserve(triangles.size());
  for (const auto& [i, j, k] : triangles) {
    const Triangle t{vertex_of_row[i], vertex_of_row[j], vertex_of_row[k]};
    patches.faces.push_back(has_three_corners(t) ? t : Triangle{t[0], t[0], t[0]});
  }
  if (repeated != Repeated::all) leave_out_repeated(patches.faces, repeated);
  std::vector<Triangle> counted(patches.faces);
  for (Triangle& t : counted) {
    if (!has_three_corners(t)) t.fill(-1);
  }
  const auto edges = meetings(counted, vertices, run);
  OrientedUnionFind sets(counted.size());
  patches.closed = !edges.empty();
  for (const auto& [first, second, same_side] : edges) {
    patches.closed = patches.closed && same_side;
    if (second >= 0) sets.unite(first, second, !same_side);
  }
  number_patches(patches, std::move(sets));
  patches.open.assign(static_cast<size_t>(patches.count), 0);
  for (const auto& [first, second, same_side] : edges) {
    if (second < 0) patches.open[patches.patch[first]] = 1;
  }
  return patches;
}

}  // namespace medial
