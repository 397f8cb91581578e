// SPDX-License-Identifier: GPL-3.0-or-later
// Integers of any size, and doubles as multiples of a power of two, without rounding.
#pragma once

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cfloat>
#include <climits>
#include <cmath>
#include <cstdint>

namespace medial {

// Numbers of up to 512 bits, which all but spread out coordinates make, allocate nothing.
using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<512>,
                                              boost::multiprecision::et_off>;

// Returns the exponent e of the last bit of a double that can be set: x is a multiple of 2^e.
inline int last_bit(double x) { return x == 0 ? INT_MAX : std::ilogb(x) - (DBL_MANT_DIG - 1); }

inline int last_bit(double x, double y, double z) {
  return std::min({last_bit(x), last_bit(y), last_bit(z)});
}

// Returns x / 2^last, which has to be an integer.
inline Integer times_power_of_two(double x, int last) {
  if (x == 0) return 0;
  const int shift = last_bit(x);
  Integer found = static_cast<int64_t>(std::ldexp(x, -shift));
  return found <<= shift - last;
}

}  // namespace medial
