// SPDX-License-Identifier: GPL-3.0-or-later
// A queue of ids in ascending order of their keys, equal ones by id. Keys lie in buckets, of which
// only those in use are sorted: that costs less than one large heap.
#pragma once

#include <algorithm>
#include <bit>
#include <queue>

#include "base/run.h"

namespace medial {

class BucketQueue {
 public:
  // The first `buckets` have that width, the next as many twice of it, and so on: most keys are
  // small. The largest share the last bucket.
  BucketQueue(double width, size_t buckets)
      : per_range_(1 / (width * static_cast<double>(buckets))),
        in_range_(static_cast<double>(buckets)),
        buckets_(kRanges * buckets) {}

  // The key may be lower than the last that was popped. An id may be pushed again.
  void push(double key, int32_t id) {
    const size_t bucket = bucket_of(key);
    if (bucket < open_) {
      late_.emplace(key, id);
    } else {
      buckets_[bucket].emplace_back(key, id);
    }
  }

  // The next id; -1 when none is left.
  int32_t pop() {
    while (sorted_.size() - next_ <= kAhead && open_ < buckets_.size()) open();
    if (next_ == sorted_.size() && late_.empty()) return -1;
    if (late_.empty() || (next_ < sorted_.size() && sorted_[next_] < late_.top())) {
      return sorted_[next_++].second;
    }
    const int32_t id = late_.top().second;
    late_.pop();
    return id;
  }

  // An id that will be popped soon, if nothing comes between; -1: there is none, or it is not
  // known, which it is for all below kAhead.
  static constexpr size_t kAhead = 32;
  int32_t soon(size_t ahead) const {
    return next_ + ahead < sorted_.size() ? sorted_[next_ + ahead].second : -1;
  }

 private:
  using Keyed = std::pair<double, int32_t>;
  static constexpr size_t kRanges = 12;
  static constexpr uint64_t kFraction = (uint64_t{1} << 52) - 1, kOne = uint64_t{1023} << 52;

  // Keys are not negative, so 1 + key / range has the number of its range in its exponent.
  size_t bucket_of(double key) const {
    const auto bits = std::bit_cast<uint64_t>(1 + key * per_range_);
    const size_t range = static_cast<size_t>(bits >> 52) - 1023, last = buckets_.size() - 1;
    if (range >= kRanges) return last;
    const double in_range = std::bit_cast<double>((bits & kFraction) | kOne) - 1;
    // The sum may be rounded up.
    return std::min(last, static_cast<size_t>((static_cast<double>(range) + in_range) * in_range_));
  }
  void open() {
    const auto bucket = std::exchange(buckets_[open_++], {});
    if (bucket.empty()) return;
    sorted_.erase(sorted_.begin(), sorted_.begin() + static_cast<int64_t>(next_));
    next_ = 0;
    const auto first = static_cast<int64_t>(sorted_.size());
    sorted_.insert(sorted_.end(), bucket.begin(), bucket.end());
    std::sort(sorted_.begin() + first, sorted_.end());
  }

  double per_range_, in_range_;
  std::vector<std::vector<Keyed>> buckets_;
  size_t open_ = 0, next_ = 0;  // buckets below `open_` have been opened
  std::vector<Keyed> sorted_;
  std::priority_queue<Keyed, std::vector<Keyed>, std::greater<>> late_;
};

}  // namespace medial
