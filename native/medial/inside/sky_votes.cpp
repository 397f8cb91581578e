// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/sky_votes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/parallel.h"
#include "base/portable_math.h"
#include "base/random.h"
#include "base/rounding.h"
#include "inside/ray_crossings.h"
#include "inside/winding_number.h"

namespace medial {
namespace {

constexpr int64_t kPlaces = 8192, kLeastPlaces = 4;  // of all patches together, and of each
constexpr int64_t kMostPlaces = 512;  // of each; derived: 2 sqrt(8192 rays) is 2 % of them
constexpr int kRays = 8;              // from each side of a place
constexpr double kLeastCosine = 0.1;  // of a ray with the normal; chosen: unseen
// A smaller share of all rays is chance, for a ray may slip through where faces meet.
constexpr double kChance = 0.01;  // chosen: unseen
// Shares of the rays of the side that sees more, and of the other side, that leave no doubt.
constexpr double kMost = 0.5, kNearlyNone = 0.1;  // chosen: unseen

// A place on a face, and a unit normal towards the front of its patch.
struct Place {
  Vec3 at, normal;
  uint64_t random;
};

class Voting {
 public:
  Voting(const FacePatches& patches, std::span<const Vec3> vertices, const Run& run)
      : patches_(patches),
        vertices_(vertices),
        run_(run),
        crossings_(soup(vertices, patches.faces), run.progress) {
    start_ = rounding_of(vertices);
    gather();
  }

  std::vector<SkyVotes> votes() const {
    std::vector<SkyVotes> result(static_cast<size_t>(patches_.count));
    parallel_for(
        patches_.count, run_, [&](int64_t p) { result[p] = votes_of(p); }, 1);
    return result;
  }

 private:
  Vec3 area_vector(int32_t face) const {
    const auto& [a, b, c] = patches_.faces[face];
    const Vec3 n = cross(vertices_[b] - vertices_[a], vertices_[c] - vertices_[a]);
    return patches_.turned[face] != 0 ? -n : n;
  }

  // Lists the faces of each patch, and sums up the areas.
  void gather() {
    faces_.resize(static_cast<size_t>(patches_.count));
    area_.assign(faces_.size(), 0);
    for (size_t face = 0; face < patches_.faces.size(); ++face) {
      if (!patches_.counts(face)) continue;
      faces_[patches_.patch[face]].push_back(static_cast<int32_t>(face));
      area_[patches_.patch[face]] += length(area_vector(static_cast<int32_t>(face)));
    }
    all_area_ = std::accumulate(area_.begin(), area_.end(), 0.0);
  }

  // Returns places in even steps of area.
  std::vector<Place> places_of(int64_t patch) const {
    if (!(area_[patch] > 0)) return {};
    const double share = area_[patch] / all_area_;
    const auto count =
        std::clamp(static_cast<int64_t>(std::ceil(share * static_cast<double>(kPlaces))),
                   kLeastPlaces, kMostPlaces);
    std::vector<Place> places;
    double before = 0;
    for (const int32_t face : faces_[patch]) {
      const double here = before + length(area_vector(face));
      while (static_cast<int64_t>(places.size()) < count) {
        const auto k = static_cast<uint64_t>(places.size());
        const uint64_t random = scrambled(scrambled(static_cast<uint64_t>(patch)) + k);
        const double at = (static_cast<double>(k) + unit(random)) / static_cast<double>(count);
        if (at * area_[patch] >= here) break;
        places.push_back(place_on(face, scrambled(random)));
      }
      before = here;
    }
    return places;
  }

  Place place_on(int32_t face, uint64_t random) const {
    const auto& [a, b, c] = patches_.faces[face];
    const double root = std::sqrt(unit(random)), along = unit(scrambled(random));
    const Vec3 at = (1 - root) * vertices_[a] + (root * (1 - along)) * vertices_[b] +
                    (root * along) * vertices_[c];
    return {at, normalized(area_vector(face)), scrambled(random + 1)};
  }

  // Calls found(place, front, back) for rays from both sides of places, each the mirror image of
  // the other; they are spread evenly over the hemispheres.
  template <typename Found>
  static void for_rays(std::span<const Place> places, const Found& found) {
    for (const Place& place : places) {
      for (int k = 0; k < kRays; ++k) {
        const Vec3 front = ray(place, k);
        found(place.at, front, front - 2 * dot(front, place.normal) * place.normal);
      }
    }
  }
  static Vec3 ray(const Place& place, int k) {
    const double cosine = kLeastCosine + (1 - kLeastCosine) * (k + 0.5) / kRays;
    const double sine = std::sqrt(1 - cosine * cosine);
    const double turn = k * std::numbers::phi + unit(place.random);
    const auto around = portable::sine_cosine(2 * std::numbers::pi * (turn - std::floor(turn)));
    const auto [u, v] = across(place.normal);
    return cosine * place.normal + (sine * around.cosine) * u + (sine * around.sine) * v;
  }

  bool escapes(const Vec3& place, const Vec3& ray) const {
    return crossings_.met(place, ray, start_, 1) == 0;
  }
  bool meets_evenly(const Vec3& place, const Vec3& ray) const {
    return crossings_.met(place, ray, start_, INT64_MAX) % 2 == 0;
  }

  SkyVotes votes_of(int64_t patch) const {
    const auto places = places_of(patch);
    SkyVotes votes;
    for_rays(places, [&](const Vec3& place, const Vec3& front, const Vec3& back) {
      ++votes.rays;
      votes.front += escapes(place, front) ? 1 : 0;
      votes.back += escapes(place, back) ? 1 : 0;
    });
    if (votes.decided()) return votes;
    for_rays(places, [&](const Vec3& place, const Vec3& front, const Vec3& back) {
      votes.even_front += meets_evenly(place, front) ? 1 : 0;
      votes.even_back += meets_evenly(place, back) ? 1 : 0;
    });
    return votes;
  }

  const FacePatches& patches_;
  std::span<const Vec3> vertices_;
  Run run_;
  RayCrossings crossings_;
  double start_ = 0;  // what is met closer lies in the face itself
  double all_area_ = 0;
  std::vector<std::vector<int32_t>> faces_;  // of each patch
  std::vector<double> area_;                 // of each patch, twice
};

}  // namespace

bool SkyVotes::decided() const {
  const auto seen = static_cast<double>(front + back);
  if (seen <= kChance * static_cast<double>(rays)) return false;
  return std::abs(static_cast<double>(front - back)) > 2 * std::sqrt(seen);
}

bool SkyVotes::clear() const {
  const auto [few, many] = std::minmax(front, back);
  return static_cast<double>(many) >= kMost * static_cast<double>(rays) &&
         static_cast<double>(few) <= kNearlyNone * static_cast<double>(many);
}

std::vector<SkyVotes> sky_votes(const FacePatches& patches, std::span<const Vec3> vertices,
                                const Run& run) {
  return Voting(patches, vertices, run).votes();
}

}  // namespace medial
