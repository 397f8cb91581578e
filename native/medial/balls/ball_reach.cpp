// SPDX-License-Identifier: GPL-3.0-or-later
#include "balls/ball_reach.h"

#include <array>

#include "base/parallel.h"

namespace medial {
namespace {

constexpr int64_t kTriangles = 16;  // triangles in one piece of work
constexpr double kLong = 64;        // pieces along an edge that make a triangle slow

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

  // Halves the triangle across its longest edge until that is short enough.
  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double ab = distance(a, b), bc = distance(b, c), ca = distance(c, a);
    const double longest = std::max({ab, bc, ca});
    if (longest > kLong * piece_) throw_if_cancelled(progress_);
    if (longest <= piece_) {
      const int32_t ball = nearest_.find((1.0 / 3) * (a + b + c));
      for (const Vec3& corner : {a, b, c}) add(ball, corner);
    } else if (ab >= bc && ab >= ca) {
      split(a, b, c);
    } else if (bc >= ca) {
      split(b, c, a);
    } else {
      split(c, a, b);
    }
  }

  const std::vector<double>& radii() const { return radii_; }

 private:
  void add(int32_t ball, const Vec3& place) {
    radii_[ball] = std::max(radii_[ball], distance(place, balls_[ball].centre));
  }
  void split(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 middle = 0.5 * a + 0.5 * b;
    add(a, middle, c);
    add(middle, b, c);
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
