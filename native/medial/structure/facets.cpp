// SPDX-License-Identifier: GPL-3.0-or-later
#include "structure/facets.h"

#include <medial/errors.h>

#include <string>

namespace medial {
namespace {

void require_length(size_t found, size_t wanted, const char* name, const char* of) {
  if (found == wanted) return;
  throw InvalidInputError("Expected " + std::to_string(wanted) + " " + name + ", one per " + of +
                          ", found " + std::to_string(found) + "; pass those of one axis.");
}

void require_rows(std::span<const Edge> pairs, size_t rows, const char* name) {
  for (const auto& pair : pairs) {
    for (const int32_t row : pair) {
      if (row >= 0 && static_cast<size_t>(row) < rows) continue;
      throw InvalidInputError("Expected " + std::string(name) + " in [0, " + std::to_string(rows) +
                              "), found " + std::to_string(row) + "; pass those of one axis.");
    }
  }
}

void require_fitting(const StructureInput& input) {
  require_length(input.radius.size(), input.vertices.size(), "radii", "vertex");
  const size_t facets = input.face_offsets.empty() ? 0 : input.face_offsets.size() - 1;
  require_length(input.generators.size(), facets, "pairs of generators", "facet");
  require_length(input.spacing.size(), input.patches.size(), "spacings", "row of patches");
  require_rows(input.generators, input.patches.size(), "generators");
  require_rows(input.wires, input.vertices.size(), "ends of wires");
}

void put_facets_at_edges(Facets& facets, const Run& run) {
  const auto& [ends, of_corner] = facets.edges;
  Csr<int32_t>& at = facets.at_edge;
  at.offsets = array<int64_t>(ends.size() + 1, 0, run);
  for (const int32_t edge : of_corner) ++at.offsets[edge];
  counts_to_offsets(at.offsets);
  at.items = array<int32_t>(of_corner.size(), run);
  facets.forward.resize(of_corner.size());
  std::vector<int64_t> next(at.offsets.begin(), at.offsets.end());
  for (int32_t f = 0; f < facets.count(); ++f) {
    for (int32_t c = facets.input.face_offsets[f]; c < facets.input.face_offsets[f + 1]; ++c) {
      const auto slot = static_cast<size_t>(next[of_corner[c]]++);
      at.items[slot] = f;
      facets.forward[slot] = facets.input.face_vertices[c] == ends[of_corner[c]][0];
    }
  }
}

void measure(Facets& facets, int64_t f) {
  const StructureInput& input = facets.input;
  const auto corners = facets.corners(f);
  const Vec3& first = input.vertices[corners[0]];
  Vec3 twice{}, sum{};
  double radii = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec3& a = input.vertices[corners[i]];
    const Vec3& b = input.vertices[corners[(i + 1) % corners.size()]];
    twice = twice + cross(a - first, b - first);
    sum = sum + (a - first);
    radii += input.radius[corners[i]];
  }
  const double share = 1 / static_cast<double>(corners.size());
  const auto& [p, q] = input.generators[f];
  facets.normal[f] = 0.5 * twice;
  facets.area[f] = length(facets.normal[f]);
  facets.middle[f] = first + share * sum;
  facets.radius[f] = share * radii;
  facets.spacing[f] = 0.5 * (input.spacing[p] + input.spacing[q]);
}

}  // namespace

Facets facets_of(const StructureInput& input, const Run& run) {
  const auto vertices = static_cast<int32_t>(input.vertices.size());
  Facets facets;
  facets.input = input;
  facets.edges = polygon_edges(input.face_offsets, input.face_vertices, vertices, run);
  require_fitting(input);
  const size_t count = input.generators.size();
  for (size_t f = 0; f < count; ++f) {
    if (input.face_offsets[f + 1] > input.face_offsets[f]) continue;
    throw InvalidInputError("Expected polygons with corners, found one without; leave it out.");
  }
  facets.area.resize(count);
  facets.spacing.resize(count);
  facets.radius.resize(count);
  facets.middle.resize(count);
  facets.normal.resize(count);
  parallel_for(static_cast<int64_t>(count), run, [&](int64_t f) { measure(facets, f); });
  put_facets_at_edges(facets, run);
  return facets;
}

}  // namespace medial
