// SPDX-License-Identifier: GPL-3.0-or-later
// A chain is a sequence of wires between vertices where wires end, branch or join facets.
#pragma once

#include <medial/types.h>

#include <array>
#include <span>
#include <vector>

namespace medial {

struct Chain {
  std::vector<int32_t> vertices;  // along the chain; a closed one repeats its first vertex
  std::vector<int32_t> wires;     // between these vertices
  bool closed = false;            // whether the chain is a cycle without an end
  std::array<bool, 2> loose{};    // whether the first, and the last, vertex is a loose end

  size_t size() const { return wires.size(); }
};

// Returns all wires, each in one chain. A vertex inside a chain is not fixed and has two wires; an
// end is loose if it is not fixed and has one wire. Chains are in the order of their lowest ends,
// and closed ones follow after them.
std::vector<Chain> chains_of(std::span<const Edge> wires, std::span<const uint8_t> fixed);

}  // namespace medial
