// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/focal_line.h"

#include <algorithm>
#include <map>

#include "base/parallel.h"
#include "base/point_tree.h"
#include "base/sort_unique.h"

namespace medial {
namespace {

// --- lines through places

constexpr size_t kMostAround = 24;  // places that a line is fitted to
constexpr size_t kLeastAround = 5;
constexpr double kReachOfLine = 2;    // spacings to these
constexpr double kLeastExtent = 0.5;  // of these along the line, in spacings
constexpr double kExactLine = 1e-6;   // the smallest deviation that is told from none, in spacings
constexpr double kFarOff = 10;        // times farther off than half of the places
constexpr double kOffAtMost = 0.02;   // spacings that may be off in any case
constexpr int kLineRounds = 8;        // in which places far off the line lose weight
constexpr int kDirectionRounds = 12;  // of powers of the matrix of the second moments

struct Line {
  Vec3 middle, along;

  Vec3 nearest(const Vec3& place) const { return middle + dot(place - middle, along) * along; }
};

// Returns the line of least squares; `along` is a direction to begin with.
Line fitted(std::span<const Vec3> places, std::span<const double> weights, Vec3 along) {
  Vec3 middle;
  double sum = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    middle = middle + weights[i] * places[i];
    sum += weights[i];
  }
  middle = (1 / sum) * middle;
  for (int round = 0; round < kDirectionRounds; ++round) {
    Vec3 next;
    for (size_t i = 0; i < places.size(); ++i) {
      const Vec3 way = places[i] - middle;
      next = next + (weights[i] * dot(way, along)) * way;
    }
    if (squared_length(next) > 0) along = normalized(next);
  }
  return {middle, along};
}

// Gives places that are farther off a line than most of them little weight; returns how far half of
// them are at most.
double weigh(std::span<const Vec3> places, const Line& line, double least,
             std::vector<double>& weights) {
  std::vector<double> off;
  for (const Vec3& place : places) off.push_back(squared_length(place - line.nearest(place)));
  std::vector<double> sorted = off;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  for (size_t i = 0; i < off.size(); ++i) weights[i] = 1 / (off[i] + *middle + least * least);
  return std::sqrt(*middle);
}

// Returns the place on the line through the places around one; nothing if the place is much farther
// off than most of them.
std::optional<Vec3> on_line_around(const Vec3& place, std::span<const Vec3> around,
                                   double spacing) {
  Vec3 farthest;
  for (const Vec3& other : around) {
    if (squared_length(other - place) > squared_length(farthest)) farthest = other - place;
  }
  if (around.size() < kLeastAround || !(length(farthest) > kLeastExtent * spacing)) return place;
  std::vector<double> weights(around.size(), 1);
  Line line{place, normalized(farthest)};
  double half_off = 0;
  for (int round = 0; round < kLineRounds; ++round) {
    line = fitted(around, weights, line.along);
    half_off = weigh(around, line, kExactLine * spacing, weights);
  }
  const Vec3 nearest = line.nearest(place);
  const double room = std::max(kFarOff * half_off, kOffAtMost * spacing);
  return distance(place, nearest) > room ? std::nullopt : std::optional(nearest);
}

// --- the cover of a line

constexpr double kDetour =
    2;  // times the length of an edge that the way along the line is, at most

using Interval = std::array<double, 2>;

// Holds the knots of a line in their order; a line that branches is several chains.
class KnotChains {
 public:
  KnotChains(std::span<const Vec3> knots, std::span<const OnLine> at,
             std::span<const int32_t> web) {
    for (const int32_t v : web) {
      if (!at[v].is_at_knot()) segments_.push_back(at[v].knots);
    }
    sort_unique(segments_);
    for (const auto& [a, b] : segments_) {
      next_[a].push_back(b);
      next_[b].push_back(a);
    }
    for (const bool rings : {false, true}) {
      for (const auto& [knot, others] : next_) {
        if (!rings && others.size() == 2) continue;
        for (const int32_t other : others) add_chain(knots, knot, other);
      }
    }
  }

  // The place of a vertex along a chain.
  struct Along {
    int32_t chain = -1;
    double way = 0;
  };

  size_t count() const { return chains_.size(); }

  Along along(const OnLine& at) const {
    if (at.is_at_knot()) {
      const auto found = inner_.find(at.knots[0]);
      return found == inner_.end() ? Along{} : found->second;
    }
    const auto found = segment_.find(at.knots);
    if (found == segment_.end()) return {};
    const Chain& chain = chains_[found->second.chain];
    const size_t i = found->second.place;
    const Knot &from = chain.knots[i], &to = chain.knots[i + 1];
    const double share = from.id == at.knots[0] ? at.share : 1 - at.share;
    return {found->second.chain, from.low + share * (to.low - from.low)};
  }

  // Adds the intervals of a chain that an edge covers, if it is on one chain: on a ring those of
  // the shorter way round. An edge over a gap of the line covers none of it, and neither does one
  // between the two ends of a line that nearly closes.
  void add_covered(const OnLine& a, const OnLine& b, double straight,
                   std::vector<std::vector<Interval>>& covers) const {
    Along from = along(a), to = along(b);
    if (from.chain < 0 && to.chain < 0) return;
    if (from.chain < 0) from = end_near(to, a);
    if (to.chain < 0) to = end_near(from, b);
    if (from.chain != to.chain) return;
    const Chain& chain = chains_[from.chain];
    const double low = std::min(from.way, to.way), high = std::max(from.way, to.way);
    const bool over_start = chain.is_ring() && high - low > 0.5 * chain.end();
    if ((over_start ? chain.end() - (high - low) : high - low) > kDetour * straight) return;
    const auto add = [&](double begin, double end) {
      if (begin < end) covers[from.chain].push_back({begin, end});
    };
    if (!over_start) return add(low, high);
    add(chain.begin(), low);
    add(high, chain.end());
  }

  // Draws intervals of a chain together, each to its middle, or to the end of the chain if it
  // reaches that. Knots in an interval become one, which is added to the knots.
  void draw_together(size_t c, std::span<const Interval> intervals, std::vector<Vec3>& knots) {
    Chain& chain = chains_[c];
    std::vector<Knot> left;
    auto next = chain.knots.begin();
    for (const Interval& interval : intervals) {
      if (interval[0] == chain.begin() && interval[1] == chain.end()) continue;
      while (next != chain.knots.end() && next->high < interval[0]) left.push_back(*next++);
      const auto first = next;
      while (next != chain.knots.end() && next->low <= interval[1]) ++next;
      if (first == next) {
        chain.points.push_back(interval);
      } else {
        left.push_back({interval[0], interval[1], joined(chain, interval, knots)});
      }
    }
    left.insert(left.end(), next, chain.knots.end());
    chain.knots = std::move(left);
  }

  OnLine place(size_t c, double way) const {
    const Chain& chain = chains_[c];
    for (const Interval& point : chain.points) {
      if (point[0] <= way && way <= point[1]) way = 0.5 * (point[0] + point[1]);
    }
    const auto next = std::find_if(chain.knots.begin(), chain.knots.end(),
                                   [&](const Knot& knot) { return way <= knot.high; });
    if (next->low <= way) return {{next->id, next->id}, 0};
    const Knot &from = *(next - 1), &to = *next;
    const double share = (way - from.high) / (to.low - from.high);
    return from.id < to.id ? OnLine{{from.id, to.id}, share} : OnLine{{to.id, from.id}, 1 - share};
  }

 private:
  // The interval of a chain that is at a knot.
  struct Knot {
    double low, high;
    int32_t id;
  };
  struct Chain {
    std::vector<Knot> knots;
    std::vector<Interval> points;  // between knots

    double begin() const { return knots.front().low; }
    double end() const { return knots.back().high; }
    bool is_ring() const { return knots.front().id == knots.back().id; }
  };
  struct Segment {
    int32_t chain;
    size_t place;
  };

  // Returns the knot in which an interval of a chain is drawn together.
  static int32_t joined(const Chain& chain, const Interval& interval, std::vector<Vec3>& knots) {
    if (interval[0] == chain.begin()) return chain.knots.front().id;
    if (interval[1] == chain.end()) return chain.knots.back().id;
    const double way = 0.5 * (interval[0] + interval[1]);
    const auto next = std::find_if(chain.knots.begin(), chain.knots.end(),
                                   [&](const Knot& knot) { return way < knot.low; });
    const Knot &from = *(next - 1), &to = *next;
    const double share = std::max(0.0, (way - from.high) / (to.low - from.high));
    knots.push_back(knots[from.id] + share * (knots[to.id] - knots[from.id]));
    return static_cast<int32_t>(knots.size()) - 1;
  }

  // Returns the end of a chain that is at a knot, if there is one, nearer to a place on it.
  Along end_near(const Along& place, const OnLine& at) const {
    const Chain& chain = chains_[place.chain];
    if (!at.is_at_knot()) return {};
    const bool first = chain.knots.front().id == at.knots[0],
               last = chain.knots.back().id == at.knots[0];
    if (!first && !last) return {};
    const bool at_front = first && (!last || place.way < 0.5 * chain.end());
    return {place.chain, at_front ? chain.begin() : chain.end()};
  }

  void add_chain(std::span<const Vec3> knots, int32_t from, int32_t to) {
    if (segment_.contains({std::min(from, to), std::max(from, to)})) return;
    const auto id = static_cast<int32_t>(chains_.size());
    const int32_t start = from;
    double way = 0;
    Chain chain{{{0, 0, from}}, {}};
    for (;;) {
      segment_[{std::min(from, to), std::max(from, to)}] = {id, chain.knots.size() - 1};
      way += distance(knots[from], knots[to]);
      chain.knots.push_back({way, way, to});
      const auto& others = next_[to];
      if (others.size() != 2 || to == start) break;
      inner_[to] = {id, way};
      const int32_t before = from;
      from = to;
      to = others[others[0] == before];
    }
    chains_.push_back(std::move(chain));
  }

  std::vector<Edge> segments_;
  std::map<int32_t, std::vector<int32_t>> next_;
  std::vector<Chain> chains_;
  std::map<int32_t, Along> inner_;  // knots between two others
  std::map<Edge, Segment> segment_;
};

// Returns the parts of a line that at least two of some intervals cover, in order.
std::vector<Interval> covered_twice(std::span<const Interval> intervals) {
  std::vector<std::pair<double, int>> ends;
  for (const auto& [low, high] : intervals) {
    ends.emplace_back(low, -1);  // what begins somewhere comes before what ends there
    ends.emplace_back(high, 1);
  }
  std::sort(ends.begin(), ends.end());
  std::vector<Interval> twice;
  int count = 0;
  for (const auto& [place, end] : ends) {
    const int before = count;
    count -= end;
    if (before == 1 && count == 2) twice.push_back({place, place});
    if (before == 2 && count == 1) twice.back()[1] = place;
  }
  return twice;
}

}  // namespace

std::vector<std::optional<Vec3>> straightened(std::span<const Vec3> places,
                                              std::span<const double> spacing, const Run& run) {
  const PointTree tree = PointTree::sorted(places, run);
  std::vector<std::optional<Vec3>> result(places.size());
  parallel_for(
      static_cast<int64_t>(places.size()), run,
      [&](int64_t i) {
        std::vector<Neighbour> near;
        tree.find(places[i], kMostAround, near);
        std::vector<Vec3> around;
        for (const Neighbour& n : near) {
          if (n.distance <= kReachOfLine * spacing[i]) around.push_back(places[n.id]);
        }
        result[i] = on_line_around(places[i], around, spacing[i]);
      },
      16);
  return result;
}

void cover_once(std::vector<Vec3>& knots, std::span<const Edge> rims, std::span<const int32_t> web,
                std::span<OnLine> at) {
  KnotChains chains(knots, at, web);
  std::vector<std::vector<Interval>> covers(chains.count());
  const auto place = [&](int32_t v) {
    const Vec3 &from = knots[at[v].knots[0]], &to = knots[at[v].knots[1]];
    return from + at[v].share * (to - from);
  };
  for (const auto& [a, b] : rims) {
    chains.add_covered(at[a], at[b], distance(place(a), place(b)), covers);
  }
  std::vector<KnotChains::Along> along;
  for (const int32_t v : web) along.push_back(chains.along(at[v]));
  for (size_t c = 0; c < covers.size(); ++c) {
    chains.draw_together(c, covered_twice(covers[c]), knots);
  }
  for (size_t i = 0; i < web.size(); ++i) {
    if (along[i].chain >= 0) at[web[i]] = chains.place(along[i].chain, along[i].way);
  }
}

}  // namespace medial
