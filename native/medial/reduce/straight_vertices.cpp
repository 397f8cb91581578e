// SPDX-License-Identifier: GPL-3.0-or-later
#include "reduce/straight_vertices.h"

#include <algorithm>

#include "base/vec3.h"
#include "reduce/sheet_locks.h"

namespace medial {
namespace {

class StraightVertices {
 public:
  StraightVertices(const SphereMesh& mesh, std::vector<FlatFace>& faces)
      : mesh_(mesh), faces_(faces), faces_at_(mesh.vertices.size()) {
    for (size_t f = 0; f < faces.size(); ++f) {
      for (const int32_t v : faces[f].corners) faces_at_[v].push_back(static_cast<int32_t>(f));
    }
    for (const Edge& wire : mesh.wires) {
      for (const int32_t v : wire) faces_at_[v].clear();
    }
  }

  // Takes the vertices out of the polygons, and returns a mark per vertex.
  std::vector<uint8_t> leave_out() {
    std::vector<uint8_t> marks(faces_at_.size(), 0);
    for (size_t v = 0; v < marks.size(); ++v) {
      if (!may_go(static_cast<int32_t>(v))) continue;
      marks[v] = 1;
      for (const int32_t f : faces_at_[v]) std::erase(faces_[f].corners, static_cast<int32_t>(v));
    }
    return marks;
  }

 private:
  // Returns the corners before and after a vertex of a polygon, the lower one first.
  Edge beside(int32_t face, int32_t v) const {
    const auto& corners = faces_[face].corners;
    const auto at = std::find(corners.begin(), corners.end(), v) - corners.begin();
    const auto count = static_cast<std::ptrdiff_t>(corners.size());
    const int32_t before = corners[(at + count - 1) % count], after = corners[(at + 1) % count];
    return {std::min(before, after), std::max(before, after)};
  }

  bool may_go(int32_t v) const {
    if (faces_at_[v].empty()) return false;
    const Edge ends = beside(faces_at_[v].front(), v);
    for (const int32_t f : faces_at_[v]) {
      if (faces_[f].corners.size() < 4 || beside(f, v) != ends) return false;
    }
    return is_straight(v, ends);
  }

  bool is_straight(int32_t v, const Edge& ends) const {
    const Vec3& start = mesh_.vertices[ends[0]];
    const Vec3 along = mesh_.vertices[ends[1]] - start, to = mesh_.vertices[v] - start;
    const double share = dot(to, along) / squared_length(along);
    const double radius = (1 - share) * mesh_.radius[ends[0]] + share * mesh_.radius[ends[1]];
    return share > 0 && share < 1 && length(to - share * along) <= kNoDistance &&
           std::abs(radius - mesh_.radius[v]) <= kNoDistance;
  }

  const SphereMesh& mesh_;
  std::vector<FlatFace>& faces_;
  std::vector<std::vector<int32_t>> faces_at_;  // none at a vertex of a wire
};

}  // namespace

void leave_out_straight_vertices(SphereMesh& mesh, std::vector<FlatFace>& faces,
                                 std::vector<int32_t>& row) {
  const std::vector<uint8_t> left_out = StraightVertices(mesh, faces).leave_out();
  std::vector<int32_t> number(row.size(), -1);
  int32_t left = 0;
  for (size_t v = 0; v < row.size(); ++v) {
    if (left_out[v] != 0) continue;
    mesh.vertices[left] = mesh.vertices[v];
    mesh.radius[left] = mesh.radius[v];
    row[left] = row[v];
    number[v] = left++;
  }
  mesh.vertices.resize(left);
  mesh.radius.resize(left);
  row.resize(left);
  for (FlatFace& face : faces) {
    for (int32_t& v : face.corners) v = number[v];
  }
  for (Edge& wire : mesh.wires) wire = {number[wire[0]], number[wire[1]]};
}

}  // namespace medial
