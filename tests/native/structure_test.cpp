// SPDX-License-Identifier: GPL-3.0-or-later
// Sheets, seams, rims, junctions and corners, of polygons that are made for it.
#include <gtest/gtest.h>
#include <medial/errors.h>
#include <medial/sampling.h>
#include <medial/structure.h>

#include "base/vec3.h"
#include "structure/places.h"

namespace medial {
namespace {

// Squares of the lattice with side 1, each between two patches.
struct Squares {
  std::vector<Vec3> vertices;
  std::vector<int32_t> offsets{0}, corners;
  std::vector<Edge> generators;
  std::vector<Edge> patches;
  double spacing = 0.5;
  double radius = 10;

  int32_t vertex(const Vec3& at) {
    for (size_t v = 0; v < vertices.size(); ++v) {
      if (vertices[v] == at) return static_cast<int32_t>(v);
    }
    vertices.push_back(at);
    return static_cast<int32_t>(vertices.size()) - 1;
  }

  void add(const Vec3& corner, const Vec3& one, const Vec3& two, int32_t a, int32_t b) {
    for (const Vec3& at : {corner, corner + one, corner + one + two, corner + two}) {
      corners.push_back(vertex(at));
    }
    offsets.push_back(static_cast<int32_t>(corners.size()));
    const auto row = static_cast<int32_t>(patches.size());
    patches.push_back({a, -1});
    patches.push_back({b, -1});
    generators.push_back({row, row + 1});
  }

  Structure structure() const {
    const std::vector<double> radii(vertices.size(), radius), apart(patches.size(), spacing);
    return structure_of({vertices, radii, offsets, corners, generators, {}, patches, apart}, 1);
  }
};

constexpr Vec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

// Three sheets of `length` squares at a common line.
Squares book(int length) {
  Squares s;
  for (int i = 0; i < length; ++i) {
    const Vec3 at{0, 0, static_cast<double>(i)};
    s.add(at, kX, kZ, 1, 2);
    s.add(at, kY, kZ, 0, 2);
    s.add(at, -kY, kZ, 0, 1);
  }
  return s;
}

TEST(Structure, OfThreeSheetsHasOneSeam) {
  const Structure s = book(4).structure();
  EXPECT_EQ(s.part_patches, (Column<Edge>{{0, 1}, {0, 2}, {1, 2}}));
  EXPECT_EQ((std::vector(s.part.begin(), s.part.begin() + 3)), (std::vector<int32_t>{2, 1, 0}));
  EXPECT_EQ(s.part_area, (Column<double>{4, 4, 4}));
  EXPECT_EQ(s.curve_kind,
            (Column<CurveKind>{CurveKind::seam, CurveKind::rim, CurveKind::rim, CurveKind::rim}));
  EXPECT_EQ(s.curve_length, (Column<double>{4, 6, 6, 6}));
  EXPECT_EQ(s.curve_parts, (Column<int32_t>{0, 1, 2, 0, 1, 2}));
  EXPECT_TRUE(s.node_kind.empty());
}

TEST(Structure, HasCornersWhereASeamReachesCreases) {
  Squares s = book(4);
  s.radius = 0.1;
  const Structure found = s.structure();
  EXPECT_EQ(found.curve_kind[1], CurveKind::crease);
  EXPECT_EQ(found.node_kind, (Column<PlaceKind>{PlaceKind::corner, PlaceKind::corner}));
  EXPECT_EQ(found.node_curves, (Column<int32_t>{0, 1, 2, 3, 0, 1, 2, 3}));
}

TEST(Structure, OfAStarOfSeamsHasOneJunction) {
  Squares s;
  const std::array axes{kX, kY, kZ};
  const std::array signs{-1.0, 1.0};
  int32_t patch = 0;
  for (int i = 0; i < 3; ++i) {
    for (const double a : signs) {
      for (const double b : signs) {
        s.add({}, a * axes[i], b * axes[(i + 1) % 3], patch, patch + 1);
        ++patch;
      }
    }
  }
  const Structure found = s.structure();
  EXPECT_EQ(found.part_area.size(), 12u);
  ASSERT_EQ(found.node_kind, (Column<PlaceKind>{PlaceKind::junction}));
  EXPECT_EQ(s.vertices[found.node_vertex[0]], (Vec3{}));
  EXPECT_EQ(found.node_curve_offsets, (Column<int32_t>{0, 6}));
}

TEST(Structure, GivesCrumbsToTheirNeighbours) {
  Squares s;
  for (int i = 0; i < 9; ++i) {
    s.add({static_cast<double>(i), 0, 0}, kX, kY, 0, i == 4 ? 2 : 1);
  }
  EXPECT_EQ(s.structure().part_area.size(), 3u);
  s.spacing = 0.75;  // one square is less than two squared spacings
  const Structure found = s.structure();
  EXPECT_EQ(found.part_area, (Column<double>{9}));
  EXPECT_EQ(std::count(found.seam.begin(), found.seam.end(), CurveKind::seam), 0);
}

TEST(Structure, TurnsTheFacetsOfASheetAlike) {
  Squares s;
  s.add({}, kX, kY, 0, 1);
  s.add(kX, kY, kX, 1, 0);  // the other way round, and so are its patches
  s.add({}, kX, -kY, 3, 3);
  EXPECT_EQ(s.structure().turned, (Column<uint8_t>{0, 1, 1}));
}

TEST(Structure, RefusesArraysThatDoNotFit) {
  Squares s = book(1);
  s.generators[0] = {0, 99};
  EXPECT_THROW(s.structure(), InvalidInputError);
  s.generators.pop_back();
  EXPECT_THROW(s.structure(), InvalidInputError);
}

TEST(Structure, OrdersPlacesInSpiteOfSmallChanges) {
  const std::vector<Placed> things{{{0}, {1.01, 3, 0}, 0.1},
                                   {{0}, {1.0, 5, 0}, 0.1},
                                   {{0}, {0, 9, 0}, 0.1},
                                   {{-1}, {7, 7, 7}, 0.1}};
  EXPECT_EQ(order_of(things), (std::vector<int32_t>{3, 2, 0, 1}));
}

}  // namespace
}  // namespace medial
