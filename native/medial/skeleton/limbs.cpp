// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton/limbs.h"

namespace medial {
namespace {

// By elongation: where branches meet, that with the larger one goes on.
Array<double> lengths(const InnerComplex& complex, const Collapse& collapse, const Wires& wires,
                      const Run& run) {
  auto longest = array<double>(complex.cell.size(), 0, run);  // of what has arrived
  auto elder = array<int32_t>(complex.cell.size(), -1, run);  // from where
  auto value = array<double>(complex.cell.size(), 0, run);
  const size_t count = wires.order.size();
  for (size_t i = 0; i < count; ++i) {
    const int32_t v = wires.order[i], next = wires.next[i];
    value[v] = std::max(longest[v], wires.elongation[v]);
    if (elder[next] < 0 || value[v] > longest[next]) {
      longest[next] = value[v];
      elder[next] = v;
    }
  }
  for (size_t i = count; i-- > 0;) {
    const int32_t v = wires.order[i], next = wires.next[i];
    if (elder[next] == v && collapse.vertex_gone(next)) value[v] = value[next];
  }
  return value;
}

// By protrusion: a branch is known by its tip x, and at a vertex w by |x - w| + R(x) - R(w).
class Protrusion {
 public:
  Protrusion(const InnerComplex& complex, const Run& run)
      : complex_(complex),
        best_(array<Arrived>(complex.cell.size(), Arrived{}, run)),
        ended_(array<double>(complex.cell.size(), 0, run)),
        of_tip_(array<double>(complex.cell.size(), 0, run)) {}

  // The branch of the best tip at v, or of v itself, comes to the next vertex. Returns the tip.
  int32_t go_on(int32_t v, int32_t next) {
    const int32_t tip = best_[v].tip < 0 ? v : best_[v].tip;
    of_tip_[tip] = std::max(of_tip_[tip], ended_[v]);
    Arrived arrived{tip, distance(complex_.position[tip], complex_.position[next]) +
                             complex_.radius[tip] - complex_.radius[next]};
    Arrived& best = best_[next];
    if (best.tip < 0 || arrived.height > best.height) std::swap(best, arrived);
    if (arrived.tip >= 0) {
      end(arrived);
      ended_[next] = std::max(ended_[next], of_tip_[arrived.tip]);
    }
    return tip;
  }
  // Nothing goes on from here.
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
  Array<Arrived> best_;  // per vertex: of what has arrived
  Array<double> ended_;  // per vertex: of what has ended there
  Array<double> of_tip_;
};

}  // namespace

Array<float> limb_values(const InnerComplex& complex, const Collapse& collapse, const Wires& wires,
                         const Run& run) {
  const auto length = lengths(complex, collapse, wires, run);
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
  auto value = array<float>(complex.cell.size(), run);
  parallel_for(complex.vertices(), run, [&](int64_t v) {
    value[v] = collapse.vertex_gone(static_cast<int32_t>(v)) ? 0 : HUGE_VALF;
  });
  parallel_for(static_cast<int64_t>(wires.order.size()), run, [&](int64_t i) {
    const int32_t v = wires.order[i];
    value[v] =
        static_cast<float>(std::min(length[v], protrusion.of_tip(tip[v])) / complex.diagonal);
  });
  return value;
}

}  // namespace medial
