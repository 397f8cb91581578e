// Disjoint sets of ids 0..n-1 as parent pointers; a set is represented by its lowest id.
#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace medial {

class UnionFind {
 public:
  explicit UnionFind(size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int32_t find(int32_t id) {
    while (parent_[id] != id) id = parent_[id] = parent_[parent_[id]];
    return id;
  }
  void unite(int32_t a, int32_t b) {
    a = find(a);
    b = find(b);
    if (a < b) std::swap(a, b);
    parent_[a] = b;
  }
  // Representative of every id. A parent is never above its child, so one ascending pass ends at
  // the roots.
  std::vector<int32_t> representatives() && {
    for (auto& p : parent_) p = parent_[p];
    return std::move(parent_);
  }

 private:
  std::vector<int32_t> parent_;
};

}  // namespace medial
