// A spacing for every place, from spacings at some sites.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/vec3.h"

namespace medial {

// Nearest points by a balanced tree of boxes, which is the order of the points itself.
class KdTree {
 public:
  explicit KdTree(std::span<const Vec3> points);

  // The `count` nearest points, nearest first; fewer when there are fewer.
  void nearest(const Vec3& query, size_t count,
               std::vector<std::pair<double, int32_t>>& found) const;

 private:
  void build(size_t begin, size_t end);
  void search(size_t begin, size_t end, const Vec3& query, size_t count,
              std::vector<std::pair<double, int32_t>>& found) const;

  std::span<const Vec3> points_;
  std::vector<int32_t> order_;  // the middle of a range splits it
  std::vector<uint8_t> axis_;   // along this coordinate
};

// The spacing of the nearest site, after sites have been lowered so that the spacing grows by less
// than kGrading times the distance from one to the next.
class SizingField {
 public:
  static constexpr double kGrading = 0.3;

  SizingField(std::span<const Vec3> sites, std::span<const double> spacings, const Run& run);

  double operator()(const Vec3& place) const;

 private:
  KdTree tree_;
  std::vector<double> spacing_;
};

// The wanted distance of neighbouring samples at every place: the same everywhere, or by a field.
struct Spacing {
  double scale = 1;  // times the field, or the spacing itself
  const SizingField* field = nullptr;

  double operator()(const Vec3& place) const { return field ? scale * (*field)(place) : scale; }
};

}  // namespace medial
