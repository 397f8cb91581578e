// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels/chains.h"

#include "base/csr.h"

namespace medial {
namespace {

class Walker {
 public:
  Walker(std::span<const Edge> wires, std::span<const uint8_t> fixed)
      : wires_(wires),
        fixed_(fixed),
        at_(rows_containing(wires, static_cast<int32_t>(fixed.size()))),
        seen_(wires.size(), 0) {}

  std::vector<Chain> walk() && {
    const auto vertices = static_cast<int32_t>(fixed_.size());
    for (int32_t v = 0; v < vertices; ++v) {
      if (!is_inside(v)) follow_all(v, false);
    }
    for (int32_t v = 0; v < vertices; ++v) follow_all(v, true);
    return std::move(chains_);
  }

 private:
  bool is_inside(int32_t vertex) const { return !fixed_[vertex] && at_[vertex].size() == 2; }

  bool is_loose(int32_t vertex) const { return !fixed_[vertex] && at_[vertex].size() == 1; }

  void follow_all(int32_t vertex, bool closed) {
    for (const int32_t wire : at_[vertex]) {
      if (!seen_[wire]) follow(vertex, wire, closed);
    }
  }

  void follow(int32_t vertex, int32_t wire, bool closed) {
    Chain& chain = chains_.emplace_back();
    chain.closed = closed;
    chain.loose[0] = is_loose(vertex);
    chain.vertices.push_back(vertex);
    while (wire >= 0) {
      seen_[wire] = 1;
      chain.wires.push_back(wire);
      vertex = wires_[wire][0] + wires_[wire][1] - vertex;
      chain.vertices.push_back(vertex);
      wire = is_inside(vertex) ? unseen(vertex) : -1;
    }
    chain.loose[1] = is_loose(vertex);
  }

  int32_t unseen(int32_t vertex) const {
    for (const int32_t wire : at_[vertex]) {
      if (!seen_[wire]) return wire;
    }
    return -1;
  }

  std::span<const Edge> wires_;
  std::span<const uint8_t> fixed_;
  Csr<int32_t> at_;  // per vertex: its wires
  std::vector<uint8_t> seen_;
  std::vector<Chain> chains_;
};

}  // namespace

std::vector<Chain> chains_of(std::span<const Edge> wires, std::span<const uint8_t> fixed) {
  return Walker(wires, fixed).walk();
}

}  // namespace medial
