// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/part_places.h"

#include <algorithm>
#include <memory>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "base/rounding.h"
#include "base/rows.h"
#include "base/sort_unique.h"
#include "inside/meeting.h"
#include "inside/surface.h"
#include "inside/winding_number.h"

namespace medial {
namespace {

constexpr double kAside = 4;              // places are as far behind their face; chosen: unseen
constexpr size_t kFaces = 64;             // of a part that are tested
constexpr double kFromCorner = 1.0 / 64;  // of the way to the middle; chosen: unseen
constexpr double kBounding = 0.75;  // of the area of an open part that is no sheet; chosen: unseen
constexpr double kGolden = std::numbers::phi;

bool meet(const Box& s, const Box& t) {
  return s.low.x <= t.high.x && t.low.x <= s.high.x && s.low.y <= t.high.y && t.low.y <= s.high.y &&
         s.low.z <= t.high.z && t.low.z <= s.high.z;
}

bool holds(const Box& whole, const Box& box) {
  return whole.low.x <= box.low.x && whole.low.y <= box.low.y && whole.low.z <= box.low.z &&
         box.high.x <= whole.high.x && box.high.y <= whole.high.y && box.high.z <= whole.high.z;
}

// Finds which of some boxes meet another box.
class BoxTree {
 public:
  // Items without a box have an empty one.
  explicit BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
    items_ =
        rows_where(boxes_.size(), [&](int32_t i) { return boxes_[i].low.x <= boxes_[i].high.x; });
    nodes_ = tree_of_boxes(items_, [&](int32_t i) { return boxes_[i]; });
  }

  const Box& operator[](int32_t item) const { return boxes_[item]; }
  std::span<const int32_t> items() const { return items_; }

  // Calls use(item) for the boxes that meet a box, until it returns true; returns whether it did.
  template <typename Use>
  bool any_met(const Box& box, const Use& use, int32_t id = 0) const {
    if (nodes_.empty() || !meet(nodes_[id].box, box)) return false;
    const BoxNode& node = nodes_[id];
    if (!node.is_leaf()) return any_met(box, use, id + 1) || any_met(box, use, node.right);
    for (int32_t i = node.begin; i < node.end; ++i) {
      if (meet(boxes_[items_[i]], box) && use(items_[i])) return true;
    }
    return false;
  }

 private:
  std::vector<Box> boxes_;
  std::vector<int32_t> items_;
  std::vector<BoxNode> nodes_;
};

using Pair = std::pair<int32_t, int32_t>;

class PlacesOfParts {
 public:
  PlacesOfParts(std::span<const Vec3> rows, std::span<const Triangle> triangles,
                const MeshParts& parts, const Run& run)
      : rows_(rows), triangles_(triangles), parts_(parts), run_(run), windings_(parts.count) {
    places_.assign(static_cast<size_t>(parts.count), PartPlace::apart);
    together_ = rounding_of(rows);
    faces_.resize(static_cast<size_t>(parts.count));
    for (size_t face = 0; face < triangles.size(); ++face) {
      if (parts.part[face] >= 0) faces_[parts.part[face]].push_back(static_cast<int32_t>(face));
    }
    for (const auto& faces : faces_) inward_.push_back(volume_of(faces) < 0);
  }

  std::vector<PartPlace> find() {
    mark_sheets();
    const BoxTree boxes(boxes_of_parts());
    const std::vector<Pair> touching = meetings(boxes);
    for (const auto& [p, q] : touching) settle(p, q);
    for (const int32_t p : boxes.items()) {
      if (places_[p] < PartPlace::within && lies_in_one(p, boxes, touching)) {
        places_[p] = PartPlace::within;
      }
    }
    return std::move(places_);
  }

 private:
  Corners corners(int32_t face) const {
    const auto& [a, b, c] = triangles_[face];
    return {rows_[a], rows_[b], rows_[c]};
  }

  // Returns the box of a face with room for what is together with it.
  Box box_of_face(int32_t face) const {
    const auto& [a, b, c] = corners(face);
    Box box;
    for (const Vec3& p : {a, b, c}) box.add(p);
    const Vec3 room{together_, together_, together_};
    return {box.low - room, box.high + room};
  }

  void mark_sheets() {
    parallel_for(
        parts_.count, run_,
        [&](int64_t p) {
          if (parts_.flat[p] || (parts_.open[p] && !bounds_a_solid(static_cast<int32_t>(p)))) {
            places_[p] = PartPlace::sheet;
          }
        },
        1);
  }

  std::vector<Box> boxes_of_parts() const {
    std::vector<Box> boxes(places_.size());
    for (size_t p = 0; p < boxes.size(); ++p) {
      if (places_[p] == PartPlace::sheet) continue;
      for (const int32_t face : faces_[p]) boxes[p].add(box_of_face(face));
    }
    return boxes;
  }

  // Returns the boxes of the faces that may meet another part.
  BoxTree faces_near_others(const BoxTree& boxes) const {
    std::vector<Box> near(triangles_.size());
    parallel_for(static_cast<int64_t>(near.size()), run_, [&](int64_t id) {
      const auto face = static_cast<int32_t>(id);
      const int32_t p = parts_.part[face];
      if (p < 0 || places_[p] == PartPlace::sheet) return;
      const Box box = box_of_face(face);
      if (boxes.any_met(box, [&](int32_t q) { return q != p; })) near[id] = box;
    });
    return BoxTree(std::move(near));
  }

  // Marks parts that pass through each other; returns, in order, the pairs of others that touch.
  std::vector<Pair> meetings(const BoxTree& boxes) {
    const auto has_neighbour = [&](int32_t p) {
      return boxes.any_met(boxes[p], [&](int32_t q) { return q != p; });
    };
    if (std::none_of(boxes.items().begin(), boxes.items().end(), has_neighbour)) return {};
    const BoxTree near = faces_near_others(boxes);
    std::vector<std::atomic<uint8_t>> crossed(places_.size());
    // A pair is only left out if both parts are known to pass through others, so the result does
    // not depend on what is known when.
    const auto are_known = [&](int32_t p, int32_t q) {
      return crossed[p].load(std::memory_order_relaxed) &&
             crossed[q].load(std::memory_order_relaxed);
    };
    auto touching = parallel_append<Pair>(
        static_cast<int64_t>(near.items().size()), run_,
        [&](int64_t i, std::vector<Pair>& out, int) {
          const int32_t face = near.items()[i], p = parts_.part[face];
          near.any_met(near[face], [&](int32_t other) {
            const int32_t q = parts_.part[other];
            if (q <= p || are_known(p, q)) return false;
            const TriangleMeeting found = meeting_of(corners(face), corners(other), together_);
            if (found == TriangleMeeting::crossed) crossed[p] = crossed[q] = 1;
            if (found == TriangleMeeting::touch) out.emplace_back(p, q);
            return false;
          });
        });
    for (size_t p = 0; p < places_.size(); ++p) {
      if (crossed[p]) places_[p] = PartPlace::overlapping;
    }
    sort_unique(touching);
    std::erase_if(touching, [&](const Pair& pair) { return are_known(pair.first, pair.second); });
    return touching;
  }

  // Finds what two parts share that touch, and whose faces may coincide.
  void settle(int32_t p, int32_t q) {
    const double of_p = share_inside(p, q), of_q = share_inside(q, p);
    const auto raise = [&](int32_t part, PartPlace to) {
      places_[part] = std::max(places_[part], to);
    };
    if (of_p == 1 || of_q == 1) {
      raise(of_p == 1 ? p : q, PartPlace::within);
      return;
    }
    const PartPlace both = of_p > 0 || of_q > 0 ? PartPlace::overlapping : PartPlace::touching;
    raise(p, both);
    raise(q, both);
  }

  bool lies_in_one(int32_t p, const BoxTree& boxes, const std::vector<Pair>& touching) {
    const auto places = places_behind(p, 1);
    return boxes.any_met(boxes[p], [&](int32_t q) {
      const Pair pair = std::minmax(p, q);
      return q != p && holds(boxes[q], boxes[p]) && !places.empty() &&
             !std::binary_search(touching.begin(), touching.end(), pair) &&
             is_inside(winding(q), places[0]);
    });
  }

  // Returns the share of the places of a part that lie in another one.
  double share_inside(int32_t p, int32_t q) {
    const auto places = places_behind(p, kFaces);
    const WindingNumber& winding_of_q = winding(q);
    const auto inside = std::count_if(places.begin(), places.end(), [&](const Vec3& place) {
      return is_inside(winding_of_q, place);
    });
    return places.empty() ? 0 : static_cast<double>(inside) / static_cast<double>(places.size());
  }

  // Returns places behind the middles and close to the corners of some faces of a part.
  std::vector<Vec3> places_behind(int32_t p, size_t most) const {
    const double aside = inward_[p] ? -kAside * together_ : kAside * together_;
    std::vector<Vec3> places;
    for_some_faces(p, most, [&](const Corners& t, const Vec3& middle, const Vec3& area) {
      const Vec3 behind = aside * normalized(area);
      places.push_back(middle - behind);
      for (const Vec3& corner : {t.a, t.b, t.c}) {
        places.push_back(corner + kFromCorner * (middle - corner) - behind);
      }
    });
    return places;
  }

  // Calls use(corners, middle, area vector) for all faces of a part, or some that are spread over
  // their list; no pattern in the list is as irregular as the golden ratio.
  template <typename Use>
  void for_some_faces(int32_t p, size_t most, const Use& use) const {
    const auto& faces = faces_[p];
    const size_t count = std::min(most, faces.size());
    const auto size = static_cast<double>(faces.size());
    for (size_t i = 0; i < count; ++i) {
      const double turns = kGolden * static_cast<double>(i);
      const auto at = static_cast<size_t>(size * (turns - std::floor(turns)));
      const Corners t = corners(faces[count == faces.size() ? i : at]);
      const Vec3 area = 0.5 * cross(t.b - t.a, t.c - t.a);
      if (area != Vec3{}) use(t, (1.0 / 3) * (t.a + t.b + t.c), area);
    }
  }

  // Returns the centre of the area of faces, which is no corner of them.
  Vec3 middle_of(std::span<const int32_t> faces) const {
    const Vec3& from = rows_[triangles_[faces.front()][0]];
    Vec3 sum;
    double whole = 0;
    for (const int32_t face : faces) {
      const auto& [a, b, c] = corners(face);
      const double area = length(cross(b - a, c - a));
      sum = sum + (area / 3) * ((a - from) + (b - from) + (c - from));
      whole += area;
    }
    return whole > 0 ? from + (1 / whole) * sum : from;
  }

  // Returns what a cone from there to the faces holds; negative where they look inward.
  double volume_of(std::span<const int32_t> faces) const {
    const Vec3 origin = middle_of(faces);
    double volume = 0;
    for (const int32_t face : faces) {
      const auto& [a, b, c] = corners(face);
      volume += dot(a - origin, cross(b - origin, c - origin)) / 6;
    }
    return volume;
  }

  // Returns whether most faces of a part separate what is inside from what is not.
  bool bounds_a_solid(int32_t p) const {
    const auto winding = make_winding(p);
    double bounding = 0, whole = 0;
    for_some_faces(p, kFaces, [&](const Corners&, const Vec3& middle, const Vec3& area) {
      const Vec3 aside = kAside * together_ * normalized(area);
      const bool bounds =
          is_inside(*winding, middle - aside) != is_inside(*winding, middle + aside);
      whole += length(area);
      if (bounds) bounding += length(area);
    });
    return bounding >= kBounding * whole;
  }

  static bool is_inside(const WindingNumber& winding, const Vec3& place) {
    return winding.is_inside(place, winding.closed(place));
  }

  const WindingNumber& winding(int32_t p) {
    if (!windings_[p]) windings_[p] = make_winding(p);
    return *windings_[p];
  }

  // Returns the winding number of a part alone, turned outward.
  std::unique_ptr<WindingNumber> make_winding(int32_t p) const {
    std::vector<Vec3> points;
    std::vector<Triangle> own;
    for (const int32_t face : faces_[p]) {
      auto [a, b, c] = corners(face);
      if (inward_[p]) std::swap(b, c);
      const auto next = static_cast<int32_t>(points.size());
      points.insert(points.end(), {a, b, c});
      own.push_back({next, next + 1, next + 2});
    }
    const Run alone;
    const DistinctRows distinct = distinct_rows(points, "point", alone);
    const Surface surface = make_surface(own, distinct.point_of_row, distinct.count(), alone);
    return std::make_unique<WindingNumber>(distinct.points, surface.triangles, surface.boundary,
                                           nullptr);
  }

  std::span<const Vec3> rows_;
  std::span<const Triangle> triangles_;
  const MeshParts& parts_;
  const Run& run_;
  std::vector<std::unique_ptr<WindingNumber>> windings_;
  std::vector<PartPlace> places_;
  std::vector<std::vector<int32_t>> faces_;  // of each part
  std::vector<uint8_t> inward_;              // whether those of a part look inward
  double together_ = 0;  // corners that are no farther from each other are at one place
};

}  // namespace

std::vector<PartPlace> part_places(std::span<const Vec3> rows, std::span<const Triangle> triangles,
                                   const MeshParts& parts, const Run& run) {
  return PlacesOfParts(rows, triangles, parts, run).find();
}

}  // namespace medial
