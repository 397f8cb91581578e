// SPDX-License-Identifier: GPL-3.0-or-later
#include "cover/ball_reach.h"

#include <array>

#include "base/parallel.h"
#include "cover/pieces.h"

namespace medial {
namespace {

// This keeps the largest radius that each ball needs, among the places that one thread has seen.
class Needs {
 public:
  Needs(std::span<const Ball> balls, const NearestBall& nearest, double piece,
        const Progress* progress)
      : balls_(balls),
        nearest_(nearest),
        piece_(piece),
        progress_(progress),
        radii_(balls.size(), 0) {}

  void add(const Vec3& place) { add(nearest_.find(place), place); }

  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    visit_pieces(a, b, c, piece_, progress_, [&](const Vec3& p, const Vec3& q, const Vec3& r) {
      const int32_t ball = nearest_.find((1.0 / 3) * (p + q + r));
      for (const Vec3& corner : {p, q, r}) add(ball, corner);
    });
  }

  const std::vector<double>& radii() const { return radii_; }

 private:
  void add(int32_t ball, const Vec3& place) {
    radii_[ball] = std::max(radii_[ball], distance(place, balls_[ball].centre));
  }

  std::span<const Ball> balls_;
  const NearestBall& nearest_;
  double piece_;
  const Progress* progress_;
  std::vector<double> radii_;
};

}  // namespace

std::vector<double> needed_radii(std::span<const Ball> balls, std::span<const Vec3> vertices,
                                 std::span<const Triangle> triangles, std::span<const Vec3> places,
                                 double piece, const Run& run) {
  const NearestBall nearest(balls);
  std::vector<Needs> needs(static_cast<size_t>(run.threads),
                           Needs(balls, nearest, piece, run.progress));
  parallel_chunks(
      static_cast<int64_t>(triangles.size()), run,
      [&](int64_t begin, int64_t end, int worker) {
        for (int64_t t = begin; t < end; ++t) {
          const auto& [a, b, c] = triangles[t];
          needs[worker].add(vertices[a], vertices[b], vertices[c]);
        }
      },
      kTriangles);
  parallel_chunks(static_cast<int64_t>(places.size()), run,
                  [&](int64_t begin, int64_t end, int worker) {
                    for (int64_t i = begin; i < end; ++i) needs[worker].add(places[i]);
                  });
  std::vector<double> radii(balls.size(), 0);
  for (const Needs& part : needs) {
    for (size_t i = 0; i < radii.size(); ++i) radii[i] = std::max(radii[i], part.radii()[i]);
  }
  return radii;
}

}  // namespace medial
