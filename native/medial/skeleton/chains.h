// SPDX-License-Identifier: GPL-3.0-or-later
// Chains: wires one after the other, between the vertices where they end, branch or join facets.
#pragma once

#include <medial/types.h>

#include <array>
#include <span>
#include <vector>

namespace medial {

struct Chain {
  std::vector<int32_t> vertices;  // along it; of a closed one the last is the first again
  std::vector<int32_t> wires;     // between them
  bool closed = false;            // without an end: nothing holds its first vertex
  std::array<bool, 2> loose{};    // whether it begins, and ends, with a vertex of its own

  size_t size() const { return wires.size(); }
};

// All wires, each in one chain. Inside a chain are vertices with two wires that are not fixed; its
// end is loose if it is not fixed and has one wire. Chains are in the order of their lowest ends,
// closed ones after them.
std::vector<Chain> chains_of(std::span<const Edge> wires, std::span<const uint8_t> fixed);

}  // namespace medial
