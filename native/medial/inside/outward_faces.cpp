// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside/outward_faces.h"

#include <algorithm>

#include "base/rows.h"
#include "inside/face_patches.h"
#include "inside/sky_votes.h"
#include "inside/surface.h"

namespace medial {
namespace {

// Where more than this share of a patch's area looks to the other side than the rest, its faces do
// not say which side is meant.
constexpr double kDiffering = 0.25;  // chosen: unseen

// The sides to which the faces of a patch look as they were given.
struct GivenSides {
  double front = 0, back = 0;  // area

  bool differ() const { return std::min(front, back) > kDiffering * (front + back); }
  bool to_the_back() const { return back > front; }
};

std::vector<GivenSides> given_sides(const FacePatches& patches, std::span<const Vec3> vertices) {
  std::vector<GivenSides> sides(static_cast<size_t>(patches.count));
  for (size_t face = 0; face < patches.faces.size(); ++face) {
    if (!patches.counts(face)) continue;
    const auto& [a, b, c] = patches.faces[face];
    const double area = length(cross(vertices[b] - vertices[a], vertices[c] - vertices[a]));
    GivenSides& given = sides[patches.patch[face]];
    (patches.turned[face] != 0 ? given.back : given.front) += area;
  }
  return sides;
}

// Returns whether every patch encloses a volume that is not negative.
bool enclose(const FacePatches& patches, std::span<const Vec3> vertices) {
  std::vector<double> volume(static_cast<size_t>(patches.count));
  std::vector<int32_t> origin(volume.size(), -1);
  for (size_t face = 0; face < patches.faces.size(); ++face) {
    if (!patches.counts(face)) continue;
    const auto& [a, b, c] = patches.faces[face];
    int32_t& first = origin[patches.patch[face]];
    if (first < 0) first = a;
    const Vec3& o = vertices[first];
    volume[patches.patch[face]] += dot(vertices[a] - o, cross(vertices[b] - o, vertices[c] - o));
  }
  return std::all_of(volume.begin(), volume.end(), [](double v) { return v >= 0; });
}

// Returns whether most of the area that rays decide about looks inward as it was given.
bool most_look_inward(std::span<const SkyVotes> votes, std::span<const GivenSides> given) {
  double inward = 0, outward = 0;
  for (size_t p = 0; p < votes.size(); ++p) {
    if (!votes[p].decided() || given[p].differ()) continue;
    const bool to_the_sky = given[p].to_the_back() == (votes[p].back > votes[p].front);
    (to_the_sky ? outward : inward) += given[p].front + given[p].back;
  }
  return inward > outward;
}

// Returns whether a patch has its outside at the back. The faces of an open patch, which may be a
// sheet in front of another, are trusted more than rays that are in doubt.
bool outside_is_back(const SkyVotes& votes, const GivenSides& given, bool open, bool most_inward) {
  const bool trusted = open && !given.differ();
  if (trusted ? votes.clear() : votes.decided()) return votes.back > votes.front;
  if (given.differ() && votes.even_back != votes.even_front) {
    return votes.even_back > votes.even_front;
  }
  return given.to_the_back() != most_inward;
}

OutwardFaces as_given(std::span<const Triangle> triangles, int32_t patches) {
  return {{triangles.begin(), triangles.end()},
          std::vector<FaceReading>(triangles.size(), FaceReading::as_given),
          patches,
          0};
}

// Turns the faces of the patches whose outside is at their back, and leaves out what counts for
// nothing.
OutwardFaces turned(std::span<const Triangle> triangles, const FacePatches& patches,
                    std::span<const int32_t> vertex_of_row, std::span<const uint8_t> back) {
  OutwardFaces result = as_given(triangles, patches.count);
  for (size_t face = 0; face < triangles.size(); ++face) {
    Triangle& t = result.triangles[face];
    if (!patches.counts(face)) {
      const bool corners =
          has_three_corners({vertex_of_row[t[0]], vertex_of_row[t[1]], vertex_of_row[t[2]]});
      result.reading[face] = corners ? FaceReading::repeated : FaceReading::without_corners;
      if (corners) t.fill(t[0]);
    } else if (patches.turned[face] != back[patches.patch[face]]) {
      result.reading[face] = FaceReading::turned;
      std::swap(t[1], t[2]);
    }
  }
  return result;
}

OutwardFaces turned_outward(std::span<const Triangle> triangles, const DistinctRows& distinct,
                            Repeated repeated, const Run& run) {
  const auto& points = distinct.points;
  const auto patches =
      face_patches(triangles, distinct.point_of_row, distinct.count(), repeated, run);
  const auto given = given_sides(patches, points);
  const auto votes = sky_votes(patches, points, run);
  const bool most_inward = most_look_inward(votes, given);
  std::vector<uint8_t> back;
  for (size_t p = 0; p < votes.size(); ++p) {
    back.push_back(outside_is_back(votes[p], given[p], patches.open[p] != 0, most_inward) ? 1 : 0);
  }
  OutwardFaces result = turned(triangles, patches, distinct.point_of_row, back);
  result.unseen = static_cast<int32_t>(
      std::count_if(votes.begin(), votes.end(), [](const auto& v) { return !v.decided(); }));
  return result;
}

bool repeats(const OutwardFaces& faces) {
  return std::find(faces.reading.begin(), faces.reading.end(), FaceReading::repeated) !=
         faces.reading.end();
}

bool leaves_faces(const OutwardFaces& faces) {
  return std::any_of(faces.reading.begin(), faces.reading.end(),
                     [](FaceReading reading) { return reading <= FaceReading::turned; });
}

}  // namespace

OutwardFaces outward_faces(std::span<const Vec3> rows, std::span<const Triangle> triangles,
                           const Run& run) {
  begin_stage(run.progress, "Faces", 0, 1);
  require_corners(triangles, rows.size());
  const DistinctRows distinct = distinct_rows(rows, "point", run);
  const auto patches =
      face_patches(triangles, distinct.point_of_row, distinct.count(), Repeated::all, run);
  if (patches.closed && enclose(patches, distinct.points)) {
    return as_given(triangles, patches.count);
  }
  OutwardFaces best = as_given(triangles, patches.count);
  const auto open_edges_of = [&](std::span<const Triangle> faces) {
    return make_surface(faces, distinct.point_of_row, distinct.count(), run).open_edges();
  };
  int64_t open = open_edges_of(triangles);
  for (const Repeated repeated : {Repeated::first, Repeated::first_of_odd}) {
    OutwardFaces read = turned_outward(triangles, distinct, repeated, run);
    const int64_t now_open = open_edges_of(read.triangles);
    const bool last = now_open == 0 || !repeats(read);
    if (!leaves_faces(read)) break;
    if (now_open < open || (now_open == open && repeated == Repeated::first)) {
      best = std::move(read);
      open = now_open;
    }
    if (last) break;
  }
  advance(run.progress, 1);
  return best;
}

}  // namespace medial
