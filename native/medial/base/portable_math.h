// SPDX-License-Identifier: GPL-3.0-or-later
// Angles without the C library, whose sine and arcsine differ between processors, systems and
// versions. These are additions, multiplications, divisions and square roots alone, which IEEE 754
// rounds in one way, so they have the same bits everywhere. Errors are at most 3 units in the last
// place.
#pragma once

namespace medial::portable {

struct SineCosine {
  double sine, cosine;
};

// Takes radians, at most 2^20 of them in absolute value; returns NaN for more.
SineCosine sine_cosine(double angle);
double sin(double angle);
double cos(double angle);

// Take -1 to 1, and return NaN outside.
double asin(double sine);
double acos(double cosine);

// Returns the angle of (x, y) from the x axis, in (-pi, pi]; 0 for (0, 0). The sum of the absolute
// values must be finite.
double atan2(double y, double x);

// Takes finite positive numbers.
double cbrt(double x);

}  // namespace medial::portable
