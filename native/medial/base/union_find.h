// SPDX-License-Identifier: GPL-3.0-or-later
// Disjoint sets of the ids 0..n-1 are kept as parent pointers; the lowest id represents its set.
#pragma once

#include <numeric>
#include <utility>

#include "base/atomic.h"
#include "base/parallel.h"

namespace medial {

class UnionFind {
 public:
  explicit UnionFind(size_t count, const Run& run = {}) : parent_(array<int32_t>(count, run)) {
    parallel_for(static_cast<int64_t>(count), run,
                 [&](int64_t id) { parent_[id] = static_cast<int32_t>(id); });
  }

  int32_t find(int32_t id) {
    while (parent_[id] != id) id = parent_[id] = parent_[parent_[id]];
    return id;
  }
  void unite(int32_t a, int32_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    if (a < b) std::swap(a, b);
    parent_[a] = b;
    joined_.push_back(a);
  }
  // Representative of every id.
  Array<int32_t> representatives() && {
    for (const int32_t id : joined_) parent_[id] = find(id);
    return std::move(parent_);
  }

 private:
  Array<int32_t> parent_;
  std::vector<int32_t> joined_;  // ids that no longer represent their set
};

// This does the same for several threads at once; the sets do not depend on their timing.
class SharedUnionFind {
 public:
  SharedUnionFind(size_t count, const Run& run) : parent_(array<int32_t>(count, run)) {
    parallel_for(static_cast<int64_t>(count), run,
                 [&](int64_t id) { parent_[id] = static_cast<int32_t>(id); });
  }

  void unite(int32_t a, int32_t b) {
    for (;;) {
      a = find(a);
      b = find(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      int32_t self = a;
      if (shared_exchange(parent_[a], self, b)) return;
    }
  }
  // Representative of every id; when all threads are done.
  Array<int32_t> representatives(const Run& run) && {
    parallel_for(static_cast<int64_t>(parent_.size()), run,
                 [&](int64_t id) { shared_store(parent_[id], find(static_cast<int32_t>(id))); });
    return std::move(parent_);
  }

 private:
  int32_t find(int32_t id) {
    for (;;) {
      int32_t above = shared_load(parent_[id]);
      if (above == id) return id;
      const int32_t two = shared_load(parent_[above]);
      if (two != above) shared_exchange(parent_[id], above, two);
      id = two;
    }
  }

  Array<int32_t> parent_;
};

// These disjoint sets also know, for elements that can be reversed, which ones are reversed
// relative to the lowest id of their set.
class OrientedUnionFind {
 public:
  explicit OrientedUnionFind(size_t count) : parent_(count), turned_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  struct Found {
    int32_t root;
    bool turned;  // relative to the root
  };
  Found find(int32_t id) {
    bool turned = false;
    while (parent_[id] != id) {
      const int32_t above = parent_[id];
      turned_[id] ^= turned_[above];  // a root is never turned
      parent_[id] = parent_[above];
      turned ^= turned_[id] != 0;
      id = parent_[id];
    }
    return {id, turned};
  }
  // Joins the sets of a and b; `turned` tells whether b is reversed relative to a. It has no effect
  // if they are in one set already.
  void unite(int32_t a, int32_t b, bool turned) {
    Found high = find(a), low = find(b);
    if (high.root == low.root) return;
    if (high.root < low.root) std::swap(high, low);
    parent_[high.root] = low.root;
    turned_[high.root] = high.turned != (low.turned != turned);
  }

 private:
  std::vector<int32_t> parent_;
  std::vector<uint8_t> turned_;  // relative to the parent
};

}  // namespace medial
