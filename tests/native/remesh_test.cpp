// SPDX-License-Identifier: GPL-3.0-or-later
// Changes of a complex of sheets, against Betti numbers that are counted by ranks of boundary
// matrices, and even meshes of plane sheets.
#include "remesh/remesh.h"

#include <gtest/gtest.h>

#include <bitset>
#include <map>
#include <numbers>
#include <set>

#include "base/random.h"
#include "remesh/target_length.h"

namespace medial {
namespace {

using Row = std::bitset<1024>;

int rank_modulo_2(std::vector<Row> rows) {
  int rank = 0;
  for (size_t column = 0; column < Row{}.size() && rank < static_cast<int>(rows.size()); ++column) {
    const auto pivot = std::find_if(rows.begin() + rank, rows.end(),
                                    [column](const Row& row) { return row[column]; });
    if (pivot == rows.end()) continue;
    std::swap(rows[rank], *pivot);
    for (size_t r = rank + 1; r < rows.size(); ++r) {
      if (rows[r][column]) rows[r] ^= rows[rank];
    }
    ++rank;
  }
  return rank;
}

Edge in_order(int32_t a, int32_t b) { return {std::min(a, b), std::max(a, b)}; }

std::vector<Triangle> left_of(const SheetComplex& mesh) {
  std::vector<Triangle> left;
  for (int32_t t = 0; t < mesh.triangles(); ++t) {
    if (!mesh.is_gone(t)) left.push_back(mesh.triangle(t));
  }
  return left;
}

// Returns pieces, loops and cavities of triangles and wires, with coefficients modulo 2.
std::array<int, 3> betti_numbers(const std::vector<Triangle>& triangles,
                                 std::span<const Edge> wires) {
  std::map<Edge, int> edges;
  std::map<int32_t, int> vertices;
  const auto add = [&](int32_t a, int32_t b) {
    edges.try_emplace(in_order(a, b), static_cast<int>(edges.size()));
    for (const int32_t v : {a, b}) vertices.try_emplace(v, static_cast<int>(vertices.size()));
  };
  for (const Triangle& t : triangles) {
    for (int i = 0; i < 3; ++i) add(t[i], t[(i + 1) % 3]);
  }
  for (const auto& [a, b] : wires) add(a, b);
  std::vector<Row> of_edges(edges.size()), of_triangles(triangles.size());
  for (const auto& [ends, e] : edges) {
    for (const int32_t v : ends) of_edges[e][vertices.at(v)] = true;
  }
  for (size_t t = 0; t < triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      of_triangles[t][edges.at(in_order(triangles[t][i], triangles[t][(i + 1) % 3]))] = true;
    }
  }
  const int one = rank_modulo_2(of_edges), two = rank_modulo_2(of_triangles);
  return {static_cast<int>(vertices.size()) - one, static_cast<int>(edges.size()) - one - two,
          static_cast<int>(triangles.size()) - two};
}

class Numbers {
 public:
  explicit Numbers(uint64_t seed) : state_(scrambled(seed)) {}
  double next() { return unit(state_ = scrambled(state_)); }
  int32_t below(int32_t count) { return static_cast<int32_t>(next() * count); }

 private:
  uint64_t state_;
};

// Some unit squares of a lattice, each of eight triangles: sheets that meet, end and enclose.
struct LatticeSquares {
  std::vector<Triangle> triangles;
  std::vector<Vec3> places;
  std::vector<Edge> wires;
  std::map<std::array<int, 3>, int32_t> number;

  explicit LatticeSquares(Numbers& random) {
    const double share = 0.2 + 0.7 * random.next();
    for (int axis = 0; axis < 3; ++axis) {
      for (int x = 0; x < 3; ++x) {
        for (int y = 0; y < 2; ++y) {
          for (int z = 0; z < 2; ++z) {
            if (random.next() < share) add({x, y, z}, axis);
          }
        }
      }
    }
  }

  int32_t vertex(const std::array<int, 3>& at) {
    const auto [found, is_new] = number.try_emplace(at, static_cast<int32_t>(places.size()));
    if (is_new) places.push_back({0.5 * at[0], 0.5 * at[1], 0.5 * at[2]});
    return found->second;
  }

  void add(const std::array<int, 3>& corner, int axis) {
    const int one = (axis + 1) % 3, two = (axis + 2) % 3;
    const auto at = [&](int i, int j) {
      std::array<int, 3> place{2 * corner[0], 2 * corner[1], 2 * corner[2]};
      place[one] += i;
      place[two] += j;
      return vertex(place);
    };
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }

  bool has_edge(int32_t a, int32_t b) const {
    return std::any_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
      return std::count(t.begin(), t.end(), a) + std::count(t.begin(), t.end(), b) == 2;
    });
  }

  void add_wires(Numbers& random) {
    const auto count = static_cast<int32_t>(places.size());
    std::set<Edge> made;
    for (int i = 0; i < 4 && count > 1; ++i) {
      const Edge wire = in_order(random.below(count), random.below(count));
      if (wire[0] != wire[1] && !has_edge(wire[0], wire[1])) made.insert(wire);
    }
    wires.assign(made.begin(), made.end());
  }

  SheetComplex complex() const {
    const std::vector<uint8_t> is_node(places.size(), 0);
    return {static_cast<int32_t>(places.size()), triangles, wires, is_node};
  }
};

// Strata that are remembered are those that the triangles have; a node may have become less.
void expect_strata(const SheetComplex& mesh, std::span<const Edge> wires) {
  const std::vector<uint8_t> is_node(mesh.vertices(), 0);
  const SheetComplex again(mesh.vertices(), left_of(mesh), wires, is_node);
  for (int32_t v = 0; v < mesh.vertices(); ++v) {
    if (!mesh.has_triangles(v) || mesh.stratum(v) == Stratum::node) continue;
    EXPECT_EQ(mesh.stratum(v), again.stratum(v)) << v;
  }
}

// Goes through all edges once, from a random one on, and returns how many collapsed.
int collapse_some(SheetComplex& mesh, Numbers& random) {
  auto edges = mesh.edges();
  if (edges.empty()) return 0;
  std::rotate(edges.begin(), edges.begin() + random.below(static_cast<int32_t>(edges.size())),
              edges.end());
  int done = 0;
  for (const auto& [a, b] : edges) {
    const bool back = random.next() < 0.5;
    const int32_t from = back ? b : a, to = back ? a : b;
    if (!mesh.can_collapse(from, to)) continue;
    EXPECT_LE(mesh.stratum(from), mesh.stratum(to));
    mesh.collapse(from, to);
    ++done;
  }
  return done;
}

// Calls change(mesh, wires, random) for many meshes, every second of them with wires.
template <typename Change>
void expect_kept(uint64_t seeds, const Change& change) {
  for (uint64_t seed = 0; seed < seeds; ++seed) {
    Numbers random(seed);
    LatticeSquares squares(random);
    if (seed % 2) squares.add_wires(random);
    SheetComplex mesh = squares.complex();
    const auto before = betti_numbers(squares.triangles, squares.wires);
    change(mesh, squares.wires, random);
    expect_strata(mesh, squares.wires);
    ASSERT_EQ(betti_numbers(left_of(mesh), squares.wires), before) << seed;
  }
}

TEST(SheetComplex, CollapsesKeepBettiNumbersAndStrata) {
  int64_t collapses = 0;
  expect_kept(2000, [&](SheetComplex& mesh, const auto& wires, Numbers& random) {
    for (int pass = 0; pass < 6; ++pass) {
      collapses += collapse_some(mesh, random);
      expect_strata(mesh, wires);
    }
  });
  EXPECT_GT(collapses, 20'000);
}

// Vertices of one place may have an edge between them, or a slit of no width.
TEST(SheetComplex, VerticesOfOnePlaceUniteAndKeepBettiNumbersAndStrata) {
  int with_edge = 0, without = 0;
  expect_kept(2000, [&](SheetComplex& mesh, const auto&, Numbers& random) {
    for (int i = 0; i < 200; ++i) {
      const int32_t from = random.below(mesh.vertices()), to = random.below(mesh.vertices());
      if (from == to || !mesh.has_triangles(from) || !mesh.has_triangles(to)) continue;
      if (!mesh.can_unite(from, to)) continue;
      ++(mesh.uses(from, to) ? with_edge : without);
      mesh.collapse(from, to);
    }
  });
  EXPECT_GT(with_edge, 1000);
  EXPECT_GT(without, 1000);
}

TEST(SheetComplex, FlipsAndSplitsKeepBettiNumbersAndStrata) {
  int64_t flips = 0;
  expect_kept(500, [&](SheetComplex& mesh, const auto&, Numbers& random) {
    std::vector<int32_t> halves;
    for (int i = 0; i < 30; ++i) {
      const auto edges = mesh.edges();
      if (edges.empty()) break;
      const auto [a, b] = edges[random.below(static_cast<int32_t>(edges.size()))];
      if (random.next() < 0.2) {
        mesh.split(a, b, halves);
      } else if (mesh.can_flip(a, b)) {
        mesh.flip(a, b);
        ++flips;
      }
    }
  });
  EXPECT_GT(flips, 2000);
}

TEST(SheetComplex, TrianglesThatFillNotchesKeepBettiNumbersAndStrata) {
  int64_t added = 0;
  expect_kept(500, [&](SheetComplex& mesh, const auto&, Numbers& random) {
    for (const auto& [a, b] : mesh.edges()) {
      const int32_t c = random.below(mesh.vertices());
      if (c == b || !mesh.can_add(a, b, c)) continue;
      mesh.add({a, b, c});
      ++added;
    }
  });
  EXPECT_GT(added, 2000);
}

// A compact mesh has the triangles of the other one, at each vertex in the same order, and what can
// be done with that can be done with it.
TEST(SheetComplex, ACompactMeshIsWhatWasLeft) {
  expect_kept(500, [&](const SheetComplex& all, const auto&, Numbers& random) {
    SheetComplex mesh = all;
    collapse_some(mesh, random);
    SheetComplex compact = mesh;
    const auto [vertex, triangle, number] = compact.compact();
    ASSERT_EQ(compact.triangles(), static_cast<int32_t>(left_of(mesh).size()));
    for (int32_t v = 0; v < compact.vertices(); ++v) {
      std::vector<int32_t> expected, found;
      mesh.for_triangles(vertex[v], [&](int32_t t) { expected.push_back(t); });
      compact.for_triangles(v, [&](int32_t t) { found.push_back(triangle[t]); });
      ASSERT_EQ(found, expected);
      ASSERT_EQ(compact.stratum(v), mesh.stratum(vertex[v]));
      ASSERT_EQ(number[vertex[v]], v);
    }
    for (const auto& [a, b] : compact.edges()) {
      ASSERT_EQ(compact.can_collapse(a, b), mesh.can_collapse(vertex[a], vertex[b]));
      ASSERT_EQ(compact.can_flip(a, b), mesh.can_flip(vertex[a], vertex[b]));
    }
  });
}

TEST(SheetComplex, StrataAreThoseOfTheLink) {
  // Three squares at a line: its middle is on a seam, its ends are nodes, and a rim goes round.
  Numbers random(0);
  LatticeSquares book(random);
  book.triangles.clear();
  book.places.clear();
  book.number.clear();
  book.add({1, 0, 0}, 1);
  book.add({0, 0, 0}, 1);
  book.add({1, 0, 0}, 0);
  const SheetComplex mesh = book.complex();
  const auto stratum = [&](int x, int y, int z) { return mesh.stratum(book.number.at({x, y, z})); };
  EXPECT_EQ(stratum(2, 0, 1), Stratum::curve);
  EXPECT_EQ(stratum(2, 0, 0), Stratum::node);
  EXPECT_EQ(stratum(3, 0, 1), Stratum::sheet);
  EXPECT_EQ(stratum(4, 0, 1), Stratum::curve);
}

// A square sheet of so many small squares on a side, whose inner vertices are a little off.
EvenMesh plane_sheet(int side) {
  std::vector<Triangle> triangles;
  std::vector<Vec3> places;
  Numbers random(7);
  const auto at = [side](int i, int j) { return i * (side + 1) + j; };
  for (int i = 0; i <= side; ++i) {
    for (int j = 0; j <= side; ++j) {
      const bool inner = i > 0 && j > 0 && i < side && j < side;
      const double off = inner ? 0.4 / side : 0;
      places.push_back({static_cast<double>(i) / side + off * (random.next() - 0.5),
                        static_cast<double>(j) / side + off * (random.next() - 0.5), 0});
    }
  }
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  std::vector<uint8_t> is_node(places.size(), 0);
  for (const int v : {at(0, 0), at(0, side), at(side, 0), at(side, side)}) is_node[v] = 1;
  const size_t count = triangles.size();
  SheetComplex mesh(static_cast<int32_t>(places.size()), std::move(triangles), {}, is_node);
  std::vector<int32_t> origin(places.size());
  return {std::move(mesh),
          places,
          std::vector<double>(places.size(), 4.0 / side),
          origin,
          std::vector<uint8_t>(places.size(), kFree),
          std::vector<int32_t>(count, 0),
          std::vector<Vec3>(count, Vec3{0, 0, 1})};
}

struct Measured {
  int count = 0;
  double area = 0, least = HUGE_VAL;  // the lowest triangle's height by its longest edge
};

Measured measured(const EvenMesh& even) {
  Measured found;
  for (const auto& [a, b, c] : left_of(even.mesh)) {
    const Vec3 &p = even.position[a], &q = even.position[b], &r = even.position[c];
    const double twice = cross(q - p, r - p).z;
    const double longest = std::max({distance(p, q), distance(q, r), distance(r, p)});
    found.area += twice / 2;
    found.least = std::min(found.least, twice / (longest * longest));
    ++found.count;
  }
  return found;
}

TEST(Remesh, APlaneSheetBecomesEvenAndKeepsItsArea) {
  EvenMesh even = plane_sheet(40);
  for (int round = 0; round < 6; ++round) remesh(even, {}, {});
  const auto [count, area, least] = measured(even);
  EXPECT_NEAR(area, 1, 1e-12);  // nothing is turned over, and the rim is straight
  EXPECT_GT(least, 0.35);
  EXPECT_LT(count, 2 * 40 * 40 / 8);
}

TEST(Remesh, NoTriangleKeepsItsSideAtAPlaceThatIsNoNumber) {
  EvenMesh even = plane_sheet(2);
  const int32_t corner = 2, beside = 1, other = 5;  // the corners of a triangle alone at its corner
  EXPECT_TRUE(keeps_sides(even, corner, even.position[corner]));
  EXPECT_FALSE(keeps_sides(even, corner, {NAN, NAN, NAN}));
  even.position[other] = even.position[beside];  // now it has no area
  EXPECT_TRUE(keeps_sides(even, corner, even.position[corner]));
  EXPECT_FALSE(keeps_sides(even, corner, {NAN, NAN, NAN}));
}

TEST(Remesh, WhatIsOnePlaceIsMergedAndTurnsNothingOver) {
  EvenMesh even = plane_sheet(40);
  merge_close(even, std::vector<double>(even.position.size(), 1.5 / 40));
  const auto [count, area, least] = measured(even);
  EXPECT_NEAR(area, 1, 1e-12);
  EXPECT_GT(least, 0);
  EXPECT_LT(count, 2 * 40 * 40 / 3);
}

TEST(Remesh, TheCurvatureOfARolledSheetIsThatOfItsCylinder) {
  constexpr double kRadius = 0.8;
  EvenMesh even = plane_sheet(40);
  for (const double curvature : curvatures(even, {})) EXPECT_EQ(curvature, 0);
  for (Vec3& p : even.position) {
    p = {kRadius * std::sin(p.x / kRadius), p.y, kRadius * std::cos(p.x / kRadius)};
  }
  for (int32_t t = 0; t < even.mesh.triangles(); ++t) settle_normal(even, t);
  const auto curvature = curvatures(even, {});
  for (int32_t v = 0; v < even.mesh.vertices(); ++v) {
    if (even.mesh.stratum(v) != Stratum::sheet) continue;
    EXPECT_NEAR(curvature[v] * kRadius, 1, 0.3) << v;  // the triangles are uneven
  }
}

TEST(Remesh, TheHalfWidthOfASquareIsThatOfItsMiddle) {
  const EvenMesh even = plane_sheet(20);
  const auto width = half_widths(even.mesh, even.position);
  EXPECT_NEAR(*std::max_element(width.begin(), width.end()), 0.5, 0.1);
  EXPECT_GT(*std::min_element(width.begin(), width.end()), 0.3);
}

}  // namespace
}  // namespace medial
