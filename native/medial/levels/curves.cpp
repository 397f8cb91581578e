// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels/curves.h"

#include <numbers>

#include "base/parallel.h"
#include "base/rows.h"

namespace medial {
namespace {

constexpr int kSmoothings = 20, kFits = 3;
// share of the radius; after a smaller move another fit changes about its square
constexpr double kSettled = 0.002;  // chosen: axis
// share of the radius; smaller errors of a straight axis need no other fit
constexpr double kStraight = 2e-5;  // chosen: axis
constexpr double kStep = 0.25;      // between new vertices, in spacings; chosen: axis
constexpr double kHalfWidth = 2;    // of the piece that is fitted, in spacings; chosen: axis
constexpr size_t kNeighbours = 12;  // samples that determine the spacing

// Returns the spacing of the samples near a place, the square root of the area of one sample.
double spacing_at(const PointTree& samples, const Vec3& place) {
  const Vec3& sample = samples[samples.nearest(place).id];
  return samples.reach(sample, kNeighbours + 1) * std::sqrt(std::numbers::pi / kNeighbours);
}

// Returns the places along a chain after many moves half way to the middle of their neighbours.
std::vector<Vec3> smoothed(const Chain& chain, std::span<const Vec3> places) {
  std::vector<Vec3> now = rows_of(places, chain.vertices), before;
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

// Returns spacings at the vertices of a line, queried every half spacing, and interpolated between.
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

// Returns the number of steps along a line up to each vertex; each edge is one step if the line has
// no length, or a spacing is 0.
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

// The spacing of samples that nearly coincide does not suit a line far away from them.
constexpr double kMostPerEdge = 64;  // number of steps, on average; work: memory

// Returns the fewest steps of a chain. With fewer it would lie on other wires, or on facets, that
// have the same ends.
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
  for (Canal& canal : curve.canal) canal.radius = samples.nearest(canal.centre).distance;
  return curve;
}

// Holds a place and its distance `way` along the curve from a vertex. The way ends at the end of
// the curve, and after a quarter of a closed curve.
struct Place {
  Vec3 centre;
  double radius, way;
};

Place walk(const Curve& curve, bool closed, size_t vertex, int direction, double way) {
  const auto steps = static_cast<int64_t>(curve.canal.size()) - 1;
  auto next = static_cast<int64_t>(vertex);
  Place now{curve.canal[vertex].centre, curve.canal[vertex].radius, 0};
  for (int64_t i = 0; i < (closed ? std::max<int64_t>(1, steps / 4) : steps); ++i) {
    next += direction;
    if (closed) next = (next + steps) % steps;
    if (next < 0 || next > steps) break;
    const Canal& canal = curve.canal[next];
    const double left = way - now.way, step = distance(now.centre, canal.centre),
                 share = step > left ? left / step : 1;
    now = {now.centre + share * (canal.centre - now.centre),
           std::lerp(now.radius, canal.radius, share), now.way + share * step};
    if (step > left) break;
  }
  return now;
}

// Returns the canal of the first fit: a cone that touches the empty balls half a width to either
// side.
Canal cone_round(const Curve& curve, bool closed, size_t vertex, double half_width) {
  const Place before = walk(curve, closed, vertex, -1, half_width),
              behind = walk(curve, closed, vertex, 1, half_width);
  const Vec3 along = behind.centre - before.centre;
  const double size = length(along), growth = behind.radius - before.radius;
  Canal cone = curve.canal[vertex];
  cone.tangent = normalized(along);
  cone.slope = size > 0 ? std::clamp(growth / size, -kSteepest, kSteepest) : 0;
  return cone;
}

// Returns the canal at a vertex with the bend of the curve there: the offset of the midpoint of two
// places, half a width to either side, from the vertex. A fit could determine the bend, too, but
// with noise so badly that inside the bend the canal would touch no ball. Near an end both places
// are only as far away as the end.
Canal bent(const Curve& curve, bool closed, size_t vertex, double half_width) {
  double way = half_width;
  for (const int direction : {-1, 1}) way = walk(curve, closed, vertex, direction, way).way;
  const Place before = walk(curve, closed, vertex, -1, way),
              behind = walk(curve, closed, vertex, 1, way);
  Canal canal = curve.canal[vertex];
  canal.bend = 0.5 * (before.centre + behind.centre) - canal.centre;
  return canal;
}

// Returns whether another fit would change next to nothing: the last one hardly moved the canal,
// and the error of a straight axis is small, both across it and at the ball that the samples across
// it belong to, which is R R' farther along.
bool is_settled(const Canal& canal, double moved, double half_width) {
  const double on = canal.radius * canal.slope / half_width, bend = length(canal.bend);
  return canal.trust == 0 || (moved < kSettled * canal.radius &&
                              bend * (on * on + bend / canal.radius) < kStraight * canal.radius);
}

struct OnCurve {
  size_t curve, vertex;
};

// Returns all vertices but the ends that are not loose: joints with other wires or facets stay.
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

// Fits canals at the vertices of curves: at all of them once, and again where that helps.
class Fitting {
 public:
  Fitting(const std::vector<Chain>& chains, std::vector<Curve>& curves, const PointTree& samples)
      : chains_(chains),
        curves_(curves),
        samples_(samples),
        vertices_(to_fit(chains, curves)),
        found_(vertices_.size()),
        moved_(vertices_.size()) {}

  void fit(const Run& run) {
    for (int fit = 0; fit < kFits; ++fit) {
      for_all(run, [&](int64_t i) { found_[i] = fit == 0 ? first(i) : next(i); });
    }
    for_all(run, [&](int64_t i) { found_[i] = finished(i); });
  }

 private:
  // New canals replace the old ones only when all of them are computed.
  template <class Function>
  void for_all(const Run& run, const Function& function) {
    parallel_for(static_cast<int64_t>(vertices_.size()), run, function, 16);
    for (size_t i = 0; i < vertices_.size(); ++i) {
      curves_[vertices_[i].curve].canal[vertices_[i].vertex] = found_[i];
    }
  }

  Canal first(int64_t i) {
    const auto& [c, k] = vertices_[i];
    return stepped(i, cone_round(curves_[c], chains_[c].closed, k, half_width(i)));
  }

  Canal next(int64_t i) {
    const auto& [c, k] = vertices_[i];
    const Canal from = bent(curves_[c], chains_[c].closed, k, half_width(i));
    return is_settled(from, moved_[i], half_width(i)) ? from : stepped(i, from);
  }

  Canal stepped(int64_t i, const Canal& from) {
    const Canal canal = fit_canal(samples_, from, half_width(i));
    moved_[i] =
        distance(canal.centre, from.centre) + std::abs(canal.slope - from.slope) * from.radius;
    return canal;
  }

  // The radius is that of the empty ball where the samples do not determine it.
  Canal finished(int64_t i) const {
    Canal canal = found_[i];
    const double empty = samples_.nearest(canal.centre).distance;
    canal.radius = canal.trust > 0 ? std::lerp(empty, canal.radius, canal.trust) : empty;
    return canal;
  }

  double half_width(int64_t i) const {
    return kHalfWidth * curves_[vertices_[i].curve].spacing[vertices_[i].vertex];
  }

  const std::vector<Chain>& chains_;
  std::vector<Curve>& curves_;
  const PointTree& samples_;
  std::vector<OnCurve> vertices_;
  std::vector<Canal> found_;
  std::vector<double> moved_;  // how far the last fit moved each canal
};

}  // namespace

std::vector<Curve> fit_curves(const std::vector<Chain>& chains, std::span<const Vec3> places,
                              const PointTree& samples, const Run& run) {
  std::vector<Curve> curves(chains.size());
  parallel_for(
      static_cast<int64_t>(chains.size()), run,
      [&](int64_t c) { curves[c] = divided(chains[c], places, samples); }, 1);
  Fitting(chains, curves, samples).fit(run);
  for (size_t c = 0; c < curves.size(); ++c) {
    if (chains[c].closed) curves[c].canal.back() = curves[c].canal.front();
  }
  return curves;
}

}  // namespace medial
