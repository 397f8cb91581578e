// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/rows.h"

#include <array>
#include <bit>
#include <string>
#include <tuple>

#include "base/parallel.h"
#include "base/sort.h"
#include "base/text.h"

namespace medial {
namespace {

bool in_range(double x) { return std::abs(x) <= kLargestCoordinate; }  // false for NaN

// The index along a 3D Hilbert curve has 2^21 steps per axis (J. Skilling, Programming the Hilbert
// curve, 2004).
constexpr int kBits = 21;

// Puts two zeros between the bits of x.
uint64_t spread(uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffffu;
  x = (x | x << 16) & 0x001f0000ff0000ffu;
  x = (x | x << 8) & 0x100f00f00f00f00fu;
  x = (x | x << 4) & 0x10c30c30c30c30c3u;
  return (x | x << 2) & 0x1249249249249249u;
}

uint64_t hilbert_key(std::array<uint32_t, 3> x) {
  for (uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1) {
    const uint32_t mask = q - 1;
    for (auto& xi : x) {
      const uint32_t set = 0u - static_cast<uint32_t>((xi & q) != 0);  // all bits, or none
      const uint32_t t = (x[0] ^ xi) & mask & ~set;
      x[0] ^= t | (mask & set);
      if (&xi != x.data()) xi ^= t;
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  uint32_t t = 0;
  for (uint32_t q = 1u << (kBits - 1); q > 1; q >>= 1) {
    t ^= (q - 1) & (0u - static_cast<uint32_t>((x[2] & q) != 0));
  }
  for (auto& xi : x) xi ^= t;
  return spread(x[0]) << 2 | spread(x[1]) << 1 | spread(x[2]);
}

Array<uint64_t> hilbert_keys(std::span<const Vec3> rows, const Run& run) {
  const Box box = box_of(rows);
  const double extent = max_abs(box.extent());
  const double scale = extent >= kSmallestExtent ? 2097151 / extent : 0;  // finite
  auto keys = array<uint64_t>(rows.size(), run);
  parallel_for(static_cast<int64_t>(rows.size()), run, [&](int64_t i) {
    const Vec3 p = scale * (rows[i] - box.low);
    keys[i] = hilbert_key(
        {static_cast<uint32_t>(p.x), static_cast<uint32_t>(p.y), static_cast<uint32_t>(p.z)});
  });
  return keys;
}

}  // namespace

Box box_of(std::span<const Vec3> rows) {
  Box box;
  for (const Vec3& p : rows) box.add(p);
  return box;
}

void require_finite(std::span<const Vec3> rows, const char* what) {
  for (size_t i = 0; i < rows.size(); ++i) {
    const Vec3& p = rows[i];
    if (in_range(p.x) && in_range(p.y) && in_range(p.z)) continue;
    throw InvalidInputError("Expected finite coordinates below 1e50, found " + text(p) +
                            " in row " + std::to_string(i) + "; repair or remove this " + what +
                            ".");
  }
}

Array<int32_t> hilbert_order(std::span<const Vec3> rows, const Run& run) {
  const auto keys = hilbert_keys(rows, run);
  const int bits = std::min(static_cast<int>(std::bit_width(rows.size())), 24);  // a bucket per row
  return bucket_order(
      static_cast<int64_t>(rows.size()), size_t{1} << bits, run,
      [&](int64_t i) { return keys[i] >> (3 * kBits - bits); },
      [&](int64_t i) { return std::tuple(keys[i], rows[i].x, rows[i].y, rows[i].z); });
}

DistinctRows distinct_rows(std::span<const Vec3> rows, const char* what, const Run& run) {
  require_finite(rows, what);
  DistinctRows distinct;
  distinct.points.reserve(rows.size() + 200);
  distinct.row.reserve(rows.size());
  distinct.point_of_row.resize(rows.size());
  for (const int32_t row : hilbert_order(rows, run)) {
    const Vec3& p = rows[row];
    if (distinct.points.empty() || distinct.points.back() != p) {
      distinct.points.push_back(p);
      distinct.row.push_back(row);
    }
    distinct.point_of_row[row] = distinct.count() - 1;
  }
  return distinct;
}

}  // namespace medial
