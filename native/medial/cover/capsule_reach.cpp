// SPDX-License-Identifier: GPL-3.0-or-later
#include "cover/capsule_reach.h"

#include <algorithm>

#include "base/parallel.h"
#include "cover/pieces.h"

namespace medial {
namespace {

using Growth = std::vector<std::vector<LengthAt>>;

// Calls visit(worker, a, b, c) for each piece of the surface.
template <typename Visit>
void visit_surface(const CoveredSolid& solid, double piece, const Run& run, const Visit& visit) {
  const auto& points = solid.vertices.points;
  const auto& triangles = solid.surface.triangles;
  parallel_chunks(
      static_cast<int64_t>(triangles.size()), run,
      [&](int64_t begin, int64_t end, int worker) {
        for (int64_t t = begin; t < end; ++t) {
          const auto& [i, j, k] = triangles[t];
          visit_pieces(
              points[i], points[j], points[k], piece, run.progress,
              [&](const Vec3& a, const Vec3& b, const Vec3& c) { visit(worker, a, b, c); });
        }
      },
      kTriangles);
}

int32_t nearest_part(const Envelope& envelope, const Vec3& a, const Vec3& b, const Vec3& c) {
  return envelope.find((1.0 / 3) * (a + b + c)).part;
}

}  // namespace

SphereMesh sphere_mesh_of(std::span<const Capsule> capsules) {
  SphereMesh mesh;
  for (const Capsule& capsule : capsules) {
    const auto row = static_cast<int32_t>(mesh.vertices.size());
    mesh.vertices.push_back(capsule.a);
    mesh.vertices.push_back(capsule.b);
    mesh.radius.push_back(capsule.radius.first);
    mesh.radius.push_back(capsule.radius.second);
    mesh.wires.push_back({row, row + 1});
  }
  return mesh;
}

Growth needed_growth(std::span<const Capsule> capsules, const CoveredSolid& solid,
                     std::span<const Vec3> places, double piece, const Run& run) {
  const SphereMesh mesh = sphere_mesh_of(capsules);
  const Envelope envelope(mesh);
  std::vector<Growth> found(static_cast<size_t>(run.threads), Growth(capsules.size()));
  const auto add = [&](int worker, int32_t part, const Vec3& place) {
    const auto near = envelope.nearest_in(part, place);
    found[worker][envelope.parts()[part][0] / 2].push_back({near.shares[1], near.distance});
  };
  visit_surface(solid, piece, run, [&](int worker, const Vec3& a, const Vec3& b, const Vec3& c) {
    const int32_t part = nearest_part(envelope, a, b, c);
    for (const Vec3& corner : {a, b, c}) add(worker, part, corner);
  });
  parallel_chunks(static_cast<int64_t>(places.size()), run,
                  [&](int64_t begin, int64_t end, int worker) {
                    for (int64_t i = begin; i < end; ++i) {
                      add(worker, envelope.find(places[i]).part, places[i]);
                    }
                  });
  Growth all(capsules.size());
  for (const Growth& of_worker : found) {
    for (size_t k = 0; k < all.size(); ++k) {
      all[k].insert(all[k].end(), of_worker[k].begin(), of_worker[k].end());
    }
  }
  return all;
}

double farthest_from(std::span<const Capsule> capsules, const CoveredSolid& solid, double piece,
                     const Run& run) {
  const SphereMesh mesh = sphere_mesh_of(capsules);
  const Envelope envelope(mesh);
  std::vector<double> away(static_cast<size_t>(run.threads), 0);
  visit_surface(solid, piece, run, [&](int worker, const Vec3& a, const Vec3& b, const Vec3& c) {
    const int32_t part = nearest_part(envelope, a, b, c);
    for (const Vec3& corner : {a, b, c}) {
      away[worker] = std::max(away[worker], envelope.nearest_in(part, corner).distance);
    }
  });
  return *std::max_element(away.begin(), away.end());
}

int64_t held_places(std::span<const Capsule> capsules, std::span<const Vec3> places,
                    const Run& run) {
  const SphereMesh mesh = sphere_mesh_of(capsules);
  const Envelope envelope(mesh);
  std::vector<int64_t> held(static_cast<size_t>(run.threads), 0);
  parallel_chunks(static_cast<int64_t>(places.size()), run,
                  [&](int64_t begin, int64_t end, int worker) {
                    for (int64_t i = begin; i < end; ++i) {
                      if (envelope.find(places[i]).nearest.distance <= 0) ++held[worker];
                    }
                  });
  int64_t sum = 0;
  for (const int64_t count : held) sum += count;
  return sum;
}

}  // namespace medial
