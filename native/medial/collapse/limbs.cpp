// SPDX-License-Identifier: GPL-3.0-or-later
#include "collapse/limbs.h"

namespace medial {
namespace {

// share of the radius; a ball that sticks out by this much less counts as equal
constexpr double kAlike = 0.05;  // chosen: rig
// if a branch sticks out this many times farther than its tip, that is not the limb's tip
constexpr double kLost = 4;  // chosen: unseen

// These are branches by elongation: where branches meet, the one with the largest value continues.
struct Branches {
  Array<double> length;  // per vertex: the length of its branch
  Array<int32_t> elder;  // per vertex: the vertex before it on the branch that continues; or -1
};

Branches by_length(const InnerComplex& complex, const Collapse& collapse, const Wires& wires,
                   const Run& run) {
  auto longest = array<double>(complex.cell.size(), 0, run);  // the largest that has arrived
  Branches b{array<double>(complex.cell.size(), 0, run),
             array<int32_t>(complex.cell.size(), -1, run)};
  const size_t count = wires.order.size();
  for (size_t i = 0; i < count; ++i) {
    const int32_t v = wires.order[i], next = wires.next[i];
    b.length[v] = std::max(longest[v], wires.elongation[v]);
    if (b.elder[next] < 0 || b.length[v] > longest[next]) {
      longest[next] = b.length[v];
      b.elder[next] = v;
    }
  }
  for (size_t i = count; i-- > 0;) {
    const int32_t v = wires.order[i], next = wires.next[i];
    if (b.elder[next] == v && collapse.vertex_gone(next)) b.length[v] = b.length[next];
  }
  return b;
}

// Returns how far the ball at x sticks out of the ball at w.
double out_of(const InnerComplex& complex, int32_t x, int32_t w) {
  return distance(complex.position[x], complex.position[w]) + complex.radius[x] - complex.radius[w];
}

// Returns for each vertex the largest distance by which a ball of its branch by elongation sticks
// out of the ball at the end of the branch. It is 0 on the tip's side of the last ball that sticks
// out about as far, because near the tip of a limb all balls do; and 0 where it is at most the
// radius of the ball at the end.
Array<double> farthest_out(const InnerComplex& complex, const Collapse& collapse,
                           const Wires& wires, const Branches& branches, const Run& run) {
  const size_t count = wires.order.size();
  const auto goes_on = [&](size_t i) {
    return branches.elder[wires.next[i]] == wires.order[i] && collapse.vertex_gone(wires.next[i]);
  };
  auto end = array<int32_t>(complex.cell.size(), -1, run);
  for (size_t i = count; i-- > 0;) {
    end[wires.order[i]] = goes_on(i) ? end[wires.next[i]] : wires.next[i];
  }
  auto most = array<double>(complex.cell.size(), -HUGE_VAL, run);
  for (size_t i = 0; i < count; ++i) {
    const int32_t v = wires.order[i];
    most[v] = std::max(most[v], out_of(complex, v, end[v]));
    if (goes_on(i)) most[wires.next[i]] = most[v];
  }
  auto result = array<double>(complex.cell.size(), 0, run);
  const auto is_alike = [&](int32_t v) {
    return out_of(complex, v, end[v]) >= most[v] - kAlike * complex.radius[v];
  };
  for (size_t i = count; i-- > 0;) {
    const int32_t v = wires.order[i], next = wires.next[i];
    if (goes_on(i)) most[v] = most[next];
    const bool is_before = goes_on(i) && (result[next] == 0 || is_alike(next));
    result[v] = is_before || most[v] <= complex.radius[end[v]] ? 0 : most[v];
  }
  return result;
}

// Computes the branches by protrusion. A branch is identified by its tip; where branches meet, the
// one whose tip's ball sticks out most continues.
class Protrusion {
 public:
  Protrusion(const InnerComplex& complex, const Run& run)
      : complex_(complex),
        best_(array<Arrived>(complex.cell.size(), Arrived{}, run)),
        ended_(array<double>(complex.cell.size(), 0, run)),
        of_tip_(array<double>(complex.cell.size(), 0, run)) {}

  // Moves the branch of the best tip at v, or of v itself, to the next vertex. Returns the tip.
  int32_t go_on(int32_t v, int32_t next) {
    const int32_t tip = best_[v].tip < 0 ? v : best_[v].tip;
    of_tip_[tip] = std::max(of_tip_[tip], ended_[v]);
    Arrived arrived{tip, out_of(complex_, tip, next)};
    Arrived& best = best_[next];
    if (best.tip < 0 || arrived.height > best.height) std::swap(best, arrived);
    if (arrived.tip >= 0) {
      end(arrived);
      ended_[next] = std::max(ended_[next], of_tip_[arrived.tip]);
    }
    return tip;
  }
  // Ends the branch at a vertex that stays.
  void stop_at(int32_t v) {
    if (best_[v].tip >= 0) end(best_[v]);
  }
  double of_tip(int32_t tip) const { return of_tip_[tip]; }

 private:
  struct Arrived {
    int32_t tip = -1;
    double height = 0;
  };
  void end(const Arrived& a) { of_tip_[a.tip] = std::max(of_tip_[a.tip], a.height); }

  const InnerComplex& complex_;
  Array<Arrived> best_;  // per vertex: the best branch that has arrived
  Array<double> ended_;  // per vertex: the largest value of branches that have ended there
  Array<double> of_tip_;
};

}  // namespace

Array<float> limb_values(const InnerComplex& complex, const Collapse& collapse, const Wires& wires,
                         const Run& run) {
  const Branches branches = by_length(complex, collapse, wires, run);
  throw_if_cancelled(run.progress);
  Protrusion protrusion(complex, run);
  auto tip = array<int32_t>(complex.cell.size(), -1, run);
  for (size_t i = 0; i < wires.order.size(); ++i) {
    const int32_t v = wires.order[i];
    tip[v] = protrusion.go_on(v, wires.next[i]);
  }
  for (const int32_t next : wires.next) {
    if (!collapse.vertex_gone(next)) protrusion.stop_at(next);
  }
  const auto farthest = farthest_out(complex, collapse, wires, branches, run);
  auto value = array<float>(complex.cell.size(), run);
  parallel_for(complex.vertices(), run, [&](int64_t v) {
    value[v] = collapse.vertex_gone(static_cast<int32_t>(v)) ? 0 : HUGE_VALF;
  });
  // The loop follows the order, because a vertex may not be removed before those that it waits for.
  for (size_t i = 0; i < wires.order.size(); ++i) {
    const int32_t v = wires.order[i];
    const double of_tip = protrusion.of_tip(tip[v]);
    const double out = farthest[v] > kLost * of_tip ? farthest[v] : of_tip;
    const auto own = static_cast<float>(std::min(branches.length[v], out) / complex.diagonal);
    value[v] = std::max(value[v], own);
    value[wires.next[i]] = std::max(value[wires.next[i]], value[v]);
  }
  return value;
}

}  // namespace medial
