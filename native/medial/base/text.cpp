// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"

#include <sstream>

namespace medial {

std::string text(double x) {
  std::ostringstream out;
  out << x;
  return out.str();
}

std::string text(const Vec3& p) {
  std::ostringstream out;
  out << "(" << p.x << ", " << p.y << ", " << p.z << ")";
  return out.str();
}

}  // namespace medial
