// SPDX-License-Identifier: GPL-3.0-or-later
#include <medial/capsule_cover.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "base/frame.h"
#include "base/parallel.h"
#include "base/rows.h"
#include "base/run.h"
#include "cover/capsule_fit.h"

namespace medial {
namespace {

constexpr int kCoordinate = 2;       // directions to begin with have whole coordinates up to this
constexpr int kCircleSteps = 64;     // the centre of a circle is off by about one part of so many
constexpr int64_t kMostRounds = 64;  // of places that are added because they are not held yet

// Returns one of each two opposite directions.
std::vector<Vec3> directions() {
  std::vector<Vec3> found;
  for (int x = 0; x <= kCoordinate; ++x) {
    for (int y = x > 0 ? -kCoordinate : 0; y <= kCoordinate; ++y) {
      for (int z = x > 0 || y > 0 ? -kCoordinate : 1; z <= kCoordinate; ++z) {
        if (std::gcd(x, std::gcd(y, z)) != 1) continue;
        found.push_back(normalized({double(x), double(y), double(z)}));
      }
    }
  }
  return found;
}

// Returns the places that are farthest along the directions, both ways.
std::vector<Vec3> extremes(std::span<const Vec3> places, std::span<const Vec3> ways) {
  std::vector<size_t> rows;
  for (const Vec3& way : ways) {
    const auto [low, high] = std::minmax_element(
        places.begin(), places.end(),
        [&](const Vec3& p, const Vec3& q) { return dot(p, way) < dot(q, way); });
    rows.push_back(low - places.begin());
    rows.push_back(high - places.begin());
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  std::vector<Vec3> found;
  for (const size_t row : rows) found.push_back(places[row]);
  return found;
}

// Returns nearly the centre of the least circle round places of a plane through 0: it goes towards
// the farthest place by ever smaller parts of the way (Badoiu and Clarkson, 2003).
Vec3 circle_centre(std::span<const Vec3> places) {
  Vec3 centre = places.front();
  for (int step = 2; step < kCircleSteps + 2; ++step) {
    const Vec3 farthest =
        *std::max_element(places.begin(), places.end(), [&](const Vec3& p, const Vec3& q) {
          return squared_length(p - centre) < squared_length(q - centre);
        });
    centre = centre + (1.0 / step) * (farthest - centre);
  }
  return centre;
}

LengthAt from_segment(const Capsule& capsule, const Vec3& place) {
  const Vec3 along = capsule.b - capsule.a;
  const double square = squared_length(along);
  const double at = square > 0 ? dot(place - capsule.a, along) / square : 0;
  const double share = std::clamp(at, 0.0, 1.0);
  return {share, distance(place, capsule.place(share))};
}

// Returns the least capsule round a segment that holds the places.
Capsule round_segment(const Vec3& a, const Vec3& b, std::span<const Vec3> places, bool tapered) {
  Capsule capsule{a, b, {}};
  std::vector<LengthAt> needs{{0, 0}, {1, 0}};
  double most = 0;
  for (const Vec3& place : places) {
    const LengthAt need = from_segment(capsule, place);
    most = std::max(most, need.length);
    if (tapered) needs.push_back(need);
  }
  capsule.radius = {most, most};
  if (!tapered || a == b) return capsule;
  const Capsule sloping{a, b, lowest_above(std::move(needs))};
  const bool fits = sloping.radius.first >= 0 && sloping.radius.second >= 0;
  return fits && sloping.volume() < capsule.volume() ? sloping : capsule;
}

// Returns the least capsule along a direction whose radius is that of the least cylinder.
Capsule along_direction(const Vec3& way, std::span<const Vec3> places, bool tapered) {
  std::vector<Vec3> flat;
  for (const Vec3& place : places) flat.push_back(place - dot(place, way) * way);
  const Vec3 centre = circle_centre(flat);
  double square = 0;
  for (const Vec3& place : flat) square = std::max(square, squared_length(place - centre));
  double first = HUGE_VAL, second = -HUGE_VAL;
  for (size_t i = 0; i < places.size(); ++i) {
    const double cap = std::sqrt(square - squared_length(flat[i] - centre));
    first = std::min(first, dot(places[i], way) + cap);
    second = std::max(second, dot(places[i], way) - cap);
  }
  if (first > second) first = second = (first + second) / 2;
  return round_segment(centre + first * way, centre + second * way, places, tapered);
}

// Moves both ends together, and each alone, by ever smaller steps while the capsule becomes
// smaller.
Capsule with_moved_ends(Capsule best, std::span<const Vec3> places, bool tapered) {
  const auto size = [&] { return std::max(best.radius.first, best.radius.second); };
  double step = size() / 2;
  while (step > kOfRadius * size()) {
    const Vec3 along = normalized(best.b - best.a);
    const Vec3 way = along == Vec3{} ? Vec3{1, 0, 0} : along;
    const auto [aside, third] = across(way);
    Capsule next = best;
    for (const Vec3& direction : {way, -way, aside, -aside, third, -third}) {
      const Vec3 by = step * direction;
      for (const auto& [a, b] : {std::pair{by, by}, {by, Vec3{}}, {Vec3{}, by}, {by, -by}}) {
        const Capsule moved = round_segment(best.a + a, best.b + b, places, tapered);
        if (moved.volume() < next.volume()) next = moved;
      }
    }
    if (next.volume() < best.volume()) {
      best = next;
    } else {
      step /= 2;
    }
  }
  return best;
}

// Returns the place that is farthest outside of a capsule, and how far.
std::pair<Vec3, double> most_outside(const Capsule& capsule, std::span<const Vec3> places) {
  std::pair<Vec3, double> found{places.front(), -HUGE_VAL};
  for (const Vec3& place : places) {
    const LengthAt need = from_segment(capsule, place);
    const double out = need.length - capsule.radius.at(need.share);
    if (out > found.second) found = {place, out};
  }
  return found;
}

// Returns a capsule that holds all places, of nearly the least volume: of the least capsules along
// each of some directions the smallest, whose ends are then moved as long as that makes it smaller.
// There must be a place. Few of them decide: the extreme ones to begin with, and then one after the
// other that is not held.
Capsule least_capsule(std::span<const Vec3> places, bool tapered) {
  const auto ways = directions();
  auto deciding = extremes(places, ways);
  Capsule best = along_direction(ways.front(), deciding, tapered);
  for (const Vec3& way : ways) {
    const Capsule other = along_direction(way, deciding, tapered);
    if (other.volume() < best.volume()) best = other;
  }
  for (int64_t round = 0; round < kMostRounds; ++round) {
    best = with_moved_ends(best, deciding, tapered);
    const auto [place, out] = most_outside(best, places);
    if (out <= kOfRadius * std::max(best.radius.first, best.radius.second)) break;
    deciding.push_back(place);
    best = round_segment(best.a, best.b, deciding, tapered);
  }
  return round_segment(best.a, best.b, places, tapered);
}

}  // namespace

LeastCapsules least_capsules(std::span<const Vec3> places, std::span<const int32_t> group,
                             int32_t count, bool tapered, int threads) {
  require_finite(places, "place");
  if (places.size() != group.size()) {
    throw InvalidInputError("Expected a group for each of " + std::to_string(places.size()) +
                            " places, found " + std::to_string(group.size()) + "; pass as many.");
  }
  const Frame frame = frame_of(places, {});
  std::vector<std::vector<Vec3>> groups(std::max(count, 0));
  for (size_t i = 0; i < places.size(); ++i) {
    if (group[i] < 0 || group[i] >= count) {
      throw InvalidInputError("Expected groups from 0 to " + std::to_string(count - 1) +
                              ", found " + std::to_string(group[i]) + "; correct it.");
    }
    groups[group[i]].push_back(frame.inward(places[i]));
  }
  LeastCapsules found;
  found.ends.resize(2 * groups.size());
  found.radii.resize(2 * groups.size());
  parallel_for(
      static_cast<int64_t>(groups.size()), {thread_count(threads), nullptr},
      [&](int64_t k) {
        if (groups[k].empty()) return;
        const Capsule capsule = least_capsule(groups[k], tapered);
        found.ends[2 * k] = frame.outward(capsule.a);
        found.ends[2 * k + 1] = frame.outward(capsule.b);
        found.radii[2 * k] = frame.outward(capsule.radius.first);
        found.radii[2 * k + 1] = frame.outward(capsule.radius.second);
      },
      1);
  return found;
}

}  // namespace medial
