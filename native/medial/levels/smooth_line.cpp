// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels/smooth_line.h"

#include <array>

namespace medial {
namespace {

constexpr std::array<double, 5> kDifference{1, -4, 6, -4, 1};
constexpr size_t kEntries = kDifference.size();

// Row j holds the entries (j, j), (j + 1, j), and so on, of a symmetric matrix; those beyond it
// are 0.
using Bands = std::vector<std::array<double, kEntries>>;

// Returns the matrix 1 + D^T W D of the fourth differences D and their weights W, which are the
// eighth powers of the widths.
Bands normal_matrix(std::span<const double> widths) {
  Bands bands(widths.size(), {1, 0, 0, 0, 0});
  for (size_t a = 0; a < kEntries; ++a) {
    for (size_t b = a; b < kEntries; ++b) {
      for (size_t i = 0; i + kEntries <= widths.size(); ++i) {
        const double square = widths[i + 2] * widths[i + 2];
        bands[i + a][b - a] +=
            kDifference[a] * kDifference[b] * (square * square * square * square);
      }
    }
  }
  return bands;
}

// Solves in place by Cholesky's method without roots: entries become pivots and factors.
void solve(Bands& bands, std::vector<Vec3>& right) {
  const size_t size = bands.size();
  for (size_t j = 0; j < size; ++j) {
    for (size_t back = 1; back < kEntries && back <= j; ++back) {
      const auto& before = bands[j - back];
      const double first = before[back] * before[0];
      for (size_t k = 0; back + k < kEntries; ++k) bands[j][k] -= first * before[back + k];
      right[j] = right[j] - before[back] * right[j - back];
    }
    for (size_t k = 1; k < kEntries; ++k) bands[j][k] /= bands[j][0];
  }
  for (size_t j = size; j-- > 0;) {
    right[j] = {right[j].x / bands[j][0], right[j].y / bands[j][0], right[j].z / bands[j][0]};
    for (size_t k = 1; k < kEntries && j + k < size; ++k) {
      right[j] = right[j] - bands[j][k] * right[j + k];
    }
  }
}

}  // namespace

std::vector<Vec3> smooth_line(std::span<const Vec3> places, std::span<const double> widths) {
  Bands bands = normal_matrix(widths);
  std::vector<Vec3> smooth(places.begin(), places.end());
  solve(bands, smooth);
  return smooth;
}

}  // namespace medial
