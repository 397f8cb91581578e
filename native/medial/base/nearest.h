// The distance to the nearest of many fixed points. The only unit that knows Boost.Geometry.
#pragma once

#include <memory>
#include <span>

#include "base/vec3.h"

namespace medial {

class Nearest {
 public:
  explicit Nearest(std::span<const Vec3> sites);
  ~Nearest();

  // Infinite when there are no sites. Safe to use from several threads.
  double distance(const Vec3& query) const;

 private:
  struct Tree;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace medial
