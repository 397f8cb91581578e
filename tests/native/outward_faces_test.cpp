// SPDX-License-Identifier: GPL-3.0-or-later
// Faces are read as those of a solid, whichever way they look.
#include "inside/outward_faces.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "inside/surface.h"
#include "shapes.h"

namespace medial {
namespace {

// A box with a cavity.
test::Mesh hollow() {
  return test::joined(test::box({0, 0, 0}, {1, 1, 1}),
                      test::turned(test::box({0.3, 0.3, 0.3}, {0.7, 0.7, 0.7})));
}

Triangle turned(const Triangle& t) { return {t[0], t[2], t[1]}; }

std::vector<Triangle> flipped(std::vector<Triangle> triangles, double share, uint64_t seed) {
  for (size_t i = 0; i < triangles.size(); ++i) {
    if (unit(scrambled(scrambled(seed) + i)) < share) triangles[i] = turned(triangles[i]);
  }
  return triangles;
}

TEST(OutwardFaces, CleanFacesAreUntouched) {
  const test::Mesh mesh = hollow();
  const OutwardFaces read = outward_faces(mesh.vertices, mesh.triangles, {2});
  EXPECT_EQ(read.triangles, mesh.triangles);
  EXPECT_EQ(read.patches, 2);
}

TEST(OutwardFaces, RandomFlipsAreUndoneForAnyNumberOfThreads) {
  const test::Mesh mesh = hollow();
  for (const double share : {0.05, 0.5, 1.0}) {
    for (uint64_t seed = 0; seed < 8; ++seed) {
      const auto given = flipped(mesh.triangles, share, seed);
      for (const int threads : {1, 3}) {
        const OutwardFaces read = outward_faces(mesh.vertices, given, {threads});
        EXPECT_EQ(read.triangles, mesh.triangles) << share << ' ' << seed;
        for (size_t t = 0; t < given.size(); ++t) {
          EXPECT_EQ(read.reading[t] == FaceReading::turned, given[t] != mesh.triangles[t]);
        }
      }
    }
  }
}

TEST(OutwardFaces, OneOfSeveralEqualFacesStays) {
  const test::Mesh mesh = test::box({0, 0, 0}, {1, 1, 1});
  auto given = mesh.triangles;
  for (const Triangle& t : mesh.triangles) given.push_back(turned(t));
  const OutwardFaces read = outward_faces(mesh.vertices, given, {});
  for (size_t t = 0; t < given.size(); ++t) {
    EXPECT_EQ(read.reading[t], t < 12 ? FaceReading::as_given : FaceReading::repeated);
  }
  EXPECT_EQ(open_edges(mesh.vertices, read.triangles, {}), 0);
}

TEST(OutwardFaces, ASheetKeepsTheSideOfMostOfItsFaces) {
  const std::vector<Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0},
                                   {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  const std::vector<Triangle> sheet{{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  auto given = sheet;
  given[2] = turned(given[2]);
  const OutwardFaces read = outward_faces(vertices, given, {});
  EXPECT_EQ(read.unseen, 1);
  for (size_t t = 0; t < sheet.size(); ++t) {
    EXPECT_EQ(read.reading[t], t == 2 ? FaceReading::turned : FaceReading::as_given);
  }
}

}  // namespace
}  // namespace medial
