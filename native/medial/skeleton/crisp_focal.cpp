// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>
#include <tuple>

#include "base/sort_unique.h"
#include "skeleton/crisp_parts.h"
#include "skeleton/focal_line.h"

namespace medial {
namespace {

// Lengths are in holes between the samples.
constexpr double kClearOfRim = 0.25;  // from the rim to a ball that is inside the sheet
constexpr double kBeyondRim = 0.5;   // the way from a vertex that leads beyond the end of the sheet
constexpr double kFarthestEnd = 1;   // from a vertex of the rim to the end of the sheet
constexpr double kAsOpen = 0.7;      // the least openness at the end, as a share of that inside
constexpr double kNearWeb = 1;       // from the end of the sheet to facets that are no sheet
constexpr double kNearEnd = 0.12;    // from the end of the sheet to what is drawn together there
constexpr double kKnotsApart = 1;    // between the places between which the line is straight
constexpr double kEndsApart = 0.25;  // of that, where the line goes on beyond the last one
constexpr double kNextKnot = 2.5;    // between neighbours of these, at most
constexpr size_t kMostSearched = 400;  // vertices, for a ball inside the sheet
constexpr int kMiddleRounds = 200;     // of steps towards the middle of the neighbours
constexpr int kSnapRounds = 60;

// At the rim of a fillet all balls nearly have one centre line, and the facets between the samples
// of the arc are a web of strips along that line. All vertices of the web go onto the line, in the
// order that the sheet beside it gives them. The line is straight between knots, so that facets of
// the web are lines, too.
class FocalRims {
 public:
  explicit FocalRims(CrispState& state) : c_(state) {}

  void gather() {
    find_ends();
    if (ends_.empty()) return;
    choose_knots();
    find_web();
    find_order();
    find_facets_of_web();
    for (int round = 0; round < kSnapRounds; ++round) {
      for (const int32_t v : web_) shorten_rim(v);
      bool changed = false;
      for (const int32_t f : facets_) {
        changed |= shorten_spikes(f);
        changed |= snap(f);
      }
      if (!changed) break;
    }
    snap_all();
    cover_line_once();
    place();
  }

 private:
  bool is_free(int32_t v) const {
    return c_.made.place[v] == Placing::touching || c_.made.place[v] == Placing::refused;
  }

  // Among the ripples of a fillet a few vertices find the end of a smooth sheet.
  bool may_join(int32_t v) const {
    return is_free(v) || (c_.made.place[v] == Placing::rim && c_.smooth_rim[v].reach > 0);
  }

  void find_ends() {
    std::vector<int32_t> rim;
    for (int32_t v = 0; v < c_.complex.vertices(); ++v) {
      if (c_.on_rim[v] && is_free(v) && !(c_.smooth_rim[v].reach > 0)) rim.push_back(v);
    }
    std::vector<Touch> found(rim.size());
    parallel_for(
        static_cast<int64_t>(rim.size()), c_.run, [&](int64_t i) { found[i] = end_near(rim[i]); },
        16);
    std::vector<Vec3> places;
    std::vector<double> spacing;
    for (size_t i = 0; i < rim.size(); ++i) {
      if (!(found[i].radius > 0)) continue;
      places.push_back(found[i].position);
      spacing.push_back(c_.spacing_at(rim[i]));
      ends_.push_back(found[i]);
    }
    keep_on_line(straightened(places, spacing, c_.run), spacing);
  }

  void keep_on_line(std::span<const std::optional<Vec3>> places, std::span<const double> spacing) {
    std::vector<Touch> found;
    std::swap(ends_, found);
    for (size_t i = 0; i < found.size(); ++i) {
      if (!places[i]) continue;
      ends_.push_back(found[i]);
      ends_.back().position = *places[i];
      spacing_.push_back(spacing[i]);
    }
  }

  // Returns the last ball that touches two places on a way out of the sheet past a vertex, if the
  // sheet ends there.
  Touch end_near(int32_t v) const {
    const int32_t inner = ball_inside(v);
    if (inner < 0) return {};
    const double spacing = c_.spacing_at(v);
    const Vec3 &from = c_.made.position[inner], &here = c_.made.position[v];
    const Vec3 beyond = here + (kBeyondRim * spacing) * normalized(here - from);
    const Touch inside = touch(c_, v, c_.walls[inner], from);
    const double least = kAsOpen * openness(inside.away);
    const Touch past = touch(c_, v, c_.walls[inner], beyond);
    if (!(inside.radius > 0) || (past.radius > 0 && openness(past.away) > least)) return {};
    const Touch last = last_ball(c_, v, c_.walls[inner], from, beyond, least);
    return distance(last.position, here) < kFarthestEnd * spacing ? last : Touch{};
  }

  // Returns the vertex closest by edges that touches two walls and is clear of the rim, or -1.
  int32_t ball_inside(int32_t v) const {
    std::vector<int32_t> reached{v};
    const double clear = kClearOfRim * c_.spacing_at(v);
    const auto is_clear = [&](int32_t u) {
      return std::none_of(reached.begin(), reached.end(), [&](int32_t w) {
        return c_.on_rim[w] && distance(c_.made.position[w], c_.made.position[u]) < clear;
      });
    };
    for (size_t next = 0; next < reached.size() && next < kMostSearched; ++next) {
      const int32_t u = reached[next];
      const bool touches = c_.made.place[u] == Placing::touching && c_.walls[u].count == 2;
      if (touches && !c_.on_rim[u] && is_clear(u)) return u;
      c_.for_edges(u, [&](const Corner&, int32_t other) {
        if (std::find(reached.begin(), reached.end(), other) == reached.end()) {
          reached.push_back(other);
        }
      });
    }
    return -1;
  }

  // Chooses ends that are a certain distance apart, and then more of them where the line goes on.
  void choose_knots() {
    apart_ = kKnotsApart * *std::max_element(spacing_.begin(), spacing_.end());
    for (const double share : {1.0, kEndsApart}) {
      for (size_t i = 0; i < ends_.size(); ++i) {
        const double apart = share * kKnotsApart * spacing_[i];
        if (share < 1 && distance_to_line(ends_[i].position) < apart) continue;
        if (has_knot_near(ends_[i].position, apart)) continue;
        boxes_[box_of(ends_[i].position)].push_back(knots_.size());
        knots_.push_back(ends_[i]);
      }
      std::vector<Vec3> places;
      for (const Touch& knot : knots_) places.push_back(knot.position);
      knot_tree_ = PointTree::sorted(places, c_.run);
    }
  }

  using BoxId = std::array<int64_t, 3>;

  BoxId box_of(const Vec3& p) const {
    const auto box = [&](double x) { return static_cast<int64_t>(std::floor(x / apart_)); };
    return {box(p.x), box(p.y), box(p.z)};
  }

  bool has_knot_near(const Vec3& place, double within) const {
    const BoxId own = box_of(place);
    for (int64_t k = 0; k < 27; ++k) {
      const auto found =
          boxes_.find({own[0] + k % 3 - 1, own[1] + k / 3 % 3 - 1, own[2] + k / 9 - 1});
      if (found == boxes_.end()) continue;
      for (const size_t knot : found->second) {
        if (distance(knots_[knot].position, place) < within) return true;
      }
    }
    return false;
  }

  double distance_to_line(const Vec3& place) const {
    return distance(place, place_at(on_line(place)));
  }

  void find_web() {
    std::vector<Vec3> places;
    for (const Touch& end : ends_) places.push_back(end.position);
    const PointTree tree = PointTree::sorted(places, c_.run);
    web_ = parallel_append<int32_t>(c_.complex.vertices(), c_.run, [&](int64_t id, auto& out, int) {
      const auto v = static_cast<int32_t>(id);
      if (!may_join(v)) return;
      const Vec3& here = c_.made.position[v];
      const double within = distance_to_line(here) / c_.spacing_at(v);
      if (within > kNearWeb) return;
      const bool at_end = c_.on_rim[v] || within < kNearEnd;
      if (at_end || !is_sheet(v, ends_[tree.nearest(here).id])) out.push_back(v);
    });
    on_line_ = array<OnLine>(c_.complex.cell.size(), OnLine{}, c_.run);
    for (const int32_t v : web_) on_line_[v].knots = {0, 0};
    for (size_t next = 0; next < web_.size(); ++next) {
      c_.for_edges(web_[next], [&](const Corner&, int32_t other) {
        if (is_in_web(other) || !may_join(other) || !is_enclosed(other)) return;
        on_line_[other].knots = {0, 0};
        web_.push_back(other);
      });
    }
    std::sort(web_.begin(), web_.end());
  }

  // Returns whether all neighbours of a vertex are in the web.
  bool is_enclosed(int32_t v) const {
    bool enclosed = true;
    c_.for_edges(v, [&](const Corner&, int32_t other) { enclosed &= is_in_web(other); });
    return enclosed;
  }

  // Returns whether the ball of a vertex touches two places as far apart as at the end of the
  // sheet.
  bool is_sheet(int32_t v, const Touch& end) const {
    if (c_.made.place[v] == Placing::refused) return false;
    const Touch at = touch(c_, v, c_.walls[v], c_.made.position[v]);
    return at.radius > 0 && openness(at.away) > kAsOpen * openness(end.away);
  }

  // The middle of their neighbours gives the vertices of the web the order of the sheet beside it.
  void find_order() {
    std::vector<Vec3> at(c_.made.position.begin(), c_.made.position.end()), next(web_.size());
    for (int round = 0; round < kMiddleRounds; ++round) {
      throw_if_cancelled(c_.progress);
      parallel_for(static_cast<int64_t>(web_.size()), c_.run, [&](int64_t i) {
        Vec3 sum;
        int count = 0;
        c_.for_edges(web_[i], [&](const Corner&, int32_t other) {
          sum = sum + at[other];
          ++count;
        });
        next[i] = (1.0 / count) * sum;
      });
      for (size_t i = 0; i < web_.size(); ++i) at[web_[i]] = next[i];
    }
    for (const int32_t v : web_) on_line_[v] = on_line(at[v]);
  }

  // Returns the place on the line that is nearest to another one.
  OnLine on_line(const Vec3& place) const {
    const int32_t near = knot_tree_.nearest(place).id;
    const Vec3& from = knots_[near].position;
    std::vector<Neighbour> others;
    knot_tree_.find(place, 4, others);
    for (const Neighbour& other : others) {
      const Vec3 way = knots_[other.id].position - from;
      const double size = squared_length(way), share = size > 0 ? dot(place - from, way) / size : 0;
      const bool is_next = size < kNextKnot * kNextKnot * apart_ * apart_;
      if (!(share > 0) || !is_next) continue;
      if (near < other.id) return {{near, other.id}, std::min(1.0, share)};
      return {{other.id, near}, std::max(0.0, 1 - share)};
    }
    return {{near, near}, 0};
  }

  void snap_all() {
    bool changed = true;
    for (int round = 0; changed && round < kSnapRounds; ++round) {
      changed = false;
      for (const int32_t f : facets_) changed |= snap(f);
    }
  }

  // Moves the corners of a facet of the web that are not between the two knots that most of it lies
  // between to one of these.
  bool snap(int32_t facet) {
    const auto ring = c_.complex.ring(facet);
    for (const Corner& c : ring) {
      if (!is_in_web(c.vertex)) return false;
    }
    const Edge kept = main_knots(ring);
    const auto is_kept = [&](int32_t knot) { return knot == kept[0] || knot == kept[1]; };
    bool changed = false;
    for (const Corner& c : ring) {
      OnLine& at = on_line_[c.vertex];
      const auto [first, second] = at.knots;
      if (at.knots == kept || (at.is_at_knot() && is_kept(first))) continue;
      const int32_t knot = is_kept(first)    ? first
                           : is_kept(second) ? second
                                             : nearer_knot(kept, place_of(c.vertex));
      at = {{knot, knot}, 0};
      changed = true;
    }
    return changed;
  }

  // Returns the knots that most of a facet lies between.
  Edge main_knots(std::span<const Corner> ring) const {
    std::map<Edge, double> extent;
    std::map<int32_t, int> corners;
    for (const Corner& c : ring) {
      const auto& [knots, share] = on_line_[c.vertex];
      if (knots[0] != knots[1]) extent[knots] += std::min(share, 1 - share);
      for (const int32_t knot : knots) ++corners[knot];
    }
    Edge kept{-1, -1};
    double most = -1;
    for (const auto& [knots, size] : extent) {
      if (size > most) std::tie(most, kept) = std::pair(size, knots);
    }
    if (kept[0] >= 0) return kept;
    std::vector<std::pair<int, int32_t>> counts;
    for (const auto& [knot, count] : corners) counts.emplace_back(-count, knot);
    std::sort(counts.begin(), counts.end());
    return {counts[0].second, counts[std::min<size_t>(1, counts.size() - 1)].second};
  }

  int32_t nearer_knot(const Edge& knots, const Vec3& place) const {
    const double first = distance(knots_[knots[0]].position, place),
                 second = distance(knots_[knots[1]].position, place);
    return knots[first > second];
  }

  void find_facets_of_web() {
    for (const int32_t v : web_) {
      facets_.insert(facets_.end(), c_.facets_at[v].begin(), c_.facets_at[v].end());
    }
    sort_unique(facets_);
  }

  bool is_in_web(int32_t v) const { return on_line_[v].knots[0] >= 0; }

  Vec3 place_at(const OnLine& at) const {
    const Vec3 &from = knots_[at.knots[0]].position, &to = knots_[at.knots[1]].position;
    return from + at.share * (to - from);
  }
  Vec3 place_of(int32_t v) const { return place_at(on_line_[v]); }

  // Moves a vertex from which two others are in one direction to the nearer one.
  bool shorten(int32_t a, int32_t v, int32_t b) {
    if (!is_in_web(a) || !is_in_web(v) || !is_in_web(b)) return false;
    const Vec3 here = place_of(v), to_a = place_of(a) - here, to_b = place_of(b) - here;
    if (!(dot(to_a, to_b) > 0)) return false;
    on_line_[v] = on_line_[squared_length(to_a) < squared_length(to_b) ? a : b];
    return true;
  }

  // The rim does not turn back.
  void shorten_rim(int32_t v) {
    const auto beside = c_.beside[v];
    if (beside.size() == 2) shorten(beside[0], v, beside[1]);
  }

  // Neither does the boundary of a facet of the sheet beside the web.
  bool shorten_spikes(int32_t facet) {
    const auto ring = c_.complex.ring(facet);
    const bool in_web =
        std::all_of(ring.begin(), ring.end(), [&](const Corner& c) { return is_in_web(c.vertex); });
    if (in_web) return false;
    bool changed = false;
    for (size_t i = 0; i < ring.size(); ++i) {
      const int32_t before = ring[(i + ring.size() - 1) % ring.size()].vertex;
      changed |= shorten(before, ring[i].vertex, ring[(i + 1) % ring.size()].vertex);
    }
    return changed;
  }

  void cover_line_once() {
    std::vector<Vec3> knots;
    for (const Touch& knot : knots_) knots.push_back(knot.position);
    std::vector<Edge> rims;
    for (const int32_t v : web_) {
      for (const int32_t other : c_.beside[v]) {
        if (v < other && is_in_web(other)) rims.push_back({v, other});
      }
    }
    cover_once(knots, rims, web_, on_line_);
    for (size_t i = knots_.size(); i < knots.size(); ++i) knots_.push_back({knots[i]});
  }

  void place() {
    for (const int32_t v : web_) c_.end_at(v, place_of(v));
  }

  CrispState& c_;
  std::vector<Touch> ends_;      // balls at the end of the sheet
  std::vector<double> spacing_;  // at each of these
  std::vector<Touch> knots_;
  double apart_ = 0;                            // the largest distance between knots
  std::map<BoxId, std::vector<size_t>> boxes_;  // the knots in them
  PointTree knot_tree_;
  std::vector<int32_t> web_;     // vertices
  std::vector<int32_t> facets_;  // at these
  Array<OnLine> on_line_;        // per vertex; without knots outside the web
};

}  // namespace

void gather_focal_rims(CrispState& state) { FocalRims(state).gather(); }

}  // namespace medial
