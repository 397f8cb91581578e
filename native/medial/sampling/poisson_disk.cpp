// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/poisson_disk.h"

#include <optional>

#include "base/random.h"
#include "base/rows.h"
#include "base/sort_unique.h"

namespace medial {
namespace {

constexpr int kSide = 4;    // cells along a block
constexpr int kMargin = 2;  // a partner is at most 1.4 cells away, and a disc reaches 0.5
constexpr int kLocal = kSide + 2 * kMargin;  // cells along a block with its margins
constexpr int kColours = 8;  // blocks of one colour are farther apart than any pair reaches

using BlockKey = uint64_t;  // 21 bits per axis

// Divides space into cells twice as wide as the largest disc, and into blocks of cells.
struct Grid {
  Vec3 origin;
  double per_length;  // cells per unit of length

  std::array<double, 3> cells(const Vec3& p) const {
    return {(p.x - origin.x) * per_length, (p.y - origin.y) * per_length,
            (p.z - origin.z) * per_length};
  }
  BlockKey block(const Vec3& p) const {
    BlockKey key = 0;
    for (const double x : cells(p)) {
      key = key << 21 | static_cast<uint64_t>(std::floor(x / kSide) + 1);
    }
    return key;
  }
};

std::array<int64_t, 3> coordinates(BlockKey key) {
  return {static_cast<int64_t>(key >> 42), static_cast<int64_t>(key >> 21 & 0x1fffff),
          static_cast<int64_t>(key & 0x1fffff)};
}

int colour(BlockKey key) {
  const auto [x, y, z] = coordinates(key);
  return static_cast<int>((x & 1) | (y & 1) << 1 | (z & 1) << 2);
}

// Holds the darts of pieces of about the same radius, numbered piece after piece.
struct Darts {
  const CurvedSurface& surface;
  std::span<const Piece> pieces;
  std::vector<int32_t> of;     // ids of the pieces
  std::vector<int64_t> first;  // number of each piece's first dart, and the number of all
  uint64_t seed;

  int64_t count() const { return first.back(); }
  size_t slot_of(int64_t dart) const {
    return static_cast<size_t>(std::upper_bound(first.begin(), first.end(), dart) - first.begin() -
                               1);
  }
};

// Reads darts in ascending order.
class DartReader {
 public:
  DartReader(const Darts& darts, int64_t start) : darts_(darts), slot_(darts.slot_of(start)) {
    enter();
  }

  Place operator()(int64_t dart) {
    if (dart >= darts_.first[slot_ + 1]) {
      ++slot_;
      if (dart >= darts_.first[slot_ + 1]) slot_ = darts_.slot_of(dart);
      enter();
    }
    return place_in(piece(), corners_, dart - darts_.first[slot_], shift_);
  }
  // Returns the piece of the dart that was read last.
  const Piece& piece() const { return darts_.pieces[darts_.of[slot_]]; }
  Vec3 point(const Place& place) const { return patch_->point(place.barycentric()); }

 private:
  void enter() {
    corners_ = piece().corners();
    patch_ = darts_.surface.patch(piece().triangle);
    const uint64_t hash =
        scrambled(darts_.seed ^ scrambled(static_cast<uint64_t>(darts_.of[slot_])));
    shift_ = {unit(hash), unit(scrambled(hash))};
  }

  const Darts& darts_;
  size_t slot_;
  std::array<Barycentric, 3> corners_;
  std::optional<Patch> patch_;
  std::array<double, 2> shift_;
};

// Holds the darts and the fixed discs by block.
struct Blocks {
  std::vector<BlockKey> keys;  // ascending
  Csr<uint32_t> darts, fixed;
  std::vector<std::vector<PlacedDisk>> placed;

  int32_t find(BlockKey key) const {
    const auto at = std::lower_bound(keys.begin(), keys.end(), key);
    return at != keys.end() && *at == key ? static_cast<int32_t>(at - keys.begin()) : -1;
  }
};

std::vector<BlockKey> dart_keys(const Darts& darts, const Grid& grid, const Run& run) {
  std::vector<BlockKey> keys(static_cast<size_t>(darts.count()));
  parallel_chunks(darts.count(), run, [&](int64_t begin, int64_t end, int) {
    DartReader read(darts, begin);
    for (int64_t i = begin; i < end; ++i) {
      const Place place = read(i);
      keys[i] = grid.block(read.point(place));
    }
  });
  return keys;
}

std::vector<BlockKey> distinct(std::span<const BlockKey> keys, const Run& run) {
  constexpr int64_t kChunk = 1 << 16;
  const auto count = static_cast<int64_t>(keys.size());
  auto found = parallel_append<BlockKey>((count + kChunk - 1) / kChunk, run,
                                         [&](int64_t chunk, std::vector<BlockKey>& out, int) {
                                           const int64_t end =
                                               std::min(count, (chunk + 1) * kChunk);
                                           std::vector<BlockKey> own;
                                           for (int64_t i = chunk * kChunk; i < end; ++i) {
                                             if (own.empty() || keys[i] != own.back())
                                               own.push_back(keys[i]);
                                           }
                                           sort_unique(own);
                                           out.insert(out.end(), own.begin(), own.end());
                                         },
                                         1);
  sort_unique(found);
  return found;
}

// Lists for every block the ids with its key, ascending.
Csr<uint32_t> by_block(std::span<const BlockKey> keys, const Blocks& blocks, const Run& run) {
  std::vector<int32_t> block(keys.size());
  parallel_chunks(static_cast<int64_t>(keys.size()), run, [&](int64_t begin, int64_t end, int) {
    for (int64_t i = begin; i < end; ++i) {
      block[i] = i > begin && keys[i] == keys[i - 1] ? block[i - 1] : blocks.find(keys[i]);
    }
  });
  Csr<uint32_t> lists;
  lists.offsets.assign(blocks.keys.size() + 2, 0);
  int64_t* const next = lists.offsets.data() + 1;
  for (const int32_t b : block) ++next[b];
  counts_to_offsets(std::span(lists.offsets).subspan(1));
  lists.items.resize(keys.size());
  for (size_t i = 0; i < keys.size(); ++i) {
    lists.items[next[block[i]]++] = static_cast<uint32_t>(i);
  }
  lists.offsets.pop_back();
  return lists;
}

Blocks make_blocks(const Darts& darts, std::span<const Disk> fixed, const Grid& grid,
                   const Run& run) {
  Blocks blocks;
  std::vector<BlockKey> fixed_keys(fixed.size());
  parallel_for(static_cast<int64_t>(fixed.size()), run,
               [&](int64_t i) { fixed_keys[i] = grid.block(fixed[i].centre); });
  const auto keys = dart_keys(darts, grid, run);
  blocks.keys = distinct(keys, run);
  const auto more = distinct(fixed_keys, run);
  blocks.keys.insert(blocks.keys.end(), more.begin(), more.end());
  sort_unique(blocks.keys);
  blocks.darts = by_block(keys, blocks, run);
  blocks.fixed = by_block(fixed_keys, blocks, run);
  blocks.placed.resize(blocks.keys.size());
  return blocks;
}

// Holds the discs in and around one block, by cell.
class Neighbourhood {
 public:
  void begin(const Grid& grid, BlockKey key) {
    grid_ = &grid;
    const auto at = coordinates(key);
    for (int i = 0; i < 3; ++i) low_[i] = static_cast<double>((at[i] - 1) * kSide - kMargin);
    heads_.fill(-1);
    disks_.clear();
  }

  // Adds a disc, unless it is beyond the margin.
  void add(const Disk& disk) {
    const auto x = local(disk.centre);
    for (const double xi : x) {
      if (!(xi >= 0 && xi < kLocal)) return;
    }
    int32_t& head =
        heads_[cell(static_cast<int>(x[0]), static_cast<int>(x[1]), static_cast<int>(x[2]))];
    disks_.push_back({disk, head});
    head = static_cast<int32_t>(disks_.size()) - 1;
  }

  // Returns whether a new disc has room; `normal` is called only if it decides.
  template <typename Normal>
  bool free(const Vec3& centre, double radius, const Normal& normal) const {
    const auto x = local(centre);
    std::array<int, 3> own, other;  // the cell, and the next one on the nearer side
    for (int i = 0; i < 3; ++i) {
      own[i] = std::clamp(static_cast<int>(x[i]), 1, kLocal - 2);
      other[i] = x[i] - own[i] < 0.5 ? own[i] - 1 : own[i] + 1;
    }
    for (int i = 0; i < 8; ++i) {
      int32_t at = heads_[cell(i & 1 ? other[0] : own[0], i & 2 ? other[1] : own[1],
                               i & 4 ? other[2] : own[2])];
      for (; at >= 0; at = disks_[at].next) {
        const Disk& disk = disks_[at].disk;
        const double reach = std::min(radius, disk.radius);
        if (squared_length(disk.centre - centre) >= reach * reach) continue;
        if (disk.normal == Vec3{} || dot(disk.normal, normal()) > 0) return false;
      }
    }
    return true;
  }

 private:
  struct Linked {
    Disk disk;
    int32_t next;
  };

  static size_t cell(int x, int y, int z) {
    const auto plane = static_cast<size_t>(x) * kLocal + static_cast<size_t>(y);
    return plane * kLocal + static_cast<size_t>(z);
  }
  std::array<double, 3> local(const Vec3& p) const {
    auto x = grid_->cells(p);
    for (int i = 0; i < 3; ++i) x[i] -= low_[i];
    return x;
  }

  const Grid* grid_ = nullptr;
  std::array<double, 3> low_{};
  std::array<int32_t, size_t{kLocal} * kLocal * kLocal> heads_{};
  std::vector<Linked> disks_;
};

struct Dart {
  Place place;
  double radius;
  Vec3 centre;
};

struct Scratch {
  Neighbourhood near;
  std::vector<Dart> darts;
  std::vector<ColumnPlace> column;  // of one dart
  std::vector<PlacedDisk> disks;
};

void gather(const Blocks& blocks, std::span<const Disk> fixed, BlockKey key, Neighbourhood& near) {
  const auto at = coordinates(key);
  for (int i = 0; i < 27; ++i) {
    const BlockKey other = static_cast<BlockKey>(at[0] + i % 3 - 1) << 42 |
                           static_cast<BlockKey>(at[1] + i / 3 % 3 - 1) << 21 |
                           static_cast<BlockKey>(at[2] + i / 9 - 1);
    const int32_t block = blocks.find(other);
    if (block < 0) continue;
    for (const uint32_t id : blocks.fixed[block]) near.add(fixed[id]);
    for (const PlacedDisk& placed : blocks.placed[block]) near.add(placed.disk);
  }
}

void read_darts(const Darts& darts, std::span<const uint32_t> ids, double scale,
                std::vector<Dart>& out) {
  out.clear();
  DartReader read(darts, ids.front());
  for (const uint32_t id : ids) {
    const Place place = read(id);
    out.push_back({place, scale * read.piece().spacing, read.point(place)});
  }
}

// Makes the discs of a column, and returns whether those at the places opposite to the dart have
// room.
bool make_disks(const Dart& dart, const CurvedSurface& surface, Scratch& scratch) {
  scratch.disks.clear();
  for (const ColumnPlace& opposite : scratch.column) {
    const auto& [triangle, at] = opposite.place;
    const auto here = static_cast<int>(scratch.disks.size());
    const Disk disk{here == 0 ? dart.centre : surface.point(triangle, at), dart.radius,
                    surface.normal(triangle, at)};
    if (here > 0 && !scratch.near.free(disk.centre, disk.radius, [&] { return disk.normal; })) {
      return false;
    }
    scratch.disks.push_back({disk, triangle, at});
    if (here == 0 || opposite.through == Through::gap) continue;
    scratch.disks[here].to_partner = opposite.before - here;
    scratch.disks[opposite.before].to_partner = here - opposite.before;
  }
  return true;
}

// Makes the disc of a dart and, if walls or gaps there are close, discs of the same size at all
// places opposite to it, or at those that are tight. Returns whether they have room.
bool make_column(const Dart& dart, double scale, const CurvedSurface& surface,
                 const OppositeWalls* walls, Scratch& scratch) {
  const SurfacePlace own{dart.place.triangle, dart.place.barycentric()};
  scratch.column.assign(1, {own});
  if (walls) walls->column(own, kCloseWalls * dart.radius / scale, scratch.column);
  if (make_disks(dart, surface, scratch)) return true;
  const size_t before = scratch.column.size();
  keep_tight(scratch.column);
  return scratch.column.size() < before && make_disks(dart, surface, scratch);
}

// Throws the darts of a block, in an order that depends only on the block and the seed. A dart
// between close walls or gaps stays only if the places opposite to it have room, too.
void throw_darts(const Darts& darts, const Grid& grid, double scale, std::span<const Disk> fixed,
                 const OppositeWalls* walls, int32_t block, Blocks& blocks, Scratch& scratch) {
  const auto ids = blocks.darts[block];
  if (ids.empty()) return;
  const BlockKey key = blocks.keys[block];
  scratch.near.begin(grid, key);
  gather(blocks, fixed, key, scratch.near);
  read_darts(darts, ids, scale, scratch.darts);
  uint64_t random = scrambled(darts.seed ^ scrambled(key));
  for (size_t left = scratch.darts.size(); left > 0; --left) {
    random = scrambled(random);
    std::swap(scratch.darts[left - 1],
              scratch.darts[static_cast<size_t>(unit(random) * static_cast<double>(left))]);
    const Dart& dart = scratch.darts[left - 1];
    const auto normal = [&] {
      return darts.surface.normal(dart.place.triangle, dart.place.barycentric());
    };
    if (!scratch.near.free(dart.centre, dart.radius, normal)) continue;
    if (!make_column(dart, scale, darts.surface, walls, scratch)) continue;
    for (const PlacedDisk& placed : scratch.disks) {
      scratch.near.add(placed.disk);
      blocks.placed[block].push_back(placed);
    }
  }
}

// Places discs of about the same size among those that are there.
std::vector<PlacedDisk> one_size(const Darts& darts, const Grid& grid, double scale,
                                 std::span<const Disk> fixed, const OppositeWalls* walls,
                                 const Run& run) {
  Blocks blocks = make_blocks(darts, fixed, grid, run);
  std::array<std::vector<int32_t>, kColours> coloured;
  for (int32_t b = 0; b < static_cast<int32_t>(blocks.keys.size()); ++b) {
    coloured[colour(blocks.keys[b])].push_back(b);
  }
  std::vector<Scratch> scratch(run.threads);
  for (const auto& list : coloured) {
    parallel_chunks(
        static_cast<int64_t>(list.size()), run,
        [&](int64_t begin, int64_t end, int worker) {
          for (int64_t i = begin; i < end; ++i) {
            throw_darts(darts, grid, scale, fixed, walls, list[i], blocks, scratch[worker]);
          }
        },
        4);
  }
  std::vector<PlacedDisk> all;
  for (const auto& placed : blocks.placed) all.insert(all.end(), placed.begin(), placed.end());
  return all;
}

// Groups the pieces by halvings of their spacing, from the largest.
std::vector<std::vector<int32_t>> by_size(std::span<const Piece> pieces, double largest) {
  std::vector<std::vector<int32_t>> sizes;
  for (size_t i = 0; i < pieces.size(); ++i) {
    const auto size = static_cast<size_t>(std::ilogb(largest / pieces[i].spacing));
    if (size >= sizes.size()) sizes.resize(size + 1);
    sizes[size].push_back(static_cast<int32_t>(i));
  }
  return sizes;
}

// Returns the number of each piece's first dart. A piece gets as many darts as its area needs,
// rounded down; the rest is carried over to the next piece.
std::vector<int64_t> numbered(std::span<const Piece> pieces, std::span<const int32_t> of,
                              double per_disk_area, uint64_t seed) {
  std::vector<int64_t> first(of.size() + 1);
  double sum = unit(scrambled(seed));
  for (size_t i = 0; i < of.size(); ++i) {
    const Piece& piece = pieces[of[i]];
    sum += per_disk_area * piece.area / (piece.spacing * piece.spacing);
    first[i + 1] = static_cast<int64_t>(sum);
  }
  return first;
}

Grid make_grid(const CurvedSurface& surface, std::span<const Disk> fixed, double largest_radius) {
  Box box = box_of(surface.mesh().points);
  for (const Disk& disk : fixed) box.add(disk.centre);
  const double extent = max_abs(box.extent());
  // Curved patches leave the box of their corners by less than its extent.
  const Vec3 low = box.low - extent * Vec3{1, 1, 1};
  return {low, 0.5 / largest_radius};
}

void require_range(const Grid& grid, const CurvedSurface& surface) {
  const double extent = max_abs(box_of(surface.mesh().points).extent());
  const double blocks = 3 * extent * grid.per_length / kSide;
  if (blocks < 0x1p20) return;
  throw InvalidInputError(
      "Expected a spacing above a five-millionth of the extent, found less; take a larger one.");
}

}  // namespace

std::vector<PlacedDisk> poisson_disks(const CurvedSurface& surface, std::span<const Piece> pieces,
                                      double scale, std::span<const Disk> fixed, int darts,
                                      uint64_t seed, const Run& run, const OppositeWalls* walls) {
  double largest = 0;
  for (const Piece& piece : pieces) largest = std::max(largest, piece.spacing);
  std::vector<Disk> there(fixed.begin(), fixed.end());
  std::vector<PlacedDisk> all;
  for (const auto& size : by_size(pieces, largest)) {
    if (size.empty()) continue;
    double widest = 0;
    for (const int32_t i : size) widest = std::max(widest, pieces[i].spacing);
    const Grid grid = make_grid(surface, fixed, scale * widest);
    require_range(grid, surface);
    const auto first = numbered(pieces, size, darts * kPacking / (scale * scale), seed);
    if (first.back() == 0) continue;
    const auto placed =
        one_size({surface, pieces, size, first, seed}, grid, scale, there, walls, run);
    for (const PlacedDisk& disk : placed) there.push_back(disk.disk);
    all.insert(all.end(), placed.begin(), placed.end());
  }
  return all;
}

}  // namespace medial
