// SPDX-License-Identifier: GPL-3.0-or-later
// A spacing for every place, from spacings at some sites.
#pragma once

#include <span>
#include <vector>

#include "base/nearest.h"
#include "base/parallel.h"
#include "base/vec3.h"

namespace medial {

// The spacing of the nearest site, after sites have been lowered so that the spacing grows by less
// than kGrading times the distance from one to the next.
class SizingField {
 public:
  static constexpr double kGrading = 0.3;

  SizingField(std::span<const Vec3> sites, std::span<const double> spacings, const Run& run);

  double operator()(const Vec3& place) const;

 private:
  Nearest sites_;
  std::vector<double> spacing_;
};

// The wanted distance of neighbouring samples at every place: the same everywhere, or by a field.
struct Spacing {
  double scale = 1;  // times the field, or the spacing itself
  const SizingField* field = nullptr;

  double operator()(const Vec3& place) const { return field ? scale * (*field)(place) : scale; }
};

}  // namespace medial
