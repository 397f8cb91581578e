// SPDX-License-Identifier: GPL-3.0-or-later
#include "structure/labels.h"

#include <map>

#include "base/rows.h"

namespace medial {
namespace {

constexpr Edge kUnknown{-1, -1};

bool contains(const Edge& patches, int32_t patch) {
  return patch >= 0 && (patches[0] == patch || patches[1] == patch);
}

// Returns the label of a facet between samples on some patches. Of the two patches at a crease
// always the lower one is taken, so that seams that pass the crease stay straight.
Edge label_between(const Edge& p, const Edge& q) {
  if (p[0] < 0 || q[0] < 0) return kUnknown;
  if (p[1] >= 0 && q[1] >= 0) {  // two samples of creases
    if (p == q) return p;
    if (contains(q, p[0]) || contains(q, p[1])) return kUnknown;
  } else {
    if (p[1] >= 0 && contains(p, q[0])) return p;
    if (q[1] >= 0 && contains(q, p[0])) return q;
  }
  return {std::min(p[0], q[0]), std::max(p[0], q[0])};
}

// Returns the label that a facet shares the longest edges with, of equal ones the lowest.
Edge label_around(const Facets& facets, std::span<const Edge> labels, int32_t facet) {
  std::map<Edge, double> lengths;
  for (int32_t c = facets.input.face_offsets[facet]; c < facets.input.face_offsets[facet + 1];
       ++c) {
    const int32_t edge = facets.edges.of_corner[c];
    for (const int32_t other : facets.at_edge[edge]) {
      if (labels[other] != kUnknown) lengths[labels[other]] += facets.length(edge);
    }
  }
  Edge best = kUnknown;
  double longest = -1;
  for (const auto& [label, length] : lengths) {
    if (length > longest) {
      best = label;
      longest = length;
    }
  }
  return best;
}

}  // namespace

std::vector<Edge> labels_of(const Facets& facets, const Run& run) {
  std::vector<Edge> labels(facets.input.generators.size());
  parallel_for(facets.count(), run, [&](int64_t f) {
    const auto& [p, q] = facets.input.generators[f];
    labels[f] = label_between(facets.input.patches[p], facets.input.patches[q]);
  });
  auto unknown = rows_where(facets.count(), [&](int32_t f) { return labels[f] == kUnknown; });
  for (size_t before = unknown.size() + 1; !unknown.empty() && unknown.size() < before;) {
    before = unknown.size();
    std::vector<std::pair<int32_t, Edge>> found;
    for (const int32_t f : unknown) found.emplace_back(f, label_around(facets, labels, f));
    for (const auto& [f, label] : found) labels[f] = label;
    std::erase_if(unknown, [&](int32_t f) { return labels[f] != kUnknown; });
  }
  return labels;
}

}  // namespace medial
