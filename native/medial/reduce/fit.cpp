// SPDX-License-Identifier: GPL-3.0-or-later
// Fits spheres by the Gauss-Newton method: the distance of a place to the nearest ball of a slab is
// linear, to first order, in the spheres of the slab. Distant places get more weight, because the
// largest distance shall decrease. No sphere goes farther than a share of its radius, because one
// at a rim would else run away as a spike for the sake of a few places.
#include "reduce/fit.h"

#include <cmath>

#include "base/parallel.h"
#include "reduce/envelope.h"

namespace medial {
namespace {

constexpr int kSteps = 12;
constexpr int kHalvings = 3;
constexpr int kSolverSteps = 100;
constexpr double kDamping = 0.1;  // share of its weight that holds a sphere; chosen: axis
constexpr double kExact = 1e-9;   // of the extent; smaller distances need no fit; derived: rounding
constexpr double kReach = 0.5;    // share of its radius by which a sphere may change; chosen: axis

// per sphere: steps of the centre and of the radius
using Step = std::vector<std::array<double, 4>>;

// Holds a linear system, its matrix and right-hand side: the demand of the places that are nearest
// to one part on the spheres of this part.
struct Demand {
  std::array<std::array<double, 12>, 12> matrix{};
  std::array<double, 12> right{};
};

double dot4(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

double dot_all(const Step& a, const Step& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += dot4(a[i], b[i]);
  return sum;
}

class Fitter {
 public:
  Fitter(SphereMesh& mesh, std::span<const TangentPlace> places, const Run& run)
      : mesh_(mesh),
        first_(mesh),
        places_(places),
        run_(run),
        envelope_(mesh),
        found_(places.size()) {
    for (const Triangle& t : mesh_.triangles) normals_.push_back(normal(t));
  }

  bool fit() {
    double now = measure();
    if (!(largest_ > kExact)) return false;
    bool moved = false;
    for (int i = 0; i < kSteps; ++i) {
      advance(run_.progress, static_cast<double>(i) / kSteps);
      const double before = now;
      now = improve(solve(demands()), now);
      moved |= now < before;
      if (!(now < 0.99 * before)) break;
    }
    return moved;
  }

 private:
  // Returns the sum of weighted fourth powers of distances.
  double measure() {
    envelope_.refit();
    parallel_for(
        static_cast<int64_t>(places_.size()), {run_.threads},
        [&](int64_t i) { found_[i] = envelope_.find(places_[i].point, found_[i].part); }, 256);
    double sum = 0;
    largest_ = square_ = weight_ = 0;
    for (size_t i = 0; i < places_.size(); ++i) {
      const double d = found_[i].nearest.distance, squared = d * d;
      sum += places_[i].area * squared * squared;
      square_ += places_[i].area * squared;
      weight_ += places_[i].area;
      largest_ = std::max(largest_, std::abs(d));
    }
    return sum;
  }

  std::vector<Demand> demands() const {
    const double mean = square_ / weight_;
    std::vector<Demand> result(envelope_.parts().size());
    for (size_t i = 0; i < places_.size(); ++i) {
      const auto& [nearest, part] = found_[i];
      const Part& of = envelope_.parts()[part];
      Vec3 centre;
      for (int k = 0; k < 3; ++k) {
        if (of[k] >= 0) centre = centre + nearest.shares[k] * mesh_.vertices[of[k]];
      }
      const Vec3 away = normalized(places_[i].point - centre);
      // gradient of minus the distance
      const std::array<double, 4> slope{away.x, away.y, away.z, 1};
      const double d = nearest.distance, weight = places_[i].area * (mean / 4 + d * d);
      std::array<double, 12> row;
      for (int k = 0; k < 12; ++k) row[k] = nearest.shares[k / 4] * slope[k % 4];
      Demand& demand = result[part];
      for (int k = 0; k < 12; ++k) {
        demand.right[k] += weight * d * row[k];
        for (int l = 0; l < 12; ++l) demand.matrix[k][l] += weight * row[k] * row[l];
      }
    }
    return result;
  }

  // Returns the step that meets the demands of all parts together, damped where they are weak.
  Step solve(const std::vector<Demand>& demands) const {
    const auto parts = envelope_.parts();
    const size_t n = mesh_.vertices.size();
    Step right(n);
    std::vector<double> weight(n, 0);
    double whole = 0;
    for (size_t p = 0; p < parts.size(); ++p) {
      for (int k = 0; k < 12; ++k) {
        const int32_t v = parts[p][k / 4];
        if (v < 0) continue;
        right[v][k % 4] += demands[p].right[k];
        weight[v] += demands[p].matrix[k][k];
        whole += demands[p].matrix[k][k];
      }
    }
    const double floor = 1e-6 * whole / static_cast<double>(n);
    const auto apply = [&](const Step& x) {
      Step y(n);
      for (size_t v = 0; v < n; ++v) {
        for (int c = 0; c < 4; ++c) y[v][c] = (kDamping * weight[v] + floor) * x[v][c];
      }
      for (size_t p = 0; p < parts.size(); ++p) {
        for (int k = 0; k < 12; ++k) {
          if (parts[p][k / 4] < 0) continue;
          double sum = 0;
          for (int l = 0; l < 12; ++l) {
            const int32_t v = parts[p][l / 4];
            if (v >= 0) sum += demands[p].matrix[k][l] * x[v][l % 4];
          }
          y[parts[p][k / 4]][k % 4] += sum;
        }
      }
      return y;
    };
    return conjugate_gradients(apply, right);
  }

  template <typename Apply>
  Step conjugate_gradients(const Apply& apply, const Step& right) const {
    const size_t n = right.size();
    Step x(n), rest = right, direction = rest;
    double squared = dot_all(rest, rest);
    const double enough = 1e-8 * squared;
    for (int i = 0; i < kSolverSteps && squared > enough; ++i) {
      throw_if_cancelled(run_.progress);
      const Step image = apply(direction);
      const double length = squared / dot_all(direction, image);
      for (size_t v = 0; v < n; ++v) {
        for (int c = 0; c < 4; ++c) {
          x[v][c] += length * direction[v][c];
          rest[v][c] -= length * image[v][c];
        }
      }
      const double next = dot_all(rest, rest), share = next / squared;
      squared = next;
      for (size_t v = 0; v < n; ++v) {
        for (int c = 0; c < 4; ++c) direction[v][c] = rest[v][c] + share * direction[v][c];
      }
    }
    return x;
  }

  Vec3 normal(const Triangle& t) const {
    const Vec3& a = mesh_.vertices[t[0]];
    return cross(mesh_.vertices[t[1]] - a, mesh_.vertices[t[2]] - a);
  }

  // Moves the corners of triangles that would have turned over back to where they were. Each round
  // stops more of them, so it ends.
  void stop_turning(const auto& vertices, const auto& radius) {
    for (bool again = true; again;) {
      again = false;
      for (size_t t = 0; t < mesh_.triangles.size(); ++t) {
        const Triangle& corners = mesh_.triangles[t];
        if (normals_[t] == Vec3{} || dot(normals_[t], normal(corners)) > 0) continue;
        for (const int32_t v : corners) {
          again |= mesh_.vertices[v] != vertices[v];
          mesh_.vertices[v] = vertices[v];
          mesh_.radius[v] = radius[v];
        }
      }
    }
  }

  // Puts a sphere where it is wanted, or as near to that as it may go.
  void place(size_t v, const Sphere& wanted) {
    const Vec3 moved = wanted.centre - first_.vertices[v];
    const double grown = wanted.radius - first_.radius[v];
    const double change = std::sqrt(squared_length(moved) + grown * grown);
    const double most = kReach * first_.radius[v];
    const double share = change > most ? most / change : 1;
    mesh_.vertices[v] = first_.vertices[v] + share * moved;
    mesh_.radius[v] = first_.radius[v] + share * grown;
  }

  // Takes the whole step, or a half or a quarter of it, and returns the new measure.
  double improve(const Step& step, double now) {
    const auto vertices = mesh_.vertices;
    const auto radius = mesh_.radius;
    double share = 1;
    for (int i = 0; i < kHalvings; ++i, share /= 2) {
      for (size_t v = 0; v < vertices.size(); ++v) {
        const auto& [x, y, z, r] = step[v];
        place(v, {vertices[v] + share * Vec3{x, y, z}, radius[v] + share * r});
      }
      stop_turning(vertices, radius);
      if (const double then = measure(); then < now) return then;
    }
    mesh_.vertices = vertices;
    mesh_.radius = radius;
    return now;
  }

  SphereMesh& mesh_;
  SphereMesh first_;  // before anything moved
  std::span<const TangentPlace> places_;
  Run run_;
  Envelope envelope_;
  std::vector<Envelope::Found> found_;
  std::vector<Vec3> normals_;  // normals of the triangles before anything moved
  double largest_ = 0, square_ = 0, weight_ = 0;
};

}  // namespace

bool fit_spheres(SphereMesh& mesh, std::span<const TangentPlace> places, const Run& run) {
  if (places.empty() || mesh.vertices.empty()) return false;
  return Fitter(mesh, places, run).fit();
}

}  // namespace medial
