// SPDX-License-Identifier: GPL-3.0-or-later
#include "structure/parts.h"

#include <map>

#include "base/rows.h"
#include "base/union_find.h"
#include "structure/places.h"

namespace medial {
namespace {

constexpr double kCrumb = 2;  // squared spacings; chosen: axis
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

// Returns the label of each facet, lower patch first. A facet with a generator where patches meet
// has the label that its other generator suggests, or that of the neighbours with which it shares
// the longest edges; twice -1 if there is none.
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

struct Contact {
  int32_t crumb, other;
  double length;
};

// Gives crumbs to their neighbours, round after round.
class Merger {
 public:
  Merger(const Facets& facets, std::span<const Edge> labels) : facets_(facets) {
    UnionFind sets(labels.size());
    for (int32_t e = 0; e < facets.edge_count(); ++e) {
      const auto at = facets.at_edge[e];
      if (at.size() == 2 && labels[at[0]] == labels[at[1]]) sets.unite(at[0], at[1]);
    }
    const auto first = std::move(sets).representatives();
    parts_.of_facet.assign(first.begin(), first.end());
    parts_.crumb.assign(labels.size(), 0);
    label_.assign(labels.begin(), labels.end());
    measure();
  }

  AxisParts merged() && {
    while (give_crumbs_away()) measure();
    unite_across_crumbs();
    return std::move(parts_);
  }

 private:
  int32_t part(int32_t facet) const { return parts_.of_facet[facet]; }

  // Parts are named after one of their facets, and measured under that name.
  void measure() {
    area_.assign(facets_.area.size(), 0);
    spacing_.assign(facets_.area.size(), 0);
    std::vector<int32_t> members(facets_.area.size(), 0);
    for (int32_t f = 0; f < facets_.count(); ++f) {
      area_[part(f)] += facets_.area[f];
      spacing_[part(f)] += facets_.spacing[f];
      ++members[part(f)];
    }
    for (size_t p = 0; p < members.size(); ++p) {
      if (members[p] > 0) spacing_[p] /= members[p];
    }
  }
  bool is_crumb(int32_t p) const { return area_[p] < kCrumb * spacing_[p] * spacing_[p]; }

  // Returns how long each crumb touches each other part, sorted by both.
  std::vector<Contact> contacts() const {
    std::vector<Contact> found;
    for (int32_t e = 0; e < facets_.edge_count(); ++e) {
      const auto at = facets_.at_edge[e];
      for (const int32_t a : at) {
        if (at.size() < 2 || !is_crumb(part(a))) continue;
        for (const int32_t b : at) {
          if (part(a) != part(b)) found.push_back({part(a), part(b), facets_.length(e)});
        }
      }
    }
    const auto pair = [](const Contact& c) { return std::pair(c.crumb, c.other); };
    std::stable_sort(found.begin(), found.end(),
                     [&](const Contact& a, const Contact& b) { return pair(a) < pair(b); });
    size_t kept = 0;
    for (size_t i = 0; i < found.size(); ++i) {
      if (kept > 0 && pair(found[i]) == pair(found[kept - 1])) {
        found[kept - 1].length += found[i].length;
      } else {
        found[kept++] = found[i];
      }
    }
    found.resize(kept);
    return found;
  }

  // Gives every crumb with a larger neighbour to one of these; if there are no such crumbs, crumbs
  // go to each other. Returns whether anything changed.
  bool give_crumbs_away() {
    const auto all = contacts();
    if (all.empty()) return false;
    const bool some_large =
        std::any_of(all.begin(), all.end(), [&](const Contact& c) { return !is_crumb(c.other); });
    std::vector<Contact> best;
    for (const Contact& c : all) {
      if (some_large && is_crumb(c.other)) continue;
      if (best.empty() || best.back().crumb != c.crumb) {
        best.push_back(c);
      } else if (c.length > best.back().length) {
        best.back() = c;
      }
    }
    join(best, some_large);
    return true;
  }

  void join(std::span<const Contact> best, bool into_large) {
    UnionFind sets(area_.size());
    for (const Contact& c : best) sets.unite(c.crumb, c.other);
    const auto first = std::move(sets).representatives();
    // The name of the largest member becomes that of all.
    const auto size = [&](int32_t p) { return std::pair(!is_crumb(p), area_[p]); };
    std::vector<int32_t> name(first.begin(), first.end());
    for (int32_t p = 0; p < static_cast<int32_t>(first.size()); ++p) {
      if (size(p) > size(name[first[p]])) name[first[p]] = p;
    }
    for (int32_t f = 0; f < facets_.count(); ++f) {
      const int32_t old = part(f), now = name[first[old]];
      if (now == old) continue;
      parts_.of_facet[f] = now;
      if (into_large) parts_.crumb[f] = 1;
    }
  }

  // A crumb divides nothing. Where it was a strip between two sheets it has their label now; where
  // it stood on a sheet, two facets are left without it.
  void unite_across_crumbs() {
    UnionFind sets(area_.size());
    for (int32_t e = 0; e < facets_.edge_count(); ++e) {
      Edge two{-1, -1};
      int count = 0;
      const auto at = facets_.at_edge[e];
      for (const int32_t f : at) {
        if (at.size() > 2 && parts_.crumb[f]) continue;
        if (count < 2) two[count] = part(f);
        ++count;
      }
      if (count == 2 && label_[two[0]] == label_[two[1]]) sets.unite(two[0], two[1]);
    }
    const auto first = std::move(sets).representatives();
    for (int32_t& p : parts_.of_facet) p = first[p];
  }

  const Facets& facets_;
  AxisParts parts_;
  std::vector<Edge> label_;  // of the part that is named after each facet
  std::vector<double> area_, spacing_;
};

}  // namespace

AxisParts parts_of(const Facets& facets, const Run& run) {
  const auto labels = labels_of(facets, run);
  AxisParts parts = Merger(facets, labels).merged();
  std::vector<int32_t> number(labels.size(), -1), names;
  std::vector<double> area;
  std::vector<Placed> things;
  for (int32_t f = 0; f < facets.count(); ++f) {
    const int32_t name = parts.of_facet[f];
    int32_t& p = number[name];
    if (p < 0) {
      p = static_cast<int32_t>(names.size());
      names.push_back(name);
      area.push_back(0);
      things.push_back({{labels[name][0], labels[name][1]}, {}, 0});
    }
    area[p] += facets.area[f];
    things[p].place = things[p].place + facets.area[f] * facets.middle[f];
    things[p].apart = std::max(things[p].apart, facets.spacing[f]);
  }
  for (size_t p = 0; p < things.size(); ++p) {
    if (area[p] > 0) things[p].place = (1 / area[p]) * things[p].place;
  }
  std::vector<int32_t> rank(things.size());
  for (const int32_t p : order_of(things)) {
    rank[p] = parts.count();
    parts.label.push_back(labels[names[p]]);
  }
  for (int32_t& p : parts.of_facet) p = rank[number[p]];
  return parts;
}

}  // namespace medial
