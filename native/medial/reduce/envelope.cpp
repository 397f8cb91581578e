// SPDX-License-Identifier: GPL-3.0-or-later
#include "reduce/envelope.h"

#include "base/parallel.h"
#include "base/rows.h"
#include "reduce/checked_mesh.h"

namespace medial {
namespace {

constexpr int32_t kLeaf = 4;

}  // namespace

std::vector<Part> parts_of(const SphereMesh& mesh) {
  std::vector<Part> parts(mesh.triangles.begin(), mesh.triangles.end());
  std::vector<uint8_t> used(mesh.vertices.size(), 0);
  for (const auto& [a, b, c] : mesh.triangles) used[a] = used[b] = used[c] = 1;
  for (const auto& [a, b] : mesh.wires) {
    parts.push_back({a, b, -1});
    used[a] = used[b] = 1;
  }
  for (size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) parts.push_back({static_cast<int32_t>(v), -1, -1});
  }
  return parts;
}

Envelope::Envelope(const SphereMesh& mesh) : mesh_(mesh), parts_(parts_of(mesh)) {
  const auto describe = [&](Node& node) { measure(node); };
  const auto split = [&](const Node& node) {
    const int axis = longest_axis(node.box.extent());
    return split_in_middle(parts_, node.begin, node.end, [&, axis](const Part& part) {
      double low = HUGE_VAL;
      for (const int32_t v : part) {
        if (v >= 0) low = std::min(low, coordinate(mesh_.vertices[v], axis));
      }
      return std::pair(low, part);
    });
  };
  build_tree(nodes_, 0, static_cast<int32_t>(parts_.size()), kLeaf, describe, split);
}

void Envelope::measure(Node& node) const {
  node.box = {};
  node.largest = 0;
  for (int32_t i = node.begin; i < node.end; ++i) {
    for (const int32_t v : parts_[i]) {
      if (v < 0) continue;
      node.box.add(mesh_.vertices[v]);
      node.largest = std::max(node.largest, mesh_.radius[v]);
    }
  }
}

void Envelope::refit() {
  for (Node& node : nodes_) measure(node);
  prepared_.resize(parts_.size());
  for (size_t i = 0; i < parts_.size(); ++i) prepared_[i] = of_part(static_cast<int32_t>(i));
}

EnvelopeOfSpheres Envelope::of_part(int32_t part) const {
  std::array<Sphere, 3> spheres;
  size_t count = 0;
  for (const int32_t v : parts_[part]) {
    if (v >= 0) spheres[count++] = {mesh_.vertices[v], mesh_.radius[v]};
  }
  return EnvelopeOfSpheres({spheres.data(), count});
}

NearestOfEnvelope Envelope::nearest_in(int32_t part, const Vec3& query) const {
  return prepared_.empty() ? of_part(part).nearest(query) : prepared_[part].nearest(query);
}

Envelope::Found Envelope::find(const Vec3& query, int32_t near) const {
  Found best;
  if (near >= 0) best = {nearest_in(near, query), near};
  const auto visit = [&](const Node& leaf) {
    for (int32_t i = leaf.begin; i < leaf.end; ++i) {
      if (part_bound(i, query) > best.nearest.distance) continue;
      const NearestOfEnvelope found = nearest_in(i, query);
      const bool first = found.distance == best.nearest.distance && i < best.part;
      if (found.distance < best.nearest.distance || first) best = {found, i};
    }
  };
  if (bound(nodes_[0], query) > best.nearest.distance) return best;
  visit_nearest(
      nodes_, 0, [&](const Node& node) { return bound(node, query); },
      [&] { return best.nearest.distance; }, visit);
  return best;
}

bool Envelope::covers(const Vec3& query, double depth) const { return covers_in(0, query, -depth); }

bool Envelope::covers_in(int32_t id, const Vec3& query, double limit) const {
  const Node& node = nodes_[id];
  if (bound(node, query) >= limit) return false;
  if (!node.is_leaf()) {
    return covers_in(id + 1, query, limit) || covers_in(node.right, query, limit);
  }
  for (int32_t i = node.begin; i < node.end; ++i) {
    if (part_bound(i, query) < limit && nearest_in(i, query).distance < limit) return true;
  }
  return false;
}

double Envelope::bound(const Node& node, const Vec3& query) {
  return std::sqrt(squared_distance(node.box, query)) - node.largest;
}

// The distance to a centre is at least that along any direction, and the direction from the middle
// of a small part is nearly the one to its nearest ball.
double Envelope::part_bound(int32_t part, const Vec3& query) const {
  Vec3 middle;
  int count = 0;
  for (const int32_t v : parts_[part]) {
    if (v < 0) break;
    middle = middle + mesh_.vertices[v];
    ++count;
  }
  const Vec3 away = query - (1.0 / count) * middle;
  const double whole = length(away);
  if (!(whole > 0)) return -HUGE_VAL;
  double least = HUGE_VAL;
  for (int i = 0; i < count; ++i) {
    const int32_t v = parts_[part][i];
    least = std::min(least, dot(away, query - mesh_.vertices[v]) / whole - mesh_.radius[v]);
  }
  return least;
}

std::vector<double> solid_distances(std::span<const Vec3> queries, const SphereMesh& mesh,
                                    int threads, Progress* progress) {
  require_finite(queries, "query");
  require_sphere_mesh(mesh);
  if (mesh.vertices.empty()) {
    throw InvalidInputError("Expected a mesh of at least one sphere, found none; pass one.");
  }
  const Run run{thread_count(threads), progress};
  const SphereMesh whole = without_doubles(mesh);
  const Envelope envelope(whole);
  std::vector<double> result(queries.size());
  parallel_for(
      static_cast<int64_t>(queries.size()), run,
      [&](int64_t i) { result[i] = envelope.find(queries[i]).nearest.distance; }, 256);
  return result;
}

}  // namespace medial
