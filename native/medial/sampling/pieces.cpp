// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/pieces.h"

#include <bit>

#include "base/atomic.h"

namespace medial {
namespace {

constexpr int kMostDepth = 15;        // as many cuts as a path can hold
constexpr double kLittleArea = 0.25;  // squared spacings; it gets one sample at most; chosen: axis
constexpr double kOneSpacing = 2;     // a ratio; spacings that differ less are equal; chosen: axis

Barycentric middle(const Barycentric& p, const Barycentric& q) {
  return {0.5 * (p.a + q.a), 0.5 * (p.b + q.b), 0.5 * (p.c + q.c)};
}

// Returns one of the three quarters at the corners, or the one between them.
std::array<Barycentric, 3> quarter(const std::array<Barycentric, 3>& c, uint32_t which) {
  if (which == 3) return {middle(c[1], c[2]), middle(c[2], c[0]), middle(c[0], c[1])};
  const Barycentric& kept = c[which];
  return {kept, middle(kept, c[(which + 1) % 3]), middle(kept, c[(which + 2) % 3])};
}

Barycentric centre(const std::array<Barycentric, 3>& c) {
  return {(c[0].a + c[1].a + c[2].a) / 3, (c[0].b + c[1].b + c[2].b) / 3,
          (c[0].c + c[1].c + c[2].c) / 3};
}

// Returns the area of a piece; for a curved one it is the area of the flat triangle of its corners.
double area_of(const std::array<Vec3, 3>& p) {
  return 0.5 * length(cross(p[1] - p[0], p[2] - p[0]));
}

class Cutter {
 public:
  Cutter(const CurvedSurface& surface, int cuts, const Spacing& spacing, std::vector<Piece>& out,
         int32_t triangle, size_t most)
      : patch_(surface.patch(triangle)),
        cuts_(cuts),
        spacing_(spacing),
        out_(out),
        triangle_(triangle),
        most_(most) {}

  void cut(uint32_t path, const std::array<Barycentric, 3>& corners, int depth) {
    if (out_.size() > most_) return;
    if (depth < cuts_) return cut_into_quarters(path, corners, depth);
    const double spacing =
        spacing_.field ? spacing_(patch_.point(centre(corners))) : spacing_.scale;
    const std::array<Vec3, 3> at{patch_.point(corners[0]), patch_.point(corners[1]),
                                 patch_.point(corners[2])};
    const double area = area_of(at);
    if (spacing_.field && depth < kMostDepth && wider(at, 2 * spacing) &&
        !(area < kLittleArea * spacing * spacing && even(at, spacing))) {
      return cut_into_quarters(path, corners, depth);
    }
    if (area > 0) out_.push_back({triangle_, path, area, spacing});
  }

 private:
  void cut_into_quarters(uint32_t path, const std::array<Barycentric, 3>& corners, int depth) {
    for (uint32_t i = 0; i < 4; ++i) cut(path << 2 | i, quarter(corners, i), depth + 1);
  }

  static bool wider(const std::array<Vec3, 3>& p, double width) {
    return std::max({distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0])}) > width;
  }

  // Returns whether the spacing is even along a piece. Quarters of a needle are needles, so cutting
  // it into short pieces takes the square of its length in spacings; where the spacing is even, one
  // long piece is enough.
  bool even(const std::array<Vec3, 3>& p, double spacing) const {
    for (int i = 0; i < 3; ++i) {
      for (const Vec3& place : {p[i], 0.5 * p[i] + 0.5 * p[(i + 1) % 3]}) {
        const double other = spacing_(place);
        if (other > kOneSpacing * spacing || spacing > kOneSpacing * other) return false;
      }
    }
    return true;
  }

  Patch patch_;
  int cuts_;
  const Spacing& spacing_;
  std::vector<Piece>& out_;
  int32_t triangle_;
  size_t most_;  // limit of the pieces in `out_`
};

}  // namespace

std::array<Barycentric, 3> Piece::corners() const {
  std::array<Barycentric, 3> corners{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int shift = std::bit_width(path) - 3; shift >= 0; shift -= 2) {
    corners = quarter(corners, path >> shift & 3u);
  }
  return corners;
}

std::vector<Piece> cut_into_pieces(const CurvedSurface& surface, int cuts, const Spacing& spacing,
                                   const Run& run, int64_t most) {
  const auto count = static_cast<int64_t>(surface.mesh().triangles.size());
  int64_t made = 0;
  return parallel_append<Piece>(
      count, run,
      [&](int64_t t, std::vector<Piece>& out, int) {
        if (shared_load(made) > most) return;
        const size_t before = out.size();
        Cutter(surface, cuts, spacing, out, static_cast<int32_t>(t),
               before + static_cast<size_t>(most))
            .cut(1, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 0);
        if (most < INT64_MAX) shared_add(made, static_cast<int64_t>(out.size() - before));
      },
      64);
}

Place place_in(const Piece& piece, const std::array<Barycentric, 3>& corners, int64_t k,
               const std::array<double, 2>& shift) {
  // This is the R2 sequence (M. Roberts 2018), with steps of the powers of the plastic number.
  const double x = shift[0] + 0.7548776662466927 * static_cast<double>(k);
  const double y = shift[1] + 0.5698402909980532 * static_cast<double>(k);
  double u = x - std::floor(x), v = y - std::floor(y);
  // This maps the square to the triangle with little distortion (E. Heitz 2019).
  if (v > u) {
    u *= 0.5;
    v -= u;
  } else {
    v *= 0.5;
    u -= v;
  }
  const auto& [p, q, r] = corners;
  return {piece.triangle, static_cast<float>(p.b + u * (q.b - p.b) + v * (r.b - p.b)),
          static_cast<float>(p.c + u * (q.c - p.c) + v * (r.c - p.c))};
}

}  // namespace medial
