// SPDX-License-Identifier: GPL-3.0-or-later
#include "cocone/labelled_poles.h"

#include <queue>

namespace medial {
namespace {

constexpr double kDeep = 0.5;  // the least cosine of two balls on the same side; chosen: unseen
constexpr int32_t kNone = -1;
constexpr int32_t kAtInfinity = 0;  // the node of all poles at infinity

enum class Label : uint8_t { none, inner, outer };

// Holds the two poles of a sample, each as a cell with that Voronoi vertex; `first` is the pole of
// Definition 1, `second` the farthest vertex on the other side of the sample. A cell with a point
// that is not a sample represents infinity.
struct TwoPoles {
  int32_t first = kNone, second = kNone;
};

struct PolesInput {
  std::span<const Vec3> points;
  const Triangulation& t;
  const Voronoi& voronoi;
  const Csr<int32_t>& incident;
  const Poles& poles;

  Vec3 towards(int32_t p, int32_t cell) const {
    return medial::towards(points[p], t, voronoi, cell);
  }
  bool is_infinite(int32_t cell) const {
    const auto samples = static_cast<int32_t>(incident.size());
    const Cell& corners = t.cells[cell];
    return std::any_of(corners.begin(), corners.end(),
                       [&](int32_t p) { return p < 0 || p >= samples; });
  }
};

// Returns the farthest Voronoi vertex for which `wanted` is true; among equally far ones it is that
// of the lowest cell. Infinite vertices are the farthest.
template <typename Wanted>
int32_t farthest(const PolesInput& s, int32_t p, const Wanted& wanted) {
  int32_t found = kNone;
  double most = -1;
  for (const int32_t cell : s.incident[p]) {
    const Vec3 v = s.towards(p, cell);
    const double far = s.t.is_infinite(cell) ? HUGE_VAL : squared_length(v);
    if (far > most && wanted(v)) most = far, found = cell;
  }
  return found;
}

TwoPoles poles_of(const PolesInput& s, int32_t p) {
  const Vec3 vector = s.poles.vector[p];
  return {farthest(s, p, [&](const Vec3& v) { return dot(v, vector) > 0; }),
          farthest(s, p, [&](const Vec3& v) { return dot(v, vector) < 0; })};
}

// Makes one node of all poles that are the same Voronoi vertex.
class Nodes {
 public:
  Nodes(const PolesInput& s, std::span<const TwoPoles> poles) : node_(s.t.cells.size(), kNone) {
    for (const TwoPoles& two : poles) {
      for (const int32_t cell : {two.first, two.second}) {
        if (cell >= 0) node_[s.voronoi.vertex[cell]] = kAtInfinity;
      }
    }
    for (int32_t cell = 0; cell < s.t.cell_count(); ++cell) {
      if (s.is_infinite(cell)) {
        node_[cell] = kAtInfinity;
      } else if (node_[cell] != kNone) {
        node_[cell] = count_++;
      }
    }
    for (int32_t cell = 0; cell < s.t.finite_cells; ++cell) {
      if (node_[cell] != kAtInfinity) node_[cell] = node_[s.voronoi.vertex[cell]];
    }
  }

  // Returns the node of a cell, or kNone if its Voronoi vertex is not a pole.
  int32_t operator[](int32_t cell) const { return cell < 0 ? kNone : node_[cell]; }
  int32_t count() const { return count_; }

 private:
  std::vector<int32_t> node_;
  int32_t count_ = 1;
};

// Links two nodes; the weight says how certainly they are on the same side, or on two sides if it
// is negative.
struct Link {
  std::array<int32_t, 2> nodes;
  float weight;

  auto begin() const { return nodes.begin(); }
  auto end() const { return nodes.end(); }
};

// Returns the cosine of the angle between two balls where their spheres meet.
double cosine(const PolesInput& s, int32_t p, int32_t of_p, int32_t q, int32_t of_q) {
  const double a = squared_length(s.towards(p, of_p)), b = squared_length(s.towards(q, of_q));
  const double d = squared_length(s.voronoi.centre[of_q] - s.voronoi.centre[of_p]);
  return (a + b - d) / (2 * std::sqrt(a) * std::sqrt(b));
}

double cosine_at(const PolesInput& s, int32_t p, int32_t cell, int32_t other) {
  return dot(normalized(s.towards(p, cell)), normalized(s.towards(p, other)));
}

class Links {
 public:
  Links(const PolesInput& s, const Edges& edges, std::span<const TwoPoles> poles,
        const Nodes& nodes, std::span<const uint8_t> flat, const Run& run)
      : s_(s), poles_(poles), nodes_(nodes) {
    parallel_append_to(found_, s.incident.size(), run, [&](int64_t p, auto& out, int) {
      at_sample(static_cast<int32_t>(p), flat[p] != 0, out);
    });
    parallel_append_to(found_, edges.count(), run,
                       [&](int64_t e, auto& out, int) { along_edge(edges.ends[e], out); });
    parallel_append_to(found_, s.t.cell_count(), run, [&](int64_t cell, auto& out, int) {
      behind_hull(static_cast<int32_t>(cell), out);
    });
  }

  std::vector<Link> take() { return std::move(found_); }

 private:
  static void link(int32_t a, int32_t b, double weight, std::vector<Link>& out) {
    if (a == kNone || b == kNone || a == b) return;
    out.push_back({{a, b}, static_cast<float>(std::min(weight, 1.0))});
  }

  void at_sample(int32_t p, bool flat, std::vector<Link>& out) const {
    const auto [first, second] = poles_[p];
    if (first < 0 || second < 0) return;
    const double cosine = dot(normalized(s_.poles.vector[p]), normalized(s_.towards(p, second)));
    if (flat ? cosine < 0 : cosine > kDeep) link(nodes_[first], nodes_[second], cosine, out);
  }

  void along_edge(const Edge& ends, std::vector<Link>& out) const {
    const auto [p, q] = ends;
    for (const int32_t a : {poles_[p].first, poles_[p].second}) {
      if (nodes_[a] <= kAtInfinity) continue;
      for (const int32_t b : {poles_[q].first, poles_[q].second}) {
        if (nodes_[b] <= kAtInfinity || nodes_[a] == nodes_[b]) continue;
        const double deep = cosine(s_, p, a, q, b);
        if (deep > kDeep) link(nodes_[a], nodes_[b], deep, out);
      }
    }
  }

  void behind_hull(int32_t cell, std::vector<Link>& out) const {
    if (nodes_[cell] != kAtInfinity) return;
    for (int i = 0; i < 4; ++i) {
      const int32_t behind = s_.t.neighbors[cell][i];
      if (nodes_[behind] <= kAtInfinity) continue;
      const Cell& ids = s_.t.cells[behind];
      const int32_t p =
          ids[slot_of(s_.t.neighbors[behind], cell) == 0 ? 1 : 0];  // a corner of both cells
      const double deep = cosine_at(s_, p, cell, behind);
      if (deep > kDeep) link(kAtInfinity, nodes_[behind], deep, out);
    }
  }

  const PolesInput& s_;
  std::span<const TwoPoles> poles_;
  const Nodes& nodes_;
  std::vector<Link> found_;
};

// Labels the nodes in the order of certainty, as Power Crust does.
class Labelling {
 public:
  Labelling(std::span<const Link> links, Csr<int32_t> at)
      : links_(links),
        at_(std::move(at)),
        label_(static_cast<size_t>(at_.size())),
        sure_(static_cast<size_t>(at_.size())) {}

  std::vector<Label> operator()() {
    sure_[kAtInfinity].outer = 1;
    queue_.push({priority(kAtInfinity), -kAtInfinity});
    while (!queue_.empty()) {
      const auto [known, turned] = queue_.top();
      queue_.pop();
      const int32_t node = -turned;
      // A node whose priority has changed since then is in the queue again.
      if (label_[node] != Label::none || known != priority(node)) continue;
      label_[node] = sure_[node].inner > sure_[node].outer ? Label::inner : Label::outer;
      pass_on(node);
    }
    return std::move(label_);
  }

 private:
  struct Sure {
    float inner = 0, outer = 0;
  };

  float priority(int32_t node) const {
    const auto [inner, outer] = sure_[node];
    // A node that both sides claim comes last.
    return inner > 0 && outer > 0 ? std::abs(inner - outer) - 1 : std::max(inner, outer);
  }

  void pass_on(int32_t node) {
    for (const int32_t id : at_[node]) {
      const Link& link = links_[id];
      const int32_t other = link.nodes[0] + link.nodes[1] - node;
      if (label_[other] != Label::none) continue;
      const bool inner = (label_[node] == Label::inner) == (link.weight > 0);
      float& known = inner ? sure_[other].inner : sure_[other].outer;
      if (!(std::abs(link.weight) > known)) continue;
      known = std::abs(link.weight);
      queue_.push({priority(other), -other});
    }
  }

  std::span<const Link> links_;
  Csr<int32_t> at_;  // per node: its links
  std::vector<Label> label_;
  std::vector<Sure> sure_;
  std::priority_queue<std::pair<float, int32_t>> queue_;  // equal priorities: lowest node first
};

std::vector<Label> labels(std::span<const Link> links, int32_t nodes, const Run& run) {
  return Labelling(links, rows_containing(links, nodes, run))();
}

}  // namespace

LabelledPoles labelled_poles(std::span<const Vec3> points, const Triangulation& t,
                             const Voronoi& voronoi, const Csr<int32_t>& incident,
                             const Edges& edges, const Poles& poles, std::span<const uint8_t> flat,
                             const Run& run) {
  begin_stage(run.progress, "Labels of poles", 0.9, 0.99);
  const PolesInput s{points, t, voronoi, incident, poles};
  const Run quiet{run.threads, nullptr};  // temporary arrays are not in the arena
  const auto samples = static_cast<size_t>(incident.size());
  std::vector<TwoPoles> two(samples);
  parallel_for(incident.size(), quiet,
               [&](int64_t p) { two[p] = poles_of(s, static_cast<int32_t>(p)); });
  const Nodes nodes(s, two);
  const auto links = Links(s, edges, two, nodes, flat, run).take();
  const auto label = labels(links, nodes.count(), quiet);
  LabelledPoles result{std::vector<Vec3>(samples), std::vector<int32_t>(samples, kNone),
                       std::vector<int32_t>(samples, kNone)};
  const auto of = [&](int32_t cell) { return cell < 0 ? Label::none : label[nodes[cell]]; };
  parallel_for(incident.size(), quiet, [&](int64_t p) {
    const auto [first, second] = two[p];
    const Label a = of(first), b = of(second);
    if (a == b) return;
    const Vec3 along = normalized(poles.vector[p]);
    const bool outward = a == Label::outer || b == Label::inner;
    result.normals[p] = outward ? along : -1.0 * along;
    if (a == Label::none || b == Label::none) return;
    result.inner[p] = outward ? second : first;
    const int32_t outer = outward ? first : second;
    result.outer[p] = nodes[outer] == kAtInfinity ? kNone : outer;
  });
  return result;
}

double disagreement(const LabelledPoles& poles, const CellSides& sides) {
  int64_t known = 0, against = 0;
  for (size_t p = 0; p < poles.normals.size(); ++p) {
    if (poles.inner[p] < 0) continue;
    const int32_t outer = poles.outer[p];
    ++known;
    against += sides[poles.inner[p]] != Side::inner || (outer >= 0 && sides[outer] == Side::inner);
  }
  return known == 0 ? 0 : static_cast<double>(against) / static_cast<double>(known);
}

}  // namespace medial
