#include "skeleton/values.h"

#include "base/raise.h"

namespace medial {

Values with_vertices(const InnerComplex& complex, const Collapse& collapse, const Wires& wires,
                     Array<float> facets, const Run& run) {
  Values values{std::move(facets), Array<float>(complex.cell.size(), 0)};
  parallel_for(complex.facets(), run, [&](int64_t f) {
    const float value = values.facet[f];
    if (!(value > 0)) return;
    for (const Corner& c : complex.ring(static_cast<int32_t>(f))) {
      raise(values.vertex[c.vertex], value);
    }
  });
  for (const int32_t v : wires.order) {
    float& next = values.vertex[other_end(complex, collapse.edge_of_vertex[v], v)];
    next = std::max(next, values.vertex[v]);
  }
  parallel_for(complex.vertices(), run, [&](int64_t v) {
    if (!collapse.vertex_gone(static_cast<int32_t>(v))) values.vertex[v] = HUGE_VALF;
  });
  return values;
}

}  // namespace medial
