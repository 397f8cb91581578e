// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/closing_samples.h"

#include <optional>

#include "base/random.h"
#include "base/rows.h"
#include "inside/level_set.h"
#include "inside/surface.h"

namespace medial {
namespace {

// Lattice steps in one radius; this gives at least six candidates for every disc that has room.
constexpr double kSteps = 2;  // chosen: axis

double median_radius(std::span<const Disk> disks) {
  std::vector<double> radii;
  for (const Disk& disk : disks) radii.push_back(disk.radius);
  const auto middle = radii.begin() + static_cast<ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return *middle;
}

std::vector<Disk> candidates_of(const OpenSurface& open, std::span<const OpenSurface::Fall> falls,
                                std::span<const Disk> kept, const Run& run) {
  std::vector<Vec3> centres;
  double largest = 0;
  for (const Disk& disk : kept) {
    centres.push_back(disk.centre);
    largest = std::max(largest, disk.radius);
  }
  const PointTree tree = PointTree::sorted(centres, run);
  std::vector<Disk> candidates(falls.size());
  parallel_chunks(
      static_cast<int64_t>(falls.size()), run,
      [&](int64_t begin, int64_t end, int) {
        for (int64_t i = begin; i < end; ++i) {
          const Vec3 at = falls[i].middle();
          const auto [away, id] = tree.nearest(at);
          const double grown = kept[id].radius + SizingField::kGrading * away;
          candidates[i] = {at, std::min(largest, grown), open.normal(at)};
        }
      },
      64);
  return candidates;
}

// Tries candidates in random order among the discs that are kept; returns those that stay, in that
// order.
class Thinning {
 public:
  Thinning(std::span<const Disk> kept, std::span<const Disk> candidates)
      : disks_(kept.begin(), kept.end()), kept_(kept.size()) {
    disks_.insert(disks_.end(), candidates.begin(), candidates.end());
    stays_.assign(disks_.size(), 0);
    std::fill_n(stays_.begin(), kept_, uint8_t{1});
    std::vector<Vec3> centres;
    for (const Disk& disk : disks_) centres.push_back(disk.centre);
    centres_ = PointTree::sorted(centres, {});
  }

  std::vector<int32_t> operator()(uint64_t seed) {
    std::vector<int32_t> order = all_rows(disks_.size() - kept_), stay;
    const auto rank = [&](int32_t i) { return scrambled(seed ^ scrambled(uint64_t(i))); };
    std::sort(order.begin(), order.end(), [&](int32_t i, int32_t j) { return rank(i) < rank(j); });
    for (const int32_t i : order) {
      const size_t id = kept_ + static_cast<size_t>(i);
      if (!has_room(disks_, id, centres_, [&](size_t j) { return stays_[j] != 0; })) continue;
      stays_[id] = 1;
      stay.push_back(i);
    }
    return stay;
  }

 private:
  std::vector<Disk> disks_;
  size_t kept_;
  std::vector<uint8_t> stays_;
  PointTree centres_;
};

}  // namespace

ClosingSamples closing_samples(std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                               std::span<const Disk> kept, uint64_t seed, const Run& run) {
  begin_stage(run.progress, "Openings", 0, 1);
  require_corners(triangles, vertices.size());
  const DistinctRows corners = distinct_rows(vertices, "vertex", run);
  const Surface surface = make_surface(triangles, corners.point_of_row, corners.count(), run);
  if (kept.empty() || surface.boundary.empty()) return {};
  const std::span<const Vec3> points = corners.points;
  const OpenSurface open(points, surface.triangles, surface.boundary, run.progress);
  const auto falls = open.falls(median_radius(kept) / kSteps, run);
  const auto candidates = candidates_of(open, falls, kept, run);
  const auto stay = Thinning(kept, candidates)(seed);
  std::vector<std::optional<Vec3>> places(stay.size());
  parallel_for(
      static_cast<int64_t>(stay.size()), run,
      [&](int64_t i) { places[i] = open.place(falls[stay[i]]); }, 64);
  ClosingSamples samples;
  for (size_t i = 0; i < stay.size(); ++i) {
    if (!places[i]) continue;
    samples.points.push_back(*places[i]);
    samples.normals.push_back(candidates[stay[i]].normal);
    samples.radius.push_back(candidates[stay[i]].radius);
  }
  advance(run.progress, 1);
  return samples;
}

}  // namespace medial
