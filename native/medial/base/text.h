// SPDX-License-Identifier: GPL-3.0-or-later
// These functions write numbers for error messages, with at most six digits.
#pragma once

#include <string>

#include "base/vec3.h"

namespace medial {

std::string text(double x);
std::string text(const Vec3& p);  // (x, y, z)

}  // namespace medial
