// SPDX-License-Identifier: GPL-3.0-or-later
#include "collapse/values.h"

#include "base/atomic.h"

namespace medial {
namespace {

constexpr Thickness kEndless{HUGE_VALF, HUGE_VALF, HUGE_VALF};

void raise_shared(Thickness& value, const Thickness& to) {
  raise(value.sheet, to.sheet);
  raise(value.spacings, to.spacings);
  raise(value.erosion, to.erosion);
}

Thickness larger(const Thickness& a, const Thickness& b) {
  return {std::max(a.sheet, b.sheet), std::max(a.spacings, b.spacings),
          std::max(a.erosion, b.erosion)};
}

}  // namespace

Thickness Values::of_edge(int32_t partner) const {
  if (partner == kAlone) return kEndless;
  return partner >= 0 ? facet[partner] : vertex[with_vertex(partner)];
}

Values with_vertices(const InnerComplex& complex, Array<Thickness> facets, const Run& run) {
  Values values{std::move(facets), Array<Thickness>(complex.cell.size(), Thickness{})};
  parallel_for(complex.facets(), run, [&](int64_t f) {
    const Thickness& value = values.facet[f];
    for (const Corner& c : complex.ring(static_cast<int32_t>(f))) {
      raise_shared(values.vertex[c.vertex], value);
    }
  });
  return values;
}

void go_along(const Wires& wires, const InnerComplex& complex, const Collapse& collapse,
              Values& values, const Run& run) {
  for (size_t i = 0; i < wires.order.size(); ++i) {
    Thickness& next = values.vertex[wires.next[i]];
    next = larger(next, values.vertex[wires.order[i]]);
  }
  parallel_for(complex.vertices(), run, [&](int64_t v) {
    if (!collapse.vertex_gone(static_cast<int32_t>(v))) values.vertex[v] = kEndless;
  });
}

}  // namespace medial
