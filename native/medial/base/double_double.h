// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of twice the digits of double: sums of a double and of what it is off by.
#pragma once

namespace medial {

// Sums, differences and products are off by less than 2^-100 of the sum of the sizes of their
// parts, where nothing overflows or underflows (Dekker 1971; Hida, Li & Bailey 2001, "sloppy").
struct DoubleDouble {
  double high = 0, low = 0;

  DoubleDouble() = default;
  DoubleDouble(double of) : high(of) {}  // NOLINT(google-explicit-constructor): as any number
  DoubleDouble(double of, double and_of) : high(of + and_of) {
    const double second = high - of;
    low = (of - (high - second)) + (and_of - second);
  }
};

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble sum(a.high, b.high);
  return {sum.high, sum.low + (a.low + b.low)};
}

inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble sum(a.high, -b.high);
  return {sum.high, sum.low + (a.low - b.low)};
}

// Returns the product of two doubles, which has no rounding: their halves have 26 bits.
inline DoubleDouble product(double a, double b) {
  constexpr double kSplitter = 0x1p27 + 1;  // derived: it cuts 53 bits into halves
  const double across = kSplitter * a, along = kSplitter * b;
  const double first = across - (across - a), second = along - (along - b);
  const double a_rest = a - first, b_rest = b - second;
  DoubleDouble exact(a * b);
  exact.low = ((first * second - exact.high) + first * b_rest + a_rest * second) + a_rest * b_rest;
  return exact;
}

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble main = product(a.high, b.high);
  return {main.high, main.low + (a.high * b.low + a.low * b.high)};
}

}  // namespace medial
