// SPDX-License-Identifier: GPL-3.0-or-later
#include "collapse/fire.h"

#include "base/address_space.h"
#include "collapse/bucket_queue.h"

namespace medial {
namespace {

void fetch([[maybe_unused]] const void* at) {
#ifdef __GNUC__
  __builtin_prefetch(at);
  asm volatile("");  // without it GCC finds no effect in this function, and omits it
#endif
}

// Returns when the fire comes to x from the edge ab. It burns at its ends at the times `t`, and
// between them the time is linear, so this is the least t(y) + |x - y| over the points y of ab.
double arrival(const Vec3& a, const Vec3& b, const Times& t, const Vec3& x) {
  const Vec3 ab = b - a, ax = x - a;
  const double size = length(ab);
  if (size > 0) {
    const double per_size = 1 / size;
    const double slope = (t[1] - t[0]) * per_size, along = dot(ax, ab) * per_size;
    const double steep = 1 - slope * slope;
    if (steep > 0) {
      const double beside = std::sqrt(std::max(0.0, squared_length(ax) - along * along));
      const double root = std::sqrt(steep);
      const double from = along * root - beside * slope;  // place of y, times the root
      if (from > 0 && from < size * root) return t[0] + slope * along + beside * root;
    }
  }
  return std::min(t[0] + length(ax), t[1] + distance(x, b));
}

Vec3 centroid(const InnerComplex& complex, int32_t facet) {
  const auto ring = complex.ring(facet);
  const Vec3& start = complex.position[ring[0].vertex];
  Vec3 sum, mean;
  double area = 0;
  for (size_t i = 1; i < ring.size(); ++i) {
    const Vec3 b = complex.position[ring[i].vertex] - start;
    mean = mean + b;
    if (i + 1 == ring.size()) break;
    const Vec3 c = complex.position[ring[i + 1].vertex] - start;
    const double part = length(cross(b, c));
    sum = sum + part * (b + c);
    area += 3 * part;
  }
  if (area > 0) return start + (1 / area) * sum;
  return start + (1 / static_cast<double>(ring.size())) * mean;
}

// Holds the data of a facet that the fire reads, in one cache line. HotEdge does so for an edge.
struct alignas(64) HotFacet {
  Vec3 centroid;
  double radius;                   // of the ball at the centroid
  double time = HUGE_VAL;          // when the fire comes to the centroid
  float erosion = HUGE_VALF;       // infinite until the facet is removed
  int32_t first = 0, corners = 0;  // its corners in the complex
  bool gone = false;

  double thickness() const { return std::max(0.0, time - radius); }
};
struct alignas(32) HotEdge {
  Times times;  // valid once the edge is free
  Incident facets;
  float erosion = 0;  // the largest of the facets removed here
};

constexpr double kNotKnown = -1;  // no time is below 0; derived: below every time
constexpr size_t kFacetsPerBucket = 512, kMostBuckets = 1 << 12;
constexpr int kLookEvery = 1 << 13;  // facets between two checks for cancellation

class Fire {
 public:
  Fire(const InnerComplex& complex, const RadiusInFacet& radius, Collapse& collapse, const Run& run)
      : complex_(complex),
        collapse_(collapse),
        run_{run.threads, nullptr, run.arena},
        progress_(run.progress),
        buckets_(std::clamp<size_t>(complex.dual.size() / kFacetsPerBucket, 16, kMostBuckets)),
        queue_(kFirstRange * complex.diagonal / static_cast<double>(buckets_), buckets_),
        facet_(array<HotFacet>(complex.dual.size(), run)),
        edge_(array<HotEdge>(complex.ends.size(), run)) {
    light_edges();
    collapse_.facets_at = array<Incident>(0, run_);
    if (run.arena) run.arena->release();
    light_facets(radius);
  }

  Burning run() && {
    int64_t count = 0;
    for (int32_t f; (f = queue_.pop()) >= 0;) {
      fetch_ahead();
      if (!facet_[f].gone) burn(f);
      if (++count % kLookEvery == 0) {
        advance(progress_,
                static_cast<double>(count) / static_cast<double>(complex_.facets() + count));
      }
    }
    return result();
  }

 private:
  void light_edges() {
    parallel_for(complex_.edges(), run_, [&](int64_t e) {
      const auto& [a, b] = complex_.ends[e];
      edge_[e] = {{}, collapse_.facets_at[e]};
      if (edge_[e].facets.count() < 2) edge_[e].times = {complex_.radius[a], complex_.radius[b]};
    });
  }

  void light_facets(const RadiusInFacet& radius) {
    const auto lit =
        parallel_append<int32_t>(complex_.facets(), run_, [&](int64_t id, auto& out, int) {
          const auto f = static_cast<int32_t>(id);
          HotFacet& facet = facet_[f] = {};
          facet.gone = collapse_.facet_gone[f] != 0;
          if (facet.gone) return;
          const auto ring = complex_.ring(f);
          facet.first = complex_.offsets[f];
          facet.corners = static_cast<int32_t>(ring.size());
          facet.centroid = centroid(complex_, f);
          facet.radius = radius(f, facet.centroid);
          for (size_t i = 0; i < ring.size(); ++i) {
            if (edge_[ring[i].edge].facets.count() == 1) heat(facet, side(ring, i));
          }
          if (facet.time < HUGE_VAL) out.push_back(f);
        });
    for (const int32_t f : lit) queue_.push(facet_[f].thickness(), f);
  }

  // Prefetches the next facets while this one burns. Each distance fetches what the previous
  // prefetch has made reachable.
  void fetch_ahead() const {
    if (const int32_t f = queue_.soon(24); f >= 0) fetch(&facet_[f]);
    if (const int32_t f = queue_.soon(16); f >= 0 && !facet_[f].gone) {
      const auto ring = ring_of(facet_[f]);
      fetch(&ring.front());
      fetch(&ring.back());
    }
    if (const int32_t f = queue_.soon(9); f >= 0 && !facet_[f].gone) {
      for (const Corner& c : ring_of(facet_[f])) fetch(&edge_[c.edge]);
    }
    if (const int32_t f = queue_.soon(3); f >= 0 && !facet_[f].gone) {
      for (const Corner& c : ring_of(facet_[f])) {
        fetch(&complex_.position[c.vertex]);
        const Incident& at = edge_[c.edge].facets;
        if (at.count() == 2) fetch(&facet_[at.other_than(f)]);
      }
    }
  }

  std::span<const Corner> ring_of(const HotFacet& facet) const {
    return {complex_.corners.data() + facet.first, static_cast<size_t>(facet.corners)};
  }

  // A side is an edge of a facet; the lower one of its ends comes first.
  struct Side {
    int32_t edge;
    Edge ends;
  };
  static Side side(std::span<const Corner> ring, size_t i) {
    const auto [low, high] = std::minmax(ring[i].vertex, ring[next(ring, i)].vertex);
    return {ring[i].edge, {low, high}};
  }
  static size_t next(std::span<const Corner> ring, size_t i) {
    return i + 1 < ring.size() ? i + 1 : 0;
  }

  double arrival_from(const Side& from, const Vec3& x) const {
    return arrival(complex_.position[from.ends[0]], complex_.position[from.ends[1]],
                   edge_[from.edge].times, x);
  }

  // Lets the fire come to a facet through an edge. Returns whether that makes the facet less thick.
  bool heat(HotFacet& facet, const Side& from) const {
    const Times& t = edge_[from.edge].times;
    if (std::min(t[0], t[1]) >= facet.time) return false;
    const double time = arrival_from(from, facet.centroid), before = facet.thickness();
    if (time >= facet.time) return false;
    facet.time = time;
    return facet.thickness() < before;
  }

  void burn(int32_t id) {
    HotFacet& facet = facet_[id];
    const auto ring = ring_of(facet);
    free_.clear();
    for (size_t i = 0; i < ring.size(); ++i) {
      if (edge_[ring[i].edge].facets.count() == 1) free_.push_back(side(ring, i));
    }
    const int32_t exit = first_free();
    collapse_.partner[exit] = id;
    facet.gone = true;
    facet.erosion =
        std::max(static_cast<float>(facet.thickness() / complex_.diagonal), edge_[exit].erosion);
    at_corner_.assign(ring.size(), kNotKnown);
    for (size_t i = 0; i < ring.size(); ++i) {
      HotEdge& edge = edge_[ring[i].edge];
      edge.erosion = std::max(edge.erosion, facet.erosion);
      edge.facets.remove(id);
      if (edge.facets.count() == 1) pass_on(ring, i);
    }
  }

  // Returns the free edge of the facet that burns first.
  int32_t first_free() const {
    const auto key = [&](const Side& free) {
      const Times& t = edge_[free.edge].times;
      return std::pair(t[0] + t[1], free.edge);
    };
    return std::min_element(free_.begin(), free_.end(),
                            [&](const Side& a, const Side& b) { return key(a) < key(b); })
        ->edge;
  }

  // Passes the fire from the current facet, over its edge that has become free, to the last facet
  // there.
  void pass_on(std::span<const Corner> ring, size_t i) {
    HotEdge& edge = edge_[ring[i].edge];
    const size_t j = next(ring, i);
    const bool upwards = ring[i].vertex < ring[j].vertex;
    edge.times = {first_at(ring, upwards ? i : j), first_at(ring, upwards ? j : i)};
    const int32_t last = edge.facets.last();
    if (heat(facet_[last], side(ring, i))) queue_.push(facet_[last].thickness(), last);
  }

  // Returns when the fire comes to a corner of the current facet.
  double first_at(std::span<const Corner> ring, size_t corner) {
    double& first = at_corner_[corner];
    if (first != kNotKnown) return first;
    first = HUGE_VAL;
    const int32_t vertex = ring[corner].vertex;
    for (const Side& from : free_) {
      const Times& t = edge_[from.edge].times;
      if (from.ends[0] == vertex || from.ends[1] == vertex) {
        first = std::min(first, t[from.ends[0] == vertex ? 0 : 1]);
      } else if (std::min(t[0], t[1]) < first) {
        first = std::min(first, arrival_from(from, complex_.position[vertex]));
      }
    }
    return first;
  }

  // Returns the results, and frees memory as early as possible.
  Burning result() {
    const size_t facets = complex_.dual.size(), edges = complex_.ends.size();
    if (run_.arena) run_.arena->release();
    release_heap();  // frees the memory of the queue
    Burning burning{array<Times>(0, run_), array<uint8_t>(0, run_), array<double>(facets, run_),
                    array<float>(facets, run_)};
    parallel_for(complex_.facets(), run_, [&](int64_t f) {
      const bool before = collapse_.facet_gone[f] != 0;
      const HotFacet& facet = facet_[f];
      burning.erosion[f] = before ? 0 : facet.erosion;
      burning.thickness[f] = before ? 0 : facet.gone ? facet.thickness() : HUGE_VAL;
      collapse_.facet_gone[f] = facet.gone;
    });
    facet_ = array<HotFacet>(0, run_);
    burning.times.resize(edges);
    burning.is_wire.resize(edges);
    parallel_for(complex_.edges(), run_, [&](int64_t e) {
      burning.times[e] = edge_[e].times;
      burning.is_wire[e] = edge_[e].facets.count() == 0;
    });
    return burning;
  }

  const InnerComplex& complex_;
  Collapse& collapse_;
  Run run_;
  Progress* progress_;
  size_t buckets_;
  BucketQueue queue_;
  Array<HotFacet> facet_;
  Array<HotEdge> edge_;
  std::vector<Side> free_;         // free edges of the current facet
  std::vector<double> at_corner_;  // when the fire comes to its corners; kNotKnown before
};

}  // namespace

RadiusInFacet radius_by(const InnerComplex& complex, std::span<const Vec3> points) {
  return [&complex, points](int32_t facet, const Vec3& place) {
    return distance(place, points[complex.generators[facet][0]]);
  };
}

Burning burn(const InnerComplex& complex, const RadiusInFacet& radius, Collapse& collapse,
             const Run& run) {
  return Fire(complex, radius, collapse, run).run();
}

}  // namespace medial
