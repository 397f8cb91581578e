// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/portable_math.h"

#include <cmath>
#include <limits>
#include <utility>

namespace medial::portable {
namespace {

// Each constant of two or three parts is their exact sum, far beyond a double.
constexpr double kHalfPi = 0x1.921fb54442d18p+0,
                 kHalfPiRest = 0x1.1a62633145c07p-54;                         // derived: pi
constexpr double kQuarterPi = kHalfPi / 2, kQuarterPiRest = kHalfPiRest / 2;  // derived: pi / 4
constexpr double kPi = 2 * kHalfPi, kPiRest = 2 * kHalfPiRest;                // derived: pi
// The first two have 33 bits, so that up to 2^20 times each is exact (Cody & Waite 1980).
constexpr double kTurn1 = 0x1.921fb544p+0, kTurn2 = 0x1.0b4611a6p-34,
                 kTurn3 = 0x1.3198a2e037073p-69;       // derived: pi / 2 in three parts
constexpr double kLargestAngle = 0x1p20;               // derived: 53 - 33 bits
constexpr double kTanEighthPi = 0x1.a827999fcef32p-2;  // derived: tan(pi / 8)

// The polynomials interpolate, in z = x^2, at Chebyshev's nodes: (asin x / x - 1) / z for |x| <=
// 1/2, (atan x / x - 1) / z for |x| <= tan(pi/8), (sin x / x - 1) / z and (cos x - 1 + z/2) / z^2
// for |x| <= pi/4. None adds more than a tenth of a unit in the last place.
constexpr double kAsin[] = {0x1.5555555555556p-3, 0x1.3333333332ecap-4, 0x1.6db6db6e31f13p-5,
                            0x1.f1c71c1db0623p-6, 0x1.6e8bb1c8209a2p-6, 0x1.1c4d35cf95420p-6,
                            0x1.c9cf076747387p-7, 0x1.782651caa6421p-7, 0x1.52420b04b3f6fp-7,
                            0x1.65a9c4dfcb4e3p-8, 0x1.1d18940834433p-6, -0x1.e6aaa8a0a9bdcp-7,
                            0x1.d72b2bc818aa9p-6};
constexpr double kAtan[] = {-0x1.5555555555555p-2, 0x1.999999999934bp-3,  -0x1.2492492436180p-3,
                            0x1.c71c7185386f1p-4,  -0x1.745d0b27da190p-4, 0x1.3b1262f3a2b5bp-4,
                            -0x1.10fa76aa9b02cp-4, 0x1.dfe637a48099bp-5,  -0x1.a0993ef875d4ap-5,
                            0x1.4161b24be475bp-5,  -0x1.3a2f1cc1ba3c5p-6};
constexpr double kSin[] = {-0x1.5555555555555p-3, 0x1.1111111111110p-7,   -0x1.a01a01a019936p-13,
                           0x1.71de3a5460533p-19, -0x1.ae64541251e39p-26, 0x1.61217eaffbfdbp-33,
                           -0x1.ab179e14267cdp-41};
constexpr double kCos[] = {0x1.5555555555555p-5,   -0x1.6c16c16c16c16p-10, 0x1.a01a01a019d09p-16,
                           -0x1.27e4fb7712b8cp-22, 0x1.1eed8deb644b7p-29,  -0x1.9394b9bb6e16dp-37,
                           0x1.ab782b04de8dep-45};

// Even and odd powers in two chains, which a processor computes side by side.
template <size_t count>
double polynomial(const double (&coefficients)[count], double z) {
  static_assert(count % 2 == 1);
  const double zz = z * z;
  double even = coefficients[count - 1], odd = coefficients[count - 2];
  for (size_t i = count - 1; i >= 2; i -= 2) {
    even = even * zz + coefficients[i - 2];
    if (i >= 3) odd = odd * zz + coefficients[i - 3];
  }
  return even + z * odd;
}

// Rounds to an integer, ties to even; |x| must be below 2^51.
double rounded(double x) { return (x + 0x1.8p52) - 0x1.8p52; }

}  // namespace

SineCosine sine_cosine(double angle) {
  if (!(std::abs(angle) <= kLargestAngle)) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none};
  }
  const double quarters = rounded(angle * (1 / kHalfPi));
  const double x = ((angle - quarters * kTurn1) - quarters * kTurn2) - quarters * kTurn3;
  const double z = x * x, half = 0.5 * z, most = 1 - half;
  const double sine = x + x * (z * polynomial(kSin, z));
  const double cosine = most + (((1 - most) - half) + z * z * polynomial(kCos, z));
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

double sin(double angle) { return sine_cosine(angle).sine; }

double cos(double angle) { return sine_cosine(angle).cosine; }

// Above 1/2, asin x = pi/2 - 2 asin(sqrt((1 - x) / 2)).
double asin(double sine) {
  const double size = std::abs(sine);
  const bool steep = size > 0.5;
  const double z = steep ? 0.5 * (1 - size) : size * size;
  const double x = steep ? std::sqrt(z) : size;
  const double angle = x + x * (z * polynomial(kAsin, z));
  return std::copysign(steep ? kHalfPi - (2 * angle - kHalfPiRest) : angle, sine);
}

double acos(double cosine) { return 2 * atan2(std::sqrt(1 - cosine), std::sqrt(1 + cosine)); }

// The quotient of the smaller and the larger of |x| and |y| is at most 1; above tan(pi/8),
// atan q = pi/4 + atan((q - 1) / (q + 1)).
double atan2(double y, double x) {
  const double width = std::abs(x), height = std::abs(y);
  const bool high = height > width;
  const double low = high ? width : height, top = high ? height : width;
  if (top == 0) return std::copysign(0.0, y);
  const bool turned = low > kTanEighthPi * top;
  const double quotient = turned ? (low - top) / (low + top) : low / top;
  const double z = quotient * quotient;
  double angle = quotient + quotient * (z * polynomial(kAtan, z));
  if (turned) angle = kQuarterPi + (angle + kQuarterPiRest);
  if (high) angle = kHalfPi - (angle - kHalfPiRest);
  if (x < 0) angle = kPi - (angle - kPiRest);
  return std::copysign(angle, y);
}

// Two of Halley's steps, each of which triples the digits, from a line through 1/8 to 1, and a last
// one of Newton's.
double cbrt(double x) {
  int exponent = 0;
  double part = std::frexp(x, &exponent);
  while (exponent % 3 != 0) {
    part *= 0.5;
    ++exponent;
  }
  double root = 0.44 + 0.58 * part;
  for (int i = 0; i < 3; ++i) {
    const double cube = root * root * root;
    root *= (cube + 2 * part) / (2 * cube + part);
  }
  root -= (root * root * root - part) / (3 * root * root);
  return std::ldexp(root, exponent / 3);
}

}  // namespace medial::portable
