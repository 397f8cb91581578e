// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/face_set.h"

#include <algorithm>

namespace medial {

FaceSet from_both_sides(const Triangulation& t, const FaceSet& set, const Run& run) {
  FaceSet both(t);
  parallel_for(t.cell_count(), run, [&](int64_t c) {
    const auto cell = static_cast<int32_t>(c);
    for_faces_of(cell, set, [&](const CellFace& f) {
      both.insert_shared(f);
      both.insert_shared(mirror(t, f));
    });
  });
  return both;
}

void insert_both(const Triangulation& t, FaceSet& set, const CellFace& f) {
  set.insert(f);
  set.insert(mirror(t, f));
}

void erase_both(const Triangulation& t, FaceSet& set, const CellFace& f) {
  set.erase(f);
  set.erase(mirror(t, f));
}

void walk_about_vertex(const Triangulation& t, const FaceSet& set, const CellFace& start, int32_t p,
                       std::vector<CellFace>& steps) {
  steps.clear();
  CellFace f = start;
  int32_t link = link_of(corners(t, start), p)[0];
  do {
    steps.push_back(f);
    f = next_about_edge(t, set, f, p, link);
    link = third_corner(t, f, p, link);
  } while (!(f == start));
}

bool put_in_cycle(std::vector<Edge>& links) {
  if (links.size() < 3) return false;
  for (size_t i = 0; i + 1 < links.size(); ++i) {
    const int32_t end = links[i][1];
    const auto rest = links.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    const auto next =
        std::find_if(rest, links.end(), [&](const Edge& e) { return e[0] == end || e[1] == end; });
    if (next == links.end()) return false;
    if ((*next)[0] != end) std::swap((*next)[0], (*next)[1]);
    std::swap(*rest, *next);
    for (size_t j = 0; j <= i; ++j) {
      if (links[j][0] == end) return false;
    }
  }
  return links.back()[1] == links.front()[0];
}

bool is_one_disc(const Triangulation& t, std::span<const CellFace> faces, int32_t p,
                 std::vector<Edge>& links) {
  links.clear();
  for (const CellFace& f : faces) links.push_back(link_of(corners(t, f), p));
  return put_in_cycle(links);
}

}  // namespace medial
