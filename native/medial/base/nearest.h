// SPDX-License-Identifier: GPL-3.0-or-later
// This class finds the nearest of many fixed points. It is the only unit that knows Boost.Geometry.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace medial {

struct Neighbour {
  double distance;
  int32_t id;

  friend auto operator<=>(const Neighbour&, const Neighbour&) = default;
};

// It is safe to use from several threads.
class Nearest {
 public:
  explicit Nearest(std::span<const Vec3> sites);
  ~Nearest();

  // Returns infinity if there are no sites.
  double distance(const Vec3& query) const;
  // Finds the `count` nearest sites, nearest first and ties by lowest id, or all if there are
  // fewer.
  void find(const Vec3& query, size_t count, std::vector<Neighbour>& found) const;

 private:
  struct Tree;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace medial
