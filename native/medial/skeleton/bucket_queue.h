// SPDX-License-Identifier: GPL-3.0-or-later
// A queue of ids in ascending order of their keys, equal ones by id. Keys lie in buckets of equal
// width, of which only the one in use is sorted: that costs less than one large heap.
#pragma once

#include <queue>

#include "base/run.h"

namespace medial {

class BucketQueue {
 public:
  // Keys of `width` * `buckets` or more share the last bucket.
  BucketQueue(double width, size_t buckets) : per_width_(1 / width), buckets_(buckets) {}

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
    while (next_ == sorted_.size() && late_.empty()) {
      if (open_ == buckets_.size()) return -1;
      open();
    }
    if (late_.empty() || (next_ < sorted_.size() && sorted_[next_] < late_.top())) {
      return sorted_[next_++].second;
    }
    const int32_t id = late_.top().second;
    late_.pop();
    return id;
  }

  // An id that will be popped soon, if nothing comes between; -1: not known.
  int32_t soon(size_t ahead) const {
    return next_ + ahead < sorted_.size() ? sorted_[next_ + ahead].second : -1;
  }

 private:
  using Keyed = std::pair<double, int32_t>;

  size_t bucket_of(double key) const {
    const double bucket = key * per_width_;
    const size_t last = buckets_.size() - 1;
    return bucket < static_cast<double>(last) ? static_cast<size_t>(bucket) : last;
  }
  void open() {
    sorted_ = std::exchange(buckets_[open_++], {});
    std::sort(sorted_.begin(), sorted_.end());
    next_ = 0;
  }

  double per_width_;
  std::vector<std::vector<Keyed>> buckets_;
  size_t open_ = 0, next_ = 0;  // buckets below `open_` have been opened
  std::vector<Keyed> sorted_;
  std::priority_queue<Keyed, std::vector<Keyed>, std::greater<>> late_;
};

}  // namespace medial
