// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/union_find.h"
#include "skeleton/crisp_parts.h"

namespace medial {
namespace {

// Places cost far more than all other stages together where walls are curved, and the denser the
// samples are, the less is seen of them. With so many samples, vertices stay whose walls are this
// many times as far away as the holes between their samples are wide: their facets lean by about
// one degree.
constexpr int64_t kManySamples = 50'000;
constexpr double kDense = 16;
constexpr double kFarFromRims = 2;  // holes from a vertex to a rim whose vertices do move

class DenseVertices {
 public:
  explicit DenseVertices(const CrispState& state)
      : c_(state), dense_(array<uint8_t>(state.complex.cell.size(), 0, state.run)) {}

  Array<uint8_t> find() && {
    if (c_.samples.count() < kManySamples) return std::move(dense_);
    parallel_for(c_.complex.vertices(), c_.run, [&](int64_t v) {
      dense_[v] = !c_.facets_at[v].empty() && is_between_dense_walls(static_cast<int32_t>(v));
    });
    decide_for_whole_rims();
    leave_out_near_other_rims();
    return std::move(dense_);
  }

 private:
  bool is_between_dense_walls(int32_t v) const {
    const double room = c_.complex.radius[v] / kDense;
    for (const int32_t f : c_.facets_at[v]) {
      for (const int32_t s : c_.complex.generators[f]) {
        const int32_t t = c_.samples.triangle(s);
        if (t < 0 || !c_.samples.faces().is_curved(t) || !(c_.samples.spacing(s) < room))
          return false;
      }
    }
    return true;
  }

  // The vertices of a rim all move to the end of the sheet, or all stay: the rim would have steps
  // otherwise.
  void decide_for_whole_rims() {
    UnionFind rims(dense_.size(), c_.run);
    for (int32_t v = 0; v < c_.complex.vertices(); ++v) {
      for (const int32_t other : c_.beside[v]) rims.unite(v, other);
    }
    const Array<int32_t> rim_of = std::move(rims).representatives();
    std::vector<int64_t> surplus(dense_.size(), 0);  // per rim: dense vertices without the others
    for_rims([&](int32_t v) { surplus[rim_of[v]] += dense_[v] ? 1 : -1; });
    for_rims([&](int32_t v) { dense_[v] = surplus[rim_of[v]] > 0; });
  }

  // The end of a sheet is found from the balls beside it.
  void leave_out_near_other_rims() {
    std::vector<Vec3> places;
    for_rims([&](int32_t v) {
      if (!dense_[v]) places.push_back(c_.complex.position[v]);
    });
    if (places.empty()) return;
    const PointTree rims = PointTree::sorted(places, c_.run);
    parallel_for(
        c_.complex.vertices(), c_.run,
        [&](int64_t v) {
          if (!dense_[v] || c_.on_rim[v]) return;
          const double room = kFarFromRims * c_.spacing_at(static_cast<int32_t>(v));
          if (rims.has_within(c_.complex.position[v], room)) dense_[v] = 0;
        },
        256);
  }

  template <typename Found>
  void for_rims(const Found& found) const {
    for (int32_t v = 0; v < c_.complex.vertices(); ++v) {
      if (c_.on_rim[v]) found(v);
    }
  }

  const CrispState& c_;
  Array<uint8_t> dense_;
};

}  // namespace

Array<uint8_t> dense_vertices(const CrispState& state) { return DenseVertices(state).find(); }

}  // namespace medial
