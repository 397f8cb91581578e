// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/curves.h"

#include <numbers>

#include "base/parallel.h"

namespace medial {
namespace {

constexpr int kSmoothings = 20, kFits = 2;
constexpr double kSettled = 0.002;    // of the radius: another fit would change the square of it
constexpr double kStep = 0.25;        // of the spacing
constexpr double kHalfWidth = 2;      // of the piece that is fitted, in spacings
constexpr size_t kNeighbours = 12;    // that tell the spacing
constexpr int64_t kFewVertices = 16;  // to a thread at a time

// Of evenly spread samples: the square root of the area that one has.
double spacing_at(const PointTree& samples, const Vec3& place) {
  const Vec3& sample = samples[samples.nearest(place).id];
  return samples.reach(sample, kNeighbours + 1) * std::sqrt(std::numbers::pi / kNeighbours);
}

// The places along a chain, each moved half way to the middle of its neighbours, many times.
std::vector<Vec3> smoothed(const Chain& chain, std::span<const Vec3> places) {
  std::vector<Vec3> now, before;
  for (const int32_t v : chain.vertices) now.push_back(places[v]);
  const size_t last = now.size() - 1;
  for (int i = 0; i < kSmoothings; ++i) {
    before = now;
    for (size_t k = 1; k < last; ++k) {
      now[k] = 0.5 * before[k] + 0.25 * (before[k - 1] + before[k + 1]);
    }
    if (chain.closed) {
      now[0] = now[last] = 0.5 * before[0] + 0.25 * (before[1] + before[last - 1]);
    }
  }
  return now;
}

// Spacings at the vertices of a line: asked for every half spacing, and between by arc length.
std::vector<double> spacings_along(std::span<const Vec3> line, const PointTree& samples) {
  std::vector<double> spacing(line.size()), arc(line.size(), 0);
  for (size_t k = 1; k < line.size(); ++k) arc[k] = arc[k - 1] + distance(line[k - 1], line[k]);
  spacing[0] = spacing_at(samples, line[0]);
  for (size_t known = 0, k = 1; k < line.size(); ++k) {
    if (arc[k] - arc[known] < 0.5 * spacing[known] && k + 1 < line.size()) continue;
    spacing[k] = spacing_at(samples, line[k]);
    const double length = arc[k] - arc[known];
    for (size_t between = known + 1; between < k; ++between) {
      const double share = length > 0 ? (arc[between] - arc[known]) / length : 0;
      spacing[between] = std::lerp(spacing[known], spacing[k], share);
    }
    known = k;
  }
  return spacing;
}

// Steps along a line up to each vertex; by vertices if it has no length, or no spacing somewhere.
std::vector<double> steps_along(std::span<const Vec3> line, std::span<const double> spacing) {
  std::vector<double> steps(line.size(), 0);
  for (size_t k = 1; k < line.size(); ++k) {
    const double density = 0.5 / kStep * (1 / spacing[k - 1] + 1 / spacing[k]);
    steps[k] = steps[k - 1] + distance(line[k - 1], line[k]) * density;
  }
  if (!(steps.back() > 0 && steps.back() < HUGE_VAL)) {
    for (size_t k = 0; k < steps.size(); ++k) steps[k] = static_cast<double>(k);
  }
  return steps;
}

// Where samples nearly coincide, their spacing says nothing about a line far away from them.
constexpr double kMostPerEdge = 64;  // steps, on average

// Fewer would fall on other wires, or on facets, with the same ends.
size_t fewest_steps(const Chain& chain) {
  if (chain.vertices.front() == chain.vertices.back()) return 3;
  return std::min<size_t>(2, chain.size());
}

Curve divided(const Chain& chain, std::span<const Vec3> places, const PointTree& samples) {
  const auto line = smoothed(chain, places);
  const auto spacing = spacings_along(line, samples);
  const auto steps = steps_along(line, spacing);
  const double most = kMostPerEdge * static_cast<double>(chain.size());
  const size_t count = std::max(fewest_steps(chain),
                                static_cast<size_t>(std::llround(std::min(steps.back(), most))));
  Curve curve;
  for (size_t i = 0, k = 0; i <= count; ++i) {
    const double step = steps.back() * static_cast<double>(i) / static_cast<double>(count);
    while (k + 2 < steps.size() && steps[k + 1] <= step) ++k;
    const double length = steps[k + 1] - steps[k],
                 share = length > 0 ? std::min(1.0, (step - steps[k]) / length) : 0;
    curve.at.push_back(i == count ? static_cast<double>(chain.size())
                                  : static_cast<double>(k) + share);
    curve.spacing.push_back(std::lerp(spacing[k], spacing[k + 1], share));
    curve.canal.push_back({.centre = line[k] + share * (line[k + 1] - line[k])});
  }
  curve.canal.back().centre = line.back();
  return curve;
}

// Of the piece of the curve round a vertex that will be fitted, at most a quarter of it to either
// side.
Vec3 tangent_at(const Curve& curve, bool closed, size_t vertex) {
  const auto steps = static_cast<int64_t>(curve.canal.size()) - 1,
             here = static_cast<int64_t>(vertex);
  const Vec3& centre = curve.canal[vertex].centre;
  const auto end = [&](int direction) {
    Vec3 last = centre;
    for (int64_t i = 1; i <= std::max<int64_t>(1, steps / 4); ++i) {
      int64_t k = here + direction * i;
      if (closed) k = (k + steps) % steps;
      if (k < 0 || k > steps) break;
      const Vec3& place = curve.canal[k].centre;
      if (i > 1 && distance(place, centre) > kHalfWidth * curve.spacing[vertex]) break;
      last = place;
    }
    return last;
  };
  return normalized(end(1) - end(-1));
}

struct OnCurve {
  size_t curve, vertex;
};

// All but the ends that are not loose: joints with other wires or with facets stay.
std::vector<OnCurve> to_fit(const std::vector<Chain>& chains, const std::vector<Curve>& curves) {
  std::vector<OnCurve> all;
  for (size_t c = 0; c < curves.size(); ++c) {
    const Chain& chain = chains[c];
    const size_t last = curves[c].canal.size() - 1;
    for (size_t k = 0; k <= last; ++k) {
      const bool stays = k == 0 ? !chain.closed && !chain.loose[0] : k == last && !chain.loose[1];
      if (!stays) all.push_back({c, k});
    }
  }
  return all;
}

// Where the samples do not tell the radius, it is that of the empty ball.
Canal fitted(Canal canal, const PointTree& samples, double half_width) {
  canal.radius = samples.nearest(canal.centre).distance;
  for (int fit = 0; fit < kFits; ++fit) {
    const Canal before = canal;
    canal = fit_canal(samples, before, half_width);
    const double change = distance(canal.centre, before.centre) + distance(canal.bend, before.bend);
    if (change < kSettled * canal.radius) break;
  }
  const double empty = samples.nearest(canal.centre).distance;
  canal.radius = canal.trust > 0 ? std::lerp(empty, radius_of_ball(canal), canal.trust) : empty;
  return canal;
}

// Along the curve from one of its vertices, `way` on or up to its end, of a closed curve a quarter.
struct Walk {
  Vec3 place;
  double way = 0;  // that was gone
};

Walk walk(const Curve& curve, bool closed, size_t vertex, int direction, double way) {
  const auto steps = static_cast<int64_t>(curve.canal.size()) - 1;
  auto next = static_cast<int64_t>(vertex);
  Walk walk{curve.canal[vertex].centre};
  for (int64_t i = 0; i < (closed ? steps / 4 : steps); ++i) {
    next += direction;
    if (closed) next = (next + steps) % steps;
    if (next < 0 || next > steps) break;
    const Vec3 step = curve.canal[next].centre - walk.place;
    const double left = way - walk.way, all = length(step);
    if (all >= left) return {all > 0 ? walk.place + (left / all) * step : walk.place, way};
    walk = {curve.canal[next].centre, walk.way + all};
  }
  return walk;
}

// From the fitted centre at a vertex to the axis. What the samples show lies across the curve, but
// touches a ball that is R R' farther on, where R is the radius across and R' its slope. If the
// axis is bent it has turned away there, and what lies across has its middle k (R R')^2 / 2 outside
// the bend, k the curvature: as far as the middle of two places of the curve, R R' to either side,
// lies inside. Near an end, as much of that as there is.
Vec3 to_axis(const Curve& curve, bool closed, size_t vertex) {
  const auto& [centre, radius, slope, tangent, bend, trust] = curve.canal[vertex];
  double way = radius * std::sqrt(1 + slope * slope) * std::abs(slope);
  for (const int direction : {-1, 1}) way = walk(curve, closed, vertex, direction, way).way;
  const Vec3 before = walk(curve, closed, vertex, -1, way).place,
             behind = walk(curve, closed, vertex, 1, way).place;
  return trust * (0.5 * (before + behind) - centre);
}

}  // namespace

std::vector<Curve> fit_curves(const std::vector<Chain>& chains, std::span<const Vec3> places,
                              const PointTree& samples, const Run& run) {
  std::vector<Curve> curves(chains.size());
  parallel_for(
      static_cast<int64_t>(chains.size()), run,
      [&](int64_t c) { curves[c] = divided(chains[c], places, samples); }, 1);
  const auto vertices = to_fit(chains, curves);
  std::vector<Canal> found(vertices.size());
  parallel_for(
      static_cast<int64_t>(vertices.size()), run,
      [&](int64_t i) {
        const auto& [c, k] = vertices[i];
        Canal canal = curves[c].canal[k];
        canal.tangent = tangent_at(curves[c], chains[c].closed, k);
        found[i] = fitted(canal, samples, kHalfWidth * curves[c].spacing[k]);
      },
      kFewVertices);
  const auto bring = [&] {
    for (size_t i = 0; i < vertices.size(); ++i) {
      curves[vertices[i].curve].canal[vertices[i].vertex] = found[i];
    }
  };
  bring();
  parallel_for(
      static_cast<int64_t>(vertices.size()), run,
      [&](int64_t i) {
        const auto& [c, k] = vertices[i];
        found[i].centre = found[i].centre + to_axis(curves[c], chains[c].closed, k);
      },
      kFewVertices);
  bring();
  for (size_t c = 0; c < curves.size(); ++c) {
    if (chains[c].closed) curves[c].canal.back() = curves[c].canal.front();
  }
  return curves;
}

}  // namespace medial
