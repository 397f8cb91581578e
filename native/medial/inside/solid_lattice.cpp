// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/solid_lattice.h"

#include <bit>

#include "base/parallel.h"
#include "base/portable_math.h"

namespace medial {
namespace {

constexpr int64_t kFirst = 32;  // places along the longest side of the box at the beginning
constexpr int64_t kRows = 64;   // rows of one piece of work
constexpr double kEmpty = 1e6;  // places, none of them inside: it is empty; work: memory
constexpr double kLeast = 1.05, kLargest = 8;  // work: time
// This is the offset of a place in its cell of the lattice. It is not in a plane of symmetry, where
// models have edges.
constexpr Vec3 kShift{0.4142, 0.5303, 0.4641};

// Returns the number of places along one side of a box. A box without extent has one place, too.
int64_t steps_along(double extent, double step) {
  return static_cast<int64_t>(std::floor(extent / step)) + 1;
}

double lattice_size(const Box& box, double step) {
  const Vec3 e = box.extent();
  return (e.x / step + 1) * (e.y / step + 1) * (e.z / step + 1);
}

// Returns a step that is finer by the ratio, limited to kLeast to kLargest, such that the lattice
// has at most `most` places; or the same step if there is none.
double finer(const Box& box, double step, double ratio, int64_t most) {
  for (double factor = std::clamp(ratio, kLeast, kLargest); factor >= kLeast; factor *= 0.9) {
    if (lattice_size(box, step / factor) <= static_cast<double>(most)) return step / factor;
  }
  return step;
}

}  // namespace

SolidLattice::SolidLattice(const WindingNumber& winding, const Box& box, int64_t places,
                           int64_t most, const Run& run) {
  double step = max_abs(box.extent()) / kFirst;
  if (!(step > 0)) return;
  for (;;) {
    fill(winding, box, step, run);
    if (2 * count_ >= places || (count_ == 0 && lattice_size(box, step) > kEmpty)) return;
    const auto wanted = static_cast<double>(places);
    const double ratio = portable::cbrt(wanted / static_cast<double>(std::max<int64_t>(count_, 1)));
    const double next = finer(box, step, ratio, most);
    if (next == step) return;
    step = next;
  }
}

void SolidLattice::fill(const WindingNumber& winding, const Box& box, double step, const Run& run) {
  const Vec3 extent = box.extent();
  step_ = step;
  size_ = {steps_along(extent.x, step), steps_along(extent.y, step), steps_along(extent.z, step)};
  const auto first = [&](int axis) {
    const double rest = coordinate(extent, axis) - step * static_cast<double>(size_[axis]);
    return coordinate(box.low, axis) + rest / 2 + coordinate(kShift, axis) * step;
  };
  origin_ = {first(0), first(1), first(2)};
  words_ = (size_[0] + 63) / 64;
  const int64_t rows = size_[1] * size_[2];
  bits_.assign(static_cast<size_t>(rows * words_), 0);
  parallel_chunks(
      rows, run,
      [&](int64_t begin, int64_t end, int) {
        std::vector<int> closed(static_cast<size_t>(size_[0]));
        for (int64_t row = begin; row < end; ++row) {
          throw_if_cancelled(run.progress);
          fill_row(winding, row, closed);
        }
      },
      kRows);
  count_ = whole_count();
}

void SolidLattice::fill_row(const WindingNumber& winding, int64_t row, std::vector<int>& closed) {
  winding.closed_along(place(row, 0), step_, closed);
  for (int64_t i = 0; i < size_[0]; ++i) {
    if (!winding.is_inside(place(row, i), closed[i])) continue;
    bits_[row * words_ + i / 64] |= uint64_t{1} << (i % 64);
  }
}

Vec3 SolidLattice::place(int64_t row, int64_t i) const {
  const auto at = [&](int64_t steps) { return step_ * static_cast<double>(steps); };
  return origin_ + Vec3{at(i), at(row % size_[1]), at(row / size_[1])};
}

int64_t SolidLattice::whole_count() const {
  int64_t sum = 0;
  for (const uint64_t word : bits_) sum += std::popcount(word);
  return sum;
}

// Calls visit(word, mask) for the words that have places in the ball.
template <typename Visit>
void SolidLattice::visit_words(const Vec3& centre, double radius, const Visit& visit) const {
  // Returns the first and the last place along an axis within `reach` of the centre.
  const auto range = [&](int axis, double reach) {
    const double at = coordinate(centre, axis) - coordinate(origin_, axis);
    const auto last = static_cast<double>(size_[axis] - 1);
    const double low = std::ceil((at - reach) / step_), high = std::floor((at + reach) / step_);
    return std::array{static_cast<int64_t>(std::clamp(low, 0.0, last + 1)),
                      static_cast<int64_t>(std::clamp(high, -1.0, last))};
  };
  const auto [z_first, z_last] = range(2, radius);
  for (int64_t z = z_first; z <= z_last; ++z) {
    const double dz = origin_.z + step_ * static_cast<double>(z) - centre.z;
    const double in_plane = std::sqrt(std::max(radius * radius - dz * dz, 0.0));
    const auto [y_first, y_last] = range(1, in_plane);
    for (int64_t y = y_first; y <= y_last; ++y) {
      const double dy = origin_.y + step_ * static_cast<double>(y) - centre.y;
      const double half = std::sqrt(std::max(in_plane * in_plane - dy * dy, 0.0));
      const auto [first, last] = range(0, half);
      if (first > last) continue;
      const int64_t row = (z * size_[1] + y) * words_;
      for (int64_t word = first / 64; word <= last / 64; ++word) {
        uint64_t mask = ~uint64_t{0};
        if (word == first / 64) mask &= ~uint64_t{0} << (first % 64);
        if (word == last / 64) mask &= ~uint64_t{0} >> (63 - last % 64);
        visit(row + word, mask);
      }
    }
  }
}

int64_t SolidLattice::count(const Vec3& centre, double radius) const {
  int64_t sum = 0;
  visit_words(centre, radius,
              [&](int64_t word, uint64_t mask) { sum += std::popcount(bits_[word] & mask); });
  return sum;
}

void SolidLattice::remove(const Vec3& centre, double radius) {
  visit_words(centre, radius, [&](int64_t word, uint64_t mask) { bits_[word] &= ~mask; });
}

void SolidLattice::restore(const SolidLattice& whole, const Vec3& centre, double radius) {
  visit_words(centre, radius,
              [&](int64_t word, uint64_t mask) { bits_[word] |= whole.bits_[word] & mask; });
}

std::vector<Vec3> SolidLattice::places() const {
  std::vector<Vec3> result;
  for (int64_t row = 0; row < size_[1] * size_[2]; ++row) {
    for (int64_t word = 0; word < words_; ++word) {
      for (uint64_t left = bits_[row * words_ + word]; left != 0; left &= left - 1) {
        result.push_back(place(row, 64 * word + std::countr_zero(left)));
      }
    }
  }
  return result;
}

}  // namespace medial
