// SPDX-License-Identifier: GPL-3.0-or-later
// Computes a spacing for every place from spacings at some sites.
#pragma once

#include <span>
#include <vector>

#include "base/parallel.h"
#include "base/point_tree.h"
#include "base/vec3.h"

namespace medial {

// Returns the spacing of the nearest site. The spacings of sites are lowered first, such that from
// one site to the next the spacing grows by less than kGrading times the distance. The next ones of
// a site among dense ones are these. With `across`, two sites are next to each other if one of them
// is among the next ones of the other, so that small spacings reach the sparse sites of an opposite
// wall, too.
class SizingField {
 public:
  static constexpr double kGrading = 0.3;  // chosen: axis

  SizingField(std::span<const Vec3> sites, std::span<const double> spacings, const Run& run,
              bool across = false);

  double operator()(const Vec3& place) const;

 private:
  PointTree sites_;
  std::vector<double> spacing_;
};

// Gives the wanted distance of neighbouring samples at every place: constant, or from a field.
struct Spacing {
  double scale = 1;  // factor of the field, or the constant spacing
  const SizingField* field = nullptr;

  double operator()(const Vec3& place) const { return field ? scale * (*field)(place) : scale; }
};

}  // namespace medial
