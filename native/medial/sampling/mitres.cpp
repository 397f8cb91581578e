// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/mitres.h"

#include "sampling/flat_parts.h"

namespace medial {
namespace {

// A crease continues where a shared normal would bend an edge by more than the height of a triangle
// next to it, along an edge that leaves all others at most this much of that.
constexpr double kStraight = 0.2;  // chosen: unseen
// A mitre ends where its turn falls below a tenth from one edge to the next, as on a flat face.
constexpr double kFlat = 0.1;  // chosen: unseen

// The triangles around a vertex, from a spoke on: each lies between its spoke and the next one.
struct Ring {
  std::vector<int32_t> triangles, spokes;  // the spokes are vertices
  std::vector<Vec3> normals;               // weighted by the angles at the vertex
};

// One of the edges along which the crease may go on.
struct Onward {
  int32_t edge = -1, to = -1;
  double rise = 0, share = 0;  // what bends still, and the turn by that of the edge before
};

class Mitres {
 public:
  Mitres(const TriangleMesh& mesh, Creases& creases)
      : mesh_(mesh), creases_(creases), creases_at_(creases_at_points(mesh, creases)) {}

  void mark() {
    for (const int32_t e : crease_edges(creases_)) {
      for (const int32_t end : creases_.edges[e].ends) follow(e, end);
    }
  }

 private:
  // Marks the edges along which a crease goes on from one of its ends. The turn of a mitre is that
  // of the walls times the cosine of the slope of a row, so it falls by ever larger ratios.
  void follow(int32_t crease, int32_t from) {
    for (double share = 1; creases_at_[from] == 1 && creases_.edges[crease].manifold;) {
      const Onward next = onward(crease, from, share);
      if (next.edge < 0) return;
      creases_.edges[next.edge].crease = Crease::sharp;
      for (const int32_t end : creases_.edges[next.edge].ends) ++creases_at_[end];
      crease = next.edge;
      from = next.to;
      share = next.share;
    }
  }
  // Returns the edge that leaves least bending if both sides of it have normals of their own; none
  // if a shared normal bends no edge too far.
  Onward onward(int32_t crease, int32_t at, double most) const {
    const Ring ring = ring_at(crease, at);
    Onward best;
    if (rise(ring, at, ring.spokes.size()) <= 1) return {};
    best.rise = kStraight;
    for (size_t i = 1; i < ring.spokes.size(); ++i) {
      const int32_t e = creases_.find(at, ring.spokes[i]);
      const double share = turn(creases_.edges[e]) / turn(creases_.edges[crease]);
      if (creases_.edges[e].crease != Crease::none || !(share > kFlat && share <= most)) continue;
      const double left = rise(ring, at, i);
      if (left < best.rise) best = {e, ring.spokes[i], left, share};
    }
    return best;
  }
  // Returns the triangles around a vertex from a crease on; none if they do not form a disc.
  Ring ring_at(int32_t crease, int32_t at) const {
    Ring ring;
    const auto fan = mesh_.fans[at];
    int32_t t = creases_.edges[crease].triangles[0], spoke = other_end(creases_.edges[crease], at);
    while (ring.triangles.size() < fan.size()) {
      const Triangle& corners = mesh_.triangles[t];
      ring.triangles.push_back(t);
      ring.spokes.push_back(spoke);
      ring.normals.push_back(mesh_.corner_angle(t, corner_of(corners, at)) * mesh_.normal[t]);
      spoke = corners[0] + corners[1] + corners[2] - at - spoke;
      const int32_t e = creases_.find(at, spoke);
      if (e == crease && ring.triangles.size() == fan.size()) return ring;
      if (e == crease || !creases_.edges[e].manifold) break;
      const Edge& both = creases_.edges[e].triangles;
      t = both[both[0] == t];
    }
    return {};
  }
  // Returns the most by which an edge rises by the height of a triangle beside it, where the normal
  // is one before a spoke and another from there on.
  double rise(const Ring& ring, int32_t at, size_t split) const {
    Vec3 before, after;
    for (size_t i = 0; i < ring.normals.size(); ++i) {
      (i < split ? before : after) = (i < split ? before : after) + ring.normals[i];
    }
    double most = 0;
    for (size_t i = 1; i < ring.spokes.size(); ++i) {
      if (i == split) continue;
      const Vec3 chord = mesh_.points[ring.spokes[i]] - mesh_.points[at];
      const double height = std::min(reach_from(mesh_, ring.triangles[i - 1], {at, ring.spokes[i]}),
                                     reach_from(mesh_, ring.triangles[i], {at, ring.spokes[i]}));
      const double up = std::abs(dot(chord, normalized(i < split ? before : after))) / 3;
      if (up > most * height) most = height > 0 ? up / height : HUGE_VAL;
    }
    return most;
  }
  // Returns the distance between the normals next to an edge, negative where it is concave.
  double turn(const MeshEdge& edge) const {
    const auto& [s, t] = edge.triangles;
    const Triangle& beyond = mesh_.triangles[t];
    const int32_t far = beyond[0] + beyond[1] + beyond[2] - edge.ends[0] - edge.ends[1];
    const bool concave = dot(mesh_.normal[s], mesh_.points[far] - mesh_.points[edge.ends[0]]) > 0;
    const double turn = distance(mesh_.normal[s], mesh_.normal[t]);
    return concave ? -turn : turn;
  }

  const TriangleMesh& mesh_;
  Creases& creases_;
  std::vector<int32_t> creases_at_;  // how many creases end at each point
};

}  // namespace

void mark_mitres(const TriangleMesh& mesh, Creases& creases) { Mitres(mesh, creases).mark(); }

}  // namespace medial
