// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh/sheet_complex.h"

#include <algorithm>

#include "base/rows.h"
#include "base/short_list.h"
#include "base/sort_unique.h"

namespace medial {

SheetComplex::SheetComplex(int32_t vertices, std::vector<Triangle> triangles,
                           std::span<const Edge> wires, std::span<const uint8_t> is_node)
    : triangles_(std::move(triangles)),
      first_(vertices, -1),
      next_(3 * triangles_.size()),
      before_(3 * triangles_.size()),
      stratum_(vertices, Stratum::node),
      stays_(is_node.begin(), is_node.end()),
      mark_(vertices, 0) {
  for (const auto& [a, b] : wires) {
    wires_.push_back({a, b});
    wires_.push_back({b, a});
  }
  std::sort(wires_.begin(), wires_.end());
  for (const Edge& wire : wires_) stays_[wire[0]] = 1;
  for (int32_t c = 3 * this->triangles() - 1; c >= 0; --c) link(c);
  for (int32_t v = 0; v < vertices; ++v) {
    if (!stays_[v]) stratum_[v] = find_stratum(v);
  }
}

void SheetComplex::link(int32_t corner) {
  int32_t& first = first_[triangles_[corner / 3][corner % 3]];
  next_[corner] = first;
  before_[corner] = -1;
  if (first >= 0) before_[first] = corner;
  first = corner;
}

void SheetComplex::unlink(int32_t corner) {
  const int32_t next = next_[corner], before = before_[corner];
  if (next >= 0) before_[next] = before;
  (before >= 0 ? next_[before] : first_[triangles_[corner / 3][corner % 3]]) = next;
}

void SheetComplex::replace_corner(int32_t t, int32_t from, int32_t to) {
  const int32_t corner = 3 * t + corner_of(triangles_[t], from);
  unlink(corner);
  triangles_[t][corner % 3] = to;
  link(corner);
}

int SheetComplex::uses(int32_t a, int32_t b) const {
  int count = 0;
  for_corners(a, [&](int32_t other) { count += other == b; });
  return count;
}

const std::vector<int32_t>& SheetComplex::triangles_at(int32_t a, int32_t b) const {
  at_edge_.clear();
  for_triangles(a, [&](int32_t t) {
    const Edge others = link_of(triangles_[t], a);
    if (others[0] == b || others[1] == b) at_edge_.push_back(t);
  });
  return at_edge_;
}

int32_t SheetComplex::across(int32_t t, int32_t a, int32_t b) const {
  int32_t found = -1;
  for (int32_t c = first_[a]; c >= 0; c = next_[c]) {
    const Triangle& corners = triangles_[c / 3];
    if (c / 3 == t || (corners[0] != b && corners[1] != b && corners[2] != b)) continue;
    if (found >= 0) return -1;
    found = c / 3;
  }
  return found;
}

std::vector<int32_t> SheetComplex::curve_neighbours(int32_t v) const {
  ShortList<int32_t> all;
  std::vector<int32_t> found;
  for_corners(v, [&](int32_t other) { all.push_back(other); });
  std::sort(all.begin(), all.end());
  for (size_t i = 0, end = 0; i < all.size(); i = end) {
    while (end < all.size() && all[end] == all[i]) ++end;
    if (end - i != 2) found.push_back(all[i]);
  }
  return found;
}

Edge SheetComplex::along_curve(int32_t v) const {
  Edge ends{-1, -1};
  for_corners(v, [&](int32_t other) {
    if (other == ends[0] || other == ends[1] || uses(v, other) == 2) return;
    ends[ends[0] >= 0] = other;
  });
  return {std::min(ends[0], ends[1]), std::max(ends[0], ends[1])};
}

Stratum SheetComplex::find_stratum(int32_t v) const {
  if (!has_triangles(v)) return Stratum::node;
  const auto ends = curve_neighbours(v);
  if (ends.empty()) return link_is_circle(v) ? Stratum::sheet : Stratum::node;
  if (ends.size() != 2) return Stratum::node;
  return link_is_arcs(v, ends[0], ends[1]) ? Stratum::curve : Stratum::node;
}

namespace {

using Link = ShortList<Edge>;

// Goes along the edges of a link from `at` to `to`, or until no edge is left. Returns how many
// edges it went along, and takes them out of the list.
int go_along(Link& edges, int32_t at, int32_t to) {
  int count = 0;
  do {
    const auto next = std::find_if(edges.begin(), edges.end(),
                                   [&](const Edge& e) { return e[0] == at || e[1] == at; });
    if (next == edges.end()) return count;
    at = (*next)[0] == at ? (*next)[1] : (*next)[0];
    *next = edges.back();
    edges.pop_back();
    ++count;
  } while (at != to);
  return count;
}

}  // namespace

bool SheetComplex::link_is_circle(int32_t v) const {
  Link edges;
  for_triangles(v, [&](int32_t t) { edges.push_back(link_of(triangles_[t], v)); });
  const int32_t start = link_of(triangles_[first_[v] / 3], v)[0];
  go_along(edges, start, start);
  return edges.empty();
}

bool SheetComplex::link_is_arcs(int32_t v, int32_t from, int32_t to) const {
  Link edges;
  for_triangles(v, [&](int32_t t) { edges.push_back(link_of(triangles_[t], v)); });
  const auto is_at = [](int32_t vertex) {
    return [vertex](const Edge& e) { return e[0] == vertex || e[1] == vertex; };
  };
  const auto arcs = std::count_if(edges.begin(), edges.end(), is_at(from));
  for (std::ptrdiff_t arc = 0; arc < arcs; ++arc) {
    go_along(edges, from, to);
    // An arc that came back to where it began has taken two of its edges.
    if (std::count_if(edges.begin(), edges.end(), is_at(from)) != arcs - arc - 1) return false;
  }
  return edges.empty();
}

std::vector<Edge> SheetComplex::edges() const {
  std::vector<Edge> all;
  std::vector<int32_t> above;
  all.reserve(3 * triangles_.size() / 2);
  for (int32_t v = 0; v < vertices(); ++v) {
    above.clear();
    for_corners(v, [&](int32_t other) {
      if (other > v) above.push_back(other);
    });
    std::sort(above.begin(), above.end());
    const auto end = std::unique(above.begin(), above.end());
    for (auto other = above.begin(); other != end; ++other) all.push_back({v, *other});
  }
  return all;
}

bool SheetComplex::ends_wire(int32_t v) const {
  const auto wire = std::lower_bound(wires_.begin(), wires_.end(), Edge{v, -1});
  return wire != wires_.end() && (*wire)[0] == v;
}

bool SheetComplex::is_wired(int32_t a, int32_t b) const {
  return std::binary_search(wires_.begin(), wires_.end(), Edge{a, b});
}

bool SheetComplex::has_triangle(int32_t a, int32_t b, int32_t c) const {
  bool found = false;
  for_triangles(a, [&](int32_t t) {
    const Edge e = link_of(triangles_[t], a);
    found = found || (e[0] == b && e[1] == c) || (e[0] == c && e[1] == b);
  });
  return found;
}

// Where a vertex goes along its curve, an edge from it to a third vertex falls together with the
// edge from there to the other end. Where both are parts of curves, the triangle between them was a
// whole sheet, smaller than the edges shall be, and the two curves become one, but for the last
// triangle between three rims.
bool SheetComplex::loses_sheet(int32_t from, int32_t to) const {
  return std::ranges::any_of(triangles_at(from, to), [&](int32_t t) {
    const int32_t third = third_corner(t, from, to);
    return uses(from, third) == 1 && uses(to, third) == 1;
  });
}

bool SheetComplex::can_collapse(int32_t from, int32_t to) const {
  if (stays_[from] || stratum_[from] > stratum_[to]) return false;
  const int at_edge = uses(from, to);
  if (at_edge == 0 || (stratum_[from] != Stratum::sheet && at_edge == 2)) return false;
  return links_have_in_common(from, to, at_edge) &&
         (stratum_[from] == Stratum::sheet || !loses_sheet(from, to));
}

bool SheetComplex::can_unite(int32_t from, int32_t to) const {
  if (stratum_[from] == Stratum::sheet || ends_wire(from) || ends_wire(to)) return false;
  return links_have_in_common(from, to, std::max(uses(from, to), 1)) && !loses_sheet(from, to);
}

// The link condition: the links of the two ends have in common what the link of the edge is, which
// is the third corners of the triangles at it. For any complex the collapse of such an edge keeps
// the homotopy type (Dey, Edelsbrunner, Guha and Nekhayev 1999; Attali, Lieutier and Salinas 2011).
bool SheetComplex::links_have_in_common(int32_t from, int32_t to, int at_edge) const {
  const uint32_t beside = newest_mark_ + 1, common = newest_mark_ += 2;
  for_corners(from, [&](int32_t other) { mark_[other] = beside; });
  int count = 0;
  const auto find_common = [&](int32_t other) {
    if (mark_[other] != beside || other == to) return;
    mark_[other] = common;
    ++count;
  };
  for_corners(to, find_common);
  auto wire = std::lower_bound(wires_.begin(), wires_.end(), Edge{to, -1});
  for (; wire != wires_.end() && (*wire)[0] == to; ++wire) find_common((*wire)[1]);
  if (count != at_edge) return false;
  bool closes = false;
  for_triangles(from, [&](int32_t t) {
    const auto& [a, b] = link_of(triangles_[t], from);
    closes = closes || (mark_[a] == common && mark_[b] == common && has_triangle(to, a, b));
  });
  return !closes;
}

void SheetComplex::collapse(int32_t from, int32_t to) {
  const bool is_inside = stratum_[from] == Stratum::sheet;
  for (const int32_t t : triangles_at(from, to)) {
    for (int i = 0; i < 3; ++i) unlink(3 * t + i);
    triangles_[t] = {-1, -1, -1};
  }
  while (first_[from] >= 0) replace_corner(first_[from] / 3, from, to);
  if (is_inside) return;
  std::vector<int32_t> beside{to};
  for_corners(to, [&](int32_t other) { beside.push_back(other); });
  sort_unique(beside);
  for (const int32_t v : beside) {
    if (!stays_[v]) stratum_[v] = find_stratum(v);
  }
}

bool SheetComplex::can_flip(int32_t a, int32_t b) const {
  const auto& two = triangles_at(a, b);
  if (two.size() != 2) return false;
  const int32_t c = third_corner(two[0], a, b), d = third_corner(two[1], a, b);
  return uses(c, d) == 0 && !is_wired(c, d);
}

void SheetComplex::flip(int32_t a, int32_t b) {
  const int32_t s = triangles_at(a, b)[0], t = at_edge_[1];
  const int32_t c = third_corner(s, a, b), d = third_corner(t, a, b);
  replace_corner(s, b, d);
  replace_corner(t, a, c);
}

int32_t SheetComplex::split(int32_t a, int32_t b, std::vector<int32_t>& split_off) {
  const auto middle = static_cast<int32_t>(first_.size());
  const std::vector<int32_t> at_edge = triangles_at(a, b);
  first_.push_back(-1);
  mark_.push_back(0);
  stays_.push_back(0);
  stratum_.push_back(at_edge.size() == 2 ? Stratum::sheet : Stratum::curve);
  split_off.clear();
  for (const int32_t t : at_edge) {
    Triangle other = triangles_[t];
    other[corner_of(other, a)] = middle;
    replace_corner(t, b, middle);
    split_off.push_back(append(other));
  }
  return middle;
}

int32_t SheetComplex::append(const Triangle& triangle) {
  const int32_t t = triangles();
  triangles_.push_back(triangle);
  next_.resize(next_.size() + 3);
  before_.resize(before_.size() + 3);
  for (int i = 0; i < 3; ++i) link(3 * t + i);
  return t;
}

void SheetComplex::add(const Triangle& triangle) {
  append(triangle);
  for (const int32_t v : triangle) {
    if (!stays_[v]) stratum_[v] = find_stratum(v);
  }
}

Kept SheetComplex::compact() {
  Kept kept{
      rows_where(vertices(), [&](int32_t v) { return has_triangles(v) || stays(v); }),
      rows_where(triangles(), [&](int32_t t) { return !is_gone(t); }),
      {},
  };
  kept.number = places_among(kept.vertices, vertices());
  const auto triangle = places_among(kept.triangles, triangles());
  const auto corner = [&](int32_t c) { return c < 0 ? c : 3 * triangle[c / 3] + c % 3; };
  for (size_t t = 0; t < kept.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const int32_t before = 3 * kept.triangles[t] + i;
      next_[3 * t + i] = corner(next_[before]);
      before_[3 * t + i] = corner(before_[before]);
      triangles_[t][i] = kept.number[triangles_[kept.triangles[t]][i]];
    }
  }
  for (size_t v = 0; v < kept.vertices.size(); ++v) {
    first_[v] = corner(first_[kept.vertices[v]]);
  }
  stratum_ = rows_of(stratum_, kept.vertices);
  stays_ = rows_of(stays_, kept.vertices);
  for (auto* of_corners : {&next_, &before_}) of_corners->resize(3 * kept.triangles.size());
  triangles_.resize(kept.triangles.size());
  first_.resize(kept.vertices.size());
  mark_.assign(kept.vertices.size(), 0);
  for (auto& [a, b] : wires_) a = kept.number[a], b = kept.number[b];
  return kept;
}

}  // namespace medial
