// SPDX-License-Identifier: GPL-3.0-or-later
#include "thickness/extrapolation.h"

#include <queue>
#include <tuple>

#include "base/csr.h"
#include "base/rows.h"

namespace medial {
namespace {

// A value reaches twice as far where no ball is larger than it, and where samples are farther apart
// than the wall is thick, this many edges beyond.
constexpr int kBeyond = 3;

// An edge of the surface has the circumcircle of a triangle of the umbrellas at both of its ends.
bool follows_surface(const Edge& ends, std::span<const Vec3> points, const Tangents& tangents,
                     const Significance& significance) {
  const auto& [p, q] = ends;
  if (dot(tangents.normals[p], tangents.normals[q]) <= kOpposite) return false;
  const double widest = 2 * std::min(significance.spacing[p], significance.spacing[q]);
  return distance(points[p], points[q]) <= widest;
}

// Collects the edges that follow the surface and have an end whose value is wanted.
std::vector<Edge> paths(const std::vector<double>& values, std::span<const Vec3> points,
                        const Tangents& tangents, const Edges& edges,
                        const Significance& significance, const Run& run) {
  return parallel_append<Edge>(edges.count(), run, [&](int64_t e, std::vector<Edge>& kept, int) {
    const Edge& ends = edges.ends[e];
    if (values[ends[0]] < HUGE_VAL && values[ends[1]] < HUGE_VAL) return;
    if (follows_surface(ends, points, tangents, significance)) kept.push_back(ends);
  });
}

// A way leads from a sample with a value to another one.
struct Way {
  double length;
  int32_t to;
  double value;
  int32_t from;
  int beyond = 0;  // this many edges led on from where the value reaches
};

// The next way is the shortest one, or the one with the largest value; the other comparisons break
// ties, so that the order is the same on every machine.
struct ByLength {
  bool operator()(const Way& a, const Way& b) const {
    return std::tie(a.length, a.to, a.value, a.beyond, a.from) >
           std::tie(b.length, b.to, b.value, b.beyond, b.from);
  }
};
struct ByValue {
  bool operator()(const Way& a, const Way& b) const {
    return std::tie(b.value, a.length, a.to, a.beyond, a.from) >
           std::tie(a.value, b.length, b.to, b.beyond, b.from);
  }
};

// This follows the ways along the surface to samples without a value.
class Spreading {
 public:
  Spreading(std::vector<double>& values, std::span<const double> own, std::span<const Vec3> points,
            std::vector<Edge> ends, const Run& run)
      : values_(values),
        own_(own),
        points_(points),
        ends_(std::move(ends)),
        at_(rows_containing(std::span<const Edge>(ends_), static_cast<int32_t>(values.size()),
                            {run.threads})),
        run_(run) {}

  // Starts from the samples that have a value, nearest first.
  void spread() {
    std::priority_queue<Way, std::vector<Way>, ByLength> ways;
    auto known = rows_where(values_.size(), [&](int32_t p) { return values_[p] < HUGE_VAL; });
    for (const int32_t p : known) go_on({0, p, values_[p], p}, ways);
    finish(ways);
  }
  // Starts from the samples that have no value, with their own balls, largest first.
  void spread_own() {
    std::priority_queue<Way, std::vector<Way>, ByValue> ways;
    for (size_t p = 0; p < values_.size(); ++p) {
      if (!(values_[p] < HUGE_VAL) && own_[p] < HUGE_VAL)
        ways.push({0, static_cast<int32_t>(p), own_[p], static_cast<int32_t>(p)});
    }
    finish(ways);
  }

 private:
  template <typename Ways>
  void finish(Ways& ways) {
    while (!ways.empty()) {
      const Way way = ways.top();
      ways.pop();
      if (values_[way.to] < HUGE_VAL) continue;  // a better way came before
      throw_if_cancelled(run_.progress);
      values_[way.to] = way.value;
      go_on(way, ways);
    }
  }
  template <typename Ways>
  void go_on(const Way& way, Ways& ways) const {
    for (const int32_t e : at_[way.to]) {
      const int32_t next = ends_[e][0] == way.to ? ends_[e][1] : ends_[e][0];
      if (values_[next] < HUGE_VAL) continue;
      const double away = distance(points_[way.from], points_[next]);
      if (away > kReach * way.value && is_wider(next, way.value)) continue;
      const int beyond = away > 2 * kReach * way.value ? way.beyond + 1 : 0;
      if (beyond > kBeyond) continue;
      const double length = way.length + distance(points_[way.to], points_[next]);
      ways.push({length, next, way.value, way.from, beyond});
    }
  }
  // Returns whether there is a ball at a sample that is larger than a value.
  bool is_wider(int32_t p, double value) const { return own_[p] < HUGE_VAL && own_[p] > value; }

  std::vector<double>& values_;
  std::span<const double> own_;
  std::span<const Vec3> points_;
  std::vector<Edge> ends_;
  Csr<int32_t> at_;
  Run run_;
};

}  // namespace

void extrapolate(std::vector<double>& values, std::span<const double> own,
                 std::span<const Vec3> points, const Tangents& tangents, const Edges& edges,
                 const Significance& significance, const Run& run) {
  Spreading to_others(values, own, points,
                      paths(values, points, tangents, edges, significance, run), run);
  to_others.spread();
  to_others.spread_own();
}

}  // namespace medial
