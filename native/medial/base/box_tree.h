// SPDX-License-Identifier: GPL-3.0-or-later
// The trees over lists of triangles and balls: how one is built, and how it finds what is nearest.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/vec3.h"

namespace medial {

// A node stands for a contiguous run of items.
struct TreeNode {
  int32_t begin = 0, end = 0;
  int32_t right = -1;  // the left child follows its parent; -1 marks a leaf

  bool is_leaf() const { return right < 0; }
};

// Builds the tree of a run of items, parents before their children, and returns its first node.
// `describe` fills in a node before its run is split; `split` reorders the run of a node and
// returns where its right half begins.
template <typename Node, typename Describe, typename Split>
int32_t build_tree(std::vector<Node>& nodes, int32_t begin, int32_t end, int32_t most_in_leaf,
                   const Describe& describe, const Split& split) {
  const auto id = static_cast<int32_t>(nodes.size());
  nodes.emplace_back();
  nodes[id].begin = begin;
  nodes[id].end = end;
  describe(nodes[id]);
  if (end - begin <= most_in_leaf) return id;
  const int32_t middle = split(nodes[id]);
  build_tree(nodes, begin, middle, most_in_leaf, describe, split);
  const int32_t right = build_tree(nodes, middle, end, most_in_leaf, describe, split);
  nodes[id].right = right;
  return id;
}

// Reorders a run such that the lower half by `key` comes before the upper one; returns the middle.
template <typename Item, typename Key>
int32_t split_in_middle(std::vector<Item>& items, int32_t begin, int32_t end, const Key& key) {
  const int32_t middle = begin + (end - begin) / 2;
  std::nth_element(items.begin() + begin, items.begin() + middle, items.begin() + end,
                   [&](const Item& s, const Item& t) { return key(s) < key(t); });
  return middle;
}

// Visits leaves, the nearer child first, except where `bound`, a lower bound of the distance to the
// items of a node, is above `best()`, the least distance so far.
template <typename Node, typename Bound, typename Best, typename Visit>
void visit_nearest(const std::vector<Node>& nodes, int32_t id, const Bound& bound, const Best& best,
                   const Visit& visit) {
  const Node& node = nodes[id];
  if (bound(node) > best()) return;
  if (node.is_leaf()) {
    visit(node);
    return;
  }
  int32_t near = id + 1, far = node.right;
  if (bound(nodes[far]) < bound(nodes[near])) std::swap(near, far);
  visit_nearest(nodes, near, bound, best, visit);
  visit_nearest(nodes, far, bound, best, visit);
}

}  // namespace medial
