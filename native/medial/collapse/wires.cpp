// SPDX-License-Identifier: GPL-3.0-or-later
#include "collapse/wires.h"

#include "collapse/bucket_queue.h"

namespace medial {
namespace {

constexpr size_t kBuckets = 512;

// A fire front on a wire measures lengths from an anchor instead of adding up edges, because
// Voronoi edges zigzag. The anchor follows after half of the radius of the ball there, and not
// before so many edges: those of sheets that are thinner than the samples are apart zigzag as well.
struct Front {
  double time = -HUGE_VAL, anchor_time = -HUGE_VAL;
  int32_t anchor = -1, edges = 0;
};
constexpr int32_t kEdgesPerAnchor = 9;  // derived: a chord of 4 spacings is off by 1 %

class WireFire {
 public:
  WireFire(const InnerComplex& complex, const Burning& burning, Collapse& collapse, const Run& run)
      : complex_(complex),
        burning_(burning),
        collapse_(collapse),
        progress_(run.progress),
        queue_(kFirstRange * complex.diagonal / kBuckets, kBuckets),
        left_(edges_left(complex, collapse, {run.threads, nullptr, run.arena})),
        front_(array<Front>(complex.cell.size(), Front{}, run)) {
    wires_.order = array<int32_t>(0, run);
    wires_.order.reserve(complex.cell.size());
    wires_.next = array<int32_t>(0, run);
    wires_.next.reserve(complex.cell.size());
    wires_.elongation = array<double>(complex.cell.size(), run);
  }

  Wires run() && {
    for (int32_t v = 0; v < complex_.vertices(); ++v) follow(v);
    for (int32_t v; (v = queue_.pop()) >= 0;) {
      if (is_loose(v)) follow(take_away(v));
    }
    return std::move(wires_);
  }

 private:
  bool is_loose(int32_t vertex) const {
    return left_[vertex].count() == 1 && burning_.is_wire[left_[vertex].last()];
  }

  // Removes loose ends, one after the other, as long as they do not have to wait. In the first
  // range the order only affects which vertex of a small tree stays: a loose end stays loose, and
  // the cells behind it determine the elongation.
  void follow(int32_t vertex) {
    while (is_loose(vertex)) {
      light(vertex);
      const double elongation = wires_.elongation[vertex];
      if (elongation > kFirstRange * complex_.diagonal) {
        queue_.push(elongation, vertex);
        return;
      }
      vertex = take_away(vertex);
    }
  }

  // Computes the time at a loose end, and the elongation of its edge.
  void light(int32_t vertex) {
    const int32_t edge = left_[vertex].last();
    const Times& t = burning_.times[edge];
    const double sideways = t[complex_.ends[edge][0] == vertex ? 0 : 1];
    Front& front = front_[vertex];
    if (!(front.time > sideways)) front = {sideways, sideways, vertex};
    const Vec3& at = complex_.position[vertex];
    const Vec3 middle = 0.5 * (at + complex_.position[other_end(complex_, edge, vertex)]);
    const double time = later(front, middle);
    wires_.elongation[vertex] = std::max(0.0, time - 0.5 * (t[0] + t[1]));
  }

  double later(const Front& front, const Vec3& x) const {
    return std::max(front.time, front.anchor_time + distance(x, complex_.position[front.anchor]));
  }

  // Removes a loose end and its edge; returns the other end of the edge.
  int32_t take_away(int32_t vertex) {
    const int32_t edge = left_[vertex].last(), other = other_end(complex_, edge, vertex);
    shared_store(collapse_.partner[edge], with_vertex(vertex));
    collapse_.edge_of_vertex[vertex] = edge;
    wires_.order.push_back(vertex);
    wires_.next.push_back(other);
    if (wires_.order.size() % (1 << 14) == 0) throw_if_cancelled(progress_);
    left_[vertex].remove(edge);
    left_[other].remove(edge);
    arrive(front_[vertex], other);
    return other;
  }

  // Lets a front come to a vertex. Where several fronts meet, the last one counts.
  void arrive(Front front, int32_t vertex) {
    const Vec3& at = complex_.position[vertex];
    front.time = later(front, at);
    const double away = distance(at, complex_.position[front.anchor]);
    if (++front.edges >= kEdgesPerAnchor && away > 0.5 * complex_.radius[vertex]) {
      front = {front.time, front.time, vertex};
    }
    if (front.time > front_[vertex].time) front_[vertex] = front;
  }

  const InnerComplex& complex_;
  const Burning& burning_;
  Collapse& collapse_;
  Progress* progress_;
  BucketQueue queue_;
  Array<Incident> left_;  // per vertex: the edges that are left at it
  Array<Front> front_;
  Wires wires_;
};

}  // namespace

Wires burn_wires(const InnerComplex& complex, const Burning& burning, Collapse& collapse,
                 const Run& run) {
  return WireFire(complex, burning, collapse, run).run();
}

}  // namespace medial
