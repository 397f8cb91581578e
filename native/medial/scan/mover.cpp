// SPDX-License-Identifier: GPL-3.0-or-later
#include "scan/mover.h"

#include <algorithm>

#include "base/parallel.h"
#include "scan/local_quadric.h"

namespace medial {
namespace {

constexpr size_t kFirst = 12;      // points of the smallest neighbourhood
constexpr size_t kMost = 500;      // points of the largest
constexpr double kFirstNoise = 3;  // the smallest radius, in units of the noise; chosen: unseen
constexpr double kStep = 1.3;      // from radius to radius where one is chosen; chosen: axis
constexpr double kLeap = 1.7;      // from radius to radius where it is known; chosen: unseen
constexpr double kAgree = 2;   // standard errors within which neighbourhoods agree; chosen: unseen
constexpr double kSheet = 4;   // noises to a point of another sheet; chosen: axis
constexpr double kStray = 5;   // noises beyond which a point is of no sheet; chosen: unseen
constexpr size_t kBeside = 8;  // places whose radii are compared

struct Near {
  double squared;
  Vec3 point;
};

// A radius, and how many points lie within it.
struct Ring {
  double radius;
  size_t end;
};

// Lists that a climb fills; those of one thread serve all its climbs.
struct Lists {
  std::vector<Near> near;
  std::vector<Ring> rings;
  std::vector<Vec3> accepted;
  std::vector<LocalQuadric> smaller;
};

// Gathers the points within a radius.
void gather(const PointTree& tree, const Vec3& centre, double radius, std::vector<Near>& near) {
  const double squared = radius * radius;
  near.clear();
  tree.visit([&](const Box& box) { return squared_distance(box, centre) <= squared; },
             [&](const Vec3& p) {
               const double away = squared_length(p - centre);
               if (away <= squared) near.push_back({away, p});
             });
}

// Climbs from a small neighbourhood to larger ones. Each takes only points near the quadric of the
// one before, so that the other wall of a thin part stays out.
class Climb {
 public:
  // Reorders the points near the centre, which are in the list of that name.
  Climb(const Vec3& centre, Lists& lists, double noise)
      : centre_(centre),
        near_(lists.near),
        noise_(noise),
        rings_(lists.rings),
        accepted_(lists.accepted),
        smaller_(lists.smaller) {
    accepted_.clear();
    smaller_.clear();
  }

  // Returns the last quadric up to a radius with which all smaller ones agree.
  std::optional<LocalQuadric> while_they_agree(double first, double last) {
    return climb(first, last, kStep, [&](const LocalQuadric& next) { return agrees(next); });
  }
  // Returns the last quadric up to a radius.
  std::optional<LocalQuadric> to(double first, double last) {
    return climb(first, last, kLeap, [](const LocalQuadric&) { return true; });
  }

 private:
  template <typename Taken>
  std::optional<LocalQuadric> climb(double first, double last, double step, const Taken& taken) {
    order(first, last, step);
    std::optional<LocalQuadric> best;
    size_t from = 0;
    for (const Ring& ring : rings_) {
      accept(near_.subspan(from, ring.end - from), best);
      from = ring.end;
      const auto next = fitted(ring.radius, best);
      if (!next) continue;
      if (!taken(*next)) return best;
      smaller_.push_back(*next);
      best = next;
    }
    return best;
  }

  // Brings the points of each ring before those of the next. The widest ring comes first, as those
  // within it have few points.
  void order(double first, double last, double step) {
    rings_.clear();
    for (double radius = first; radius < last; radius *= step) rings_.push_back({radius, 0});
    rings_.push_back({last, near_.size()});
    for (size_t i = rings_.size() - 1; i-- > 0;) {
      const double squared = rings_[i].radius * rings_[i].radius;
      size_t& end = rings_[i].end;
      for (Near& one : near_.first(rings_[i + 1].end)) {
        if (one.squared <= squared) std::swap(one, near_[end++]);
      }
    }
  }

  void accept(std::span<const Near> ring, const std::optional<LocalQuadric>& sheet) {
    for (const Near& one : ring) {
      if (!sheet || std::abs(sheet->above(one.point)) <= kSheet * noise_) {
        accepted_.push_back(one.point);
      }
    }
  }

  std::optional<LocalQuadric> fitted(double radius, const std::optional<LocalQuadric>& sheet) {
    if (accepted_.size() < (sheet ? kFirst : 2 * kFirst)) return {};
    const Vec3 normal = sheet ? sheet->tilted() : least_spread(accepted_);
    auto quadric = fit_quadric(accepted_, centre_, normal, radius, Weights::smooth);
    if (quadric && !sheet) {  // once more, without points off the first sheet and upright
      std::erase_if(accepted_,
                    [&](const Vec3& p) { return std::abs(quadric->above(p)) > kSheet * noise_; });
      quadric = fit_quadric(accepted_, centre_, quadric->tilted(), radius, Weights::smooth);
    }
    return quadric;
  }

  bool agrees(const LocalQuadric& larger) const {
    return std::all_of(smaller_.begin(), smaller_.end(), [&](const LocalQuadric& one) {
      const double apart = dot(larger.place() - one.place(), larger.normal);
      return !(std::abs(apart) > kAgree * noise_ * std::sqrt(one.variance));
    });
  }

  Vec3 centre_;
  std::span<Near> near_;
  double noise_;
  std::vector<Ring>& rings_;
  std::vector<Vec3>& accepted_;
  std::vector<LocalQuadric>& smaller_;
};

// Chooses the widest neighbourhood of a place with which all smaller ones agree.
Neighbourhood chosen_at(const PointTree& tree, const Vec3& centre, double noise, double largest,
                        Lists& lists) {
  const double few = tree.reach(centre, kFirst + 1),
               first = std::min(largest, std::max(1.5 * few, kFirstNoise * noise)),
               many = few * std::sqrt(static_cast<double>(kMost) / kFirst),
               last = std::clamp(many, first, largest);
  gather(tree, centre, last, lists.near);
  const auto best = Climb(centre, lists, noise).while_they_agree(first, last);
  if (!best) return {first};
  return {first, best->radius, noise * std::sqrt(best->variance)};
}

// Moves a point onto the quadric of its neighbourhood; leaves the result empty where it is far off.
Moved moved_at(const PointTree& tree, const Vec3& centre, const Neighbourhood& known, double noise,
               Lists& lists) {
  if (!(known.radius > 0)) return {};
  gather(tree, centre, known.radius, lists.near);
  const auto best = Climb(centre, lists, noise).to(known.first, known.radius);
  if (!best || std::abs(best->terms[0]) * best->radius > kStray * noise) return {};
  return {best->place(), {known.first, best->radius, noise * std::sqrt(best->variance)}};
}

// Returns for each place the neighbourhood with the median radius of those next to it, so that
// neighbours use similar ones.
std::vector<Neighbourhood> evened(const PointTree& places, std::span<const Neighbourhood> chosen,
                                  const Run& run) {
  std::vector<Neighbourhood> even(chosen.size());
  parallel_for(
      places.size(), run,
      [&](int64_t i) {
        std::vector<Neighbour> near;
        places.find(places[static_cast<int32_t>(i)], kBeside + 1, near);
        std::erase_if(near, [&](const Neighbour& one) { return !(chosen[one.id].radius > 0); });
        if (near.empty()) return;
        const auto middle = near.begin() + static_cast<int64_t>(near.size() / 2);
        std::nth_element(
            near.begin(), middle, near.end(), [&](const Neighbour& a, const Neighbour& b) {
              return std::pair(chosen[a.id].radius, a.id) < std::pair(chosen[b.id].radius, b.id);
            });
        even[i] = chosen[middle->id];
        even[i].radius = std::max(even[i].radius, chosen[i].first);
        even[i].first = chosen[i].first;
      },
      128);
  return even;
}

}  // namespace

std::vector<Neighbourhood> neighbourhoods(const PointTree& tree, std::span<const int32_t> centres,
                                          double noise, double largest, const Run& run) {
  std::vector<Neighbourhood> chosen(centres.size());
  parallel_chunks(
      static_cast<int64_t>(centres.size()), run,
      [&](int64_t begin, int64_t end, int) {
        Lists lists;
        for (int64_t i = begin; i < end; ++i) {
          chosen[i] = chosen_at(tree, tree[centres[i]], noise, largest, lists);
        }
      },
      32);
  std::vector<Vec3> places;
  for (const int32_t id : centres) places.push_back(tree[id]);
  const PointTree beside(places);
  const auto even = evened(beside, chosen, run);
  std::vector<Neighbourhood> found(static_cast<size_t>(tree.size()));
  parallel_for(
      tree.size(), run,
      [&](int64_t i) { found[i] = even[beside.nearest(tree[static_cast<int32_t>(i)]).id]; }, 512);
  return found;
}

std::vector<Moved> moved_points(const PointTree& tree, std::span<const int32_t> centres,
                                std::span<const Neighbourhood> neighbourhoods, double noise,
                                const Run& run) {
  std::vector<Moved> moved(centres.size());
  parallel_chunks(
      static_cast<int64_t>(centres.size()), run,
      [&](int64_t begin, int64_t end, int) {
        Lists lists;
        for (int64_t i = begin; i < end; ++i) {
          moved[i] = moved_at(tree, tree[centres[i]], neighbourhoods[centres[i]], noise, lists);
        }
      },
      128);
  return moved;
}

}  // namespace medial
