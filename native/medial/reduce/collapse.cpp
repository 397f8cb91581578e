// SPDX-License-Identifier: GPL-3.0-or-later
#include "reduce/collapse.h"

#include <optional>
#include <queue>

#include "base/union_find.h"
#include "reduce/checked_mesh.h"
#include "reduce/quadric.h"

namespace medial {
namespace {

constexpr double kLength = 1e-6;  // cost of length, which prefers short edges; derived: rounding
constexpr double kSame = 1e-12;   // of the largest: costs closer are equal; derived: rounding

struct Candidate {
  double cost = 0;
  Edge ends = {};
  std::array<uint32_t, 2> version = {};

  // The next candidate is the cheapest, and of equal ones that of the lowest rows.
  bool operator<(const Candidate& other) const {
    return std::tie(other.cost, other.ends) < std::tie(cost, ends);
  }
};

class Collapser {
 public:
  Collapser(const SphereMesh& mesh, SphereComplex complex, std::span<const TangentPlace> places,
            SheetLocks* locks)
      : complex_(std::move(complex)),
        locks_(locks),
        quadrics_(mesh.vertices.size()),
        version_(mesh.vertices.size(), 0),
        waiting_(mesh.vertices.size()) {
    for (size_t v = 0; v < mesh.vertices.size(); ++v) {
      spheres_.push_back({mesh.vertices[v], mesh.radius[v]});
      row_.push_back(static_cast<int32_t>(v));
    }
    for (const TangentPlace& place : places) {
      const auto corners =
          std::count_if(place.of.begin(), place.of.end(), [](int v) { return v >= 0; });
      for (const int32_t v : place.of) {
        if (v >= 0) {
          quadrics_[v].add_plane(place.normal, place.point,
                                 place.area / static_cast<double>(corners));
        }
      }
    }
  }

  // Collapses edges until the wanted number of vertices is left. Slabs may turn over only when
  // nothing else can collapse. Between sheets, first all edges go that change nothing;
  // if then more nodes and bent curves are left than vertices are wanted, it stops and returns
  // false.
  bool run(int64_t wanted, const Run& run) {
    left_ = static_cast<int64_t>(spheres_.size());
    if (locks_) {
      collapse_all({false, kNoDistance}, 0, run);
      if (needed() > wanted) return false;
    }
    collapse_all({false, HUGE_VAL}, wanted, run);
    collapse_all({true, HUGE_VAL}, wanted, run);
    if (locks_ && locks_->shortest() > 0) {
      collapse_all({false, HUGE_VAL, locks_->shortest()}, 0, run);
    }
    return true;
  }

  Collapsed result(const SphereMesh& mesh) const {
    Collapsed out;
    std::vector<int32_t> number(spheres_.size(), -1);
    for (size_t v = 0; v < spheres_.size(); ++v) {
      if (gone(static_cast<int32_t>(v))) continue;
      number[v] = static_cast<int32_t>(out.row.size());
      out.row.push_back(row_[v]);
      out.mesh.vertices.push_back(spheres_[v].centre);
      out.mesh.radius.push_back(spheres_[v].radius);
    }
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto id = static_cast<int32_t>(t);
      const auto& [a, b, c] = complex_.triangle(id);
      const auto those = complex_.triangles_of(a);
      if (!std::binary_search(those.begin(), those.end(), id)) continue;
      out.mesh.triangles.push_back({number[a], number[b], number[c]});
      if (locks_) out.part.push_back(locks_->part(id));
    }
    for (size_t v = 0; v < spheres_.size(); ++v) {
      for (const int32_t other : complex_.neighbours(static_cast<int32_t>(v))) {
        if (static_cast<int32_t>(v) < other) out.mesh.wires.push_back({number[v], number[other]});
      }
    }
    out.mesh = without_doubles(std::move(out.mesh));
    return out;
  }

 private:
  static constexpr uint32_t kGone = UINT32_MAX;
  bool gone(int32_t v) const { return version_[v] == kGone; }

  // Says which edges may collapse now.
  struct Allowed {
    bool turns = false;         // slabs may turn over
    double most = HUGE_VAL;     // the largest distance by which the surface may move
    double longest = HUGE_VAL;  // if not infinite, edges of curves that are shorter, and no others
  };

  // Returns how many vertices describe the curves roughly: the nodes, and one for each curve that
  // is not straight.
  int64_t needed() const {
    int64_t count = 0;
    UnionFind bent(spheres_.size());
    for (int32_t v = 0; v < static_cast<int32_t>(spheres_.size()); ++v) {
      if (gone(v) || !locks_->is_on_curve(v)) continue;
      ++count;
      if (locks_->is_end(v)) continue;
      for (const int32_t other : complex_.neighbours(v)) {
        if (other > v || locks_->is_end(other) || !locks_->is_curve(complex_, v, other)) continue;
        if (bent.find(v) != bent.find(other)) --count;
        bent.unite(v, other);
      }
    }
    return count;
  }

  void collapse_all(const Allowed& allowed, int64_t wanted, const Run& run) {
    const auto total = static_cast<int64_t>(spheres_.size());
    allowed_ = allowed;
    fill();
    while (left_ > wanted && !queue_.empty()) {
      if (step() && left_ % 256 == 0) {
        advance(run.progress, static_cast<double>(total - left_) /
                                  static_cast<double>(std::max<int64_t>(1, total - wanted)));
      }
    }
  }

  void fill() {
    queue_ = {};
    for (auto& edges : waiting_) edges.clear();
    for (size_t v = 0; v < spheres_.size(); ++v) {
      for (const int32_t other : complex_.neighbours(static_cast<int32_t>(v))) {
        if (static_cast<int32_t>(v) < other) push(static_cast<int32_t>(v), other);
      }
    }
  }

  void push(int32_t a, int32_t b) {
    if (a > b) std::swap(a, b);
    const Target target = target_of(a, b);
    if (!is_allowed(a, b, target)) return wait_at_both(a, b);
    const double along = squared_length(spheres_[a].centre - spheres_[b].centre);
    const double weight = quadrics_[a].weight() + quadrics_[b].weight();
    queue_.push({std::max(0.0, target.cost) + kLength * weight * along,
                 {a, b},
                 {version_[a], version_[b]}});
  }

  struct Target {
    Sphere sphere;
    int32_t row = -1;
    double cost = HUGE_VAL;
    int32_t kept = -1;  // the end that stays; -1 if either may
  };

  // The lighter of both vertices decides, so that no small thing is lost in a large sheet.
  bool is_allowed(int32_t a, int32_t b, const Target& target) const {
    if (allowed_.longest < HUGE_VAL && !is_short_on_curve(a, b)) return false;
    if (allowed_.most == HUGE_VAL) return target.cost < HUGE_VAL;
    const double weight = std::min(quadrics_[a].weight(), quadrics_[b].weight());
    return target.cost <= weight * allowed_.most * allowed_.most;
  }

  bool is_short_on_curve(int32_t a, int32_t b) const {
    return distance(spheres_[a].centre, spheres_[b].centre) < allowed_.longest &&
           locks_->is_curve(complex_, a, b);
  }

  // Returns the best sphere for both, or one of the two if that is as good.
  Target target_of(int32_t a, int32_t b) const {
    if (locks_ && !locks_->may_move(complex_, a, b, spheres_)) return end_of(a, b);
    Quadric sum = quadrics_[a];
    sum += quadrics_[b];
    const Sphere &s = spheres_[a], &t = spheres_[b];
    const Sphere middle{0.5 * (s.centre + t.centre), 0.5 * (s.radius + t.radius)};
    Target best{s, row_[a], sum(s), -1};
    const double other = sum(t), same = kSame * std::max(best.cost, other);
    if (other < best.cost - same) best = {t, row_[b], other, -1};
    const auto free = sum.best(middle);
    if (free && free->radius >= 0) {
      const double cost = sum(*free);
      const double rise = s.radius - t.radius;
      const double reach = squared_length(s.centre - t.centre) + rise * rise;
      if (cost < best.cost - same - kSame * sum.weight() * reach) best = {*free, -1, cost, -1};
    }
    return best;
  }

  // Returns the end into which the other one may merge, of two the better one; an infinite cost if
  // there is none.
  Target end_of(int32_t a, int32_t b) const {
    Quadric sum = quadrics_[a];
    sum += quadrics_[b];
    Target best;
    for (const auto& [kept, other] : {Edge{a, b}, Edge{b, a}}) {
      if (!locks_->may_merge(complex_, other, kept, spheres_)) continue;
      const double cost = sum(spheres_[kept]);
      if (cost < best.cost) best = {spheres_[kept], row_[kept], cost, kept};
    }
    return best;
  }

  // Tries the next edge; returns whether it has collapsed.
  bool step() {
    const Candidate next = queue_.top();
    queue_.pop();
    auto [a, b] = next.ends;
    if (next.version[0] != version_[a] || next.version[1] != version_[b]) return false;
    if (gone(a) || gone(b)) return false;
    const Target target = target_of(a, b);
    if (!is_allowed(a, b, target) || !complex_.can_collapse(a, b) ||
        (locks_ && locks_->ends_sheet(complex_, a, b)) ||
        (!allowed_.turns && (turns(a, b, target.sphere) || turns(b, a, target.sphere)))) {
      wait_at_both(a, b);
      return false;
    }
    if (target.kept == b) std::swap(a, b);
    // No other collapse changes which vertices are on curves.
    const bool along_curve = locks_ && locks_->is_on_curve(a) && locks_->is_on_curve(b);
    complex_.collapse(a, b);
    quadrics_[a] += quadrics_[b];
    spheres_[a] = target.sphere;
    row_[a] = target.row;
    ++version_[a];
    version_[b] = kGone;
    --left_;
    if (along_curve) locks_->update(complex_, a);
    push_again(a);
    return true;
  }

  void wait_at_both(int32_t a, int32_t b) {
    wait(a, b);
    wait(b, a);
  }

  // Adds an edge to the waiting edges of a vertex, unless it is there. An edge waits at both its
  // ends, and comes back from either; without this check the number of copies would double with
  // every turn.
  void wait(int32_t v, int32_t other) {
    auto& others = waiting_[v];
    const auto at = std::lower_bound(others.begin(), others.end(), other);
    if (at == others.end() || *at != other) others.insert(at, other);
  }

  // Queues edges again: the cost of those at the vertex has changed, and those at its neighbours
  // may be able to collapse now.
  void push_again(int32_t a) {
    waiting_[a].clear();
    for (const int32_t v : complex_.neighbours(a)) push(a, v);
    for (const int32_t v : complex_.neighbours(a)) {
      for (const int32_t other : std::exchange(waiting_[v], {})) {
        const auto those = complex_.neighbours(v);
        if (other != a && std::binary_search(those.begin(), those.end(), other)) push(v, other);
      }
    }
  }

  // Returns whether a triangle of `a`, but not of `b`, would turn over or lose its area.
  bool turns(int32_t a, int32_t b, const Sphere& target) const {
    for (const int32_t t : complex_.triangles_of(a)) {
      const auto& corners = complex_.triangle(t);
      if (std::find(corners.begin(), corners.end(), b) != corners.end()) continue;
      std::array<Vec3, 3> before, after;
      for (int i = 0; i < 3; ++i) {
        before[i] = spheres_[corners[i]].centre;
        after[i] = corners[i] == a ? target.centre : before[i];
      }
      const Vec3 was = cross(before[1] - before[0], before[2] - before[0]);
      const Vec3 is = cross(after[1] - after[0], after[2] - after[0]);
      if (is_line(before, was)) continue;
      if (!(dot(was, is) > 0) || is_line(after, is)) return true;
    }
    return false;
  }

  // Returns whether a triangle has no area; between sheets also if it is so thin that it is a line.
  bool is_line(const std::array<Vec3, 3>& corners, const Vec3& twice_area) const {
    if (!locks_) return !(squared_length(twice_area) > 0);
    double longest = 0;
    for (int i = 0; i < 3; ++i) {
      longest = std::max(longest, squared_length(corners[(i + 1) % 3] - corners[i]));
    }
    return !(squared_length(twice_area) > kNoDistance * kNoDistance * longest);
  }

  SphereComplex complex_;
  SheetLocks* locks_;  // null if there are no sheets
  std::vector<Sphere> spheres_;
  std::vector<int32_t> row_;
  std::vector<Quadric> quadrics_;
  std::vector<uint32_t> version_;
  // per vertex: other ends of edges that could not collapse, ascending
  std::vector<std::vector<int32_t>> waiting_;
  std::priority_queue<Candidate> queue_;
  int64_t left_ = 0;
  Allowed allowed_;
};

}  // namespace

std::optional<Collapsed> collapse_edges(const SphereMesh& mesh, SphereComplex complex,
                                        std::span<const TangentPlace> places, int32_t wanted,
                                        const Run& run, SheetLocks* locks) {
  Collapser collapser(mesh, std::move(complex), places, locks);
  if (!collapser.run(wanted, run)) return {};
  return collapser.result(mesh);
}

}  // namespace medial
