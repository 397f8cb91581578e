// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/text.h"

#include <medial/errors.h>

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

void require_one_each(size_t found, size_t wanted, const std::string& what, const std::string& of) {
  if (found == wanted) return;
  throw InvalidInputError("Expected " + what + ", found " + std::to_string(found) + " for " +
                          std::to_string(wanted) + " " + of + ".");
}

}  // namespace medial
