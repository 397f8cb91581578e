// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as error messages write them: six digits at most.
#pragma once

#include <string>

#include "base/vec3.h"

namespace medial {

std::string text(double x);
std::string text(const Vec3& p);  // (x, y, z)

}  // namespace medial
