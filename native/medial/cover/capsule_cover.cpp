// SPDX-License-Identifier: GPL-3.0-or-later
#include <medial/capsule_cover.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/parallel.h"
#include "base/text.h"
#include "cover/capsule_reach.h"

namespace medial {
namespace {

constexpr int64_t kOfTask = 1;  // capsules in one piece of work

void check(const CapsuleCoverInput& input, const CapsuleCoverOptions& options) {
  require_finite(input.places, "end of a segment");
  require_finite(input.vertices, "vertex");
  require_corners(input.faces, input.vertices.size());
  const auto rows = static_cast<int32_t>(input.places.size());
  for (const Edge& segment : input.segments) {
    for (const int32_t row : segment) {
      if (row >= 0 && row < rows) continue;
      throw InvalidInputError("Expected rows from 0 to " + std::to_string(rows - 1) +
                              " as ends of segments, found " + std::to_string(row) +
                              "; correct it.");
    }
  }
  if (!input.radii.empty() && input.radii.size() != 2 * input.segments.size()) {
    throw InvalidInputError("Expected two radii for each of " +
                            std::to_string(input.segments.size()) + " segments, found " +
                            std::to_string(input.radii.size()) + "; pass as many.");
  }
  require_amounts(options.count, options.places, options.tolerance, "capsule");
}

void largest_first(std::vector<Capsule>& capsules) {
  std::stable_sort(capsules.begin(), capsules.end(), [](const Capsule& one, const Capsule& other) {
    return one.volume() > other.volume();
  });
}

// Returns the largest capsules in the solid round the segments, by falling volume.
std::vector<Capsule> inner_capsules(const CapsuleCoverInput& input,
                                    const CapsuleCoverOptions& options, const CoveredSolid& solid,
                                    const SolidDepth& depth, const Run& run) {
  std::vector<Capsule> capsules(input.segments.size());
  parallel_for(
      static_cast<int64_t>(capsules.size()), run,
      [&](int64_t i) {
        const auto& [a, b] = input.segments[i];
        capsules[i] = inner_capsule(solid.frame.inward(input.places[a]),
                                    solid.frame.inward(input.places[b]), options.tapered, depth);
      },
      kOfTask);
  std::erase_if(capsules, [](const Capsule& capsule) { return !(capsule.volume() > 0); });
  largest_first(capsules);
  if (static_cast<int64_t>(capsules.size()) > options.count) capsules.resize(options.count);
  if (capsules.empty()) {
    throw DegenerateInputError("Expected segments in the solid, found none of " +
                               std::to_string(input.segments.size()) +
                               " with an end in it; pass those of its inner axis.");
  }
  return capsules;
}

// Returns the capsules with the given radii, by falling volume.
std::vector<Capsule> given_capsules(const CapsuleCoverInput& input, const Frame& frame) {
  std::vector<Capsule> capsules;
  for (size_t k = 0; k < input.segments.size(); ++k) {
    const auto& [a, b] = input.segments[k];
    capsules.push_back({frame.inward(input.places[a]),
                        frame.inward(input.places[b]),
                        {frame.inward(input.radii[2 * k]), frame.inward(input.radii[2 * k + 1])}});
  }
  largest_first(capsules);
  return capsules;
}

// Returns the least growth that is linear, or the same everywhere, and holds what a capsule needs.
LinearLength growth_of(std::vector<LengthAt> needs, bool tapered) {
  if (tapered) return lowest_above(std::move(needs));
  const auto most = std::max_element(
      needs.begin(), needs.end(),
      [](const LengthAt& one, const LengthAt& other) { return one.length < other.length; });
  return {most->length, most->length};
}

// Lets a capsule hold what it needs. It grows by at most `most`, and shrinks only if there is no
// limit.
void grow(Capsule& capsule, std::vector<LengthAt> needs, double most, bool tapered) {
  LinearLength& radius = capsule.radius;
  const bool limited = most < HUGE_VAL;
  for (LengthAt& need : needs) need.length = std::min(need.length, most);
  needs.push_back({0, limited ? 0 : -radius.first});
  needs.push_back({1, limited ? 0 : -radius.second});
  const bool is_ball = capsule.a == capsule.b;
  const LinearLength more = growth_of(std::move(needs), tapered && !is_ball);
  radius.first = std::max(radius.first + std::min(more.first, most), 0.0);
  radius.second = std::max(radius.second + std::min(more.second, most), 0.0);
}

void grow_all(std::vector<Capsule>& capsules, const CapsuleCoverOptions& options, double most,
              const CoveredSolid& solid, const SolidLattice& lattice, const Run& run) {
  auto needs = needed_growth(capsules, solid, lattice.places(), kPiece * lattice.step(), run);
  for (size_t k = 0; k < capsules.size(); ++k) {
    grow(capsules[k], std::move(needs[k]), most, options.tapered);
  }
  std::erase_if(capsules, [](const Capsule& capsule) { return !(capsule.volume() > 0); });
}

double largest_reach(std::span<const Capsule> capsules, const SolidDepth& depth, const Run& run) {
  std::vector<double> out(capsules.size());
  parallel_for(
      static_cast<int64_t>(capsules.size()), run,
      [&](int64_t i) { out[i] = reach_out(capsules[i], depth); }, kOfTask);
  return std::max(*std::max_element(out.begin(), out.end()), 0.0);
}

void store(CapsuleCover& cover, std::span<const Capsule> capsules, const Frame& frame) {
  for (const Capsule& capsule : capsules) {
    cover.ends.push_back(frame.outward(capsule.a));
    cover.ends.push_back(frame.outward(capsule.b));
    cover.radii.push_back(frame.outward(capsule.radius.first));
    cover.radii.push_back(frame.outward(capsule.radius.second));
  }
}

}  // namespace

CapsuleCover cover_by_capsules(const CapsuleCoverInput& input, const CapsuleCoverOptions& options,
                               int threads, Progress* progress) {
  const Run run{thread_count(threads), progress};
  begin_stage(run.progress, "Lattice", 0, 0.3);
  check(input, options);
  const CoveredSolid solid(input.vertices, input.faces, input.places, run);
  const SolidLattice lattice = solid.lattice(options.places, run);
  const SolidDepth depth(solid);
  begin_stage(run.progress, "Depths of capsules", 0.3, 0.6);
  auto capsules = input.radii.empty() ? inner_capsules(input, options, solid, depth, run)
                                      : given_capsules(input, solid.frame);
  begin_stage(run.progress, "Reach of capsules", 0.6, 1);
  const bool around = options.mode == CoverMode::around;
  const double most = around ? HUGE_VAL : solid.frame.inward(options.tolerance);
  if (most > 0) grow_all(capsules, options, most, solid, lattice, run);

  CapsuleCover cover;
  const bool grown = most > 0;
  cover.outside = grown ? solid.frame.outward(largest_reach(capsules, depth, run)) : 0;
  if (!around) {
    const double away = farthest_from(capsules, solid, kPiece * lattice.step(), run);
    cover.farthest = solid.frame.outward(away);
  }
  const auto inside = lattice.places();
  cover.held =
      static_cast<double>(held_places(capsules, inside, run)) / static_cast<double>(inside.size());
  cover.places = lattice.count();
  cover.step = solid.frame.outward(lattice.step());
  store(cover, capsules, solid.frame);
  advance(run.progress, 1);
  return cover;
}

}  // namespace medial
