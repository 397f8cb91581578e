// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/paired_samples.h"

#include "base/random.h"
#include "base/rows.h"
#include "sampling/mirrored_rows.h"

namespace medial {
namespace {

// A partner may be moved onto a crease, or to a sample, by this share of the distance of the walls.
// Where that is less than a disc's radius, the share is smaller: the facet between partners is as
// wide as the disc, and must not leave the wall when it turns.
constexpr double kMoved = 0.14;          // chosen: axis
constexpr double kReplaced = 1.03;       // radii from a partner on the same crease; chosen: unseen
constexpr int kMostReflections = 3;      // from crease to crease
constexpr double kOneDirection = 0.866;  // 30 degrees: faces look one way; chosen: unseen
constexpr double kAcute = -0.2;  // the cosine between the normals of an acute edge; chosen: unseen
constexpr double kRimThickness = 0.5;  // of the radius, at most; chosen: axis
constexpr double kRim = 2;  // thicknesses from an edge to the row next to it; chosen: axis

double tolerance_of(const FixedSample& sample, double thickness) {
  return kMoved * std::min(thickness, sample.radius) * std::min(1.0, thickness / sample.radius);
}

}  // namespace

PairedSamples::PairedSamples(const CurvedSurface& surface, const Creases& creases,
                             const OppositeWalls& walls, const Spacing& spacing, const Run& run)
    : surface_(surface),
      creases_(creases),
      walls_(walls),
      lines_(surface.mesh(), creases),
      spacing_(spacing),
      run_(run),
      chain_of_(creases.edges.size(), -1) {
  for (int64_t c = 0; c < creases.chains.size(); ++c) {
    for (const ChainLink& link : creases.chains[c]) {
      chain_of_[link.edge] = static_cast<int32_t>(c);
    }
  }
}

// --- the faces at a sample, and the walls opposite to them

bool PairedSamples::is_reflex(int32_t edge) const {
  const MeshEdge& e = creases_.edges[edge];
  if (!e.manifold) return false;
  const Triangle& other = mesh().triangles[e.triangles[1]];
  const int32_t third = other[0] + other[1] + other[2] - e.ends[0] - e.ends[1];
  return dot(mesh().points[third] - mesh().points[e.ends[0]], mesh().normal[e.triangles[0]]) > 0;
}

// Returns the place of a sample on each face from which the solid, or the gap, is not a wedge that
// begins there.
std::vector<SurfacePlace> PairedSamples::places_of(const FixedSample& sample,
                                                   Through through) const {
  if (sample.edge < 0) {
    if (sample.kind == SampleKind::surface) return {{sample.triangle, sample.at}};
    const double at[3] = {sample.at.a, sample.at.b, sample.at.c};
    return places_at_vertex(mesh().triangles[sample.triangle][std::max_element(at, at + 3) - at]);
  }
  const MeshEdge& e = creases_.edges[sample.edge];
  std::vector<SurfacePlace> places;
  for (const int32_t t : e.triangles) {
    if (t < 0) continue;
    places.push_back({t, place_on_edge(mesh().triangles[t], e.ends, sample.share)});
  }
  const bool acute =
      places.size() == 2 && dot(normal(e.triangles[0]), normal(e.triangles[1])) < kAcute;
  if (acute && is_reflex(sample.edge) == (through == Through::gap)) places.clear();
  return places;
}

std::vector<SurfacePlace> PairedSamples::places_at_vertex(int32_t vertex) const {
  std::vector<SurfacePlace> places;
  for (const int32_t t : mesh().fans[vertex]) {
    const bool again = std::any_of(places.begin(), places.end(), [&](const SurfacePlace& other) {
      return dot(normal(t), normal(other.triangle)) > kOneDirection;
    });
    if (!again) places.push_back({t, place_on_edge(mesh().triangles[t], {vertex, -1}, 0)});
  }
  return places;
}

std::optional<WallPlace> PairedSamples::wall_opposite(const FixedSample& sample,
                                                      const SurfacePlace& place,
                                                      Through through) const {
  return walls_(place, kCloseWalls * sample.radius / kDisk, through);
}

PairedSamples::Opposites PairedSamples::opposites_of(const FixedSample& sample) const {
  Opposites found;
  for (const Through through : {Through::solid, Through::gap}) {
    for (const SurfacePlace& place : places_of(sample, through)) {
      const auto wall = wall_opposite(sample, place, through);
      if (wall) found.push_back({place.triangle, *wall, through});
    }
  }
  return found;
}

// --- the samples that are there

uint64_t PairedSamples::cell_of(const Vec3& point, int dx, int dy, int dz) const {
  const auto at = [&](double x, int d) {
    return static_cast<uint64_t>(static_cast<int64_t>(std::floor(x / width_)) + d);
  };
  return scrambled(at(point.x, dx) ^ scrambled(at(point.y, dy) ^ scrambled(at(point.z, dz))));
}

template <typename Found>
void PairedSamples::for_near(const Vec3& point, double reach, const Found& found) const {
  const int cells = width_ > 0 ? static_cast<int>(std::ceil(reach / width_)) : -1;
  for (int x = -cells; x <= cells; ++x) {
    for (int y = -cells; y <= cells; ++y) {
      for (int z = -cells; z <= cells; ++z) {
        const auto cell = cells_.find(cell_of(point, x, y, z));
        if (cell == cells_.end()) continue;
        for (const int32_t id : cell->second) {
          const double away = distance(samples_[id].point, point);
          if (away <= reach) found(id, away);
        }
      }
    }
  }
}

// Returns the nearest sample of the same wall within a tolerance, or -1.
int32_t PairedSamples::coincident(const FixedSample& sample, double tolerance) const {
  int32_t best = -1;
  double nearest = HUGE_VAL;
  for_near(sample.point, tolerance, [&](int32_t id, double away) {
    const Disk other = disk_of(samples_[id]);
    const bool same_wall = other.normal == Vec3{} || dot(other.normal, sample.normal) > 0;
    if (!same_wall || away > nearest || (away == nearest && id > best)) return;
    best = id;
    nearest = away;
  });
  return best;
}

// Returns whether one of the samples before a number is too near.
bool PairedSamples::is_crowded(const FixedSample& sample, size_t before) const {
  bool crowded = false;
  for_near(sample.point, sample.radius, [&](int32_t id, double away) {
    if (static_cast<size_t>(id) >= before) return;
    const Disk other = disk_of(samples_[id]);
    if (!(away < std::min(sample.radius, other.radius))) return;
    crowded |= other.normal == Vec3{} || dot(other.normal, sample.normal) > 0;
  });
  return crowded;
}

// Returns whether a partner from another wall is near on the same crease.
bool PairedSamples::is_replaced(const FixedSample& sample) const {
  bool replaced = false;
  for_near(sample.point, kReplaced * sample.radius, [&](int32_t id, double away) {
    const FixedSample& other = samples_[id];
    if (!is_partner_[id] || other.edge < 0) return;
    replaced |= chain_of_[other.edge] == chain_of_[sample.edge] &&
                away < kReplaced * std::min(sample.radius, other.radius);
  });
  return replaced;
}

int32_t PairedSamples::add(const FixedSample& sample, bool is_partner) {
  const auto id = static_cast<int32_t>(samples_.size());
  samples_.push_back(sample);
  is_partner_.push_back(is_partner);
  cells_[cell_of(sample.point, 0, 0, 0)].push_back(id);
  return id;
}

// One of the two names the other.
void PairedSamples::link(int32_t p, int32_t q) {
  if (p == q || samples_[p].partner == q || samples_[q].partner == p) return;
  if (samples_[p].partner < 0) {
    samples_[p].partner = q;
  } else if (samples_[q].partner < 0) {
    samples_[q].partner = p;
  }
}

// --- creases

void PairedSamples::add_on_creases(std::span<const FixedSample> samples) {
  for (const FixedSample& s : samples) width_ = std::max(width_, s.radius);
  std::vector<Opposites> opposites(samples.size());
  std::vector<uint8_t> rank(samples.size());
  parallel_for(
      static_cast<int64_t>(samples.size()), run_,
      [&](int64_t i) {
        opposites[i] = opposites_of(samples[i]);
        rank[i] = rank_of(samples[i], opposites[i]);
      },
      64);
  // Corners stay where they are, so all of them are there before the partners of the first one.
  std::vector<int32_t> id(samples.size(), -1);
  for (size_t i = 0; i < samples.size(); ++i) {
    if (rank[i] == 0) id[i] = add(samples[i], false);
  }
  for (uint8_t now = 0; now < 4; ++now) {
    throw_if_cancelled(run_.progress);
    for (size_t i = 0; i < samples.size(); ++i) {
      if (rank[i] != now || (now > 0 && is_replaced(samples[i]))) continue;
      if (now > 0) id[i] = add(samples[i], false);
      add_partners(id[i], opposites[i], 0);
    }
  }
}

// Corners come first, and the inner edges of corners before their outer ones.
uint8_t PairedSamples::rank_of(const FixedSample& sample, const Opposites& opposites) const {
  if (sample.edge < 0) return 0;
  if (is_reflex(sample.edge)) return 2;
  return inside_corner(sample, opposites) ? 1 : 3;
}

void PairedSamples::add_partners(int32_t id, const Opposites& opposites, int depth) {
  if (depth > kMostReflections) return;
  for (const auto& [triangle, wall, through] : opposites) {
    const FixedSample found = on_surface(surface_, wall.triangle, wall.at, spacing_);
    const double tolerance = tolerance_of(samples_[id], wall.distance);
    const int32_t partner = add_partner(found, tolerance, through, depth);
    if (through == Through::solid) link(id, partner);
  }
  add_outer_edge(id, opposites, depth);
}

// Returns through what an edge is the inner one of a corner, where two walls or two gaps meet.
std::optional<Through> PairedSamples::inside_corner(const FixedSample& sample,
                                                    const Opposites& opposites) const {
  if (sample.edge < 0) return {};
  const Through through = is_reflex(sample.edge) ? Through::solid : Through::gap;
  const auto count = std::count_if(opposites.begin(), opposites.end(),
                                   [&](const Opposite& o) { return o.through == through; });
  return count == 2 ? std::optional(through) : std::nullopt;
}

// Adds the sample of the outer edge of a corner that is opposite to its inner edge.
void PairedSamples::add_outer_edge(int32_t id, const Opposites& opposites, int depth) {
  const FixedSample sample = samples_[id];
  const auto through = inside_corner(sample, opposites);
  if (!through) return;
  const auto first = std::find_if(opposites.begin(), opposites.end(),
                                  [&](const Opposite& o) { return o.through == *through; });
  const auto second = std::find_if(first + 1, opposites.end(),
                                   [&](const Opposite& o) { return o.through == *through; });
  const double sign = *through == Through::solid ? 1 : -1;
  const Vec3 n = sign * normal(first->triangle), m = sign * normal(second->triangle);
  const double cosine = dot(n, m), determinant = 1 - cosine * cosine;
  const double down = first->wall.distance, across = second->wall.distance;
  // The point is `down` below one face, and `across` below the other one.
  const Vec3 away =
      ((across * cosine - down) / determinant) * n + ((down * cosine - across) / determinant) * m;
  const double tolerance = tolerance_of(sample, std::min(down, across));
  const auto line = lines_.nearest(walls_.point(sample.triangle, sample.at) + away, tolerance);
  if (!line) return;
  const FixedSample outer = on_edge(surface_, creases_, line->edge, line->share, spacing_);
  const int32_t there = coincident(outer, tolerance);
  const int32_t other = there >= 0 ? there : add(outer, true);
  if (*through == Through::solid) link(other, id);
  if (*through == Through::gap && there < 0) add_partners(other, opposites_of(outer), depth + 1);
}

// Adds a partner, or finds that it is there. One that is next to a crease moves onto it, and has
// partners of its own. Others have one on their other side.
int32_t PairedSamples::add_partner(const FixedSample& found, double tolerance, Through through,
                                   int depth) {
  const int32_t there = coincident(found, tolerance);
  if (there >= 0) return there;
  const auto line = lines_.nearest(walls_.point(found.triangle, found.at), tolerance);
  if (!line) {
    const int32_t id = add(found, true);
    const auto next = through == Through::solid ? Through::gap : Through::solid;
    const auto wall = wall_opposite(found, {found.triangle, found.at}, next);
    if (wall) add_partners(id, {{found.triangle, *wall, next}}, depth + 1);
    return id;
  }
  const FixedSample moved = on_edge(surface_, creases_, line->edge, line->share, spacing_);
  const int32_t same = coincident(moved, tolerance);
  if (same >= 0) return same;
  const int32_t id = add(moved, true);
  add_partners(id, opposites_of(moved), depth + 1);
  return id;
}

// --- rows next to creases

void PairedSamples::add_rims() {
  const auto on_creases = static_cast<int32_t>(samples_.size());
  for (int32_t id = 0; id < on_creases; ++id) {
    const int32_t edge = samples_[id].edge;
    if (edge < 0 || !creases_.edges[edge].manifold || is_reflex(edge)) continue;
    for (const int side : {0, 1}) add_rim(id, side);
  }
}

void PairedSamples::add_rim(int32_t id, int side) {
  const FixedSample sample = samples_[id];
  const MeshEdge& edge = creases_.edges[sample.edge];
  const int32_t triangle = edge.triangles[side];
  if (dot(normal(triangle), normal(edge.triangles[1 - side])) < kAcute) return;
  const Barycentric at = place_on_edge(mesh().triangles[triangle], edge.ends, sample.share);
  const auto wall = wall_opposite(sample, {triangle, at});
  if (!wall || !(wall->distance < kRimThickness * sample.radius)) return;
  const double away = kRim * wall->distance;
  const auto place = walk_from_edge(mesh(), creases_, edge, triangle, sample.share, away);
  if (!place) return;
  const FixedSample inner = on_surface(surface_, place->triangle, place->at, spacing_);
  const auto opposite = wall_opposite(inner, *place);
  if (!opposite || coincident(inner, 0.5 * away) >= 0) return;
  const FixedSample other = on_surface(surface_, opposite->triangle, opposite->at, spacing_);
  if (coincident(other, 0.5 * away) >= 0) return;
  const int32_t row = add(inner, true);
  add_partners(row, opposites_of(inner), 0);
}

void PairedSamples::add_beside(std::span<const std::array<FixedSample, 2>> rows) {
  for (const auto& [left, right] : rows) {
    const size_t before = samples_.size();
    if (add_member(left) && add_member(right)) continue;
    while (samples_.size() > before) {
      cells_[cell_of(samples_.back().point, 0, 0, 0)].pop_back();
      samples_.pop_back();
      is_partner_.pop_back();
    }
  }
}

// Adds a sample and the places opposite to it unless they are there; returns whether it and those
// that are tight have room.
bool PairedSamples::add_member(const FixedSample& sample) {
  std::vector<ColumnPlace> column;
  walls_.column({sample.triangle, sample.at}, kCloseWalls * sample.radius / kDisk, column);
  const double thickness = column.size() > 1 ? column[1].distance : sample.radius;
  if (coincident(sample, tolerance_of(sample, thickness)) >= 0) return true;
  const size_t others = samples_.size();
  if (is_crowded(sample, others)) return false;
  std::vector<int32_t> ids{add(sample, false)};
  for (size_t i = 1; i < column.size(); ++i) {
    const ColumnPlace& opposite = column[i];
    ids.push_back(-1);
    if (ids[opposite.before] < 0) continue;
    const auto& [triangle, at] = opposite.place;
    const FixedSample next = on_surface(surface_, triangle, at, spacing_);
    const int32_t there = coincident(next, tolerance_of(sample, opposite.distance));
    if (there < 0 && is_crowded(next, others)) {
      if (opposite.is_tight) return false;
      continue;
    }
    ids[i] = there < 0 ? add(next, true) : there;
    if (opposite.through == Through::solid) link(ids[opposite.before], ids[i]);
  }
  return true;
}

std::vector<FixedSample> PairedSamples::sorted() && {
  std::vector<int32_t> order = all_rows(samples_.size());
  std::stable_sort(order.begin(), order.end(),
                   [&](int32_t a, int32_t b) { return samples_[a].kind < samples_[b].kind; });
  const std::vector<int32_t> place = places_among(order, order.size());
  std::vector<FixedSample> all;
  for (const int32_t id : order) {
    all.push_back(samples_[id]);
    if (all.back().partner >= 0) all.back().partner = place[all.back().partner];
  }
  for (size_t i = 0; i < all.size(); ++i) {
    const int32_t other = all[i].partner;
    if (other >= 0 && all[other].partner < 0) all[other].partner = static_cast<int32_t>(i);
  }
  return all;
}

}  // namespace medial
