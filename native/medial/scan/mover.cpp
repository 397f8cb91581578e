// SPDX-License-Identifier: GPL-3.0-or-later
#include "scan/mover.h"

#include <algorithm>
#include <tuple>

#include "base/parallel.h"
#include "scan/local_quadric.h"

namespace medial {
namespace {

constexpr size_t kFirst = 12;      // points of the smallest neighbourhood
constexpr size_t kMost = 500;      // points of the largest
constexpr double kFirstNoise = 3;  // the smallest radius, in units of the noise
constexpr double kStep = 1.3;      // from radius to radius
constexpr double kAgree = 2;       // standard errors within which neighbourhoods agree
constexpr double kSheet = 4;       // units of the noise beyond which a point is of another sheet
constexpr double kStray = 5;       // units of the noise beyond which a point is of no sheet
constexpr size_t kBeside = 8;      // centres whose radii are compared

struct Near {
  double squared;
  Vec3 point;
};

// Gathers the points within a radius, nearest first and ties by their coordinates.
void gather(const PointTree& tree, const Vec3& centre, double radius, std::vector<Near>& near) {
  const double squared = radius * radius;
  near.clear();
  tree.visit([&](const Box& box) { return squared_distance(box, centre) <= squared; },
             [&](const Vec3& p) {
               const double away = squared_length(p - centre);
               if (away <= squared) near.push_back({away, p});
             });
  const auto key = [](const Near& a) {
    return std::tie(a.squared, a.point.x, a.point.y, a.point.z);
  };
  std::sort(near.begin(), near.end(),
            [&](const Near& a, const Near& b) { return key(a) < key(b); });
}

// Climbs from a small neighbourhood to larger ones. Each takes only points near the quadric of the
// one before, so that the other wall of a thin part stays out.
class Climb {
 public:
  Climb(const Vec3& centre, std::span<const Near> near, double noise)
      : centre_(centre), near_(near), noise_(noise) {}

  // Returns the last quadric up to a radius; with `agree`, the last one with which all smaller ones
  // agree.
  std::optional<LocalQuadric> to(double first, double last, bool agree) {
    std::optional<LocalQuadric> best;
    for (double radius = first;; radius = std::min(radius * kStep, last)) {
      accept(radius, best);
      const auto next = fitted(radius, best);
      if (next) {
        if (agree && !agrees(*next)) return best;
        smaller_.push_back(*next);
        best = next;
      }
      if (radius >= last) return best;
    }
  }

 private:
  void accept(double radius, const std::optional<LocalQuadric>& sheet) {
    for (; at_ < near_.size() && near_[at_].squared <= radius * radius; ++at_) {
      const Vec3& p = near_[at_].point;
      if (!sheet || std::abs(sheet->above(p)) <= kSheet * noise_) accepted_.push_back(p);
    }
  }

  std::optional<LocalQuadric> fitted(double radius, const std::optional<LocalQuadric>& sheet) {
    if (accepted_.size() < kFirst) return {};
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
    return std::ranges::all_of(smaller_, [&](const LocalQuadric& one) {
      const double apart = dot(larger.place() - one.place(), larger.normal);
      return !(std::abs(apart) > kAgree * noise_ * std::sqrt(one.variance));
    });
  }

  Vec3 centre_;
  std::span<const Near> near_;
  double noise_;
  size_t at_ = 0;
  std::vector<Vec3> accepted_;
  std::vector<LocalQuadric> smaller_;
};

struct Radii {
  double first, last;
};

// Returns the smallest and the largest radius at a place.
Radii radii_at(const PointTree& tree, const Vec3& centre, double noise, double largest) {
  const double few = tree.reach(centre, kFirst + 1),
               first = std::min(largest, std::max(1.5 * few, kFirstNoise * noise)),
               many = few * std::sqrt(static_cast<double>(kMost) / kFirst);
  return {first, std::clamp(many, first, largest)};
}

// Returns the median radius of the centres beside each, so that neighbours use similar ones.
std::vector<double> evened(const PointTree& tree, std::span<const int32_t> centres,
                           const std::vector<double>& radii, const Run& run) {
  std::vector<Vec3> places;
  for (const int32_t id : centres) places.push_back(tree[id]);
  const PointTree beside(places);
  std::vector<double> even(radii.size());
  parallel_for(
      static_cast<int64_t>(radii.size()), run,
      [&](int64_t i) {
        std::vector<Neighbour> near;
        beside.find(places[i], kBeside + 1, near);
        std::vector<double> some;
        for (const auto& [away, id] : near) {
          if (radii[id] > 0) some.push_back(radii[id]);
        }
        if (some.empty()) return;
        const auto middle = some.begin() + static_cast<int64_t>(some.size() / 2);
        std::nth_element(some.begin(), middle, some.end());
        even[i] = *middle;
      },
      128);
  return even;
}

}  // namespace

std::vector<Moved> moved_points(const PointTree& tree, std::span<const int32_t> centres,
                                double noise, double largest, const Run& run) {
  const auto count = static_cast<int64_t>(centres.size());
  std::vector<double> chosen(centres.size(), 0), first(centres.size(), 0);
  parallel_for(
      count, run,
      [&](int64_t i) {
        const Vec3& centre = tree[centres[i]];
        const Radii radii = radii_at(tree, centre, noise, largest);
        std::vector<Near> near;
        gather(tree, centre, radii.last, near);
        const auto best = Climb(centre, near, noise).to(radii.first, radii.last, true);
        first[i] = radii.first;
        if (best) chosen[i] = best->radius;
      },
      128);
  const auto even = evened(tree, centres, chosen, run);
  std::vector<Moved> moved(centres.size());
  parallel_for(
      count, run,
      [&](int64_t i) {
        const Vec3& centre = tree[centres[i]];
        if (!(even[i] > 0)) return;
        const double last = std::max(first[i], even[i]);
        std::vector<Near> near;
        gather(tree, centre, last, near);
        const auto best = Climb(centre, near, noise).to(first[i], last, false);
        if (!best || std::abs(best->terms[0]) * best->radius > kStray * noise) return;
        moved[i] = {best->place(), best->radius, noise * std::sqrt(best->variance)};
      },
      128);
  return moved;
}

}  // namespace medial
