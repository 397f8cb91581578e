// SPDX-License-Identifier: GPL-3.0-or-later
// The trees over lists of triangles and balls: how one is built, and how it finds what is nearest.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/select.h"
#include "base/vec3.h"

namespace medial {

// A node stands for a contiguous run of items.
struct TreeNode {
  int32_t begin = 0, end = 0;
  int32_t right = -1;  // the left child follows its parent; -1 marks a leaf

  bool is_leaf() const { return right < 0; }
};

struct BoxNode : TreeNode {
  Box box;
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
  select(items.begin() + begin, items.begin() + middle, items.begin() + end,
         [&](const Item& s, const Item& t) { return key(s) < key(t); });
  return middle;
}

// Returns the tree of items by their boxes, which comes with an order of the items; of two with the
// same middle the lower one comes first.
template <typename BoxOf>
std::vector<BoxNode> tree_of_boxes(std::vector<int32_t>& items, const BoxOf& box_of_item) {
  constexpr int32_t kInLeaf = 4;
  std::vector<BoxNode> nodes;
  const auto describe = [&](BoxNode& node) {
    for (int32_t i = node.begin; i < node.end; ++i) node.box.add(box_of_item(items[i]));
  };
  const auto split = [&](const BoxNode& node) {
    const int axis = longest_axis(node.box.extent());
    return split_in_middle(items, node.begin, node.end, [&, axis](int32_t item) {
      const Box box = box_of_item(item);
      return std::pair(coordinate(box.low, axis) + coordinate(box.high, axis), item);
    });
  };
  if (items.empty()) return nodes;
  build_tree(nodes, 0, static_cast<int32_t>(items.size()), kInLeaf, describe, split);
  return nodes;
}

// Visits the leaves under a node, the nearer child first, except where `bound`, a lower bound of
// the distance to the items of a node, is above `best()`, the least distance so far.
template <typename Node, typename Bound, typename Best, typename Visit>
void visit_nearest(const std::vector<Node>& nodes, int32_t id, const Bound& bound, const Best& best,
                   const Visit& visit) {
  const Node& node = nodes[id];
  if (node.is_leaf()) {
    visit(node);
    return;
  }
  int32_t near = id + 1, far = node.right;
  double to_near = bound(nodes[near]), to_far = bound(nodes[far]);
  if (to_far < to_near) {
    std::swap(near, far);
    std::swap(to_near, to_far);
  }
  if (!(to_near > best())) visit_nearest(nodes, near, bound, best, visit);
  if (!(to_far > best())) visit_nearest(nodes, far, bound, best, visit);
}

// Returns the nearest place of the items of a tree if it is nearer than a distance; of equally near
// ones that of the lowest item. `bound` returns a lower bound of the squared distance to the items
// of a node, `place_on` the place on an item, or nothing if it cannot be nearer than a distance.
template <typename Place, typename Node, typename Bound, typename PlaceOn>
std::optional<Place> nearest_place(const std::vector<Node>& nodes, std::span<const int32_t> items,
                                   double than, const Bound& bound, const PlaceOn& place_on) {
  std::optional<Place> best;
  int32_t best_item = -1;
  double within = than;
  const auto visit = [&](const Node& leaf) {
    for (int32_t i = leaf.begin; i < leaf.end; ++i) {
      const std::optional<Place> place = place_on(items[i], within);
      if (!place) continue;
      const bool first = best && place->distance == within && items[i] < best_item;
      if (!(place->distance < within || first)) continue;
      best = place;
      best_item = items[i];
      within = place->distance;
    }
  };
  if (nodes.empty()) return best;
  visit_nearest(
      nodes, 0, bound, [&] { return within * within; }, visit);
  return best;
}

}  // namespace medial
