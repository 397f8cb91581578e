// SPDX-License-Identifier: GPL-3.0-or-later
// These functions write error messages, and numbers for them with at most six digits.
#pragma once

#include <string>

#include "base/vec3.h"

namespace medial {

std::string text(double x);
std::string text(const Vec3& p);  // (x, y, z)

// Throws InvalidInputError unless as many are found as wanted: `what` says one per what, and `of`
// how many of them there are and what to do.
void require_one_each(size_t found, size_t wanted, const std::string& what, const std::string& of);

}  // namespace medial
