#include "skeleton/fire.h"

#include "skeleton/bucket_queue.h"

namespace medial {
namespace {

// When the fire comes to x from the edge ab, which burns at its ends at the times `t` and between
// them at times that change evenly: the least of t(y) + |x - y| over the points y of ab.
double arrival(const Vec3& a, const Vec3& b, const Times& t, const Vec3& x) {
  const Vec3 ab = b - a, ax = x - a;
  const double size = length(ab);
  if (size > 0) {
    const double slope = (t[1] - t[0]) / size, along = dot(ax, ab) / size;
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

// Where a facet is, and how large the ball is there.
struct Middle {
  Vec3 centroid;
  double radius;
};

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

constexpr size_t kFacetsPerBucket = 512, kMostBuckets = 1 << 14;
constexpr int kLookEvery = 1 << 13;  // facets between two looks at whether to stop

class Fire {
 public:
  Fire(const InnerComplex& complex, std::span<const Vec3> points, Collapse& collapse,
       const Run& run)
      : complex_(complex),
        collapse_(collapse),
        run_{run.threads, nullptr, run.arena},
        progress_(run.progress),
        buckets_(std::clamp<size_t>(complex.dual.size() / kFacetsPerBucket, 16, kMostBuckets)),
        queue_(0.25 * complex.diagonal / static_cast<double>(buckets_), buckets_ + 1),
        middle_(array<Middle>(complex.dual.size(), run)),
        time_(array<double>(complex.dual.size(), HUGE_VAL, run)),
        reached_(array<float>(complex.ends.size(), 0, run)) {
    burning_ = {array<Times>(complex.ends.size(), run),
                array<double>(complex.dual.size(), HUGE_VAL, run),
                array<float>(complex.dual.size(), HUGE_VALF, run)};
    light_edges();
    light_facets(points);
  }

  Burning run() && {
    int64_t count = 0;
    for (int32_t f; (f = queue_.pop()) >= 0;) {
      if (!collapse_.facet_gone[f]) burn(f);
      if (++count % kLookEvery == 0) {
        advance(progress_,
                static_cast<double>(count) / static_cast<double>(complex_.facets() + count));
      }
    }
    return std::move(burning_);
  }

 private:
  void light_edges() {
    parallel_for(complex_.edges(), run_, [&](int64_t e) {
      if (collapse_.facets_at[e].count > 1) return;
      const auto& [a, b] = complex_.ends[e];
      burning_.times[e] = {complex_.radius[a], complex_.radius[b]};
    });
  }

  void light_facets(std::span<const Vec3> points) {
    parallel_for(complex_.facets(), run_, [&](int64_t id) {
      const auto f = static_cast<int32_t>(id);
      if (collapse_.facet_gone[f]) {
        burning_.thickness[f] = 0;
        burning_.erosion[f] = 0;
        return;
      }
      const Vec3 middle = centroid(complex_, f);
      middle_[f] = {middle, distance(middle, points[complex_.generators[f][0]])};
      for (const Corner& c : complex_.ring(f)) {
        if (collapse_.facets_at[c.edge].count == 1) heat(f, c.edge);
      }
    });
    for (int32_t f = 0; f < complex_.facets(); ++f) {
      if (!collapse_.facet_gone[f] && time_[f] < HUGE_VAL) queue_.push(burning_.thickness[f], f);
    }
  }

  double arrival_from(int32_t edge, const Vec3& x) const {
    const auto& [a, b] = complex_.ends[edge];
    return arrival(complex_.position[a], complex_.position[b], burning_.times[edge], x);
  }

  // The fire comes to a facet through an edge. Returns whether it becomes less thick by that.
  bool heat(int32_t facet, int32_t edge) {
    const Times& t = burning_.times[edge];
    if (std::min(t[0], t[1]) >= time_[facet]) return false;
    const double time = arrival_from(edge, middle_[facet].centroid);
    if (time >= time_[facet]) return false;
    time_[facet] = time;
    const double thickness = std::max(0.0, time - middle_[facet].radius);
    return std::exchange(burning_.thickness[facet], thickness) > thickness;
  }

  void burn(int32_t facet) {
    const auto ring = complex_.ring(facet);
    free_.clear();
    for (const Corner& c : ring) {
      if (collapse_.facets_at[c.edge].count == 1) free_.push_back(c.edge);
    }
    const int32_t exit = first_free();
    collapse_.facet_gone[facet] = 1;
    collapse_.partner[exit] = facet;
    const auto share = static_cast<float>(burning_.thickness[facet] / complex_.diagonal);
    const float erosion = std::max(share, reached_[exit]);
    burning_.erosion[facet] = erosion;
    for (const auto& [vertex, edge] : ring) {
      reached_[edge] = std::max(reached_[edge], erosion);
      collapse_.facets_at[edge].remove(facet);
      if (collapse_.facets_at[edge].count == 1) pass_on(edge);
    }
  }

  // Of the free edges of a facet the one that burns first.
  int32_t first_free() const {
    const auto sum = [&](int32_t edge) {
      return burning_.times[edge][0] + burning_.times[edge][1];
    };
    int32_t best = free_[0];
    for (const int32_t edge : free_) {
      if (sum(edge) < sum(best) || (sum(edge) == sum(best) && edge < best)) best = edge;
    }
    return best;
  }

  // From the facet in hand, over an edge that has become free, to the last facet there.
  void pass_on(int32_t edge) {
    for (int i = 0; i < 2; ++i) {
      const Vec3& x = complex_.position[complex_.ends[edge][i]];
      double first = HUGE_VAL;
      for (const int32_t from : free_) first = std::min(first, arrival_from(from, x));
      burning_.times[edge][i] = first;
    }
    const int32_t next = collapse_.facets_at[edge].ids;
    if (heat(next, edge)) queue_.push(burning_.thickness[next], next);
  }

  const InnerComplex& complex_;
  Collapse& collapse_;
  Run run_;
  Progress* progress_;
  size_t buckets_;
  BucketQueue queue_;
  Array<Middle> middle_;
  Array<double> time_;    // per facet: when the fire comes to its centroid
  Array<float> reached_;  // per edge: the erosion of the facets there that have gone
  Burning burning_;
  std::vector<int32_t> free_;  // edges of the facet in hand
};

}  // namespace

Burning burn(const InnerComplex& complex, std::span<const Vec3> points, Collapse& collapse,
             const Run& run) {
  return Fire(complex, points, collapse, run).run();
}

}  // namespace medial
