// SPDX-License-Identifier: GPL-3.0-or-later
// This queue returns ids in ascending order of their keys, and equal keys in the order of the ids.
// Keys are kept in buckets, of which only those in use are sorted; this costs less than one large
// heap.
#pragma once

#include <algorithm>
#include <bit>
#include <queue>

#include "base/run.h"

namespace medial {

class BucketQueue {
 public:
  // The first `buckets` buckets have this width, the next as many have twice this width, and so on,
  // because most keys are small. The largest keys share the last bucket.
  BucketQueue(double width, size_t buckets)
      : per_range_(1 / (width * static_cast<double>(buckets))),
        in_range_(static_cast<double>(buckets)),
        buckets_(kRanges * buckets) {}

  // Adds an id. Its key may be lower than the last that was popped, and an id may be pushed again.
  void push(double key, int32_t id) {
    const size_t bucket = bucket_of(key);
    if (bucket < open_) {
      late_.emplace(key, id);
    } else {
      buckets_[bucket].emplace_back(key, id);
    }
  }

  // Removes and returns the next id, or -1 if none is left.
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

  // Returns the id that is popped after `ahead` others if nothing is pushed between them, or -1 if
  // it is unknown or there is none. It is known for all `ahead` below kAhead.
  static constexpr size_t kAhead = 32;
  int32_t soon(size_t ahead) const {
    return next_ + ahead < sorted_.size() ? sorted_[next_ + ahead].second : -1;
  }

 private:
  using Keyed = std::pair<double, int32_t>;
  static constexpr size_t kRanges = 12;
  static constexpr uint64_t kFraction = (uint64_t{1} << 52) - 1, kOne = uint64_t{1023} << 52;

  // Keys are not negative, so the exponent of 1 + key / range is the number of the key's range.
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
  size_t open_ = 0, next_ = 0;  // all buckets below `open_` have been opened
  std::vector<Keyed> sorted_;
  std::priority_queue<Keyed, std::vector<Keyed>, std::greater<>> late_;
};

}  // namespace medial
