// SPDX-License-Identifier: GPL-3.0-or-later
// The C library's long double functions are the judges of the errors; where they have no more bits
// than a double, only the stored hash judges. It was computed by GCC 12 on x86-64.
#include "base/portable_math.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "base/random.h"
#include "base/select.h"

namespace medial {
namespace {

constexpr int kTries = 200000;

// Half of the numbers are even in (-size, size), half have any magnitude below it.
double number(uint64_t seed, double size) {
  const uint64_t random = scrambled(seed);
  const double even = size * (2 * unit(random) - 1);
  return random & 1 ? even : std::ldexp(even, -static_cast<int>((random >> 1) % 60));
}

double ulps(double found, long double exact) {
  const auto near = std::abs(static_cast<double>(exact));
  const double ulp = std::nextafter(near, HUGE_VAL) - near;
  return static_cast<double>(std::abs(found - exact) / ulp);
}

template <typename Ours, typename Exact>
double worst_error(double size, const Ours& ours, const Exact& exact) {
  double worst = 0;
  for (int i = 0; i < kTries; ++i) {
    const double x = number(i, size);
    worst = std::max(worst, ulps(ours(x), exact(static_cast<long double>(x))));
  }
  return worst;
}

class PortableMathErrors : public testing::Test {
  void SetUp() override {
    if (std::numeric_limits<long double>::digits < 64) GTEST_SKIP() << "no wider type";
  }
};

TEST_F(PortableMathErrors, AreAtMostThreeUlps) {
  using L = long double;
  EXPECT_LE(worst_error(7, portable::sin, [](L x) { return std::sin(x); }), 3);
  EXPECT_LE(worst_error(7, portable::cos, [](L x) { return std::cos(x); }), 3);
  EXPECT_LE(worst_error(0x1p20, portable::sin, [](L x) { return std::sin(x); }), 3);
  EXPECT_LE(worst_error(0x1p20, portable::cos, [](L x) { return std::cos(x); }), 3);
  EXPECT_LE(worst_error(1, portable::asin, [](L x) { return std::asin(x); }), 3);
  EXPECT_LE(worst_error(1, portable::acos, [](L x) { return std::acos(x); }), 3);
  const auto root = [](double x) { return portable::cbrt(std::abs(x)); };
  EXPECT_LE(worst_error(1e300, root, [](L x) { return std::cbrt(std::abs(x)); }), 3);
  double worst = 0;
  for (int i = 0; i < kTries; ++i) {
    const double y = number(2 * i, 1), x = number(2 * i + 1, 1);
    worst = std::max(worst, ulps(portable::atan2(y, x), std::atan2(L(y), L(x))));
  }
  EXPECT_LE(worst, 3);
}

// Cody and Waite's reduction is worst next to the multiples of pi/2.
TEST_F(PortableMathErrors, AreSmallNextToQuarterTurns) {
  for (int k = 1; k < 600000; k += 101) {
    const double x = k * (std::numbers::pi / 2);
    const auto [sine, cosine] = portable::sine_cosine(x);
    EXPECT_LE(ulps(sine, std::sin(static_cast<long double>(x))), 3) << k;
    EXPECT_LE(ulps(cosine, std::cos(static_cast<long double>(x))), 3) << k;
  }
}

TEST(PortableMath, SpecialValuesAreThoseOfTheStandard) {
  using std::numbers::pi;
  EXPECT_EQ(portable::asin(1), pi / 2);
  EXPECT_EQ(portable::asin(-1), -pi / 2);
  EXPECT_EQ(portable::asin(0), 0);
  EXPECT_TRUE(std::isnan(portable::asin(1.5)));
  EXPECT_EQ(portable::acos(1), 0);
  EXPECT_EQ(portable::acos(-1), pi);
  EXPECT_TRUE(std::isnan(portable::acos(-1.5)));
  EXPECT_EQ(portable::sin(0), 0);
  EXPECT_EQ(portable::cos(0), 1);
  EXPECT_TRUE(std::isnan(portable::cos(HUGE_VAL)));
  for (const double y : {0.0, 1.0, -1.0, 1e-300}) {
    for (const double x : {0.0, 1.0, -1.0, 1e300}) {
      EXPECT_EQ(portable::atan2(y, x), std::atan2(y, x)) << y << ' ' << x;
    }
  }
  EXPECT_EQ(portable::cbrt(27), 3);
}

uint64_t hash_of(uint64_t hash, double x) { return scrambled(hash ^ std::bit_cast<uint64_t>(x)); }

TEST(PortableMath, HasTheSameBitsEverywhere) {
  uint64_t hash = 0;
  for (int i = 0; i < kTries; ++i) {
    const double x = number(i, 1), y = number(i + kTries, 1);
    const auto [sine, cosine] = portable::sine_cosine(100 * x);
    for (const double value : {portable::asin(x), portable::acos(x), sine, cosine,
                               portable::atan2(y, x), portable::cbrt(std::abs(y))}) {
      hash = hash_of(hash, value);
    }
  }
  EXPECT_EQ(hash, 13752088357580797165u);
}

TEST(Select, DividesLikeNthElementAndAlwaysInTheSameOrder) {
  uint64_t hash = 0;
  for (const int count : {1, 2, 3, 10, 1000}) {
    for (const int kinds : {1, 2, 7, 1 << 30}) {
      std::vector<int> items(count);
      std::iota(items.begin(), items.end(), 0);
      const auto key = [&](int i) { return static_cast<int>(scrambled(i) % kinds); };
      const auto before = [&](int a, int b) { return key(a) < key(b); };
      const int middle = count / 2;
      select(items.begin(), items.begin() + middle, items.end(), before);
      for (int i = 0; i < count; ++i) {
        const int low = std::min(i, middle), high = std::max(i, middle);
        EXPECT_LE(key(items[low]), key(items[high]));
        hash = hash_of(hash, items[i]);
      }
      std::sort(items.begin(), items.end());
      for (int i = 0; i < count; ++i) EXPECT_EQ(items[i], i);
    }
  }
  EXPECT_EQ(hash, 15058666793091769586u);
}

}  // namespace
}  // namespace medial
